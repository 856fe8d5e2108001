"""Commands that the firmware refuses: those of a streamed file pause it, others are told."""

from ...host.tags import COMMAND_TAG, FILE_TAG, SCRIPT_TAG
from ...rrf.wire.refusals import (
    BEGINS,
    EXTRUSION,
    LINE,
    MACHINE,
    is_plain_refusal,
    only_switches_off,
    refusal,
    text_of,
)
from .file_lines import FileLines

OF_PEOPLE = frozenset(("source:api", COMMAND_TAG, SCRIPT_TAG))
"""Tags of what a person has typed or clicked."""

REPEAT_SECONDS = 10.0
"""Time in which the same refusal isn't told again."""


class RefusedLines:
    """Finds out whose command a refusal is about; on OctoPrint's receiving thread.

    ``link`` is the ``SerialLink``. ``notify(name, *arguments)`` only takes note: ``print_stops``
    (code, place, text), ``refused_operation`` (code, detail).
    ``stops(code, text, started_at)`` says whether a refusal is a reason to pause that print.
    """

    def __init__(self, link, notify, *, stops, clock):
        self._link = link
        self._files = FileLines(link)
        self._notify = notify
        self._stops = stops
        self._clock = clock
        self._told = {}

    def look(self, comm, line):
        """Pause the print if a line of its file was refused; tell a person of what else was."""
        if not line.startswith(BEGINS):
            return
        row = refusal(line)
        if row is None and not is_plain_refusal(line):
            return
        command, tags = self._whose(row.about if row else LINE)
        if FILE_TAG in tags:
            if row and self._link.is_streaming_a_print():
                self._pause(comm, row, command, tags, text_of(line))
        elif not OF_PEOPLE.isdisjoint(tags):
            self._tell(command, text_of(line))

    def _whose(self, about):
        """Return the command that a reply is about, and its tags; none where nothing is awaited."""
        link = self._link
        if about == MACHINE:
            return "", {FILE_TAG}
        if about == EXTRUSION:
            return link.extruded if link.extruded[0] else ("", {FILE_TAG})
        return (link.awaited_command, link.awaited_tags) if link.awaited else ("", ())

    def _pause(self, comm, row, command, tags, text):
        is_stopping = comm.isPausing() or comm.isPaused() or comm.isCancelling()
        if is_stopping or comm.isFinishing() or only_switches_off(command):
            return
        if comm.isStarting():
            # pausing now would be undone, and what is of a line of the file comes later
            return
        if not self._stops(row.code, text, self._files.started_at()):
            return
        self._notify("print_stops", row.code, self._files.place(command, tags), text)
        # at once, as OctoPrint does on this thread when a printer asks for it: the ok that lets
        # the next line out is right behind
        comm.setPause(True)

    def _tell(self, command, text):
        detail = f"{command}: {text}" if command else text
        now = self._clock()
        if now - self._told.get(detail, -REPEAT_SECONDS) < REPEAT_SECONDS:
            return
        self._told = {detail: now}
        self._notify("refused_operation", "refused", detail)
