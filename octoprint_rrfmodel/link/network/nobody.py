"""What stands for OctoPrint's printer while there is none."""


class Nobody:
    """Has every method that the link calls of a printer, and is interested in nothing."""

    def greeted(self, greeting):
        """A board has said what it is."""

    def log(self, line):
        """A line for the terminal."""

    def heard(self, line):
        """A line that the board has said."""

    def ended(self, code, why):
        """There is no use in going on."""

    def reconnect(self):
        """Connect again."""

    def look(self):
        """The model has changed."""

    def control_job(self, action):
        """Return whether OctoPrint does that to the board's job, which it shows as its own."""
        return False

    def is_printing(self):
        """Return whether OctoPrint shows a print as going on."""
        return False

    def is_paused(self):
        """Return whether OctoPrint shows a print as paused."""
        return False

    def profile(self):
        """Return the printer profile of the connection."""
        return None
