"""Commands to the machine: checked against model and state, then given to OctoPrint's queue."""

import threading

from .command_texts import command_text
from .printer_profile import profile_of
from .rrf.blocking import blocks
from .rrf.commands import Refusal, Situation, root_of, translate
from .rrf.gcode import words

COMMAND_TAG = "trigger:rrfmodel.command"

RATE = 20.0
"""Commands a second."""

BURST = 30
"""Commands that may come at once."""

NOT_PAUSING = {"pause": "trigger:pause", "cancel": "trigger:cancel"}
"""Action of ``job`` to the tag without which OctoPrint pauses its own job too at an M25; it finds
out what has become of the print from the model."""


class Rate:
    """Lets so many through in a second; any thread may ask. ``clock()`` is in seconds."""

    def __init__(self, clock):
        self._clock = clock
        self._lock = threading.Lock()
        self._left = float(BURST)
        self._at = clock()

    def allows(self):
        """Return whether one more may go through now, and count it if so."""
        with self._lock:
            now = self._clock()
            self._left = min(float(BURST), self._left + (now - self._at) * RATE)
            self._at = now
            if self._left < 1:
                return False
            self._left -= 1
            return True


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
        self._rate = Rate(clock)

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
        if not self._rate.allows():
            return 409, command_text("too_many", {})
        if name == "refresh":
            self._look(root_of(parameters.get("key") or ""))
            return None
        action = parameters.get("action") if name == "job" else None
        lines = self._end_job() if action == "cancel" else outcome.lines
        tags = {COMMAND_TAG, NOT_PAUSING[action]} if action in NOT_PAUSING else {COMMAND_TAG}
        carried = [self._carried(line, machine) for line in lines]
        self._printer().commands(carried, tags=tags)
        # what has come of it is asked at once where that costs nobody time: a print's lines would
        # wait, and behind a command that blocks the question comes soon enough
        if not self._bridge().is_streaming_a_print() and not any(map(blocks, carried)):
            self._look(None)
        return None

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
        )

    def _carried(self, line, machine):
        """Return a line in a form in which OctoPrint sends it, counts its ok and shows no more.

        T-1 is no command to it, and a tool, a bed or a chamber that its printer profile hasn't got
        is dropped. Behind another command on the same line it looks at none of them.
        """
        comm = self._bridge().connection
        if comm is None:
            return line
        if line.startswith("T"):
            number = int(line[1:])
            # the profile of this connection and what OctoPrint has learnt; both versions have it
            return line if number >= 0 and comm._validate_tool(number) else f"M400 {line}"
        for code, part, kind in (
            ("M140 ", "heatedBed", "bedHeaters"),
            ("M141 ", "heatedChamber", "chamberHeaters"),
        ):
            if line.startswith(code):
                # it would show the target of any slot as that of the first
                is_first = words(line).get("P") == machine.slot(kind)
                is_known = profile_of(comm, self._profiles())[part]
                return line if is_first and is_known else f"M120 {line} M121"
        return line
