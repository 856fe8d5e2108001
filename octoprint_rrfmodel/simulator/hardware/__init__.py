"""What a mainboard and its ``config.g`` put into an object model, as data."""
