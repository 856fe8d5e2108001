"""Commands on their way through a computer in front of a board, answered when they are through.

One after the other, as the board's network channel takes them; only what the computer takes past
that channel goes beside. None is sent twice: where its answer is lost nobody knows what has come
of it. A request stays open for as long as its command takes, on a thread of its own.
"""

import math
import threading

from ...rrf.wire.machine import CODE, is_at_once
from .login import Busy, Refused
from .session import SessionLost
from .transport import NotConnected, Unreachable
from .waiting_lines import WaitingLines

MOST_BYTES = 1024 * 1024

HEADERS = {"Content-Type": "text/plain; charset=utf-8"}

LOOK_SECONDS = 60.0

MOST_LETTERS = 200
"""Of what is told where a command has failed in the computer itself."""


class Codes(WaitingLines):
    """Hands commands to the computer of ``session``; ``tell(*news)`` takes what comes of them.

    It is what ``outgoing.Outgoing`` is for a board by itself.
    """

    def __init__(self, session, clock, tell):
        super().__init__()
        self._session = session
        self._clock = clock
        self._told = tell
        self._running = None

    @property
    def is_executing(self):
        """Whether one is known not to be through."""
        return self._running is not None

    @property
    def at(self):
        """When to look again; that one is through is told."""
        return self._clock() + (0.0 if self.is_due() else LOOK_SECONDS)

    def is_due(self):
        """Return whether there is something to do now."""
        return any(self._may_go(line) for line in self.lines())

    def next(self):
        """Return the command to send now, ``None`` where there is none."""
        for line in self.lines():
            if self._may_go(line):
                try:
                    self._lines.remove(line)
                except ValueError:
                    # an emergency stop has emptied the queue
                    return None
                return line
        return None

    def send(self, line):
        """Send a command; what comes of it is told later."""
        if not is_at_once(line):
            self._running = line
        threading.Thread(target=self._run, args=(line,), name="rrfmodel.code", daemon=True).start()
        return True

    def _may_go(self, line):
        return self._running is None or is_at_once(line)

    def _run(self, line):
        news = self._outcome(line)
        if self._running is line:
            self._running = None
        self._told(*news, ("done", line))

    def _outcome(self, line):
        try:
            answer = run(self._session, line, end=math.inf)
        except NotConnected:
            return [("unsent", line, "away")]
        except (Unreachable, Busy):
            return [("unsent", line, "doubtful")]
        except (SessionLost, Refused):
            return [("unsent", line, "reset"), ("lost",)]
        text = answer.body.decode("utf-8", "replace")
        if answer.status == 200:
            return [("said", text)] if text.strip() else []
        text = " ".join(text.split())[:MOST_LETTERS]
        return [("said", f"Error: {text or answer.status}")]


def run(session, text, end):
    """Return the answer to a command; ``end`` is when it must have come, infinite for never."""
    body = text.encode()
    headers = {**HEADERS, "Content-Length": str(len(body))}
    return session.send("POST", CODE, headers, body, most=MOST_BYTES, end=end)
