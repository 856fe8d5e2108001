"""``rr_gcode`` and ``rr_reply``: what is said to a board, and what it says."""

from __future__ import annotations

from ...device.network_access import NetworkAccess
from .answers import TEXT, text_answer
from .http_input import HttpInput
from .pending_replies import PendingReplies
from .request_parser import Request
from .requests import RequestRow, RequestRows


class TalkRequests:
    """G-code in, text out; nothing ties one to the other."""

    def __init__(self, access: NetworkAccess, gcode: HttpInput, replies: PendingReplies):
        self._access = access
        self._gcode = gcode
        self._replies = replies

    def requests(self) -> RequestRows:
        return {"gcode": RequestRow(self._take), "reply": RequestRow(self._reply)}

    def _take(self, request: Request) -> bytes:
        return text_answer(
            self._gcode.put(request.parameter("gcode") or ""), self._access.cors_site
        )

    def _reply(self, request: Request) -> bytes:
        return text_answer(self._replies.fetch(), self._access.cors_site, TEXT)
