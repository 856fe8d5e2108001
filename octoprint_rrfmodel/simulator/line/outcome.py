"""What a G-code comes to: a reply, or something that takes its time.

A command is a function that returns its reply, or a generator that yields conditions and returns
the reply at the end. While a condition isn't true the channel accepts nothing further, whatever
lies in its input (RRF 3.5 GCodes.cpp:770-785, GCodes4.cpp:1885).
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Any, Union

from ..clock import Condition
from ..text.command import GCodeError
from ..text.serial_line import Reply

Running = Generator[Condition, None, Any]
Outcome = Union[None, str, Reply, Running]


class MoveError(GCodeError):
    """A G0 to G3 that fails; it takes the rest of its line with it."""


class Silently:
    """A condition during whose wait no temperatures are reported.

    RRF reports while a command is retried (M109, M190, M191, M116, G4, M400, any that waits for
    moves), not while a state machine or a macro goes on (3.5 GCodes.cpp:4865, seen in firmware).
    """

    def __init__(self, condition: Condition):
        self._condition = condition

    def __call__(self) -> bool:
        return self._condition()


class MacroAbandoned(Exception):
    """Ends the macro that runs, after a cancelled message box or ``abort``."""


def as_reply(outcome: Outcome) -> Reply:
    """Return what a command function returned as a reply."""
    if outcome is None:
        return Reply()
    return outcome if isinstance(outcome, Reply) else Reply(str(outcome))
