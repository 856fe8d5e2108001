"""Futures for other plugins: what they hang on one runs on a thread of its own."""

import threading
from concurrent.futures import Future


class Answer(Future):
    """A future whose callbacks never run on the thread that brings the answer.

    That thread is the worker, on which the guard of a print runs. One thread each, as a callback
    may wait for the answer to another question.
    """

    def add_done_callback(self, fn):
        """Have ``fn(future)`` called when this is done, as ``concurrent.futures`` describes."""
        super().add_done_callback(lambda done: _start(fn, done))


def _start(function, done):
    threading.Thread(target=function, args=(done,), name="rrfmodel.answer", daemon=True).start()
