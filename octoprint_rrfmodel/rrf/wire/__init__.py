"""Text of the line to values and back."""
