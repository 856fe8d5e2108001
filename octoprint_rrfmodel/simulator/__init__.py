"""A simulated RepRapFirmware board: the serial protocol byte for byte, without hardware.

Standard library and :mod:`octoprint_rrfmodel.rrf` only; nothing here imports OctoPrint.
:class:`~.board.Board` is the device, :class:`~.port.SimulatedSerial` a serial object for
OctoPrint's transport, :class:`~.pty.PtyBoard` a pseudo-terminal,
:class:`~.network.http_board.HttpBoard` its web server,
``python -m octoprint_rrfmodel.simulator`` the command.

The floors, from the bottom to the top; a module imports from its own floor and those below:

* ``text``: letters, expressions, commands, the framing of replies.
* ``clock``: simulated time, and what waits for a moment in it.
* ``firmware``: the versions; a new one is a row, and what differs elsewhere names its release.
* ``hardware``: what a mainboard and its ``config.g`` put into an object model.
* ``machines``: the machines; a new one is a row.
* ``model``: the object model put together, as each version has it, and as text.
* ``captured``: a captured object model in a machine's place.
* ``faults``: the faults; a new one is a row, and what it does to a machine is an incident.
* ``line``: what goes out on USB, what comes in, the channels, the faults that are on.
* ``device``: what a board does in simulated time: motion, heat, card, jobs, boxes, incidents.
* ``interpreter``: from a line to the function of its G-code, and macros.
* ``gcodes``: the G-codes, a class for each group; a new one is a row of its group.
* ``assembly``: each part made once with what it uses; groups register here.
* ``board``: bytes in, bytes out, and time in between.
* ``port``, ``pty``, ``network``: faces of a board; a new one is given a ``Board``. On the network a
  request is a row of its group, and groups register in ``network.http_board``.
* ``replay``: the machine of a support bundle, as a ``Board``.
* ``__main__``: the command line.
"""
