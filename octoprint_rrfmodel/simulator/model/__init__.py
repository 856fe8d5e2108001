"""The object model: put together, shown per firmware version, printed."""
