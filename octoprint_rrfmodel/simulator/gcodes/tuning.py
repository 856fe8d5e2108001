"""How it moves, heats and probes: G31, G60, M303, M572, M593, M906."""

from __future__ import annotations

from typing import Any

from ..clock import Clock
from ..device.motion import Motion
from ..device.thermal import Thermal
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome, Running
from ..line.output import Output
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError

PHASES = ("heater on", "settling", "tuning with fan off", "tuning with fan on")
PHASE_SECONDS = 40.0
"""Simulated time of each; a real one takes longer."""
MOST_POINTS = 6
SHAPERS = ("none", "mzv", "zvd", "zvdd", "zvddd", "ei2", "ei3")


class Tuning:
    """Sets what moves and heats well, and finds it out."""

    def __init__(
        self, *, model: ObjectModel, motion: Motion, thermal: Thermal, clock: Clock, output: Output
    ):
        self._model = model
        self._motion = motion
        self._thermal = thermal
        self._clock = clock
        self._output = output

    def rows(self) -> Rows:
        return {
            "G31": Row(self._probe),
            "G60": Row(self._save_point),
            "M303": Row(self._tune),
            "M572": Row(self._pressure_advance),
            "M593": Row(self._shaping),
            "M906": Row(self._currents),
        }

    def _probe(self, channel: Channel, command: Command) -> Outcome:
        """G31: K is the probe, Z where it triggers, X and Y where it is."""
        number = command.integer("K", 0) or 0
        probes = self._model.data["sensors"].get("probes") or []
        if not 0 <= number < len(probes):
            raise GCodeError(f"Z probe number {number} not found")
        probe = probes[number]
        height = command.number_of("Z")
        offsets = {place: command.number_of(letter) for place, letter in enumerate("XY")}
        threshold = command.integer("P")
        for place, offset in offsets.items():
            if offset is not None:
                probe["offsets"][place] = offset
        if height is not None:
            probe["triggerHeight"] = height
            probe["offsets"][2] = -height
        if threshold is not None:
            probe["threshold"] = threshold
        if command.raw.keys() - {"K"}:
            self._model.bump("sensors")
            return None
        x, y = probe["offsets"][:2]
        return (
            f"Z probe {number}: current reading {probe['value'][0]}, threshold"
            f" {probe['threshold']}, trigger height {probe['triggerHeight']:.3f}, offsets"
            f" X{x:.1f} Y{y:.1f}"
        )

    def _save_point(self, channel: Channel, command: Command) -> Running:
        """G60."""
        yield self._motion.has_stopped
        point = command.integer("S", 0) or 0
        if not 0 <= point < MOST_POINTS:
            raise GCodeError("Bad restore point number")
        self._motion.show(self._clock.now)
        self._motion.save_restore_point(point)

    # -- heaters

    def _tune(self, channel: Channel, command: Command) -> Outcome:
        """M303: a heater, or the first one of a tool; without either what is being tuned."""
        if not command.raw:
            return self._told()
        index = command.integer("H", -1) or 0
        if "T" in command:
            tool = self._model.tool(command.integer("T", -1)) or {}
            index = next(iter(tool.get("heaters") or []), -1)
        heater = self._thermal.heater(index)
        if heater is None:
            raise GCodeError(f"Heater {index} not found")
        target = command.number_of("S", heater["max"]) or 0.0
        if self._thermal.tuned or heater["state"] == "fault":
            raise GCodeError(f"Heater {index} can't be tuned now")
        self._thermal.tuned[index] = target
        self._thermal.set_state(index, "tuning")
        self._begin(index, 0)
        return (
            f"Auto tuning heater {index} using target temperature {target:.1f}°C and PWM 1.00"
            " - do not leave printer unattended"
        )

    def _told(self) -> str:
        for index in self._thermal.tuned:
            return f"Heater {index} is being tuned"
        return "No heater has been tuned since startup"

    def _begin(self, index: int, phase: int) -> None:
        heater = self._thermal.heater(index) or {}
        if heater.get("state") != "tuning" or index not in self._thermal.tuned:
            # somebody has switched it off, or the board has restarted
            self._thermal.tuned.pop(index, None)
            return
        if phase == len(PHASES):
            self._finish(index, heater)
            return
        self._output.text(f"Auto tune starting phase {phase + 1}, {PHASES[phase]}\n")
        self._clock.after_seconds(PHASE_SECONDS, lambda: self._begin(index, phase + 1))

    def _finish(self, index: int, heater: dict[str, Any]) -> None:
        del self._thermal.tuned[index]
        self._thermal.set_state(index, "off")
        model = heater["model"]
        model["heatingRate"] = round(float(model["heatingRate"]) * 1.05, 3)
        model["deadTime"] = round(float(model["deadTime"]) * 0.95, 2)
        self._model.bump("heat")
        self._output.text(
            f"Auto tuning heater {index} completed after 2 idle and 5 tuning cycles in"
            f" {len(PHASES) * PHASE_SECONDS:.0f} seconds\n"
        )

    # -- motors

    def _pressure_advance(self, channel: Channel, command: Command) -> Outcome:
        """M572: D names extruders, those of the current tool without."""
        seconds, named = command.number_of("S"), command.numbers("D")
        extruders = self._motion.extruders
        if named is None:
            named = list((self._model.current_tool() or {}).get("extruders") or [])
        if any(not 0 <= int(each) < len(extruders) for each in named):
            raise GCodeError("Invalid extruder number")
        if seconds is None:
            known = ", ".join(f"{each['pressureAdvance']:.3f}" for each in extruders)
            return f"Extruder pressure advance: {known}"
        for each in named:
            extruders[int(each)]["pressureAdvance"] = seconds
        self._model.bump("move")
        return None

    def _shaping(self, channel: Channel, command: Command) -> Outcome:
        """M593."""
        shaping = self._model.data["move"]["shaping"]
        kind = command.string("P")
        if kind is not None and kind.lower() not in SHAPERS:
            raise GCodeError(f"Unsupported input shaper type '{kind}'")
        if not command.raw:
            return f"Input shaping '{shaping['type']}' at {shaping['frequency']:.1f}Hz"
        if kind is not None:
            shaping["type"] = kind.lower()
        for letter, member in (("F", "frequency"), ("S", "damping")):
            value = command.number_of(letter)
            if value is not None:
                shaping[member] = value
        self._model.bump("move")
        return None

    def _currents(self, channel: Channel, command: Command) -> Running:
        """M906: in mA; E has one for each extruder, one alone is that of all."""
        yield self._motion.has_stopped
        for index in self._motion.named_axes(command.raw):
            axis = self._motion.axes[index]
            axis["current"] = int(command.number_of(axis["letter"]) or 0)
        values = command.numbers("E") or []
        for place, extruder in enumerate(self._motion.extruders if values else ()):
            if len(values) == 1 or place < len(values):
                extruder["current"] = int(values[0 if len(values) == 1 else place])
        self._model.bump("move")
