"""The serial port ``RRF-SIM``: a board that needs no hardware."""

NAME = "RRF-SIM"


class SimulatedPort:
    """Offers and opens the port where the settings want it.

    ``settings()`` gives the simulator's settings.
    """

    def __init__(self, settings):
        self._settings = settings

    def names(self, candidates, *args, **kwargs):
        """Return the port's name, if it is offered (OctoPrint's hook for additional ports)."""
        return [NAME] if self._settings()["enabled"] else []

    def open(self, comm, port, baudrate, read_timeout, *args, **kwargs):
        """Return a connection to a board that was just switched on, ``None`` for other ports."""
        settings = self._settings()
        if port != NAME or not settings["enabled"]:
            return None
        from ...simulator.board import Board
        from ...simulator.device import demo_print
        from ...simulator.port import SimulatedSerial

        board = Board(
            settings["machine"],
            settings["firmware"],
            faults=settings["faults"],
            speed=float(settings["speed"]),
        )
        if settings["demo_print"]:
            demo_print.put_on(board.card, [tool["number"] for tool in board.tools()])
        return SimulatedSerial(board, port=port, baudrate=baudrate, timeout=read_timeout)
