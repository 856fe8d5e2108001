"""OctoPrint's serial line: hooks, accounting of acknowledgements, card, terminal."""
