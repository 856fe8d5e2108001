"""The plugin's latest lines of OctoPrint's log, each with what belongs into its sentence apart.

The sentences are the plugin's own, whatever is put into them may be a person's.
"""

import collections
import logging
import traceback
from pathlib import PurePath
from typing import NamedTuple

LOGGER = "octoprint.plugins.rrfmodel"

MOST_LINES = 300
MOST_LENGTH = 500
"""Characters of a value that are kept."""

MOST_FRAMES = 30

PACKAGES = ("octoprint_rrfmodel", "octoprint")
"""Whose places in their code are told; of others the module is."""


class LogLine(NamedTuple):
    """One line, as it was logged."""

    at: float
    """Seconds since the epoch."""
    level: str
    logger: str
    sentence: str
    """With places for the values, in ``%``'s form."""
    values: tuple
    """Numbers as they are, anything else as text."""
    error: str
    """What was raised, its type; empty for nothing."""
    message: str
    """What that says."""
    frames: tuple
    """Where it was raised, outermost first, by module, line and function."""


class OwnLog(logging.Handler):
    """Keeps the latest lines; ``start`` and ``stop`` put it where it hears of them, and away."""

    def __init__(self):
        super().__init__()
        self._lines = collections.deque(maxlen=MOST_LINES)

    def start(self):
        """Hear of the plugin's lines from now on."""
        logging.getLogger(LOGGER).addHandler(self)

    def stop(self):
        """Hear of no more."""
        logging.getLogger(LOGGER).removeHandler(self)

    def latest(self):
        """Return the lines, oldest first."""
        with self.lock:
            return list(self._lines)

    def emit(self, record):
        """Keep a line (logging's method, under its lock)."""
        try:
            self._lines.append(_line_of(record))
        except Exception:
            self.handleError(record)


def _line_of(record):
    values = record.args if isinstance(record.args, tuple) else (record.args,)
    kind, error, trace = record.exc_info or (None, None, None)
    return LogLine(
        at=record.created,
        level=record.levelname,
        logger=record.name[len(LOGGER) + 1 :],
        sentence=str(record.msg),
        values=tuple(map(_value, values)) if record.args else (),
        error=kind.__name__ if kind else "",
        message=str(error)[:MOST_LENGTH] if error else "",
        frames=tuple(map(_place, traceback.extract_tb(trace)[-MOST_FRAMES:])),
    )


def _value(value):
    is_number = isinstance(value, (int, float))
    return value if is_number else str(value)[:MOST_LENGTH]


def _place(frame):
    """Return where a line of code is, without the folders that it is installed in."""
    parts = PurePath(frame.filename).parts
    starts = [at for at, part in enumerate(parts) if part in PACKAGES]
    where = "/".join(parts[starts[-1] :]) if starts else "another package"
    return f"{where}:{frame.lineno} {frame.name}" if starts else where
