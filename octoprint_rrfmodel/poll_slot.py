"""What is known of the one poll that may be under way."""


class TooManyQueries(Exception):
    """As many questions as may wait for the slot are waiting."""


class Poll:
    """A request, from OctoPrint's queue to its answer and the M105 behind it."""

    def __init__(self, request, query, is_card, queued_at):
        self.request = request
        self.query = query
        self.is_card = is_card
        self.queued_at = queued_at
        self.sent_at = None
        self.status_sent = False
        self.answered = False

    def is_over(self):
        """Return whether the next poll may leave."""
        # the M105 behind it leaves when OctoPrint has the ok of the poll itself
        return self.answered and self.status_sent
