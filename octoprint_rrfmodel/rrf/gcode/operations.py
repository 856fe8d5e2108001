"""A printer operation of the host, command by command, as an RRF user would send it.

``ROWS`` is the table: which command of which operation, what goes out in its place, why. A host
that thinks in Marlin sends an operation as several commands; those that only set and restore a
mode vanish, and the one that does something becomes a whole line.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Callable, NamedTuple, Union

from ..views.machine import HAS_EXPRESSIONS, M568_SETS_TOOLS, Machine
from ..wire.gcode_words import extrude_line, jog_line, number, numbers, words

OFF = "-273.15"
"""A temperature that switches a heater off (3.5 Tool.cpp:788); 0 leaves it active."""


class Refused(NamedTuple):
    """Nothing goes out, and a person has to know why."""

    code: str
    detail: str = ""


class Lines(NamedTuple):
    """What goes out instead, perhaps nothing, and the target that it gives a heater."""

    lines: tuple[str, ...] = ()
    heater: str = ""
    """``tool1``, ``bed``, ``chamber``: whose target the host can't see in the lines itself."""
    target: float = 0.0


class Memory:
    """What one operation has said so far; each caller has one of its own."""

    def __init__(self) -> None:
        self.relative = False


NOTHING = Lines()
"""Nothing goes out, and nobody has to know."""

Outcome = Union[Lines, Refused]
Translation = Callable[[dict[str, "float | None"], Machine, Memory], Outcome]


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


def _set_mode(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    memory.relative = given.get("G") == 91
    return Lines()


def _nothing(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    return Lines()


def _jog(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    axes = "".join(letter for letter in given if letter not in "GF")
    unhomed = machine.unhomed(axes)
    if unhomed:
        return Refused("not_homed", unhomed)
    moves = [f"{axis}{number(given[axis] or 0)}" for axis in axes]
    return Lines((jog_line(moves, memory.relative, given.get("F")),))


def _home(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    return Lines((" ".join(["G28", *(letter for letter in given if letter != "G")]),))


def _extrude(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    tool = machine.current_tool
    if tool is None and machine.knows_tools:
        return Refused("no_tool_selected")
    if tool is not None and machine.is_cold(tool):
        return Refused("too_cold", str(tool["number"]))
    return Lines((extrude_line([given.get("E") or 0], given.get("F")),))


def _select_tool(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    wanted = int(given.get("T") or 0)
    if machine.knows_tools and wanted not in machine.tools:
        return Refused("no_such_tool", str(wanted))
    return Lines((f"T{wanted}",))


def _tool_target(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    wanted, target = given.get("T"), given.get("S") or 0
    tool = machine.default_tool if wanted is None else machine.tools.get(int(wanted))
    if tool is None:
        if not machine.knows_tools:
            chosen = "" if wanted is None else f" T{int(wanted)}"
            return Lines((f"M104 S{number(target)}{chosen}",))
        return Refused("no_such_tool", "" if wanted is None else str(int(wanted)))
    name = tool["number"]
    heater = f"tool{name}"
    if machine.version >= M568_SETS_TOOLS:
        targets = numbers([target] * heater_count(tool))
        state = 2 if target else 0
        return Lines((f"M568 P{name} S{targets} A{state}",), heater, target)
    current = machine.current_tool
    if not target:
        return Lines((tool_off(tool, machine),), heater)
    lines = [f"M104 T{name} S{number(target)}"]
    standby = tool.get("standby")
    if current is not None and current["number"] == name and standby:
        # M104 has set the standby temperature too
        lines.append(f"G10 P{name} R{numbers(standby)}")
    return Lines(tuple(lines), heater, target)


def _slot_target(code: str, heater: str) -> Translation:
    def translate(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
        slot = machine.slot(f"{heater}Heaters")
        if slot is None:
            return Refused(f"no_{heater}")
        target = given.get("S") or 0
        line = f"{code} P{slot} S{number(target)}" if target else slot_off(code, slot, machine)
        return Lines((line,), heater, target)

    return translate


def slot_off(code: str, slot: int, machine: Machine) -> str:
    """Return the line that switches the heater of a slot off, with M140 or M141.

    A host that looks for S would take the temperature in it for a target, so it stands in an
    expression, or behind another command where the firmware has none.
    """
    if machine.version >= HAS_EXPRESSIONS:
        return f"{code} P{slot} S{{{OFF}}}"
    return f"M120 {code} P{slot} S{OFF} M121"


def tool_off(tool: Mapping[str, Any], machine: Machine) -> str:
    """Return the line that switches a tool's heaters off."""
    name = tool["number"]
    if machine.version >= M568_SETS_TOOLS:
        return f"M568 P{name} A0"
    off = _off_except_those_of(machine.current_tool, tool)
    return f"G10 P{name} S{off} R{off}"


def _off_except_those_of(current: Mapping[str, Any] | None, tool: Mapping[str, Any]) -> str:
    """Return temperatures that switch a tool's heaters off, 0 for one that the current tool uses.

    G10 would switch that off too (2.05 Tool.cpp, SetToolHeaterStandbyTemperature); M568 doesn't.
    """
    is_other = current is not None and current.get("number") != tool.get("number")
    others = (current.get("heaters") or ()) if current is not None and is_other else ()
    return ":".join("0" if index in others else OFF for index in tool.get("heaters") or (None,))


def heater_count(tool: Mapping[str, Any]) -> int:
    """Return how many heaters a tool has, 1 where the model doesn't tell."""
    return len(tool.get("heaters") or ()) or 1


def _flow_rate(given: dict[str, float | None], machine: Machine, memory: Memory) -> Outcome:
    tool = machine.current_tool
    percent = number(given.get("S") or 0)
    if tool is None:
        return Refused("no_tool_selected")
    extruders = tool.get("extruders") or ()
    return Lines(tuple(f"M221 D{extruder} S{percent}" for extruder in extruders))


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
        "One line, so that no other client's command gets in between; M120 and M121 keep and"
        " restore modes and feed rate (3.5 GCodeMachineState.cpp:41-60).",
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
        _select_tool,
        "A tool that does not exist would deselect all without a word (3.5 GCodes.cpp).",
    ),
    Row(
        "tool_target",
        "set_temperature",
        ("M104",),
        _tool_target,
        "M104 moves the standby temperature too and leaves a heater active at 0; M568 sets the"
        " active temperature and the state (3.5 GCodes2.cpp:3776, :1759).",
    ),
    Row(
        "bed_target",
        "set_temperature",
        ("M140",),
        _slot_target("M140", "bed"),
        "The first slot with a heater; 0 would leave it active (3.5 GCodes2.cpp:2225), so it"
        " becomes what switches off.",
    ),
    Row(
        "chamber_target",
        "set_temperature",
        ("M141",),
        _slot_target("M141", "chamber"),
        "As the bed.",
    ),
    Row(
        "flow_rate",
        "flow_rate",
        ("M221",),
        _flow_rate,
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
