"""Tokens that stand for a user once, for a few seconds, where a page can't show a key."""

import base64
import secrets
import threading
import time

SECONDS = 5.0

MOST_TOKENS = 100
"""Kept at a time; with more of them the oldest are worth nothing any more."""

BYTES = 20


class OneshotTokens:
    """Issues tokens and takes them back, each once; any thread may call it."""

    def __init__(self, clock=time.monotonic):
        self._clock = clock
        self._lock = threading.Lock()
        self._issued = {}

    def issue(self, caller):
        """Return a new token that stands for a caller."""
        token = base64.b32encode(secrets.token_bytes(BYTES)).decode("ascii")
        with self._lock:
            self._forget_old()
            self._issued[token] = caller, self._clock() + SECONDS
        return token

    def redeem(self, token):
        """Return whom a token stands for, ``None`` where it is unknown, used or too old."""
        with self._lock:
            caller, until = self._issued.pop(token, (None, 0.0))
        return caller if self._clock() < until else None

    def _forget_old(self):
        now = self._clock()
        kept = [(token, each) for token, each in self._issued.items() if now < each[1]]
        self._issued = dict(kept[-(MOST_TOKENS - 1) :])
