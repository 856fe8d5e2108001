"""A simulated RepRapFirmware board: the serial protocol byte for byte, without hardware.

Standard library only; nothing here imports OctoPrint. :class:`~.board.Board` is the device,
:class:`~.port.SimulatedSerial` a serial object for OctoPrint's transport,
:class:`~.pty.PtyBoard` a pseudo-terminal, ``python -m octoprint_rrfmodel.simulator`` the command.
"""
