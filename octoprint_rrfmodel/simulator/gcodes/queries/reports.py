"""Commands that only tell: temperatures, position, endstops."""

from __future__ import annotations

from ...clock import Clock
from ...device.live_members import LiveMembers
from ...device.motion import Motion
from ...device.thermal import Thermal
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...model.tree import ObjectModel
from ...text.command import Command, GCodeError
from ...text.serial_line import Kind, Reply


class Reports:
    """Tells what M105 and its kin ask for."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        clock: Clock,
        live: LiveMembers,
        motion: Motion,
        thermal: Thermal,
    ):
        self._model = model
        self._clock = clock
        self._live = live
        self._motion = motion
        self._thermal = thermal

    def rows(self) -> Rows:
        return {
            "M105": Row(self._report_temperatures),
            "M114": Row(self._position),
            "M119": Row(self._endstops),
            "M998": Row(self._resend),
        }

    def _report_temperatures(self, channel: Channel, command: Command) -> Outcome:
        """M105."""
        channel.status_request = "M105"
        channel.reported_at = self._clock.now
        return Reply(self._thermal.report(), Kind.TEMPERATURES)

    def _position(self, channel: Channel, command: Command) -> Outcome:
        """M114: where the queue ends, and the steps of this moment (RRF 3.5 GCodes.cpp:3332)."""
        self._live.refresh()
        motion = self._motion
        axes = [axis for axis in motion.axes if axis.get("visible", True)]
        ends = {
            axis["letter"]: (end, end - motion.offset(index))
            for index, (axis, end) in enumerate(zip(motion.axes, motion.target()))
        }
        user = " ".join(f"{axis['letter']}:{ends[axis['letter']][1]:.3f}" for axis in axes)
        drives = " ".join(
            f"E{index}:{extruder['position']:.1f}"
            for index, extruder in enumerate(motion.extruders)
        )
        counts = " ".join(str(round(axis["machinePosition"] * axis["stepsPerMm"])) for axis in axes)
        machine = " ".join(f"{ends[axis['letter']][0]:.3f}" for axis in axes)
        extrusion = f"E:{motion.virtual_e:.3f} {drives}".rstrip()
        return f"{user} {extrusion} Count {counts} Machine {machine} Bed comp 0.000"

    def _endstops(self, channel: Channel, command: Command) -> Outcome:
        """M119 (RRF 3.5 EndstopsManager.cpp:519)."""
        self._live.refresh()
        found = self._model.data["sensors"].get("endstops") or []
        states = []
        for index, axis in enumerate(self._motion.axes):
            endstop = found[index] if index < len(found) else None
            if endstop is None:
                text = "no endstop"
            elif endstop.get("triggered"):
                text = "at max stop" if endstop.get("highEnd") else "at min stop"
            else:
                text = "not stopped"
            states.append(f"{axis['letter']}: {text}")
        return f"Endstops - {', '.join(states)}, Z probe: {self._probe_state()}"

    def _probe_state(self) -> str:
        probes = self._model.data["sensors"].get("probes") or []
        if not probes or probes[0] is None:
            return "at min stop"  # what isn't there reads as triggered (seen in firmware)
        value = (probes[0].get("value") or [0])[0]
        return "at min stop" if value >= probes[0].get("threshold", 500) else "not stopped"

    def _resend(self, channel: Channel, command: Command) -> Outcome:
        """M998: asks for a line again; nothing in RRF sends it by itself (3.5 GCodes2.cpp:4705)."""
        number = command.integer("P")
        if number is None:
            raise GCodeError("missing parameter 'P'")
        return Reply(f"rs {number}", Kind.TEMPERATURES)
