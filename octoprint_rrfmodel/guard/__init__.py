"""What watches over a print, and what a person is warned of."""
