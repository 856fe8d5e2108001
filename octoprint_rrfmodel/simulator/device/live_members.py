"""The members of the model that follow from everything else: status, clocks, inputs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from octoprint_rrfmodel.rrf.m409 import answer

from ..clock import Clock
from ..line.channel import Channel
from ..model.tree import ObjectModel
from .job import Job
from .motion import Motion
from .status import Status


class LiveMembers:
    """Brings the model up to date before somebody looks at it."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        clock: Clock,
        motion: Motion,
        job: Job,
        status: Status,
        channels: Mapping[str, Channel],
    ):
        self._model = model
        self._clock = clock
        self._motion = motion
        self._job = job
        self._status = status
        self._channels = channels

    def refresh(self) -> None:
        """Bring positions, status, clocks and inputs of the model up to date."""
        self._motion.show(self._clock.now)
        self._job.show()
        state = self._model.data["state"]
        up_time = self._clock.up_time
        state["status"] = self._status.shown()
        state["upTime"] = int(up_time)
        if "msUpTime" in state:
            state["msUpTime"] = int(up_time * 1000) % 1000
        state["time"] = self._clock.date_time()
        self._show_endstops()
        for gcode_input in self._model.data.get("inputs") or ():
            if gcode_input is None:
                continue
            channel = self._channels.get(gcode_input["name"])
            if channel is not None:
                gcode_input["state"] = channel.state
                if "inMacro" in gcode_input:
                    gcode_input["inMacro"] = channel.is_in_macro

    def _show_endstops(self) -> None:
        """An axis that stands where it has been homed touches its endstop."""
        found = self._model.data["sensors"].get("endstops") or []
        for axis, endstop in zip(self._motion.axes, found):
            if endstop is not None and axis["homed"]:
                position, high = float(axis["machinePosition"]), endstop.get("highEnd")
                endstop["triggered"] = (
                    position >= float(axis["max"]) if high else position <= float(axis["min"])
                )

    def member(self, path: str) -> Any:
        """Return a member of the object model by its M409 key, for expressions."""
        self.refresh()
        return answer(self._model.data, path, "vno")["result"]
