"""OctoPrint's printer operations, told by their tags, on their way through the queuing hook."""

import threading

from ...host.printer_profile import takes_tool_numbers
from ...rrf.gcode.operations import NOTHING, Refused
from ...rrf.gcode.recognition import OPERATIONS, Memory, is_on, row_for, translate

OPERATION_OF_TAG = {f"trigger:printer.{operation}": operation for operation in OPERATIONS}
"""OctoPrint's tag to the operation; 1.11 adds one for ``commands`` to each."""

TARGET = "M104"

FIRST_TOOL = 0


class OperationTranslator:
    """Translates commands of operations; what a person typed or a file holds stays as it is.

    ``machine()`` is the view of the model that commands depend on. ``is_on(row)`` says whether
    a row of the table is switched on. ``refused(code, detail)`` only takes note. ``profile()`` is
    the printer profile of the connection.
    """

    def __init__(self, machine, is_on, refused, *, profile):
        self._machine = machine
        self._profile = profile
        self._is_on = is_on
        self._refused = refused
        # an operation's commands are queued one after the other by one thread
        self._callers = threading.local()

    def translate(self, cmd, gcode, tags):
        """Return what to queue in place of ``cmd``, ``None`` to queue it as it is."""
        operation = next((OPERATION_OF_TAG[tag] for tag in tags if tag in OPERATION_OF_TAG), "")
        row = row_for(operation, gcode)
        if row is None:
            return None
        machine = self._machine()
        if gcode == TARGET:
            cmd = self._with_tool(cmd, machine)
        memory = self._callers.__dict__.setdefault("memory", Memory())
        # a mode counts for what follows also where it goes out as it is
        outcome = translate(row, cmd, machine, memory)
        if not is_on(row, self._is_on):
            return None
        if isinstance(outcome, Refused):
            self._refused(outcome.code, outcome.detail)
            return NOTHING
        return outcome

    def _with_tool(self, cmd, machine):
        """Return a target with the tool that OctoPrint has left out.

        With one extruder it says nothing of ``tool0``, the only one that it then takes; without a
        number the board heats whatever tool is selected.
        """
        if "T" in cmd or FIRST_TOOL not in machine.tools or takes_tool_numbers(self._profile()):
            return cmd
        return f"{cmd} T{FIRST_TOOL}"
