"""Answers that wait for something at the board, without keeping it from others meanwhile."""

from __future__ import annotations

import threading
import time
from collections.abc import Generator
from typing import Any, Callable, TypeVar

from .acceptor import AtBoard

LOOK_SECONDS = 0.01
"""Between two looks whether something has become true that an answer waits for."""

Answer = TypeVar("Answer")


def awaited(
    steps: Generator[Callable[[], bool], Any, Answer], at_board: AtBoard, ended: threading.Event
) -> Answer:
    """Return the answer that ``steps`` comes to; it yields what has to become true meanwhile.

    ``at_board`` is entered for each step and each look, and ``ended`` ends the waiting.
    """
    while True:
        with at_board():
            try:
                is_true = next(steps)
            except StopIteration as end:
                answer: Answer = end.value
                return answer
        while not _holds(is_true, at_board) and not ended.is_set():
            time.sleep(LOOK_SECONDS)


def _holds(condition: Callable[[], bool], at_board: AtBoard) -> bool:
    with at_board():
        return condition()
