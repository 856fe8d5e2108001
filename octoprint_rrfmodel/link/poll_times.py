"""When the next poll is due, and whether it asks for the whole or for a part."""

from ..rrf.follow.pace import CATCHING_UP_SECONDS, IDLE_SHARE, PRINTING_SECONDS, SPARING_SHARE
from ..rrf.follow.rows import GAP_SECONDS


class PollTimes:
    """Asks for small parts on a slow line, beside a print within a small share of its time.

    ``follower`` follows the model, ``card`` the card, ``pace`` has measured the line of ``link``.
    """

    def __init__(self, follower, card, link, *, pace):
        self._follower = follower
        self._card = card
        self._link = link
        self._pace = pace

    def choose(self):
        """Decide how the model is asked for from now on."""
        is_free = not self._link.is_streaming_a_print()
        share = IDLE_SHARE if is_free else SPARING_SHARE
        self._follower.spare(self._pace.bytes_a_second, share, is_free)
        self._link.polls_alone = self._follower.is_sparing

    def wait(self, hurries):
        """Return the seconds until the next poll; ``hurries`` where something has happened."""
        if self._follower.is_sparing and not self._pace.has_failed:
            wait = self._follower.rows.wait()
            has_more = self._follower.behind or self._card.behind
            is_hasty = has_more and self._follower.rows.is_free
            return min(wait, CATCHING_UP_SECONDS) if is_hasty else wait
        if hurries:
            return 0.0
        return self._pace.wait(
            self._link.is_streaming_a_print(),
            behind=self._follower.behind or self._card.behind,
            begins=not self._follower.ready,
        )

    def hurry(self):
        """Ask for what matters as soon as may be; return the seconds until then."""
        if not self._follower.is_sparing:
            return 0.0
        self._follower.rows.hurry()
        return GAP_SECONDS

    def interval(self):
        """Return the seconds between two polls as they go now."""
        if self._follower.is_sparing:
            return PRINTING_SECONDS
        return self._pace.wait(self._link.is_streaming_a_print())
