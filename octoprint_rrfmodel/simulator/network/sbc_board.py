"""A board behind a single-board computer on the network."""

from __future__ import annotations

import socket
import time
from typing import Callable

from ..board import Board
from .network_face import NetworkFace
from .rr.standalone import BOARD_TYPES, WebPages
from .sbc.codes import Codes
from .sbc.emulated import Emulated, EmulatedFiles
from .sbc.machine_files import FileRequests, MachineFiles
from .sbc.machine_model import MachineModel
from .sbc.machine_requests import MachineRequests
from .sbc.machine_server import MachineServer
from .sbc.messages import Messages
from .sbc.routes import Routes
from .sbc.sbc_sessions import SbcSessions

IN_ORDER, AT_ONCE = "HTTP", "SBC"
"""Channel on which G-code waits for its turn, and one for what doesn't wait."""
MODE = "sbc"
"""Fault that is on as long as a computer is in front of the board: it answers for some keys."""


class SbcBoard(NetworkFace):
    """Answers ``/machine`` and what of ``rr_*`` is emulated; ``clock`` gives real seconds."""

    def __init__(
        self,
        board: Board,
        host: str = "127.0.0.1",
        port: int = 0,
        *,
        clock: Callable[[], float] = time.monotonic,
    ):
        super().__init__(board, host, port)
        self.messages = Messages(board.clock, clock)
        self.sessions = SbcSessions(board.network_access, clock)
        self.codes = Codes(board.use_channel(IN_ORDER), board.use_channel(AT_ONCE), self.messages)
        self._model = MachineModel(
            board.object_model,
            board.live,
            text=board.model_text,
            firmware=board.firmware,
            messages=self.messages,
        )
        self._server = MachineServer(
            self._routes(),
            self.delivery,
            access=board.network_access,
            at_board=self.at_board,
            model=self._model.whole,
            ended=self.ended,
        )
        with board.lock:
            board.faults.register(self.sessions)
            board.inject(MODE)
            board.restart.register(self._restarted)
            board.pumps.append(self.codes.pump)
            board.output.listeners.append(self._overhear)
            board.replies.takers.update(self.codes.takers)

    def converse(self, client: socket.socket, address: str) -> None:
        self._server.converse(client, address)

    def unplug(self) -> None:
        self.board.clear(MODE)
        self.board.pumps.remove(self.codes.pump)
        self.board.output.listeners.remove(self._overhear)
        for name in self.codes.takers:
            del self.board.replies.takers[name]

    def _overhear(self, text: str) -> None:
        self.messages.add(text)
        self.board.bump("reply")

    def _restarted(self) -> None:
        """The computer stays, and its sessions too."""
        self.codes.forget()
        self.board.use_channel(IN_ORDER)
        self.board.use_channel(AT_ONCE)

    def _routes(self) -> Routes:
        board = self.board
        files = MachineFiles(self.writer)
        result = Routes(
            board.firmware, self.sessions, faults=board.faults, pages=WebPages(board.card)
        )
        result.register(
            MachineRequests(self.sessions, self._model, self.codes),
            FileRequests(files),
            Emulated(
                self.sessions,
                self.codes,
                self.source,
                board_type=BOARD_TYPES.get(board.mainboard.short_name, "unknown"),
            ),
            EmulatedFiles(board.card, files),
        )
        return result
