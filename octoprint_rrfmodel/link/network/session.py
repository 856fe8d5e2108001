"""A session at one board: one login at a time, the right key with everything, 401 and 503.

On a board without a password every request with a key that it doesn't know takes one of its eight
slots (3.5 HttpResponder.cpp): so after a 401, and after eight silent seconds, nothing is asked
before a new login.
"""

import threading
import time
from functools import partial

from .login import DOWN, SBC, Busy, goodbye, log_in
from .transport import Unreachable

ANSWER_SECONDS = 5.0
"""Time that an answer may take: a board waits two seconds for a responder, and half a second for
buffers; ``rr_fileinfo`` takes up to four."""

ANSWER_BYTES = 64 * 1024

SESSION_SECONDS = 7.5
"""Time without a request after which the board may have forgotten the session."""

GOODBYE_SECONDS = 1.0

WITHOUT_FILE = frozenset((401, 403, *DOWN))
"""Statuses that are told by exceptions, so that nobody reads what comes with them."""


class SessionLost(Exception):
    """The board doesn't know this session any more: mostly it was reset."""


class Session:
    """Asks one board, through one session; any thread may.

    ``transport`` carries requests (``transport.Transport``), ``password()`` is the board's.
    """

    def __init__(self, transport, password, clock=time.monotonic):
        self._transport = transport
        self._password = password
        self._clock = clock
        self._lock = threading.Lock()
        self._key = None
        self._logins = 0
        """How many there were: by it a session is told from the one before."""
        self._is_in = False
        self._used_at = 0.0
        self.greeting = None
        self.is_held = lambda: False
        """Whether something keeps the session alive beside requests."""

    def log_in(self):
        """Return what the board says of itself, once there is a session."""
        with self._lock:
            if not self._is_fresh():
                self._log_in()
            return self.greeting

    def log_out(self):
        """Give the slot back, if there is one; raises nothing."""
        with self._lock:
            is_in, self._is_in = self._is_fresh(), False
            if is_in:
                try:
                    self._get(goodbye(self.greeting), GOODBYE_SECONDS)
                except Unreachable:
                    return

    def ask(self, path, *, seconds=ANSWER_SECONDS, most=ANSWER_BYTES):
        """Return the body of an answer; this module's exceptions say why there is none."""
        return self.get(path, seconds=seconds, most=most).body

    def get(self, path, *, seconds=ANSWER_SECONDS, most=ANSWER_BYTES):
        """Return the answer, for who looks at its status."""
        return self._with_session(lambda: self._get(path, seconds, most))

    def upload(self, path, body, length, told=None):
        """Send a file; return the body of the answer."""
        headers = {"Content-Length": str(length), "Content-Type": "application/octet-stream"}

        def send():
            return self._transport.post(path, {**self._headers(), **headers}, body, told)

        return self._with_session(send).body

    def send(self, method, path, headers, body=None, **how):
        """Send something and return the answer; ``how`` is the transport's (``Transport.send``)."""

        def exchange():
            return self._transport.send(method, path, {**self._headers(), **headers}, body, **how)

        return self._with_session(exchange)

    def connected(self):
        """Return address, connection and key for a talk of another kind, behind a login."""
        with self._lock:
            if not self._is_fresh():
                self._log_in()
            key = self._key
        return self._transport.address, self._transport.connected(), key

    def lose(self):
        """Note that the other side doesn't know the session any more."""
        with self._lock:
            self._is_in = False

    def open(self, path, most):
        """Return a response to read a file from, whose ``status`` may be that of a refusal."""
        return self._with_session(lambda: self._opened(path, most))

    def _opened(self, path, most):
        response = self._transport.open(path, self._headers(), most)
        if response.status in WITHOUT_FILE:
            response.close()
        return response

    def _with_session(self, exchange):
        with self._lock:
            if not self._is_fresh():
                self._log_in()
            login = self._logins
        answer = exchange()
        is_sbc = self.greeting.protocol == SBC
        if answer.status == 401 or (is_sbc and answer.status == 403):
            with self._lock:
                # somebody else may have logged in meanwhile
                if login == self._logins:
                    self._is_in = False
            raise SessionLost
        self._used_at = self._clock()
        if answer.status == 503 or (is_sbc and answer.status in DOWN):
            raise Busy
        return answer

    def _is_fresh(self):
        is_recent = self._clock() - self._used_at < SESSION_SECONDS
        return self._is_in and (is_recent or self.is_held())

    def _headers(self):
        return {} if self._key is None else {"X-Session-Key": str(self._key)}

    def _get(self, path, seconds, most=ANSWER_BYTES):
        return self._transport.get(path, self._headers(), seconds=seconds, most=most)

    def _log_in(self):
        self._is_in, self._key = False, None
        get = partial(self._get, seconds=ANSWER_SECONDS)
        self.greeting, self._key = log_in(get, self._password())
        self._is_in = True
        self._used_at = self._clock()
        self._logins += 1
