"""What to ask the board next."""
