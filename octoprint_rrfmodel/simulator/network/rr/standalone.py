"""A board on its own: who may ask, and what is asked (RRF 3.5 HttpResponder.cpp)."""

from __future__ import annotations

from functools import partial
from typing import Callable, Union

from ...clock import Clock
from ...device.card import Card
from ...device.network_access import NetworkAccess
from ...firmware import Firmware
from ..uploads import CardWriter, Upload, moment_of
from .answers import error_answer, options, page_answer, rejection, text_answer
from .http_sessions import HttpSessions, Session
from .request_parser import Request
from .requests import RequestGroup, RequestRow, RequestRows, UnknownRequest, Waiting

PREFIX = "/rr_"
LONGEST_PAGE_NAME = 100
NOT_AUTHORIZED = "Not authorized"
UNKNOWN_REQUEST = "Unknown request"
UNKNOWN_METHOD = "Unknown message type or not authenticated"
NO_PAGE = (
    "page not found<br>Check that the SD card is mounted and has the correct files in its /www "
    "folder"
)
BOARD_TYPES = {
    "Mini5plus": "duet5lcwifi",
    "MB6HC": "duet3mb6hc102",
    "MB6XD": "duet3mb6xd101",
    "2WiFi": "duetwifi102",
}
"""Short name of a mainboard → ``boardType`` (RRF 3.5 Platform.cpp:4023)."""


class RunningUpload:
    """An upload with the session that it keeps alive."""

    def __init__(self, upload: Upload, session: Session, *, touch: Callable[[], object], site: str):
        self.upload = upload
        self._session = session
        self._touch = touch
        self._site = site
        session.uploads += 1

    def receive(self, data: bytes) -> None:
        """Take bytes, each packet of which keeps the session."""
        self._touch()
        self.upload.receive(data)

    def end(self) -> None:
        """Let its session be given back again."""
        self._session.uploads -= 1

    def answer(self) -> bytes:
        """Finish it and return its answer."""
        return error_answer(0 if self.upload.finish() else 1, self._site)


Outcome = Union[bytes, Waiting, RunningUpload]


class WebPages:
    """Files of the web interface; whatever has no dot in its name is its first page."""

    def __init__(self, card: Card):
        self._card = card

    def first(self) -> bytes | None:
        """Return the first page's content, ``None`` without one."""
        return self._card.read("0:/www/index.html")

    def answer(self, path: str) -> bytes | None:
        """Return the file, ``None`` without one."""
        name = path.lstrip("/") or "index.html"
        if len(name) > LONGEST_PAGE_NAME:
            return None
        names = [name]
        if "." not in name.rpartition("/")[2]:
            names.append("index.html")
        elif name.endswith((".htm", ".html")):
            names.append("html404.htm")
        for wanted in names:
            for ending, is_packed in ((".gz", True), ("", False)):
                content = self._card.read(f"0:/www/{wanted}{ending}")
                if content is not None:
                    return page_answer(wanted, content, is_packed)
        return None


class Standalone:
    """Answers requests by the table that groups register in."""

    def __init__(
        self,
        *,
        firmware: Firmware,
        board: str,
        access: NetworkAccess,
        sessions: HttpSessions,
        clock: Clock,
        writer: CardWriter,
    ):
        self._firmware = firmware
        self._board = BOARD_TYPES.get(board, "unknown")
        self._access = access
        self._sessions = sessions
        self._clock = clock
        self._writer = writer
        self._pages = WebPages(writer.card)
        self._rows: dict[str, RequestRow] = {
            "upload": RequestRow(lambda request: error_answer(0, access.cors_site))
        }

    def register(self, *groups: RequestGroup) -> None:
        """Add requests."""
        for group in groups:
            rows: RequestRows = group.requests()
            self._rows.update(rows)

    def answer(self, request: Request) -> Outcome:
        """Return what a request is answered with, or the upload that it begins."""
        method, site = request.method.upper(), self._access.cors_site
        if method == "OPTIONS":
            return options(site, self._sessions.has_keys)
        if method == "GET":
            if request.path.startswith(PREFIX):
                return self._request(request, request.path[len(PREFIX) :].lower())
            page = self._pages.answer(request.path)
            return rejection(404, NO_PAGE, site) if page is None else page
        session = self._sessions.find(request.address, self._key(request))
        if method == "POST" and session is not None:
            return self._post(request, session)
        return rejection(500, UNKNOWN_METHOD, site)

    def _key(self, request: Request) -> int:
        return request.header_number("x-session-key") or 0

    def _request(self, request: Request, name: str) -> Outcome:
        site = self._access.cors_site
        session = self._session_for(request, name)
        if name == "connect" and request.parameter("password") is not None:
            return self._connect(request)
        if session is None:
            return rejection(401, NOT_AUTHORIZED, site)
        if name == "disconnect":
            return error_answer(0 if self._sessions.log_out(session) else 1, site)
        row = self._rows.get(name)
        if row is None or not row.is_known_to(self._firmware.release):
            return rejection(500, UNKNOWN_REQUEST, site)
        try:
            return row.function(request)
        except UnknownRequest:
            return rejection(500, UNKNOWN_REQUEST, site)

    def _session_for(self, request: Request, name: str) -> Session | None:
        """A login makes no session by itself; before there were keys it did (seen in firmware)."""
        admits = name != "connect" or not self._sessions.has_keys
        ask = self._sessions.admit if admits else self._sessions.find
        return ask(request.address, self._key(request))

    def _connect(self, request: Request) -> bytes:
        error, key = self._sessions.log_in(
            request.address,
            request.parameter("password") or "",
            request.parameter("sessionkey") == "yes",
        )
        if error:
            return error_answer(error, self._access.cors_site)
        moment = moment_of(request.parameter("time"))
        if moment is not None:
            self._clock.set_wall(moment)
        text = f'{{"err":0,"sessionTimeout":8000,"boardType":"{self._board}"'
        if self._firmware.api_level:
            text += f',"apiLevel":{self._firmware.api_level}'
        if self._sessions.has_keys:
            text += f',"sessionKey":{key}'
        return text_answer(text + "}", self._access.cors_site)

    def _post(self, request: Request, session: Session) -> Outcome:
        name, site = request.parameter("name"), self._access.cors_site
        if request.path.lower() != f"{PREFIX}upload" or name is None:
            return rejection(500, "only rr_upload is supported for POST requests", site)
        size = request.header_number("content-length")
        if size is None:
            return rejection(500, "invalid POST upload request", site)
        time, crc = request.parameter("time"), request.parameter("crc32")
        upload = Upload(self._writer, name, size=size, time=time, crc=crc)
        if not upload.is_possible:
            return rejection(500, "could not create file", site)
        touch = partial(self._sessions.find, session.address, session.key)
        return RunningUpload(upload, session, touch=touch, site=site)
