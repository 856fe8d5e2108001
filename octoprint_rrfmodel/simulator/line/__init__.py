"""Channels, what comes in and goes out on USB, and the faults that are on."""
