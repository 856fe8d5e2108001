"""What a person is told once, on every open page."""

from ..host.notification_texts import notification_text
from ..rrf.wire.masking import masked


class Notifications:
    """Tells the pages; any thread may call it. ``tell_pages(message)`` reaches them."""

    def __init__(self, tell_pages, clock):
        self._tell_pages = tell_pages
        self._clock = clock

    def tell(self, code, detail=""):
        """Tell of a refusal, or of what has happened; never a password that stands in a command."""
        detail = masked(detail)
        self._tell_pages(
            {
                "type": "notice",
                "code": code,
                "detail": detail,
                "text": notification_text(code, detail),
                "at": round(self._clock(), 3),
            }
        )

    def reset(self):
        """Tell that the board began anew (a listener)."""
        self.tell("board_reset")

    def did_not_come_back(self):
        """Tell that a restart has failed."""
        self.tell("recover_failed")
