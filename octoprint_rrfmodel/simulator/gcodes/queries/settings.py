"""Configuration that is told without parameters, and taken note of in no way with them."""

from __future__ import annotations

from typing import Any

from ...device.card import SYSTEM, Card
from ...device.motion import Motion
from ...device.thermal import Thermal
from ...firmware import Firmware
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...model.tree import ObjectModel
from ...text.command import Command, GCodeError
from ...text.serial_line import Kind, Reply

WITHOUT_PID = (3, 7)
"""M301 and M304 are gone (release notes of 3.7.0)."""

WATCHED = {0: "tooHigh", 1: "tooLow"}
"""Condition of a heater's monitor by its number."""


class Settings:
    """Tells what ``config.g`` has set; the texts are those of RRF 3.5 (seen in firmware)."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        motion: Motion,
        thermal: Thermal,
        card: Card,
        firmware: Firmware,
    ):
        self._model = model
        self._motion = motion
        self._thermal = thermal
        self._card = card
        self._firmware = firmware

    def rows(self) -> Rows:
        return {
            "M85": Row(_nothing),
            "M143": Row(self._monitors),
            "M150": Row(self._led_colour),
            "M200": Row(self._filament_diameters),
            "M207": Row(self._retraction),
            "M208": Row(self._axis_limits),
            "M260": Row(self._no_i2c),
            "M261": Row(self._no_i2c),
            "M301": Row(self._pid, until=WITHOUT_PID),
            "M304": Row(self._pid, until=WITHOUT_PID),
            "M305": Row(_replaced),
            "M307": Row(self._heater_model),
            "M308": Row(self._sensor),
            "M350": Row(self._microstepping),
            "M376": Row(self._taper),
            "M404": Row(self._filament_width),
            "M407": Row(self._filament_width),
            "M503": Row(self._configuration),
            "M505": Row(self._system_folder),
        }

    def _heater(self, command: Command, letter: str, default: int | None) -> dict[str, Any]:
        number = command.integer(letter, default)
        if number is None:
            raise GCodeError(f"missing parameter '{letter}'")
        heater = self._thermal.heater(number)
        if heater is None:
            raise GCodeError(f"Heater {number} not found")
        return heater

    def _monitors(self, channel: Channel, command: Command) -> Outcome:
        """M143: of monitor P, S the limit, A what happens, C when."""
        number = command.integer("H", 1)
        monitors = self._heater(command, "H", 1)["monitors"]
        if command.raw.keys() - {"H"}:
            self._set_monitor(monitors, command)
            return None
        lines = []
        for index, monitor in enumerate(monitors):
            if monitor["limit"] is None:
                lines.append(f"Heater {number} monitor {index} is disabled")
            else:
                lines.append(
                    f"Heater {number} monitor {index} uses sensor {monitor.get('sensor', -1)} to "
                    "generate a heater fault if the reading exceeds "
                    f"{monitor['limit']:.1f}°C"
                )
        return "\n".join(lines)

    def _set_monitor(self, monitors: list[dict[str, Any]], command: Command) -> None:
        place = command.integer("P", 0) or 0
        if not 0 <= place < len(monitors):
            raise GCodeError(f"Invalid monitor number '{place}'")
        condition = WATCHED.get(command.integer("C", 0) or 0, "disabled")
        is_off = condition == "disabled"
        monitors[place].update(
            action=None if is_off else command.integer("A", 0),
            condition=condition,
            limit=None if is_off else command.number_of("S", monitors[place]["limit"]),
        )
        self._model.bump("heat")

    def _led_colour(self, channel: Channel, command: Command) -> Outcome:
        """M150: a board without a strip doesn't know it."""
        if self._model.data.get("ledStrips") or not self._firmware.at_least(3, 5):
            return None
        return Reply("Warning: M150: Command is not supported")

    def _filament_diameters(self, channel: Channel, command: Command) -> Outcome:
        """M200."""
        if command.raw:
            return None
        found = (f"{e.get('filamentDiameter', 1.75):.3f}" for e in self._motion.extruders)
        return "Volumetric extrusion is disabled for this input, filament diameters: " + ", ".join(
            found
        )

    def _retraction(self, channel: Channel, command: Command) -> Outcome:
        """M207."""
        if command.raw:
            return None
        lines = []
        for tool in self._model.tools():
            values = tool["retraction"]
            length = values["length"]
            lines.append(
                f"Tool {tool['number']} retract/reprime: length {length:.2f}/"
                f"{length + values['extraRestart']:.2f}mm, speed {values['speed']:.1f}/"
                f"{values['unretractSpeed']:.1f}mm/sec, Z hop {values['zHop']:.2f}mm"
            )
        return "\n".join(lines)

    def _axis_limits(self, channel: Channel, command: Command) -> Outcome:
        """M208: S1 sets the lowest positions."""
        axes = self._motion.axes
        named = [axis for axis in axes if axis["letter"] in command]
        if not named:
            limits = ", ".join(f"{a['letter']}{a['min']:.1f}:{a['max']:.1f}" for a in axes)
            return f"Axis limits (mm) {limits}"
        lowest = command.integer("S", 0) == 1
        for axis in named:
            values = command.numbers(axis["letter"]) or [0.0]
            if len(values) == 2:
                axis["min"], axis["max"] = values
            else:
                axis["min" if lowest else "max"] = values[0]
        self._model.bump("move")
        return None

    def _no_i2c(self, channel: Channel, command: Command) -> Outcome:
        """M260 and M261: no board here has a bus for them."""
        if not self._firmware.at_least(3, 6):
            raise GCodeError("I2C not available")
        if command.number == 260:
            raise GCodeError("Command is not supported")
        raise GCodeError("missing parameter 'B'")

    def _pid(self, channel: Channel, command: Command) -> Outcome:
        """M301 and M304."""
        default = 1 if command.number == 301 else 0
        number = command.integer("H", default)
        self._heater(command, "H", default)
        if command.raw.keys() - {"H"}:
            return None
        return f"Heater {number} uses model-derived PID parameters. Use M307 H{number} to view them"

    def _heater_model(self, channel: Channel, command: Command) -> Outcome:
        """M307."""
        heater = self._heater(command, "H", None)
        if command.raw.keys() - {"H"}:
            return None
        model = heater["model"]
        rate = model.get("coolingRate") or 0.0
        exponent = model.get("coolingExp") or 1.0
        rise = 100 * (model["heatingRate"] / rate) ** (1 / exponent) if rate else 0.0
        return (
            f"Heater {command.integer('H')}: heating rate {model['heatingRate']:.3f}, "
            f"cooling rate {rate:.3f}, dead time {model['deadTime']:.2f}, "
            f"max PWM {model['maxPwm']:.2f}, mode PID, "
            f"calibrated at {model['standardVoltage']:.1f}V\n"
            f"Predicted max temperature rise {rise:.0f}°C\n"
            "PID parameters: heating P83.9 I1.676 D164.4, steady P83.9 I6.215 D164.4"
        )

    def _sensor(self, channel: Channel, command: Command) -> Outcome:
        """M308."""
        number = command.integer("S")
        if number is None:
            raise GCodeError("missing parameter 'S'")
        if command.raw.keys() - {"S"}:
            return None
        sensors = self._model.data["sensors"].get("analog") or []
        sensor = sensors[number] if 0 <= number < len(sensors) else None
        if sensor is None:
            raise GCodeError(f"Sensor {number} does not exist")
        kind = sensor["type"] if self._firmware.at_least(3, 6) else sensor["type"].capitalize()
        name = f" ({sensor['name']})" if sensor["name"] else ""
        port = sensor.get("port") or f"temp{number}"
        return (
            f"Sensor {number}{name} type {kind} using pin {port}, "
            f"last error ok, reading {sensor['lastReading']:.1f}, T:{sensor.get('r25', 100000):.1f}"
            f" B:{sensor.get('beta', 4725.0):.1f} C:{_exponential(sensor.get('c', 0.0))}"
            f" R:{sensor.get('rRef', 2200.0):.1f} L:0 H:0"
        )

    def _microstepping(self, channel: Channel, command: Command) -> Outcome:
        """M350."""
        if command.raw:
            return None
        drives = [(axis["letter"], axis) for axis in self._motion.axes]
        drives += [("E", extruder) for extruder in self._motion.extruders]
        parts = []
        for letter, drive in drives:
            steps = drive["microstepping"]
            parts.append(f"{letter}:{steps['value']}({'on' if steps['interpolated'] else 'off'})")
        return "Microstepping - " + ", ".join(parts)

    def _taper(self, channel: Channel, command: Command) -> Outcome:
        """M376."""
        height = command.number_of("H")
        compensation = self._model.data["move"]["compensation"]
        if height is not None:
            compensation["fadeHeight"] = height
            self._model.bump("move")
            return None
        return "Bed compensation is not tapered"

    def _filament_width(self, channel: Channel, command: Command) -> Outcome:
        """M404 and M407."""
        return None if command.raw else "Filament width 1.75mm"

    def _configuration(self, channel: Channel, command: Command) -> Outcome:
        """M503: the text of config.g."""
        lines = self._card.lines(f"{SYSTEM}/config.g")
        if lines is None:
            raise GCodeError("Configuration file not found")
        return Reply("\n".join(lines) + "\n", Kind.LONG)

    def _system_folder(self, channel: Channel, command: Command) -> Outcome:
        """M505: there is no other."""
        if "P" in command:
            raise GCodeError("Path not found")
        return f"Sys file path is {self._model.data['directories']['system']}"


def _exponential(value: float) -> str:
    digits, _, exponent = f"{value:.2e}".partition("e")
    return f"{digits}e{int(exponent):+d}"


def _replaced(channel: Channel, command: Command) -> Outcome:
    raise GCodeError("M305 has been replaced by M308 and M950")


def _nothing(channel: Channel, command: Command) -> Outcome:
    return None
