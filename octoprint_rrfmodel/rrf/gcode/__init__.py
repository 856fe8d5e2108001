"""What is said to a board."""
