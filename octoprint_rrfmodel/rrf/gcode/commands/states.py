"""States of the printer that forbid commands, one row each."""

from __future__ import annotations

from typing import Callable, NamedTuple

from .outcome import Request, forbidden


class State(NamedTuple):
    """One line of the table."""

    code: str
    holds: Callable[[Request], bool]


def _prints(request: Request) -> bool:
    machine, situation = request.machine, request.situation
    streams = situation.octoprint_prints and not situation.octoprint_is_paused
    # the end of a cancelled job is a macro that moves the machine
    return streams or machine.prints or machine.status == "cancelling"


def _could_end(request: Request) -> bool:
    machine, situation = request.machine, request.situation
    if situation.line_is_held:
        return machine.prints or machine.status == "cancelling"
    return _prints(request)


def _has_a_print(request: Request) -> bool:
    situation = request.situation
    return situation.octoprint_prints or _prints(request) or request.machine.status == "paused"


NOT_CONNECTED = State("not_connected", lambda request: not request.situation.is_connected)
NOT_RRF = State("not_rrf", lambda request: not request.situation.is_rrf)
WITHOUT_MACHINE = (
    NOT_CONNECTED,
    NOT_RRF,
    State("halted", lambda request: request.machine.is_halted),
    State("no_model", lambda request: not request.machine.model),
)
"""Nothing that needs the machine goes: what is told first comes first."""

PRINTING = State("printing", _prints)
PRINTING_FREELY = State("printing", _could_end)
PRINTING_OR_PAUSED = State("printing_or_paused", _has_a_print)
STREAMED = State("streamed", lambda request: request.situation.octoprint_prints)


def forbid(request: Request, *states: State) -> None:
    """Raise ``Refused`` if one of the states holds."""
    for state in states:
        if state.holds(request):
            raise forbidden(state.code)
