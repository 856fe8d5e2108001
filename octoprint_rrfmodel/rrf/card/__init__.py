"""The board's files, and what is said of them."""
