"""``/machine/``: sessions, the model, G-code (DSF MachineController.cs)."""

from __future__ import annotations

from collections.abc import Sequence

from .codes import Codes
from .machine_model import MachineModel, as_json
from .machine_request import (
    DONE,
    FORBIDDEN,
    UNAUTHORIZED,
    MachineAnswer,
    MachineRequest,
    MachineRow,
    WaitingAnswer,
    json_answer,
    text_answer,
)
from .sbc_sessions import SbcSessions

SESSIONS_SINCE = (3, 4)
MODEL_SINCE = (3, 4)


class MachineRequests:
    """Everything but files."""

    def __init__(self, sessions: SbcSessions, model: MachineModel, codes: Codes):
        self._sessions = sessions
        self._model = model
        self._codes = codes

    def rows(self) -> Sequence[MachineRow]:
        return (
            MachineRow("GET", "connect", self._connect, SESSIONS_SINCE, is_open=True),
            MachineRow("GET", "disconnect", self._disconnect, SESSIONS_SINCE),
            MachineRow("GET", "noop", lambda request, rest: DONE, SESSIONS_SINCE),
            MachineRow("GET", "model", self._whole, MODEL_SINCE),
            MachineRow("GET", "status", self._whole),
            MachineRow("POST", "code", self._run),
        )

    def _connect(self, request: MachineRequest, rest: str) -> MachineAnswer:
        session = self._sessions.log_in(request.parameter("password") or "")
        if session is None:
            return FORBIDDEN
        return json_answer(as_json({"sessionKey": session.key}))

    def _disconnect(self, request: MachineRequest, rest: str) -> MachineAnswer:
        session = self._sessions.find(request.headers.get("x-session-key"), request.address)
        if session is None:
            return UNAUTHORIZED
        self._sessions.log_out(session)
        return DONE

    def _whole(self, request: MachineRequest, rest: str) -> MachineAnswer:
        return json_answer(as_json(self._model.whole()))

    def _run(self, request: MachineRequest, rest: str) -> WaitingAnswer:
        """Answers when the code has finished, unless that isn't wanted."""
        is_awaited = not request.is_set("async")
        code = self._codes.add(request.body.decode("utf-8", "replace"), is_awaited)
        if is_awaited:
            yield lambda: code.is_done
        return text_answer(code.reply)
