"""Klipper's commands that set up and look at a machine."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..gcode.commands.outcome import bad, forbidden
from ..gcode.commands.parameters import is_number, sendable
from ..views.machine import array, mapping
from ..wire.gcode_words import number, quoted
from .places import number_of, thing_of
from .steps import At, Lines, Operation, Row, Step
from .words import Command

MILLIMETRES_A_MINUTE = 60.0

RETRACTION = {
    "RETRACT_LENGTH": ("S", 1.0),
    "UNRETRACT_EXTRA_LENGTH": ("R", 1.0),
    "RETRACT_SPEED": ("F", MILLIMETRES_A_MINUTE),
    "UNRETRACT_SPEED": ("T", MILLIMETRES_A_MINUTE),
}
"""Parameters of SET_RETRACTION: the word of M207, and the factor into its unit."""

GLOBALS = "globals"
"""The macro object whose fields are the machine's global variables."""


def _plain(*lines: str) -> Any:
    def steps(command: Command, at: At) -> Sequence[Step]:
        command.takes()
        return [Lines(lines)]

    return steps


def _save(command: Command, at: At) -> Sequence[Step]:
    command.takes()
    return [Operation("save_parameters", {})]


def _advance(command: Command, at: At) -> Sequence[Step]:
    command.takes("EXTRUDER", "ADVANCE", "SMOOTH_TIME")
    if "ADVANCE" not in command.given:
        # what remains would be SMOOTH_TIME
        raise forbidden("macro_smooth_time")
    wanted = command.text("EXTRUDER", at.view.extruder or "extruder")
    _, extruder = thing_of(at, wanted, "extruder")
    drives = array(extruder.tool.get("extruders"))
    if not drives or not isinstance(drives[0], int):
        raise forbidden("macro_cannot")
    seconds = command.number("ADVANCE")
    return [Operation("pressure_advance", {"extruder": drives[0], "seconds": seconds})]


def _pin(command: Command, at: At) -> Sequence[Step]:
    command.takes("PIN", "VALUE")
    _, output = thing_of(at, command.text("PIN"), "output_pin")
    place = number_of(output, "state", "gpOut", at=at)
    return [Operation("output", {"output": place, "value": command.number("VALUE")})]


def _has_pins(at: At) -> bool:
    return bool(array(at.view.state.get("gpOut")))


def _sensor(command: Command, at: At) -> Sequence[Step]:
    command.takes("SENSOR", "ENABLE")
    wanted = command.text("SENSOR")
    _, sensor = thing_of(at, wanted, "filament_switch_sensor", "filament_motion_sensor")
    place = number_of(sensor, "sensors", "filamentMonitors", at=at)
    return [Lines((f"M591 D{place} S{1 if command.number('ENABLE') else 0}",))]


def _has_monitors(at: At) -> bool:
    return any(map(mapping, array(mapping(at.view.model.get("sensors")).get("filamentMonitors"))))


def _retraction(command: Command, at: At) -> Sequence[Step]:
    command.takes(*RETRACTION)
    words = ["M207"]
    for name, (letter, factor) in RETRACTION.items():
        if name in command.given:
            words.append(f"{letter}{number(command.number(name) * factor)}")
    if len(words) == 1:
        raise bad("macro_misses", command=command.name, parameter=", ".join(RETRACTION))
    return [Lines((" ".join(words),))]


def _variable(command: Command, at: At) -> Sequence[Step]:
    command.takes("MACRO", "VARIABLE", "VALUE")
    if command.text("MACRO").lower() != GLOBALS:
        raise forbidden("macro_variables", globals=GLOBALS)
    value = _literal(command.text("VALUE"))
    return [Operation("variable", {"name": command.text("VARIABLE"), "value": value})]


def _literal(text: str) -> Any:
    """Return what a value is that Klipper would read as one of Python's."""
    words = {"true": True, "false": False}
    if text.lower() in words:
        return words[text.lower()]
    try:
        value = float(text)
    except ValueError:
        inner = text[1:-1] if len(text) > 1 and text[0] == text[-1] in "'\"" else text
        return inner
    return value if is_number(value) else text


def _respond(command: Command, at: At) -> Sequence[Step]:
    command.takes("MSG")
    return [Lines((f"M118 S{quoted(sendable('MSG', command.text('MSG')))}",))]


def _display(command: Command, at: At) -> Sequence[Step]:
    command.takes("MSG")
    return [Lines((f"M117 {quoted(sendable('MSG', command.text('MSG', '')))}",))]


def _has_probe(at: At) -> bool:
    return bool(array(mapping(at.view.model.get("sensors")).get("probes")))


def _probe(command: Command, at: At) -> Sequence[Step]:
    command.takes()
    return [Operation("probe", {"action": "measure"})]


ROWS = (
    Row("SAVE_CONFIG", _save, "Keep what can be kept (M500)"),
    Row("QUERY_ENDSTOPS", _plain("M119"), "Tell the state of the endstops (M119)"),
    Row("QUERY_PROBE", _plain("G31"), "Tell the state of the probe (G31)", _has_probe),
    Row("PROBE", _probe, "Probe where the head is (G30 S-1)", _has_probe),
    Row("GET_POSITION", _plain("M114"), "Tell the position (M114)"),
    Row("SET_PRESSURE_ADVANCE", _advance, "Set pressure advance (M572)"),
    Row("SET_RETRACTION", _retraction, "Set firmware retraction (M207)"),
    Row("SET_PIN", _pin, "Set an output, 0 to 1 (M42)", _has_pins),
    Row("SET_FILAMENT_SENSOR", _sensor, "Switch a filament monitor (M591)", _has_monitors),
    Row("SET_GCODE_VARIABLE", _variable, "Set a global variable of the machine's"),
    Row("RESPOND", _respond, "Say something on the line (M118)"),
    Row("SET_DISPLAY_TEXT", _display, "Show a message (M117)"),
)
