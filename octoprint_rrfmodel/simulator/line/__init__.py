"""Channels and what goes out on USB."""
