"""The emergency stop."""

from __future__ import annotations

from collections.abc import Mapping

from ..line.channel import Channel
from ..model.tree import ObjectModel
from .activity import Activity
from .job import Job
from .motion import Motion
from .thermal import Thermal


class Emergency:
    """Stops the machine with everything that is under way."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        activity: Activity,
        thermal: Thermal,
        motion: Motion,
        job: Job,
        channels: Mapping[str, Channel],
    ):
        self._model = model
        self._activity = activity
        self._thermal = thermal
        self._motion = motion
        self._job = job
        self._channels = channels

    def stop(self) -> None:
        """Everything off, every channel but its input forgotten, until the next reset."""
        self._activity.is_halted = True
        self._thermal.all_off()
        self._motion.stop()
        self._job.forget()
        self._model.data["state"]["currentTool"] = -1
        for channel in self._channels.values():
            channel.abandon(keep_input=True)
        self._model.bump("job", "state")

    def end(self) -> None:
        """Take commands again, as nothing but a reset makes a real board do."""
        self._activity.is_halted = False
