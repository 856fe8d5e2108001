"""What the plugin itself asks on the line, from OctoPrint's queue to the acknowledgement."""

POLL, STATUS = "poll", "status"
"""A poll that goes without a status request behind it, and the request behind any other."""


class OwnRequests:
    """Kept by the hooks of a connection; each looks at what another has noted."""

    def __init__(self):
        self.is_alone = False
        """Whether the poll in the queue goes without a status request behind it."""
        self.awaited = None
        """``POLL`` or ``STATUS`` while its acknowledgement is awaited, ``None`` for all else."""
        self.report_elsewhere = False
        """Whether the board would send its reports to another channel: the last that asked it for
        something of the kind was a poll that went alone."""
