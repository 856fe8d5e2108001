"""Commands to the machine: checked against model and state, then given to the link."""

from ..host.answers import RequestRefused
from ..host.command_texts import command_text
from ..host.tags import COMMAND_TAG
from ..rrf.gcode.blocking import blocks
from ..rrf.gcode.commands import Refusal, Situation, root_of, translate

CARD_JOB_ACTIONS = ("pause", "resume", "cancel")
"""Actions of ``job`` that OctoPrint has too, for a print that it shows as its own."""


class MachineCommands:
    """Runs the commands of the public contract's section 5; any thread may call it.

    ``link`` reaches the board, ``machine()`` is the view of the model. ``boxes`` knows of boxes
    that nobody can answer. ``recovery`` restarts the board. ``look(key)`` only takes note that the
    printer is to be asked soon, and for a key again, "" for all, ``None`` for none. ``rate`` counts
    what others may ask of the machine.
    """

    def __init__(self, link, machine, boxes, *, recovery, look, rate):
        self._link = link
        self._boxes = boxes
        self._recovery = recovery
        self._look = look
        self.rate = rate
        """Counts what others may ask of the machine."""
        self.machine = machine
        """Gives the view of the model."""

    def command(self, name, /, **parameters):
        """Run a command, as other plugins do; ``ValueError`` says why it is refused.

        It has been queued when this returns: what comes of it shows in the model.
        """
        refused = self.run(name, parameters)
        if refused:
            raise ValueError(refused[1])

    def run(self, name, parameters):
        """Run a command; return status and sentence of one that is refused, else ``None``."""
        machine = self.machine()
        outcome = translate(name, parameters, machine, self._situation())
        if isinstance(outcome, Refusal):
            return outcome.status, command_text(outcome.code, outcome.values)
        if name == "recover":
            return self._recover()
        if name == "emergency_stop":
            self._link.stop_now({COMMAND_TAG})
            return None
        if not self.rate.allows():
            return 409, command_text("too_many", {})
        if name == "refresh":
            self._look(root_of(parameters.get("key") or ""))
            return None
        self._send(name, parameters, outcome.lines, machine)
        return None

    def checked(self, name, parameters):
        """Return the lines of a command, and send nothing; raise ``RequestRefused``."""
        outcome = translate(name, parameters, self.machine(), self._situation())
        if isinstance(outcome, Refusal):
            text = command_text(outcome.code, outcome.values)
            raise RequestRefused(outcome.status, text)
        why = self._recovery.refusal() if name == "recover" else None
        if why:
            raise RequestRefused(409, why)
        return outcome.lines

    def _send(self, name, parameters, lines, machine):
        """Give the lines to the link, or let OctoPrint do what it can do by itself."""
        if name == "job" and parameters["action"] in CARD_JOB_ACTIONS:
            if self._link.control_card_job(parameters["action"]):
                return
            if parameters["action"] == "cancel":
                lines = self._link.end_job()
        if name == "message_box":
            self._boxes.note_answer()
        carried = self._link.carried(lines, machine)
        # an answer that what the line waits for is waiting for, past all that waits behind it
        answers = name == "message_box" and self._link.waits_in_a_box()
        self._link.send(carried, {COMMAND_TAG}, force=answers)
        # what has come of it is asked at once where that costs nobody time: a print's lines would
        # wait, and behind a command that blocks the question comes soon enough
        if not self._link.is_streaming_a_print() and not any(map(blocks, carried)):
            self._look(None)

    def _recover(self):
        why = self._recovery.refusal()
        if why:
            return 409, why
        self._recovery.start()
        return None

    def _situation(self):
        link = self._link
        # a line is there or it isn't
        is_away = getattr(link, "is_away", False)
        return Situation(
            is_connected=link.is_operational and not is_away,
            is_rrf=link.is_rrf,
            octoprint_prints=link.has_a_print(),
            octoprint_is_paused=link.is_paused(),
            answers_boxes=not self._boxes.is_waiting,
            box_is_answered=self._boxes.is_answered(),
            line_is_held=self._boxes.holds_the_line(),
        )
