"""What a board does in simulated time."""
