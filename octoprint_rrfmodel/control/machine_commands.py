"""Commands to the machine: checked against model and state, then given to OctoPrint's queue."""

from ..host.command_texts import command_text
from ..host.printer_profile import profile_of
from ..host.tags import COMMAND_TAG
from ..rrf.gcode.blocking import blocks
from ..rrf.gcode.commands import Refusal, Situation, identity_of_box, root_of, translate
from ..rrf.wire.gcode_words import words
from .rate import Rate

OWN_JOB = {
    "pause": ("pause_print", lambda comm: comm.isPrinting()),
    "resume": ("resume_print", lambda comm: comm.isPaused()),
    "cancel": ("cancel_print", lambda comm: comm.isPrinting() or comm.isPaused()),
}
"""Action of ``job`` to the method of OctoPrint's printer that does it to a print from the card, and
whether it does anything in the connection's state."""

ANSWER_SECONDS = 10.0
"""Time after which an answer to a message box is no longer waited for."""

SLOTS = (
    ("M140 ", "heatedBed", "bedHeaters"),
    ("M141 ", "heatedChamber", "chamberHeaters"),
)
"""Command, what OctoPrint's printer profile calls the heater, and its slots in the model."""


class MachineCommands:
    """Runs the commands of the public contract's section 5; any thread may call it.

    ``printer()`` and ``profiles()`` are OctoPrint's. ``bridge()`` knows the connection,
    ``machine()`` is the view of the model. ``box`` knows of boxes that nobody can answer.
    ``recovery`` restarts the board. ``end_job()`` gives the lines that end the board's job.
    ``look(key)`` only takes note that the printer is to be asked soon, and for a key again, ""
    for all, ``None`` for none.
    """

    def __init__(self, printer, profiles, bridge, machine, box, recovery, end_job, look, clock):
        self._printer = printer
        self._profiles = profiles
        self._bridge = bridge
        self._machine = machine
        self._box = box
        self._recovery = recovery
        self._end_job = end_job
        self._look = look
        self._clock = clock
        self._answered, self._answered_at = None, 0.0
        self.rate = Rate(clock)
        """Counts what others may ask of the machine."""

    def command(self, name, /, **parameters):
        """Run a command, as other plugins do; ``ValueError`` says why it is refused.

        It has been queued when this returns: what comes of it shows in the model.
        """
        refused = self.run(name, parameters)
        if refused:
            raise ValueError(refused[1])

    def run(self, name, parameters):
        """Run a command; return status and sentence of one that is refused, else ``None``."""
        machine = self._machine()
        outcome = translate(name, parameters, machine, self._situation())
        if isinstance(outcome, Refusal):
            return outcome.status, command_text(outcome.code, outcome.values)
        if name == "recover":
            return self._recover()
        if name == "emergency_stop":
            # past all queues, as what OctoPrint streams is one
            self._printer().commands(list(outcome.lines), tags={COMMAND_TAG}, force=True)
            return None
        if not self.rate.allows():
            return 409, command_text("too_many", {})
        if name == "refresh":
            self._look(root_of(parameters.get("key") or ""))
            return None
        self._send(name, parameters, outcome.lines, machine)
        return None

    def _send(self, name, parameters, lines, machine):
        """Give the lines to OctoPrint's queue, or let OctoPrint do what it can do by itself."""
        if name == "job" and parameters["action"] in OWN_JOB:
            method, does_it = OWN_JOB[parameters["action"]]
            comm = self._bridge().connection
            # what it shows as its own print must not end behind its back: it would cancel whatever
            # is printed by then
            if comm is not None and comm.isSdFileSelected() and does_it(comm):
                getattr(self._printer(), method)()
                return
            if parameters["action"] == "cancel":
                lines = self._end_job()
        if name == "message_box":
            self._answered = identity_of_box(machine.model)
            self._answered_at = self._clock()
        carried = [self._carried(line, machine) for line in lines]
        self._printer().commands(carried, tags={COMMAND_TAG})
        # what has come of it is asked at once where that costs nobody time: a print's lines would
        # wait, and behind a command that blocks the question comes soon enough
        if not self._bridge().is_streaming_a_print() and not any(map(blocks, carried)):
            self._look(None)

    def _recover(self):
        why = self._recovery.refusal()
        if why:
            return 409, why
        self._recovery.start()
        return None

    def _situation(self):
        bridge = self._bridge()
        comm = bridge.connection
        return Situation(
            is_connected=self._printer().is_operational(),
            is_rrf=bridge.is_rrf,
            octoprint_prints=bridge.has_a_print(),
            octoprint_is_paused=comm is not None and comm.isPaused(),
            answers_boxes=not self._box.is_waiting,
            box_is_answered=self._is_answered(),
        )

    def _is_answered(self):
        """Return whether the model still shows the box that was answered last.

        Before 3.5 an answer names no box: a second one would be for the next, which nobody has
        read yet.
        """
        if self._answered is None or self._clock() - self._answered_at > ANSWER_SECONDS:
            return False
        return identity_of_box(self._machine().model) == self._answered

    def _carried(self, line, machine):
        """Return a line in a form that OctoPrint sends and shows nothing wrong of.

        It drops what its printer profile has no bed or chamber for, and shows the target of any
        slot as that of the first. Behind another command on the same line it looks at neither.
        """
        comm = self._bridge().connection
        for code, part, kind in SLOTS:
            if comm is not None and line.startswith(code):
                is_first = words(line).get("P") == machine.slot(kind)
                is_known = profile_of(comm, self._profiles())[part]
                return line if is_first and is_known else f"M120 {line} M121"
        if comm is not None and line.startswith("T") and not comm._validate_tool(int(line[1:])):
            # the model has the tool, whatever number of extruders the printer profile has
            comm._sanity_check_tools = False
        return line
