"""What is read of a model."""
