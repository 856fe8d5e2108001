"""From a line to the function of its G-code."""
