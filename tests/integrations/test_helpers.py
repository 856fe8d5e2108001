"""What other plugins hang on an answer never holds up who brings it."""

import threading
from concurrent.futures import Future
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.integrations.helpers import Helpers

SECONDS = 5


class Questions:
    """Questions that are answered when the test wants it."""

    def __init__(self):
        self.asked = []

    def refusal(self):
        return None

    def ask(self, key, flags):
        self.asked.append(Future())
        return self.asked[-1]

    def answer(self, number, value):
        """Answer as the worker does; return whether that is over although callbacks wait."""
        future = self.asked[number]
        future.set_running_or_notify_cancel()
        done = threading.Thread(
            target=future.set_result, args=(SimpleNamespace(result=value),), daemon=True
        )
        done.start()
        done.join(SECONDS)
        return not done.is_alive()


@pytest.fixture
def questions():
    return Questions()


@pytest.fixture
def query(questions):
    nothing = SimpleNamespace()
    return Helpers(dict, nothing, questions, command=nothing, status=nothing, objects=nothing).query


def test_row_36_callback_that_waits_holds_up_nobody(questions, query):
    called, may_go, thread = threading.Event(), threading.Event(), []

    def callback(future):
        thread.append(threading.current_thread().name)
        called.set()
        may_go.wait(SECONDS)

    future = query("heat")
    future.add_done_callback(callback)
    assert questions.answer(0, 5)
    assert future.result(SECONDS) == 5
    assert called.wait(SECONDS) and thread == ["rrfmodel.answer"]
    may_go.set()


def test_callback_may_wait_for_another_answer(questions, query):
    found, is_over = [], threading.Event()

    def callback(future):
        second = query("move")
        threading.Thread(target=questions.answer, args=(1, 7), daemon=True).start()
        found.append(second.result(SECONDS))
        is_over.set()

    query("heat").add_done_callback(callback)
    assert questions.answer(0, 5)
    assert is_over.wait(SECONDS) and found == [7]


def test_callback_that_raises_is_nobody_else_s(questions, query):
    future, called = query("heat"), threading.Event()
    future.add_done_callback(lambda done: called.set())
    assert questions.answer(0, 5)
    assert called.wait(SECONDS)
    late = threading.Event()
    future.add_done_callback(lambda done: late.set())
    assert late.wait(SECONDS)


def test_question_that_is_given_up_is_not_answered(questions, query):
    future = query("heat")
    assert future.cancel()
    assert questions.answer(0, 5)
    assert future.cancelled()
