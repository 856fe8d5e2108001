"""Tests of the pure half: no OctoPrint, no serial line."""
