"""OctoPrint itself: its settings, printer profile, permissions, requests, job; sentences."""
