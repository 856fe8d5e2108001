"""Why nothing came of what was asked of a board's card."""

from .login import Busy, Refused
from .session import SessionLost
from .transport import Unreachable

FAILURES = (Unreachable, SessionLost, Busy, Refused)
"""What says that the board could not be asked."""


class CardRefused(Exception):
    """Nothing was changed or read; ``code`` says why, ``detail`` what it is about."""

    def __init__(self, code, detail=""):
        super().__init__(code)
        self.code = code
        self.detail = detail
