"""Text and bytes of a serial line, and what they say."""
