"""Printing from the card: selecting, running, pausing, cancelling, simulating.

RRF 3.5 GCodes3.cpp, PrintMonitor.cpp. The File channel reads the file; what its lines do is what
they do on any other channel.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ..hardware.blank import no_job
from ..line.channel import Channel
from ..line.output import Output
from ..model.tree import ObjectModel
from .card import Card
from .fileinfo import file_info
from .motion import Motion

_LAYER_COMMENT = re.compile(r";LAYER_CHANGE|;LAYER:(\d+)")
"""A slicer's layer change; the group is its number from 0 where it gives one."""

SELECTED, PRINTING, PAUSING, PAUSED, RESUMING, CANCELLING = (
    "selected",
    "printing",
    "pausing",
    "paused",
    "resuming",
    "cancelling",
)
SIMULATION_SPEED = 40.0
"""Seconds of print time a simulation goes through in one second."""


class Job:
    """The file that is selected or printing, and its times; ``channel`` runs its lines."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        card: Card,
        motion: Motion,
        channel: Channel,
        output: Output,
    ):
        self._model = model
        self._card = card
        self._motion = motion
        self._channel = channel
        self._output = output
        self.restart()

    def restart(self) -> None:
        self.state: str | None = None
        self.path: str | None = None
        self.is_simulation = False
        self._lines: list[bytes] = []
        self._next = 0
        self.position = 0
        self.duration = 0.0
        self._pause_seconds = 0.0
        self._warm_up: float | None = None
        self._layer_started = 0.0
        self._objects: list[dict[str, Any]] = []
        self.current_object = -1
        self._ended_by: str | None = None

    @property
    def is_printing(self) -> bool:
        """Whether a file is being printed or paused."""
        return self.state not in (None, SELECTED)

    @property
    def is_running(self) -> bool:
        return self.state == PRINTING

    @property
    def data(self) -> dict[str, Any]:
        job: dict[str, Any] = self._model.data["job"]
        return job

    def forget(self) -> None:
        """Drop the file as if there had been none."""
        self.restart()
        self._model.data["job"] = self._model.members_of(no_job(), "job")

    def has_run_all(self) -> bool:
        """Return whether the lines read so far are through, as a condition to wait for."""
        return self._channel.is_idle

    def fraction_printed(self) -> float:
        size = (self.data.get("file") or {}).get("size") or 0
        return self.position / size if self.is_printing and size else 0.0

    def select(self, path: str, content: bytes) -> None:
        """Make that file the one that M24 starts."""
        self.path, self.state = path, SELECTED
        self._lines = content.splitlines(keepends=True)
        self._next = self.position = 0
        info = file_info(path, content, self._card.date(path))
        self.data["file"] = self._model.members_of(info, "job.file")
        self.data["filePosition"] = 0
        self._model.bump("job")

    def seek(self, position: int) -> None:
        """Go on at that byte of the file (M26)."""
        passed = 0
        for index, line in enumerate(self._lines):
            if passed >= position:
                self._next = index
                break
            passed += len(line)
        self.position = position

    def start(self, simulate: bool = False) -> None:
        """Begin to print the selected file."""
        self.state, self.is_simulation = PRINTING, simulate
        self.duration = self._pause_seconds = 0.0
        self._warm_up, self._layer_started = None, 0.0
        self._objects, self.current_object = [], -1
        job = self.data
        job.update(
            duration=0,
            layer=None,
            layerTime=None,
            pauseDuration=0,
            rawExtrusion=0.0,
            warmUpDuration=0,
            lastFileName=None,
            build=self._build(),
        )
        if "firstLayerDuration" in job:
            job["firstLayerDuration"] = None
        self._model.volume_open(True)
        self._model.bump("job")

    def _build(self) -> dict[str, Any]:
        return {
            "currentObject": self.current_object,
            "m486Names": bool(self._objects),
            "m486Numbers": False,
            "objects": self._objects,
        }

    def feed(self) -> None:
        """Give the File channel its next line, and end the job after the last one."""
        if self.state != PRINTING or not self._channel.is_idle:
            return
        if self.is_simulation:
            self._go_through()
            return
        if self._next >= len(self._lines):
            if not self._motion.is_moving:
                self.finish(cancelled=False)
            return
        line = self._lines[self._next]
        self._next += 1
        self.position += len(line)
        text = line.decode("utf-8", "replace").rstrip("\r\n")
        if text.startswith(";"):
            self._comment(text)
        else:
            self._channel.lines.append(text)

    def _go_through(self) -> None:
        """Let the position of a simulated print follow its time; nothing is executed."""
        info = self.data.get("file") or {}
        total = info.get("printTime") or len(self._lines) / 10
        self.position = min(int(info.get("size") or 0), int(self.duration / total * info["size"]))
        if self.duration >= total:
            self.finish(cancelled=False)

    def _comment(self, text: str) -> None:
        match = _LAYER_COMMENT.match(text)
        if match:
            given = match.group(1)
            self._layer(int(given) + 1 if given else (self.data.get("layer") or 0) + 1)

    def _layer(self, number: int) -> None:
        if self._warm_up is None:
            self._warm_up = self.duration
            self.data["warmUpDuration"] = int(self.duration)
        self.data.update(layer=number, layerTime=0.0)
        self._layer_started = self.duration

    def extruded(self, amount: float, position: Sequence[float]) -> None:
        """Count what a printing move extrudes."""
        if self.is_running:
            self.data["rawExtrusion"] = (self.data.get("rawExtrusion") or 0.0) + amount

    def step(self, seconds: float) -> None:
        """Let the job's clocks go on."""
        if not self.is_printing:
            return
        if self.state == PRINTING:
            self.duration += seconds * (SIMULATION_SPEED if self.is_simulation else 1.0)
        elif self.state in (PAUSED, PAUSING, RESUMING):
            self._pause_seconds += seconds

    def show(self) -> None:
        """Put the progress into the model."""
        if not self.is_printing:
            return
        job = self.data
        job["duration"] = int(self.duration)
        job["pauseDuration"] = int(self._pause_seconds)
        if self._warm_up is None:
            job["warmUpDuration"] = int(self.duration)
        if job.get("layer"):
            job["layerTime"] = self.duration - self._layer_started
        job["filePosition"] = self.position
        job["build"] = self._build()
        self._times_left(job)

    def _times_left(self, job: dict[str, Any]) -> None:
        left = job.setdefault("timesLeft", {})
        fraction = self.fraction_printed()
        printing = max(0.0, self.duration - (self._warm_up or 0.0))
        info = job.get("file") or {}
        if self._warm_up is None or fraction <= 0.0 or printing < 1.0:
            left["file"] = left["filament"] = None
        else:
            left["file"] = int(printing * (1 - fraction) / fraction)
            total = sum(info.get("filament") or ())
            used = job.get("rawExtrusion") or 0.0
            if total > 0 and used > 0:
                left["filament"] = max(0, int(printing * (total - used) / used))
        slicer = info.get("printTime")
        left["slicer"] = None if slicer is None else max(0, int(slicer - printing))

    def finish(self, cancelled: bool) -> None:
        """End the job and tell everybody."""
        job = self.data
        hours, minutes = divmod(int(self.duration + self._pause_seconds) // 60, 60)
        name, simulated = self.path or "", self.is_simulation
        last = int(self.duration)
        warm_up = int(self._warm_up or 0)
        self._model.data["job"] = self._model.members_of(no_job(), "job")
        job = self.data
        job["lastFileName"], job["lastDuration"] = name, last
        if "lastWarmUpDuration" in job:
            job["lastWarmUpDuration"] = warm_up
        self.state = self.path = None
        self._lines = []
        self._channel.abandon()
        self._model.volume_open(False)
        self._model.bump("job")
        if simulated and not cancelled:
            self._output.text(f"File {name} will print in {hours}h {minutes}m plus heating time\n")
            return
        if not cancelled:
            self._output.text("Done printing file\n")
        verb = "Cancelled" if cancelled else "Finished"
        self._output.text(f"{verb} printing file {name}, print time was {hours}h {minutes}m\n")

    def pause_for_fault(self) -> None:
        """Pause at once, as the event system does."""
        if self.state == PRINTING:
            self.state = PAUSED
            self._channel.lines.clear()

    def name_object(self, number: int, name: str | None = None) -> None:
        """Make M486 object ``number`` the current one; -1 for none."""
        while number >= len(self._objects):
            index = len(self._objects)
            self._objects.append(
                {"cancelled": False, "name": f"Object {index}", "x": [80, 120], "y": [80, 120]}
            )
            self._model.bump("job")
        if name is not None and number >= 0:
            self._objects[number]["name"] = name
            self._model.bump("job")
        self.current_object = number

    def cancel_object(self, number: int, cancelled: bool) -> bool:
        """Mark an object; return whether there is such a one."""
        if not 0 <= number < len(self._objects):
            return False
        self._objects[number]["cancelled"] = cancelled
        self._model.bump("job")
        return True
