"""``state.status``: what the board is doing, in one word."""

from __future__ import annotations

from ..firmware import Firmware
from . import job as jobs
from .activity import Activity
from .boxes import MessageBoxes
from .motion import Motion
from .power import Power

_JOB_STATUS = {
    jobs.PAUSING: "pausing",
    jobs.RESUMING: "resuming",
    jobs.PAUSED: "paused",
    jobs.CANCELLING: "cancelling",
    jobs.PRINTING: "processing",
}


class Status:
    """Tells the status from what goes on in the parts of the board."""

    def __init__(
        self,
        *,
        firmware: Firmware,
        activity: Activity,
        power: Power,
        motion: Motion,
        job: jobs.Job,
        boxes: MessageBoxes,
    ):
        self._firmware = firmware
        self._activity = activity
        self._power = power
        self._motion = motion
        self._job = job
        self._boxes = boxes
        self.recorded: str | None = None
        """What a recorded machine was doing; shown until the board does something of its own."""

    def shown(self) -> str:
        """Return ``state.status``; the order of precedence is RRF 3.5 RepRap.cpp:2391."""
        if self._activity.is_halted:
            return "halted"
        if not self._power.is_on:
            return "off"
        doing = self._doing()
        if doing is not None:
            self.recorded = None
            return doing
        if self.recorded is not None:
            return self.recorded
        return "busy" if self._boxes.is_blocking else "idle"

    def _doing(self) -> str | None:
        status = _JOB_STATUS.get(self._job.state or "")
        if status == "processing" and self._job.is_simulation:
            return "simulating"
        if status is not None and (status != "cancelling" or self._firmware.has_cancelling):
            return status
        if self._activity.is_changing_tool:
            return "changingTool"
        return "busy" if self._activity.is_in_macro or self._motion.is_moving else None
