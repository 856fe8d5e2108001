"""Futures for other plugins: what they hang on one runs on a thread of its own."""

from concurrent.futures import Future

from ..host.own_thread import on_a_thread_of_its_own


class Answer(Future):
    """A future whose callbacks never run on the thread that brings the answer.

    That thread is the worker, on which the guard of a print runs. One thread each, as a callback
    may wait for the answer to another question.
    """

    def add_done_callback(self, fn):
        """Have ``fn(future)`` called when this is done, as ``concurrent.futures`` describes."""
        super().add_done_callback(
            lambda done: on_a_thread_of_its_own(fn, done, name="rrfmodel.answer")
        )
