"""Klipper's commands about motion, and what clients put around a move."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..gcode.commands.outcome import bad, forbidden
from ..wire.gcode_words import number, words
from .steps import At, Given, Lines, Operation, Row, Step
from .words import Command

SAVE, RESTORE = "SAVE_GCODE_STATE", "RESTORE_GCODE_STATE"

OFFSETS = {f"{axis}{kind}": (axis, bool(kind)) for axis in "XYZ" for kind in ("", "_ADJUST")}
"""Parameters of SET_GCODE_OFFSET: the axis, and whether it is to be shifted by so much."""

AXES = "XYZUVWABCD"
"""Letters that a move may have."""

DEFAULT_FEED = 3000.0
"""Millimetres a minute of a move that names no speed."""

EXTRUDE_FEED = 300.0

MILLIMETRES_A_MINUTE = 60.0


def moves(parts: Sequence[str]) -> list[Step] | None:
    """Return operations for what stands between SAVE_GCODE_STATE and RESTORE_GCODE_STATE.

    ``None`` where that is anything but moves, with G90, G91, M82 and M83 among them.
    """
    absolute, absolute_extrusion, feed = True, True, None
    found: list[Step] = []
    for part in parts:
        code = part.split(";")[0].split()[0].upper()
        if code in ("G90", "G91"):
            absolute = absolute_extrusion = code == "G90"
        elif code in ("M82", "M83"):
            absolute_extrusion = code == "M82"
        elif code in ("G0", "G1", "G00", "G01"):
            given = words(part.split(";")[0])
            given.pop("G", None)
            feed = given.pop("F", feed)
            moved = _move(given, absolute, absolute_extrusion, feed)
            if moved is None:
                return None
            found.extend(moved)
        else:
            return None
    return found


def _move(
    given: dict[str, Any], absolute: bool, absolute_extrusion: bool, feed: float | None
) -> list[Step] | None:
    if any(value is None for value in given.values()):
        return None
    extruded = given.pop("E", None)
    if any(letter not in AXES for letter in given):
        return None
    found: list[Step] = []
    if extruded is not None:
        if absolute_extrusion or given:
            return None
        found.append(_extrude(extruded, feed))
    if given:
        parameters = {"axes": given, "absolute": absolute, "speed": feed or DEFAULT_FEED}
        found.append(Operation("jog", parameters))
    return found


def _extrude(amount: float, feed: float | None) -> Operation:
    return Operation("extrude", {"amounts": amount, "speed": feed or EXTRUDE_FEED})


def kept(parts: Sequence[str]) -> list[Step]:
    """Return what is sent for other things between SAVE_GCODE_STATE and RESTORE_GCODE_STATE."""
    return [Given(line) for line in ("M120", *parts, "M121")]


def _unpaired(command: Command, at: At) -> Sequence[Step]:
    raise bad("macro_unpaired", save=SAVE, restore=RESTORE)


def _linear_move(command: Command, at: At) -> Sequence[Step]:
    command.takes("X", "Y", "Z", "E", "F", "ABSOLUTE")
    given = {name: command.number(name) for name in "XYZE" if name in command.given}
    absolute = command.number("ABSOLUTE", 0.0) == 1
    if not given:
        raise bad("macro_misses", command=command.name, parameter="X, Y, Z, E")
    feed = command.number("F", DEFAULT_FEED)
    found: list[Step] = []
    extruded = given.pop("E", None)
    if given:
        found.append(Operation("jog", {"axes": given, "absolute": absolute, "speed": feed}))
    if extruded is not None:
        found.append(_extrude(extruded, feed))
    return found


def _client_extrude(sign: int) -> Any:
    def steps(command: Command, at: At) -> Sequence[Step]:
        command.takes("LENGTH", "SPEED")
        feed = command.number("SPEED", EXTRUDE_FEED / MILLIMETRES_A_MINUTE) * MILLIMETRES_A_MINUTE
        return [_extrude(sign * command.number("LENGTH", 1.0), feed)]

    return steps


def _offset(command: Command, at: At) -> Sequence[Step]:
    command.takes(*OFFSETS, "MOVE", "MOVE_SPEED")
    found: list[Step] = []
    for name, (axis, is_relative) in OFFSETS.items():
        if name in command.given:
            amount = command.number(name)
            parameters = {"axis": axis, "amount": amount, "absolute": not is_relative}
            found.append(Operation("babystep", parameters))
    if not found:
        raise bad("macro_misses", command=command.name, parameter="Z_ADJUST, Z")
    return found


def _limits(command: Command, at: At) -> Sequence[Step]:
    known = {
        "VELOCITY": "M203 X{0} Y{0}",
        "ACCEL": "M204 P{0} T{0}",
        "SQUARE_CORNER_VELOCITY": "M566 X{0} Y{0}",
    }
    command.takes(*known)
    found = []
    for name, line in known.items():
        if name in command.given:
            value = command.number(name)
            if value <= 0:
                raise bad("out_of_range", parameter=name, low="0", high="∞")
            if name != "ACCEL":
                value *= MILLIMETRES_A_MINUTE
            found.append(line.format(number(value)))
    if not found:
        raise bad("macro_misses", command=command.name, parameter=", ".join(known))
    return [Lines(tuple(found))]


def _level(command: Command, at: At) -> Sequence[Step]:
    return [Operation("mesh", {"action": "calibrate"})]


def _mesh(action: str) -> Any:
    return lambda command, at: [Operation("mesh", {"action": action})]


def _profile(command: Command, at: At) -> Sequence[Step]:
    command.takes("LOAD", "SAVE", "REMOVE")
    if "LOAD" not in command.given:
        raise forbidden("macro_profiles")
    name = command.text("LOAD")
    known = (at.view.objects["bed_mesh"][0].fields["profile_name"])(at.view, None)
    if name not in ("default", known):
        raise forbidden("macro_profiles")
    return [Operation("mesh", {"action": "load"})]


ROWS = (
    Row(SAVE, _unpaired, "Keep modes and feed rate until RESTORE_GCODE_STATE"),
    Row(RESTORE, _unpaired, "Set back what SAVE_GCODE_STATE has kept"),
    Row("SET_GCODE_OFFSET", _offset, "Babystepping (M290)"),
    Row("SET_VELOCITY_LIMIT", _limits, "Speed, acceleration and jerk (M203, M204, M566)"),
    Row("BED_MESH_CALIBRATE", _mesh("probe"), "Probe the bed (G29)"),
    Row("BED_MESH_CLEAR", _mesh("clear"), "Use no height map (G29 S2)"),
    Row("BED_MESH_PROFILE", _profile, "Load the height map (G29 S1)"),
    Row("QUAD_GANTRY_LEVEL", _level, "Run bed.g (G32)"),
    Row("Z_TILT_ADJUST", _level, "Run bed.g (G32)"),
    Row("DELTA_CALIBRATE", _level, "Run bed.g (G32)"),
    Row("BED_TILT_CALIBRATE", _level, "Run bed.g (G32)"),
    Row("_CLIENT_LINEAR_MOVE", _linear_move, "Move, and leave all modes as they are"),
    Row("_CLIENT_EXTRUDE", _client_extrude(1), "Extrude"),
    Row("_CLIENT_RETRACT", _client_extrude(-1), "Retract"),
)
