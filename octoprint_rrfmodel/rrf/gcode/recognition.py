"""OctoPrint's G-code of a printer operation, recognised command by command.

``ROWS`` is the table: which command of which operation, which intent it is, why another line goes
out. A host that thinks in Marlin sends an operation as several commands; those that only set and
restore a mode vanish, and the one that does something becomes a whole line of ``operations``.
"""

from __future__ import annotations

from typing import Callable, NamedTuple, Union

from ..views.machine import Machine
from ..wire.gcode_words import words
from . import operations
from .forms import Slots
from .operations import NOTHING, Outcome

Given = dict[str, Union[float, None]]
"""The words of a command, by letter."""


class Memory:
    """What one operation has said so far; each caller has one of its own."""

    def __init__(self) -> None:
        self.relative = False


Translation = Callable[[Given, Machine, Memory], Outcome]


class Row(NamedTuple):
    """One line of the table."""

    name: str
    """As the setting that switches it off is called."""
    operation: str
    """The host's operation."""
    gcodes: tuple[str, ...]
    """Its commands that this row is about."""
    translate: Translation
    reason: str
    """Why, with the source."""
    only_with: str = ""
    """The row that has to be on too: the host's own command for it needs the mode."""


def _set_mode(given: Given, machine: Machine, memory: Memory) -> Outcome:
    memory.relative = given.get("G") == 91
    return NOTHING


def _nothing(given: Given, machine: Machine, memory: Memory) -> Outcome:
    return NOTHING


def _jog(given: Given, machine: Machine, memory: Memory) -> Outcome:
    moves = {letter: value or 0 for letter, value in given.items() if letter not in "GF"}
    return operations.jog(machine, moves, memory.relative, given.get("F"))


def _home(given: Given, machine: Machine, memory: Memory) -> Outcome:
    return operations.home(machine, [letter for letter in given if letter != "G"])


def _extrude(given: Given, machine: Machine, memory: Memory) -> Outcome:
    return operations.extrude(machine, given.get("E") or 0, given.get("F"))


def _select(given: Given, machine: Machine, memory: Memory) -> Outcome:
    return operations.select(machine, int(given.get("T") or 0))


def _heat_tool(given: Given, machine: Machine, memory: Memory) -> Outcome:
    tool = given.get("T")
    return operations.heat_tool(machine, None if tool is None else int(tool), given.get("S") or 0)


def _heat_slot(kind: Slots) -> Translation:
    def translate(given: Given, machine: Machine, memory: Memory) -> Outcome:
        return operations.heat_slot(machine, kind, given.get("S") or 0)

    return translate


def _extrusion_factor(given: Given, machine: Machine, memory: Memory) -> Outcome:
    return operations.extrusion_factor(machine, given.get("S") or 0)


ROWS = (
    Row(
        "jog_mode",
        "jog",
        ("G90", "G91"),
        _set_mode,
        "The jog itself carries its mode; alone it would stay set (3.5 GCodeMachineState.cpp:41).",
        only_with="jog",
    ),
    Row(
        "jog",
        "jog",
        ("G0", "G1"),
        _jog,
        "One line in the queue, so that no other client's command gets in between; M120 and M121"
        " keep and restore modes and feed rate (3.5 GCodeMachineState.cpp:41-60).",
    ),
    Row(
        "home_mode",
        "home",
        ("G90", "G91"),
        _nothing,
        "G28 needs no mode and restores it.",
        only_with="home",
    ),
    Row("home", "home", ("G28",), _home, "Values behind the letters are ignored; macros do it."),
    Row(
        "extrude_mode",
        "extrude",
        ("G90", "G91", "M82", "M83"),
        _nothing,
        "Absolute extrusion left behind would ruin a job in relative extrusion.",
        only_with="extrude",
    ),
    Row(
        "extrude",
        "extrude",
        ("G1",),
        _extrude,
        "One line with its own mode; refused without a tool or with a cold one, which the"
        " firmware would answer with an error.",
    ),
    Row(
        "tool_select",
        "change_tool",
        ("T",),
        _select,
        "A tool that does not exist would deselect all without a word (3.5 GCodes.cpp).",
    ),
    Row(
        "tool_target",
        "set_temperature",
        ("M104",),
        _heat_tool,
        "M104 moves the standby temperature too and leaves a heater active at 0; M568 sets the"
        " active temperature and the state (3.5 GCodes2.cpp:3776, :1759).",
    ),
    Row(
        "bed_target",
        "set_temperature",
        ("M140",),
        _heat_slot("bed"),
        "The first slot with a heater; 0 would leave it active (3.5 GCodes2.cpp:2225), so it"
        " becomes what switches off.",
    ),
    Row(
        "chamber_target",
        "set_temperature",
        ("M141",),
        _heat_slot("chamber"),
        "As the bed.",
    ),
    Row(
        "flow_rate",
        "flow_rate",
        ("M221",),
        _extrusion_factor,
        "Without D and without a tool M221 is an error; with D it means one extruder.",
    ),
)

OPERATIONS = frozenset(row.operation for row in ROWS)

_BY_COMMAND = {(row.operation, gcode): row for row in ROWS for gcode in row.gcodes}


def row_for(operation: str, gcode: str) -> Row | None:
    """Return the row about a command of an operation, ``None`` where it goes out as it is."""
    return _BY_COMMAND.get((operation, gcode))


def is_on(row: Row, is_switched_on: Callable[[str], bool]) -> bool:
    """Return whether a row counts; ``is_switched_on(name)`` tells what somebody has chosen."""
    return is_switched_on(row.name) and (not row.only_with or is_switched_on(row.only_with))


def translate(row: Row, command: str, machine: Machine, memory: Memory) -> Outcome:
    """Return what goes out in place of ``command``: lines, perhaps none, or a refusal."""
    return row.translate(words(command), machine, memory)
