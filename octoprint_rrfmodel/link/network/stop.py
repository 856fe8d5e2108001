"""Stops a board, or restarts it, past everything that waits; on a thread of its own."""

import threading
import time

from .login import Busy, Refused
from .session import SessionLost
from .transport import Unreachable

TRIES = 25

PAUSE_SECONDS = 0.2


def stop(dialect, logger, command="M112"):
    """Send a command of which the board must have one; doesn't wait for it."""
    target = _restart if command == "M999" else _stop
    threading.Thread(
        target=target, args=(dialect, logger), name="rrfmodel.stop", daemon=True
    ).start()


def _stop(dialect, logger):
    """Stop it again and again, until it says that it stands."""
    for _ in range(TRIES):
        if _is_so(dialect.take_at_once, "M112") and _is_so(dialect.is_halted):
            logger.info("The board has stopped")
            return
        time.sleep(PAUSE_SECONDS)
    logger.warning("The board has not said that it has stopped")


def _restart(dialect, logger):
    """Restart it once: what it has taken is not sent again."""
    for _ in range(TRIES):
        if _is_so(dialect.take_at_once, "M999"):
            return
        time.sleep(PAUSE_SECONDS)
    logger.warning("The board has not taken the restart")


def _is_so(asked, *arguments):
    try:
        return asked(*arguments)
    except (Unreachable, SessionLost, Busy, Refused):
        return False
