"""``rr_model``, and the status forms before it: ``rr_status``, ``rr_config``."""

from __future__ import annotations

import time

from ...device.live_members import LiveMembers
from ...device.network_access import NetworkAccess
from ...firmware import Firmware
from ...gcodes.queries.old_status import OldStatus
from ...line.switches import FaultSwitches
from ...model.om import OUT_OF_BUFFERS as NO_ROOM
from ...model.om import ModelText
from ...model.tree import ObjectModel
from ...text.letters import utf8
from .answers import OUT_OF_BUFFERS, text_answer
from .output_buffers import OutputBuffers
from .request_parser import Request
from .requests import RequestRow, RequestRows, Waiting

PATIENCE_SECONDS = 0.5
"""How long a model waits for free buffers (3.5.2 and later, seen in firmware)."""


class ModelSource:
    """The object model as the network sees it."""

    def __init__(
        self, *, model: ObjectModel, live: LiveMembers, text: ModelText, faults: FaultSwitches
    ):
        self._model = model
        self._live = live
        self._text = text
        self._faults = faults

    def reply(self, key: str, flags: str) -> str:
        """Return the JSON text; ``state.thisInput`` is nobody's."""
        self._live.refresh()
        model = dict(self._model.data)
        if "thisInput" in model["state"]:
            model["state"] = {**model["state"], "thisInput": None}
        exponents = self._faults.is_on("exponent")
        text = self._text.reply(model, key, flags, exponents=exponents)
        return self._faults.model_text(text)


class ModelRequests:
    """Answers with parts of the object model."""

    def __init__(
        self,
        source: ModelSource,
        buffers: OutputBuffers,
        *,
        access: NetworkAccess,
        firmware: Firmware,
    ):
        self._source = source
        self._buffers = buffers
        self._access = access
        self._waits = firmware.waits_for_buffers

    def requests(self) -> RequestRows:
        return {"model": RequestRow(self._model, since=(3, 1))}

    def _model(self, request: Request) -> Waiting:
        """3.5 and later wait for buffers, and nothing but a model does."""
        until = time.monotonic() + PATIENCE_SECONDS
        if self._waits:
            yield lambda: self._buffers.are_enough() or time.monotonic() >= until
            if not self._buffers.are_enough():
                return OUT_OF_BUFFERS
        key, flags = (request.parameter(name) or "" for name in ("key", "flags"))
        text = self._source.reply(key, flags)
        if text == NO_ROOM or len(utf8(text)) > self._buffers.room:
            return OUT_OF_BUFFERS
        return text_answer(text + "\n", self._access.cors_site)


STATUS_TYPES = {1: 2, 2: 3, 3: 4}
"""``type`` of rr_status → ``S`` of M408; any other number is 1, and without one it is S1."""
FLAT, CONFIGURATION = 1, 5
_BEHIND_PARAMETERS = ',"sensors":'


class OldStatusRequests:
    """Status as it was told before the object model, and for as long as there is M408."""

    def __init__(self, status: OldStatus, model: ObjectModel, access: NetworkAccess):
        self._status = status
        self._model = model
        self._access = access

    def requests(self) -> RequestRows:
        return {
            "status": RequestRow(self._tell, until=(3, 7)),
            "config": RequestRow(self._configuration, until=(3, 7)),
        }

    def _tell(self, request: Request) -> bytes:
        kind = FLAT
        if request.parameter("type") is not None:
            kind = STATUS_TYPES.get(request.number("type"), STATUS_TYPES[1])
        seq = f',"seq":{(self._model.data.get("seqs") or {}).get("reply", 0)}'
        text = self._status.text(kind)
        if kind == FLAT:
            text = f"{text[:-1]}{seq}}}"
        else:
            text = text.replace(_BEHIND_PARAMETERS, seq + _BEHIND_PARAMETERS, 1)
        return text_answer(text + "\n", self._access.cors_site)

    def _configuration(self, request: Request) -> bytes:
        return text_answer(self._status.text(CONFIGURATION) + "\n", self._access.cors_site)
