"""A board on its own on the network."""

from __future__ import annotations

import socket
import time
from typing import Callable

from ..board import Board
from ..interpreter.urgent import Urgent
from .network_face import NetworkFace
from .rr.folder_requests import ChangeRequests, FolderRequests
from .rr.http_input import HttpInput
from .rr.http_server import HttpServer
from .rr.http_sessions import HttpSessions
from .rr.model_requests import ModelRequests, OldStatusRequests
from .rr.output_buffers import OutputBuffers
from .rr.pending_replies import PendingReplies
from .rr.print_file_requests import PrintFileRequests
from .rr.standalone import Standalone
from .rr.talk_requests import TalkRequests

HTTP = "HTTP"
BOOT_SECONDS = 5.0
"""Simulated seconds from a restart until the network is back (5 to 20 on WiFi)."""
CORS_SINCE = (3, 2)
"""Before that every page may ask; from here on those that M586 names."""
DUET2_RESPONDERS, MINI_RESPONDERS, LARGE_RESPONDERS = 3, 4, 6
"""Requests in work at the same time (RRF 3.5 Network.h:25-37); a Duet 2 has 4 up to 3.4."""


class HttpBoard(NetworkFace):
    """Answers ``rr_*``; ``clock`` gives the seconds that sessions live in."""

    def __init__(
        self,
        board: Board,
        host: str = "127.0.0.1",
        port: int = 0,
        *,
        clock: Callable[[], float] = time.monotonic,
    ):
        super().__init__(board, host, port)
        self._back_at = 0.0
        self.sessions = HttpSessions(
            board.network_access, board.firmware, faults=board.faults, clock=clock
        )
        self.replies = PendingReplies(board.object_model, self.sessions, clock)
        self._server = HttpServer(
            self._standalone(),
            self.delivery,
            responders=self._responders(),
            at_board=self.at_board,
            ended=self.ended,
        )
        if not board.firmware.at_least(*CORS_SINCE):
            board.network_access.allow_site("*")
        with board.lock:
            board.faults.register(self.sessions)
            board.restart.register(self._restarted)
            board.output.listeners.append(self.replies.overhear)
            board.replies.takers[HTTP] = self.replies.keep

    def converse(self, client: socket.socket, address: str) -> None:
        self._server.converse(client, address)

    def unplug(self) -> None:
        self.board.output.listeners.remove(self.replies.overhear)
        del self.board.replies.takers[HTTP]

    def is_up(self) -> bool:
        return super().is_up() and self.board.clock.now >= self._back_at

    def _restarted(self) -> None:
        self.sessions.forget()
        self.replies.forget()
        self.board.use_channel(HTTP)
        self._back_at = self.board.clock.now + BOOT_SECONDS

    def _responders(self) -> int:
        board = self.board.mainboard
        if board.is_duet2:
            return DUET2_RESPONDERS if self.board.firmware.at_least(3, 5) else MINI_RESPONDERS
        return MINI_RESPONDERS if board.wifi else LARGE_RESPONDERS

    def _standalone(self) -> Standalone:
        board, access, firmware = self.board, self.board.network_access, self.board.firmware
        buffers = OutputBuffers(
            board.mainboard.buffers(firmware), lambda: self.replies.buffers, board.faults
        )
        result = Standalone(
            firmware=firmware,
            board=board.mainboard.short_name,
            access=access,
            sessions=self.sessions,
            clock=board.clock,
            writer=self.writer,
        )
        result.register(
            TalkRequests(access, self._input(), self.replies),
            ModelRequests(self.source, buffers, access=access, firmware=firmware),
            OldStatusRequests(board.old_status, board.object_model, access),
            FolderRequests(board.card, board.folder_text, buffers=buffers, access=access),
            ChangeRequests(
                card=board.card,
                job=board.job,
                model=board.object_model,
                output=board.output,
                access=access,
                says_why=firmware.at_least(3, 5),
            ),
            PrintFileRequests(
                board.card, board.job, board.file_text, access=access, firmware=firmware
            ),
        )
        return result

    def _input(self) -> HttpInput:
        board = self.board
        channel = board.use_channel(HTTP)
        urgent = Urgent(
            gcodes=board.gcodes,
            decoder=board.decoder,
            emergency=board.emergency,
            channel=channel,
            cancels_waits=board.firmware.looks_at_usb,
        )
        return HttpInput(channel, urgent, board.firmware)
