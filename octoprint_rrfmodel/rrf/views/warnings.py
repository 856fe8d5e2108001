"""View: what a person has to know now, each thing as a code and the numbers that belong to it.

``CONDITIONS`` is the table: what the model shows, whether a print that the host streams may go
on with it. The firmware pauses for such things only what it prints itself (3.5
GCodes3.cpp:1520-1573).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Callable, NamedTuple

from ..wire.alerts import alerts
from .board_warnings import (
    Found,
    differing_versions,
    driver_errors,
    hot_drivers,
    hot_processors,
    low_supplies,
    open_loads,
)
from .channels import own_channel
from .filament_monitors import only_own_prints, unfed
from .machine import Machine, array, mapping

Model = Mapping[str, Any]

FAULT, WARNING, ADVICE = "fault", "warning", "advice"
"""How much a thing matters: something doesn't work, it may not work for long, it could work
better."""

OFF = "off"
"""``state.status``, and code, of motors without supply voltage."""

LOSES_BOXES = ((3, 5, 0), (3, 6, 0))
"""From and to which firmware nobody can answer a box that USB waits for: M292 does not reach it
(Duet3D/RepRapFirmware #1141; fixed in 3.6.1)."""


class MachineWarning(NamedTuple):
    """One thing that is wrong, as long as it is."""

    code: str
    numbers: tuple[int, ...] = ()
    texts: tuple[tuple[str, str], ...] = ()
    """What else belongs into its sentence, by name; some of it is the printer's own text."""

    @property
    def name(self) -> str:
        """The code with the numbers that tell it from others of its kind."""
        return "_".join([self.code, *map(str, self.numbers)])

    @property
    def values(self) -> dict[str, str]:
        """What belongs into its sentence."""
        number = {"number": ".".join(map(str, self.numbers))} if self.numbers else {}
        return {**number, **dict(self.texts)}


class Condition(NamedTuple):
    """One line of the table."""

    code: str
    find: Callable[[Model], Iterator[Found]]
    """Each thing that is so."""
    stops_a_print: bool
    resumable: bool
    """Whether a print may go on once this is over."""
    reason: str
    """Why it matters, with the source."""
    only_printing: bool = False
    """Whether it is normal while nothing is printed."""
    level: str = FAULT


def _status(word: str) -> Callable[[Model], Iterator[Found]]:
    def find(model: Model) -> Iterator[Found]:
        if mapping(model.get("state")).get("status") == word:
            yield Found()

    return find


def _heaters(model: Model) -> Iterator[Found]:
    for number, heater in enumerate(array(mapping(model.get("heat")).get("heaters"))):
        if mapping(heater).get("state") == "fault":
            yield Found((number,))


def _startup_error(model: Model) -> Iterator[Found]:
    error = mapping(mapping(model.get("state")).get("startupError"))
    if error:
        members = ("file", "line", "message")
        yield Found((), tuple((member, str(error.get(member, ""))) for member in members))


def loses_boxes(version: tuple[int, int, int]) -> bool:
    """Return whether a box that USB waits for can't be answered on that firmware."""
    first, last = LOSES_BOXES
    return first <= version <= last


def _waiting(model: Model) -> Iterator[Found]:
    if not loses_boxes(Machine(model).version):
        return
    if own_channel(model).get("state") == "awaitingAcknowledgement":
        yield Found()


CONDITIONS = (
    Condition(
        "halted",
        _status("halted"),
        True,
        False,
        "After M112 next to nothing is accepted until a reset (3.5 GCodes2.cpp:585).",
    ),
    Condition(
        OFF,
        _status(OFF),
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
        unfed,
        True,
        True,
        "Shows only in the model while a host prints (M591 S1); only what the current tool is fed"
        " with counts.",
        only_printing=True,
    ),
    Condition(
        "driver_error", driver_errors, True, True, "A motor may stand still; told from 3.5 on."
    ),
    Condition(
        "message_box_unanswerable",
        _waiting,
        False,
        True,
        "USB waits for M292, which does not reach it (Duet3D/RepRapFirmware #1141).",
    ),
    Condition(
        "startup_error",
        _startup_error,
        False,
        True,
        "What follows in config.g wasn't done; told from 3.5 on.",
        level=WARNING,
    ),
    Condition(
        "supply_voltage",
        low_supplies,
        False,
        True,
        "The board's motors have no force; an expansion board's supply shows in no status.",
        level=WARNING,
    ),
    Condition(
        "driver_warning",
        hot_drivers,
        False,
        True,
        "A driver that gets hotter still switches its motor off (over-temperature warning).",
        level=WARNING,
    ),
    Condition(
        "open_load",
        open_loads,
        False,
        True,
        "A moving motor may be unplugged; slow and standing ones say so for no reason.",
        only_printing=True,
        level=WARNING,
    ),
    Condition(
        "mcu_temperature",
        hot_processors,
        False,
        True,
        "The processor is specified up to there.",
        level=WARNING,
    ),
    Condition(
        "versions_differ",
        differing_versions,
        False,
        True,
        "Boards of other versions misunderstand each other (Duet3D, updating CAN boards).",
        level=WARNING,
    ),
    Condition(
        "filament_monitor_mode",
        only_own_prints,
        False,
        True,
        "With M591 S1 the firmware does nothing about it while a host prints.",
        only_printing=True,
        level=ADVICE,
    ),
)

RESET = MachineWarning("reset")
"""The board has begun anew: nothing of a print that was under way holds any more."""

POSITION_LOST = MachineWarning("position_lost")
"""The supply of the motors was off during a print, and no axis is homed since (3.5 Platform.cpp,
Spin). The host's lines would go on, each refused, until the file is through."""

UNANSWERABLE = MachineWarning("message_box_unanswerable")

GUARDS = (*(row.code for row in CONDITIONS if row.stops_a_print), RESET.code)
"""The codes of what stops a print."""

LEVELS = {row.code: row.level for row in CONDITIONS}

_RESUMABLE = {**{row.code: row.resumable for row in CONDITIONS}, POSITION_LOST.code: True}


def warnings_of(model: Model, is_printing: bool = False) -> list[MachineWarning]:
    """Return what the model shows to be wrong, the worst first."""
    return [
        MachineWarning(row.code, *found)
        for row in CONDITIONS
        if is_printing or not row.only_printing
        for found in row.find(model)
    ]


def faults(model: Model) -> list[MachineWarning]:
    """Return what a print that the host streams can't go on with."""
    found = [each for each in warnings_of(model, is_printing=True) if each.code in GUARDS]
    return found + [each for each in _told_in_a_box(model) if each not in found]


def said(text: str, model: Model) -> list[MachineWarning]:
    """Return what a text of the firmware's tells of that stops a print that the host streams.

    For firmware whose model doesn't: drivers before 3.5, filament before 3.5.
    """
    fed = (Machine(model).current_tool or {}).get("extruders")
    return [
        MachineWarning(*alert)
        for alert in alerts(text)
        if alert.code != "filament_error" or not isinstance(fed, list) or alert.numbers[0] in fed
    ]


def _told_in_a_box(model: Model) -> list[MachineWarning]:
    """Return the faults that only a box tells of.

    It stays open until somebody answers it; of a heater the model says whether that is over.
    """
    message = mapping(mapping(model.get("state")).get("messageBox")).get("message")
    if not isinstance(message, str):
        return []
    told = set(_heaters_told(model))
    return [
        each
        for each in said(message, model)
        if each.code != "heater_fault" or each.numbers[0] not in told
    ]


def _heaters_told(model: Model) -> Iterator[int]:
    for number, heater in enumerate(array(mapping(model.get("heat")).get("heaters"))):
        if isinstance(mapping(heater).get("state"), str):
            yield number


def is_unhomed(model: Model) -> bool:
    """Return whether X, Y or Z is known not to be homed."""
    axes = map(mapping, array(mapping(model.get("move")).get("axes")))
    return any(
        axis.get("letter") in ("X", "Y", "Z") and axis.get("homed") is False for axis in axes
    )


def is_resumable(found: MachineWarning) -> bool:
    """Return whether a print may go on once this is over."""
    return _RESUMABLE.get(found.code, False)
