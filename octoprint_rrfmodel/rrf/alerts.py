"""View: what a person has to know now, each thing as a code and the numbers that belong to it.

``CONDITIONS`` is the table: what the model shows, whether a print that the host streams may go
on with it. The firmware pauses for such things only what it prints itself (3.5
GCodes3.cpp:1520-1573).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Callable, NamedTuple

from .machine import Machine, array, mapping

Model = Mapping[str, Any]

DRIVER_ERRORS = 0b0100_1010_0011_1110
"""Bits of ``boards[].drivers[].status`` that are errors: 1 over temperature, 2 and 3 short to
ground, 4 and 5 short to supply, 9 an external driver's, 11 position not maintained, 14 move
without tuning; Duet3D CANlib, ``StandardDriverStatus::ErrorMask``. Over-temperature warning, open
load, stall and standstill are none."""

FEEDING = frozenset(("ok", "noDataReceived", "noMonitor", "", None))
"""Words of ``sensors.filamentMonitors[].status`` that say nothing bad of the filament; a monitor
that has just been switched on has received no data."""

LOSES_BOXES = ((3, 5, 0), (3, 6, 0))
"""From and to which firmware nobody can answer a box that USB waits for: M292 does not reach it
(Duet3D/RepRapFirmware #1141; fixed in 3.6.1)."""


class Alert(NamedTuple):
    """One thing that is wrong, as long as it is."""

    code: str
    numbers: tuple[int, ...] = ()

    @property
    def name(self) -> str:
        """The code with the numbers that tell it from others of its kind."""
        return "_".join([self.code, *map(str, self.numbers)])


class Condition(NamedTuple):
    """One line of the table."""

    code: str
    find: Callable[[Model], Iterator[tuple[int, ...]]]
    """The numbers of each thing that is so."""
    stops_a_print: bool
    resumable: bool
    """Whether a print may go on once this is over."""
    reason: str
    """Why it matters, with the source."""
    only_printing: bool = False
    """Whether it is normal while nothing is printed."""


def _status(word: str) -> Callable[[Model], Iterator[tuple[int, ...]]]:
    def find(model: Model) -> Iterator[tuple[int, ...]]:
        if mapping(model.get("state")).get("status") == word:
            yield ()

    return find


def _heaters(model: Model) -> Iterator[tuple[int, ...]]:
    for number, heater in enumerate(array(mapping(model.get("heat")).get("heaters"))):
        if mapping(heater).get("state") == "fault":
            yield (number,)


def _monitors(model: Model) -> Iterator[tuple[int, ...]]:
    tool = Machine(model).current_tool
    fed = None if tool is None else tool.get("extruders")
    for number, monitor in enumerate(array(mapping(model.get("sensors")).get("filamentMonitors"))):
        monitor = mapping(monitor)
        # 0 is off, 1 while printing, 2 always; before 3.5 a truth value
        is_on = monitor.get("enableMode", monitor.get("enabled"))
        is_fed = not isinstance(fed, list) or number in fed
        status = monitor.get("status")
        feeds = isinstance(status, (str, type(None))) and status in FEEDING
        if is_on and is_fed and not feeds:
            yield (number,)


def _drivers(model: Model) -> Iterator[tuple[int, ...]]:
    for place, board in enumerate(map(mapping, array(model.get("boards")))):
        address = board.get("canAddress")
        for number, driver in enumerate(array(board.get("drivers"))):
            status = mapping(driver).get("status")
            if isinstance(status, int) and status & DRIVER_ERRORS:
                yield (address if isinstance(address, int) else place, number)


def loses_boxes(version: tuple[int, int, int]) -> bool:
    """Return whether a box that USB waits for can't be answered on that firmware."""
    first, last = LOSES_BOXES
    return first <= version <= last


def _waiting(model: Model) -> Iterator[tuple[int, ...]]:
    if not loses_boxes(Machine(model).version):
        return
    for channel in map(mapping, array(model.get("inputs"))):
        if channel.get("name") == "USB" and channel.get("state") == "awaitingAcknowledgement":
            yield ()


CONDITIONS = (
    Condition(
        "halted",
        _status("halted"),
        True,
        False,
        "After M112 next to nothing is accepted until a reset (3.5 GCodes2.cpp:585).",
    ),
    Condition(
        "off",
        _status("off"),
        True,
        True,
        "The motors have no supply voltage (3.5 Platform.cpp:1522).",
    ),
    Condition(
        "heater_fault",
        _heaters,
        True,
        True,
        "The heater is off until M562 (3.5 GCodes3.cpp:1520).",
    ),
    Condition(
        "filament_error",
        _monitors,
        True,
        True,
        "Shows only in the model while a host prints (M591 S1); only what the current tool is fed"
        " with counts.",
        only_printing=True,
    ),
    Condition("driver_error", _drivers, True, True, "A motor may stand still; told from 3.5 on."),
    Condition(
        "message_box_unanswerable",
        _waiting,
        False,
        True,
        "USB waits for M292, which does not reach it (Duet3D/RepRapFirmware #1141).",
    ),
)

RESET = Alert("reset")
"""The board has begun anew: nothing of a print that was under way holds any more."""

UNANSWERABLE = Alert("message_box_unanswerable")

GUARDS = (*(row.code for row in CONDITIONS if row.stops_a_print), RESET.code)
"""The codes of what stops a print."""

_RESUMABLE = {row.code: row.resumable for row in CONDITIONS}


def alerts(model: Model, is_printing: bool = False) -> list[Alert]:
    """Return what the model shows to be wrong, the worst first."""
    return [
        Alert(row.code, numbers)
        for row in CONDITIONS
        if is_printing or not row.only_printing
        for numbers in row.find(model)
    ]


def faults(model: Model) -> list[Alert]:
    """Return what a print that the host streams can't go on with."""
    return [alert for alert in alerts(model, is_printing=True) if alert.code in GUARDS]


def is_resumable(alert: Alert) -> bool:
    """Return whether a print may go on once this is over."""
    return _RESUMABLE.get(alert.code, False)
