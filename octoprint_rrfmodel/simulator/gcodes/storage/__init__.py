"""G-codes of the card: its files, and prints from it."""
