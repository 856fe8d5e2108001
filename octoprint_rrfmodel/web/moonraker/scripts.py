"""What a client sends as a script: taken apart, looked at as a whole, sent line by line."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...host.macro_texts import macro_text
from ...host.tags import SCRIPT_TAG
from ...rrf.gcode.commands.outcome import Refused
from ...rrf.script.moment import at_moment
from ...rrf.script.plan import planned
from ...rrf.script.steps import Asked, Given, Lines, Operation, Restart
from .methods import Call, run

MOST_LINES = 50

LONGEST_LINE = 200
"""Characters of a line; the firmware's buffer holds 256 bytes (3.5 GCodes.h, MaxGCodeLength)."""

RESTART = "printer.firmware_restart"


def lines_of(script):
    """Return the lines of a script without blanks around them; or raise ``RequestRefused``."""
    if not isinstance(script, str):
        raise RequestRefused(400, gettext("A script is a text with G-code, one command a line."))
    lines = [line.strip() for line in script.replace("\r\n", "\n").split("\n")]
    lines = [line for line in lines if line]
    if not lines:
        raise RequestRefused(400, gettext("The script holds no G-code."))
    if len(lines) > MOST_LINES:
        raise RequestRefused(
            400, gettext("The script has more than 50 lines. Upload it as a file.")
        )
    for line in lines:
        if not line.isprintable():
            raise RequestRefused(400, gettext("A line of the script holds a control character."))
        if len(line.encode("utf-8")) > LONGEST_LINE:
            raise RequestRefused(400, gettext("A line of the script is longer than 200 bytes."))
        # OctoPrint takes a semicolon for the beginning of a comment, even between quotes
        if line.partition(";")[0].count('"') % 2:
            raise RequestRefused(
                400,
                gettext("A line of the script has a quote without its partner, or a ; in quotes."),
            )
    return lines


class GcodeScripts:
    """Sends scripts to a connected RepRapFirmware; never waits, so that any thread may call it.

    ``objects`` are the printer objects, ``link`` leads to the board, ``commands`` are those to the
    machine (``MachineCommands``).
    """

    def __init__(self, objects, link, commands):
        self._objects = objects
        self._link = link
        self._commands = commands
        self._methods = None

    def attach(self, methods):
        """Know the methods of Moonraker's that some commands stand for (``Methods``)."""
        self._methods = methods

    def run(self, script, caller):
        """Queue the lines of a script; raise ``RequestRefused``, and nothing of it is sent."""
        lines = lines_of(script)
        self._check()
        steps = self._planned(lines)
        first, others = steps[:1], steps[1:]
        if any(isinstance(step, (Asked, Restart)) for step in others):
            raise RequestRefused(400, macro_text("macro_order", {}))
        if others and isinstance(first[0], Restart):
            raise RequestRefused(400, macro_text("macro_order", {}))
        lines = [line for step in steps for line in self._lines_of(step)]
        if not self._commands.rate.allows(len(lines)):
            raise RequestRefused(409, gettext("Too many commands at once. Try again in a second."))
        for step in first:
            if isinstance(step, Asked):
                self._ask(step.method, step.params, caller)
            elif isinstance(step, Restart):
                self._ask(RESTART, {}, caller)
        if lines:
            self._link.send_later(lines, {SCRIPT_TAG})

    def _ask(self, name, params, caller):
        """Run a method of Moonraker's for whoever sends the script."""
        found = self._methods.named(name)
        if found is None:
            raise RequestRefused(409, gettext("That can't be done here."))
        run(found, Call(params, caller))

    def _planned(self, lines):
        at = at_moment(self._objects.world(), self._commands.machine())
        try:
            return planned(lines, at)
        except Refused as refused:
            refusal = refused.refusal
            text = macro_text(refusal.code, refusal.values)
            raise RequestRefused(refusal.status, text) from None

    def _lines_of(self, step):
        """Return the lines of a step in the forms that the link takes; raise ``RequestRefused``."""
        if isinstance(step, Given):
            return [step.line]
        if isinstance(step, Lines):
            return self._link.carried(step.lines, self._commands.machine())
        if isinstance(step, Operation):
            lines = self._commands.checked(step.name, step.parameters)
            carried = self._link.carried(lines, self._commands.machine())
            return [f"{line}{step.behind}" for line in carried]
        return []

    def emergency_stop(self):
        """Stop the machine at once, past all queues; raise ``RequestRefused``."""
        self._check()
        self._link.stop_now({SCRIPT_TAG})

    def _check(self):
        if not self._objects.is_connected():
            raise RequestRefused(409, gettext("No printer with RepRapFirmware is connected."))
