"""The G-codes: a class for each group, which registers its rows in the board's table."""
