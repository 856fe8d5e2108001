"""Message boxes in OctoPrint's dialog for prompts of a printer, and in whatever else shows those.

OctoPrint's bundled plugin for ``// action:prompt_...`` lines shows them in its page and tells apps.
It is handed what those lines would say, by its own handler of the hook; no line is made up. Its
answer, ``M876 S<button>``, becomes M292 on its way through the queuing hook.
"""

import logging

from flask_babel import gettext

from ..rrf.gcode.operations import Lines
from ..rrf.views.machine import Machine, mapping
from ..rrf.views.prompt import END, answer, prompt
from ..rrf.views.warnings import UNANSWERABLE, warnings_of
from ..rrf.wire.gcode_words import words
from ..rrf.wire.masking import masked

PROMPT_PLUGIN = "action_command_prompt"
PROMPT_COMMAND = "M876"

ACTION_HOOK = "octoprint.comm.protocol.action"
CAPABILITY_HOOK = "octoprint.comm.protocol.firmware.capabilities"
CAPABILITY = "PROMPT_SUPPORT"
"""What Marlin says of itself; without it the bundled plugin shows nothing."""

NO_BOX = {}

MOST_CHOICES = 1000


class BoxPrompt:
    """Shows the open box, once, and closes the dialog when the box is gone.

    ``handler(hook)`` is the bundled plugin's handler of a hook, ``None`` without that plugin.
    ``link`` has what OctoPrint's hooks are handed as the connection.
    ``model()`` is the snapshot, ``is_on()`` the setting. ``look`` is called by one thread,
    ``translate`` by any.
    """

    def __init__(self, handler, link, *, model, is_on):
        self._handler = handler
        self._link = link
        self._model = model
        self._is_on = is_on
        self._shown = NO_BOX
        self._announced_to = None
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.prompt")

    def look(self):
        """Show what is new, close what is gone."""
        box = self._box()
        # mostly there is none, and to look up a setting takes OctoPrint longer than all of this
        if "seq" in box and not self._is_on():
            box = NO_BOX
        if box.get("seq") == self._shown.get("seq"):
            return
        handle, comm = self._handler(ACTION_HOOK), self._link.connection
        if handle is not None and self._shown:
            _tell(handle, comm, END)
        self._shown = NO_BOX
        if handle is None or comm is None or "seq" not in box:
            return
        self._announce(comm)
        is_answerable = UNANSWERABLE not in warnings_of(self._model())
        self._shown = box
        names = {"ok": gettext("OK"), "cancel": gettext("Cancel"), "close": gettext("Close")}
        # one that the printer itself has begun would be in the way
        for line in (END, *prompt(box, is_answerable, names)):
            _tell(handle, comm, line)

    def translate(self, cmd, gcode, tags=()):
        """Return what goes out in place of a command, ``None`` for all but answers to prompts.

        RepRapFirmware has no M876: what answers no box that is open isn't sent.
        """
        if gcode != PROMPT_COMMAND or not self._is_on():
            return None
        box, shown = self._box(), self._shown
        index = words(cmd).get("S")
        line = None
        is_one = index is not None and 0 <= index < MOST_CHOICES
        if is_one and shown and box.get("seq") == shown["seq"]:
            line = answer(shown, int(index), Machine(self._model()).version)
        if line is None:
            self._logger.info("Not sending %r: it answers no message box", masked(cmd))
            return Lines()
        return Lines((line,))

    def _announce(self, comm):
        """Say once for each connection that prompts are understood."""
        handle = self._handler(CAPABILITY_HOOK)
        if handle is not None and comm is not self._announced_to:
            self._announced_to = comm
            handle(comm, CAPABILITY, True, {})

    def _box(self):
        """Return the open box, an empty one where there is none."""
        return mapping(mapping(self._model().get("state")).get("messageBox"))


def _tell(handle, comm, line):
    name, parameters = line
    action = f"{name} {parameters}".strip()
    handle(comm, f"//action:{action}", action, name=name, params=parameters)


def handler_of(plugin_manager):
    """Return the function that finds the bundled plugin's handler of a hook."""
    return lambda hook: plugin_manager().get_hooks(hook).get(PROMPT_PLUGIN)
