"""The G-codes, a module for each group."""
