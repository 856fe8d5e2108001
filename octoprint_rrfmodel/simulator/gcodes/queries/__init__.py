"""G-codes that only tell: reports, the object model, M408."""
