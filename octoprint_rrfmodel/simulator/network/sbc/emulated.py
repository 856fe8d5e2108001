"""``rr_*`` as DSF emulates it, differently from a board (DSF RepRapFirmwareController.cs)."""

from __future__ import annotations

import re
import zlib
from collections.abc import Sequence

from ...device.card import Card
from ...device.printing.file_text import SLOT
from ..rr.model_requests import ModelSource
from .codes import Code, Codes
from .machine_files import MachineFiles, listed
from .machine_model import as_json
from .machine_request import (
    DONE,
    FORBIDDEN,
    MachineAnswer,
    MachineRequest,
    MachineRow,
    json_answer,
    text_answer,
)
from .sbc_sessions import SbcSessions

SINCE = (3, 5)
_KEY = re.compile(r"[A-Za-z0-9.\[\]]*")
_FLAGS = re.compile(r"[A-Za-z0-9]*")
NO_FOLDER = '{"err":2}'


def _number(text: str | None) -> int:
    return int(text) if text and text.isdecimal() else 0


def _error(number: int) -> MachineAnswer:
    return json_answer(f'{{"err":{number}}}')


def _done(answer: MachineAnswer) -> MachineAnswer:
    return _error(0 if answer.status < 300 else 1)


class EmulatedFiles:
    """Files by the names that boards know."""

    def __init__(self, card: Card, files: MachineFiles):
        self._card = card
        self._files = files

    def rows(self) -> Sequence[MachineRow]:
        return (
            MachineRow("GET", "rr_filelist", self._details, SINCE),
            MachineRow("GET", "rr_files", self._names, SINCE),
            MachineRow("GET", "rr_fileinfo", self._tell, SINCE),
            MachineRow("GET", "rr_thumbnail", self._thumbnail, SINCE),
            MachineRow("GET", "rr_download", self._download, SINCE),
            MachineRow("POST", "rr_upload", self._upload, SINCE),
            MachineRow("GET", "rr_delete", self._delete, SINCE),
            MachineRow("GET", "rr_move", self._move, SINCE),
            MachineRow("GET", "rr_mkdir", self._make, SINCE),
        )

    def _details(self, request: MachineRequest, rest: str) -> MachineAnswer:
        asked = request.parameter("dir") or ""
        path = self._card.path_of(asked, SLOT)
        if not self._card.has_folder(path):
            return text_answer(NO_FOLDER)
        entries = [listed(entry) for entry in self._card.entries(path)]
        first = request.parameter("first")
        if first is None:
            return json_answer(as_json(entries))
        start = _number(first)
        page = {"dir": asked, "first": start, "files": entries[start:]}
        return json_answer(as_json({**page, "next": 0, "err": 0}))

    def _names(self, request: MachineRequest, rest: str) -> MachineAnswer:
        asked = request.parameter("dir") or "0:/gcodes/"
        path = self._card.path_of(asked, SLOT)
        if not self._card.has_folder(path):
            return text_answer(NO_FOLDER)
        mark = "*" if request.parameter("flagDirs") == "1" else ""
        names = [(mark if e.is_folder else "") + e.name for e in self._card.entries(path)]
        return json_answer(as_json({"dir": asked, "first": 0, "files": names, "next": 0, "err": 0}))

    def _tell(self, request: MachineRequest, rest: str) -> MachineAnswer:
        answer = self._files.tell(request.parameter("name") or "")
        if answer.status != 200:
            return _error(1)
        return json_answer('{"err":0,' + answer.body.decode()[1:])

    def _thumbnail(self, request: MachineRequest, rest: str) -> MachineAnswer:
        """All of it in one piece."""
        name, offset = request.parameter("name") or "", _number(request.parameter("offset"))
        data = self._files.picture(name, offset)
        if data is None:
            return _error(1)
        found = {"fileName": name, "offset": offset, "data": data, "next": 0, "err": 0}
        return json_answer(as_json(found))

    def _download(self, request: MachineRequest, rest: str) -> MachineAnswer:
        return self._files.read(request.parameter("name") or "")

    def _upload(self, request: MachineRequest, rest: str) -> MachineAnswer:
        """The file is written in its place: what was there is lost where the checksum is wrong."""
        name, crc = request.parameter("name") or "", request.parameter("crc32")
        self._files.write(name, request.body, request.parameter("time"))
        if crc is not None and crc.lower() != f"{zlib.crc32(request.body):08x}":
            self._files.delete(name, is_tree=False)
            return _error(1)
        return _error(0)

    def _delete(self, request: MachineRequest, rest: str) -> MachineAnswer:
        is_tree = request.parameter("recursive") == "yes"
        return _done(self._files.delete(request.parameter("name") or "", is_tree=is_tree))

    def _move(self, request: MachineRequest, rest: str) -> MachineAnswer:
        old, new = request.parameter("old") or "", request.parameter("new") or ""
        is_forced = request.parameter("deleteexisting") == "yes"
        return _done(self._files.move(old, new, is_forced=is_forced))

    def _make(self, request: MachineRequest, rest: str) -> MachineAnswer:
        return _done(self._files.make(request.parameter("dir") or ""))


class Emulated:
    """Sessions by address, G-code and the model."""

    def __init__(
        self, sessions: SbcSessions, codes: Codes, source: ModelSource, *, board_type: str
    ):
        self._sessions = sessions
        self._codes = codes
        self._source = source
        self._board_type = board_type
        self._sent: dict[str, list[Code]] = {}

    def rows(self) -> Sequence[MachineRow]:
        return (
            MachineRow("GET", "rr_connect", self._connect, SINCE, is_open=True),
            MachineRow("GET", "rr_disconnect", self._disconnect, SINCE),
            MachineRow("GET", "rr_gcode", self._run, SINCE),
            MachineRow("GET", "rr_reply", self._reply, SINCE),
            MachineRow("GET", "rr_model", self._model, SINCE),
        )

    def _connect(self, request: MachineRequest, rest: str) -> MachineAnswer:
        if not self._sessions.log_in_address(request.address, request.parameter("password") or ""):
            return json_answer('{"err":1,"isEmulated":true}')
        return json_answer(
            '{"apiLevel":1,"err":0,"isEmulated":true,"sessionTimeout":8000,'
            f'"boardType":"{self._board_type}"}}'
        )

    def _disconnect(self, request: MachineRequest, rest: str) -> MachineAnswer:
        session = self._sessions.find(request.headers.get("x-session-key"), request.address)
        if session is None:
            return FORBIDDEN
        self._sessions.log_out(session)
        return DONE

    def _run(self, request: MachineRequest, rest: str) -> MachineAnswer:
        text = request.parameter("gcode") or ""
        if text:
            code = self._codes.add(text, is_awaited=True)
            self._sent.setdefault(request.address, []).append(code)
        return json_answer('{"bufferSpace":255,"err":0}')

    def _reply(self, request: MachineRequest, rest: str) -> MachineAnswer:
        sent = self._sent.get(request.address, [])
        done = [code for code in sent if code.is_done]
        self._sent[request.address] = [code for code in sent if not code.is_done]
        return text_answer("".join(f"{code.reply}\n" for code in done))

    def _model(self, request: MachineRequest, rest: str) -> MachineAnswer:
        key, flags = request.parameter("key") or "", request.parameter("flags") or ""
        if not _KEY.fullmatch(key) or not _FLAGS.fullmatch(flags):
            return _error(1)
        return json_answer(self._source.reply(key, flags))
