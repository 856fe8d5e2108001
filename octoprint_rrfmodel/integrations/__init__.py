"""Other plugins: those that are served without being asked, and what they may call."""
