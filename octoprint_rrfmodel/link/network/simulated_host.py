"""The host ``RRF-SIM``: a board on the network that needs no hardware."""

import threading

from .address import Address

NAME = "rrf-sim"
"""As addresses are compared: in small letters."""

OF_A_BOARD = ("machine", "firmware", "speed", "faults")


class SimulatedHost:
    """Runs the board where the settings want it; ``settings()`` gives the simulator's settings."""

    def __init__(self, settings):
        self._settings = settings
        self._lock = threading.Lock()
        self._board = None
        self._made_of = None

    def place_of(self, address):
        """Return where to ask the board at an address; another than the simulated one is itself."""
        settings = self._settings()
        if address.host != NAME or not settings["enabled"]:
            return address
        with self._lock:
            made_of = {name: settings[name] for name in OF_A_BOARD}
            # the same one as long as it is to be the same: what it prints goes on meanwhile
            if self._board is None or made_of != self._made_of:
                self._stop()
                self._board, self._made_of = self._start(**made_of), made_of
            return Address("http", "127.0.0.1", int(self._board.url.rpartition(":")[2]))

    def stop(self):
        """Switch it off."""
        with self._lock:
            self._stop()

    def _stop(self):
        board, self._board = self._board, None
        if board is not None:
            board.stop()

    def _start(self, machine, firmware, speed, faults):
        from ...simulator.board import Board
        from ...simulator.network.http_board import HttpBoard

        return HttpBoard(Board(machine, firmware, speed=speed, faults=faults)).start()
