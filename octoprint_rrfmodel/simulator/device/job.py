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
from .motion import Motion
from .printing.build_objects import BuildObjects
from .printing.fileinfo import file_info
from .printing.progress import Progress
from .thermal import HeatWait

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
        self.objects = BuildObjects(model)
        self.progress = Progress()
        self.restart()

    def restart(self) -> None:
        self.state: str | None = None
        self.path: str | None = None
        self.is_simulation = False
        self._lines: list[bytes] = []
        self._next = 0
        self.position = 0
        self.progress.restart()
        self.objects.restart()
        self._is_ending = False

    @property
    def is_printing(self) -> bool:
        """Whether a file is being printed or paused."""
        return self.state not in (None, SELECTED)

    @property
    def printed_path(self) -> str | None:
        """The file that is being printed or paused, ``None`` without one."""
        return self.path if self.is_printing else None

    @property
    def is_running(self) -> bool:
        return self.state == PRINTING

    @property
    def duration(self) -> float:
        """Seconds since the print has begun, without its pauses."""
        return self.progress.duration

    @property
    def line_number(self) -> int:
        """Number of the line that has been read last, from 1."""
        return self._next

    @property
    def data(self) -> dict[str, Any]:
        job: dict[str, Any] = self._model.data["job"]
        return job

    def forget(self) -> None:
        """Drop the print; the file's information stays (seen in firmware)."""
        file, name = self.data.get("file"), self.path or self.data.get("lastFileName")
        self.restart()
        self._model.data["job"] = self._model.members_of(no_job(), "job")
        if file is not None:
            self.data.update(file={**file, "fileName": None}, lastFileName=name)

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
        info["fileName"] = None
        self.data.update(
            file=self._model.members_of(info, "job.file"), filePosition=0, lastFileName=path
        )
        self._last(0, 0)
        self._model.bump("job")

    def seek(self, position: int) -> None:
        """Go on at that byte of the file (M26)."""
        passed, self._next = 0, len(self._lines)
        for index, line in enumerate(self._lines):
            if passed >= position:
                self._next = index
                break
            passed += len(line)
        self.position = position

    def start(self, simulate: bool = False) -> None:
        """Begin to print the selected file."""
        self.state, self.is_simulation = PRINTING, simulate
        self.progress.restart()
        self.objects.restart()
        job = self.data
        job["file"]["fileName"] = self.path
        self._last(None, None)
        job.update(
            duration=0,
            layer=None,
            layerTime=None,
            pauseDuration=0,
            rawExtrusion=0.0,
            warmUpDuration=0,
            lastFileName=None,
            build=self.objects.build(),
        )
        if "firstLayerDuration" in job:
            job["firstLayerDuration"] = None
        self._model.volume_open(True)
        self._model.bump("job")

    def _last(self, duration: int | None, warm_up: int | None) -> None:
        """Show the times of the last print; there are none while one is under way."""
        job = self.data
        job["lastDuration"] = duration
        if "lastWarmUpDuration" in job:
            job["lastWarmUpDuration"] = warm_up

    def feed(self) -> None:
        """Give the File channel its next line, and end the job after the last one."""
        if self.state != PRINTING or not self._channel.is_idle:
            return
        if self.is_simulation:
            self._go_through()
            return
        if self._is_ending or self._next >= len(self._lines):
            self._is_ending = True
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
        self.position = min(
            int(info.get("size") or 0), int(self.progress.duration / total * info["size"])
        )
        if self.progress.duration >= total:
            self.finish(cancelled=False)

    def _comment(self, text: str) -> None:
        match = _LAYER_COMMENT.match(text)
        if match:
            given = match.group(1)
            self._layer(int(given) + 1 if given else (self.data.get("layer") or 0) + 1)

    def _layer(self, number: int) -> None:
        self.data.update(layer=number, layerTime=0.0)
        self.progress.begin_layer()

    def extruded(self, amount: float, position: Sequence[float]) -> None:
        """Count what a printing move extrudes."""
        if self.is_running:
            self.data["rawExtrusion"] = (self.data.get("rawExtrusion") or 0.0) + amount

    def step(self, seconds: float) -> None:
        """Let the job's clocks go on."""
        if not self.is_printing:
            return
        if self.state == PRINTING:
            speed = SIMULATION_SPEED if self.is_simulation else 1.0
            self.progress.step(seconds * speed, isinstance(self._channel.wait, HeatWait))
            self.progress.measure(self.fraction_printed(), self.data.get("rawExtrusion") or 0.0)
        elif self.state in (PAUSED, PAUSING, RESUMING):
            self.progress.paused += seconds

    def show(self) -> None:
        """Put the progress into the model."""
        if not self.is_printing:
            return
        job, progress = self.data, self.progress
        job["duration"] = int(progress.duration)
        job["pauseDuration"] = int(progress.paused)
        job["warmUpDuration"] = int(progress.warm_up)
        if job.get("layer"):
            job["layerTime"] = progress.layer_time
        job["filePosition"] = self.position
        job["build"] = self.objects.build()
        info, used = job.get("file") or {}, job.get("rawExtrusion") or 0.0
        left = progress.times_left(info, self.fraction_printed(), used)
        job.setdefault("timesLeft", {}).update(left)

    def finish(self, cancelled: bool) -> None:
        """End the job and tell everybody."""
        job = self.data
        hours, minutes = divmod(int(self.progress.duration) // 60, 60)
        name, simulated = self.path or "", self.is_simulation
        last = 0 if cancelled else int(self.progress.duration)
        warm_up = 0 if cancelled else int(self.progress.warm_up)
        info = {**(job.get("file") or {}), "fileName": None}
        self._model.data["job"] = self._model.members_of(no_job(), "job")
        self.data.update(lastFileName=name, file=info)
        self._last(last, warm_up)
        self.state = self.path = None
        self._lines, self._is_ending = [], False
        self._channel.abandon()
        self._model.volume_open(False)
        self._model.bump("job")
        if simulated and not cancelled:
            self._output.text(f"File {name} will print in {hours}h {minutes}m plus heating time\n")
            return
        # cancelled or not (seen in firmware)
        self._output.text("Done printing file\n")
        verb = "Cancelled" if cancelled else "Finished"
        self._output.text(f"{verb} printing file {name}, print time was {hours}h {minutes}m\n")

    def end_after_this(self) -> None:
        """End the job behind the command that runs (M0 in the file)."""
        self._is_ending = True

    @property
    def can_be_interrupted(self) -> bool:
        """Whether what the file's command waits for is no macro."""
        return not self._channel.is_in_macro

    def interrupt(self) -> None:
        """Stop reading, and leave the moves not begun and a command that waits for later."""
        if self._channel.running is not None or self._channel.pending or self._channel.lines:
            self._rewind(self._next - 1)
            self._channel.abandon()
        dropped = self._motion.drop_waiting()
        if dropped is not None:
            self._rewind(dropped)

    def _rewind(self, index: int) -> None:
        self.position -= sum(len(line) for line in self._lines[index : self._next])
        self._next = index

    def pause_for_fault(self) -> None:
        """Pause at once, as the event system does."""
        if self.state == PRINTING:
            self.state = PAUSED
            self.interrupt()
