"""What belongs to a print from the card: its file, its objects, what is left of it."""
