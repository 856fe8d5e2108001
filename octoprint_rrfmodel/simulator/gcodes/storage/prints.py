"""G-codes of prints from the card: M0, M23 to M27, M32, M37, M226, M486, M600, M601."""

from __future__ import annotations

from ...device import job as jobs
from ...device.card import Card
from ...device.job import Job
from ...device.live_members import LiveMembers
from ...device.motion import Motion
from ...interpreter.macros import Macros
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome, Running, Silently
from ...line.output import Output
from ...text.command import Command, GCodeError

ONLY_IN_FILE = "use M226 and M601 only within a file being printed"


class Prints:
    """Starts, pauses and ends prints from the card."""

    def __init__(
        self,
        *,
        job: Job,
        card: Card,
        motion: Motion,
        macros: Macros,
        live: LiveMembers,
        output: Output,
    ):
        self._job = job
        self._card = card
        self._motion = motion
        self._output = output
        self._paused_at: list[float] = []
        self._macros = macros
        self._live = live

    def rows(self) -> Rows:
        return {
            "M0": Row(self._stop),
            "M1": Row(self._stop),
            "M2": Row(self._stop),
            "M23": Row(self._select_file),
            "M24": Row(self._start_or_resume),
            "M25": Row(self._pause_print),
            "M26": Row(self._set_position),
            "M27": Row(self._tell_progress),
            "M32": Row(self._select_and_start),
            "M37": Row(self._simulate),
            "M226": Row(self._pause_from_file),
            "M486": Row(self._objects, since=(3, 1)),
            "M600": Row(self._pause_from_file),
            "M601": Row(self._pause_from_file, since=(3, 1)),
        }

    def _open(self, name: str) -> None:
        if self._job.is_printing:
            raise GCodeError("Cannot set file to print, because a file is already being printed")
        found = self._card.name_of(self._card.path_of(name))
        content = self._card.read(found) if found else None
        if found is None or content is None:
            raise GCodeError(f'GCode file "{name}" not found\n')
        self._job.select(found, content)

    def _select_file(self, channel: Channel, command: Command) -> Outcome:
        """M23: name and size aren't told."""
        self._open(command.needed_name())
        return "File opened\nFile selected"

    def _select_and_start(self, channel: Channel, command: Command) -> Outcome:
        """M32."""
        reply = self._select_file(channel, command)
        self._job.start()
        return reply

    def _simulate(self, channel: Channel, command: Command) -> Outcome:
        """M37: goes through a file without moving; tells the time at the end."""
        if "P" not in command:
            mode = command.integer("S")
            if mode is not None:
                return None
            return "Simulation mode: off, move time: 0.0 sec, other time: 0.0 sec"
        self._open(command.needed_string("P"))
        self._job.start(simulate=True)
        return None

    def _start_or_resume(self, channel: Channel, command: Command) -> Outcome:
        """M24."""
        job = self._job
        if job.state == jobs.PAUSED:
            return self._resume(channel)
        if job.state == jobs.SELECTED:
            return self._start(channel)
        if job.is_printing:
            return None
        raise GCodeError("Cannot print, because no file is selected!")

    def _start(self, channel: Channel) -> Running:
        with self._macros.running(channel):
            yield from self._macros.system(channel, "start.g")
        self._job.start()

    def _resume(self, channel: Channel) -> Running:
        self._job.state = jobs.RESUMING
        with self._macros.running(channel):
            if self._motion.is_homed:
                yield from self._macros.system(channel, "resume.g")
            yield Silently(self._motion.has_stopped)
            # back to where the print was (RRF 3.5 GCodes4.cpp, resuming2)
            self._motion.go_back(self._paused_at)
            yield Silently(self._motion.has_stopped)
        self._job.state = jobs.PRINTING
        return "Printing resumed"

    def _pause_print(self, channel: Channel, command: Command) -> Outcome:
        """M25: answers after pause.g."""
        if self._job.state != jobs.PRINTING:
            what = "Printing is already paused!" if self._job.is_printing else ""
            raise GCodeError(what or "Cannot pause print, because no file is being printed!")
        return self._pause(channel)

    def _pause(self, channel: Channel) -> Running:
        """Stop behind the moves in the queue, whatever the file waits for (seen in firmware)."""
        job = self._job
        job.state = jobs.PAUSING
        if channel.name != "File":
            if not job.can_be_interrupted:
                yield Silently(job.has_run_all)
            job.interrupt()
        self._output.text("Resume state saved\n")
        self._live.refresh()
        self._motion.save_restore_point(1)
        yield Silently(self._motion.has_stopped)
        self._live.refresh()
        self._paused_at = self._motion.target()
        where = " ".join(
            f"{axis['letter']}{axis['userPosition']:.1f}" for axis in self._motion.axes
        )
        with self._macros.running(channel):
            # only where all axes are homed (RRF 3.5 GCodes4.cpp, seen in firmware)
            if self._motion.is_homed:
                yield from self._macros.system(channel, "pause.g")
            yield Silently(self._motion.has_stopped)
        job.state = jobs.PAUSED
        return f"Printing paused at {where}"

    def _stop(self, channel: Channel, command: Command) -> Outcome:
        """M0, M1, M2: cancels a paused print with cancel.g, ends a file from within."""
        job = self._job
        if channel.name == "File":
            return self._end()
        if job.state != jobs.PAUSED:
            raise GCodeError("Pause the print before attempting to cancel it")
        return self._cancel(channel)

    def _end(self) -> Running:
        yield self._motion.has_stopped
        self._job.end_after_this()

    def _cancel(self, channel: Channel) -> Running:
        self._job.state = jobs.CANCELLING
        with self._macros.running(channel):
            yield Silently(self._motion.has_stopped)
            yield from self._macros.system(channel, "cancel.g")
        self._job.finish(cancelled=True)

    def _set_position(self, channel: Channel, command: Command) -> Outcome:
        """M26."""
        position = command.integer("S")
        if position is None:
            raise GCodeError("missing parameter 'S'")
        self._job.seek(position)
        return None

    def _tell_progress(self, channel: Channel, command: Command) -> Outcome:
        """M27."""
        if not self._job.is_printing:
            return "Not SD printing."
        size = (self._job.data.get("file") or {}).get("size") or 0
        return f"SD printing byte {self._job.position}/{size}"

    def _pause_from_file(self, channel: Channel, command: Command) -> Outcome:
        """M226, M600, M601: only the file itself may."""
        if channel.name != "File":
            raise GCodeError(ONLY_IN_FILE)
        return self._pause(channel)

    def _objects(self, channel: Channel, command: Command) -> Outcome:
        """M486: T count, S current, A name, P cancel, U resume, C cancel the current one."""
        job = self._job
        if not command.raw:
            return job.objects.told()
        number = command.integer("S")
        if number is not None:
            job.objects.name(number, command.string("A") if "A" in command else None)
        if "C" in command:
            if not job.objects.cancel(job.objects.current, True):
                raise GCodeError("Object number out of range")
            return f"Object {job.objects.current} cancelled"
        for letter, cancelled in (("P", True), ("U", False)):
            wanted = command.integer(letter)
            if wanted is not None and not job.objects.cancel(wanted, cancelled):
                raise GCodeError("Object number out of range")
        return None
