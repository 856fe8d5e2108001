"""A request to DSF's web server, and what it is answered with."""

from __future__ import annotations

import email
import email.policy
import http
from collections.abc import Generator, Mapping
from typing import Callable, NamedTuple, Union
from urllib.parse import parse_qs, unquote, unquote_plus

from ...text.letters import utf8

JSON, TEXT, BYTES = "application/json", "text/plain; charset=utf-8", "application/octet-stream"


class MachineRequest(NamedTuple):
    """A request whose session has been looked up."""

    method: str
    path: str
    """As it came, percent signs and all."""
    query: str
    headers: Mapping[str, str]
    """Names are in lower case."""
    body: bytes
    address: str

    def parameter(self, name: str) -> str | None:
        """Return a parameter, whose case doesn't count; ``None`` where it isn't given."""
        given = parse_qs(self.query, keep_blank_values=True)
        found = {key.lower(): values[0] for key, values in given.items()}
        return found.get(name.lower())

    def is_set(self, name: str) -> bool:
        return (self.parameter(name) or "").lower() == "true"

    def fields(self) -> dict[str, str]:
        """Return the fields of a form in either of its encodings."""
        kind = self.headers.get("content-type", "")
        if not kind.startswith("multipart/"):
            text = self.body.decode("utf-8", "replace")
            return {name: values[0] for name, values in parse_qs(text).items()}
        head = f"Content-Type: {kind}\r\n\r\n".encode()
        message = email.message_from_bytes(head + self.body, policy=email.policy.HTTP)
        found = {}
        for part in message.iter_parts() if message.is_multipart() else ():
            name = part.get_param("name", header="content-disposition")
            content = part.get_payload(decode=True)
            if isinstance(name, str) and isinstance(content, bytes):
                found[name] = content.decode("utf-8", "replace").strip("\r\n")
        return found


class MachineAnswer(NamedTuple):
    """Status, text or bytes, and type of an answer."""

    status: int
    body: bytes = b""
    kind: str = TEXT

    def data(self, keeps_open: bool) -> bytes:
        """Return the bytes of the answer."""
        phrase = http.HTTPStatus(self.status).phrase
        head = f"HTTP/1.1 {self.status} {phrase}\r\n"
        if self.status != http.HTTPStatus.NO_CONTENT:
            head += f"Content-Type: {self.kind}\r\nContent-Length: {len(self.body)}\r\n"
        if not keeps_open:
            head += "Connection: close\r\n"
        return (head + "Server: Kestrel\r\nCache-Control: no-cache\r\n\r\n").encode() + self.body


DONE, CREATED = MachineAnswer(204), MachineAnswer(201)
UNAUTHORIZED, FORBIDDEN = MachineAnswer(401), MachineAnswer(403)
NOT_FOUND, CONFLICT = MachineAnswer(404), MachineAnswer(409)


def json_answer(text: str, status: int = 200) -> MachineAnswer:
    """Return an answer of that JSON."""
    return MachineAnswer(status, utf8(text), f"{JSON}; charset=utf-8")


def text_answer(text: str, status: int = 200) -> MachineAnswer:
    """Return an answer of that text."""
    return MachineAnswer(status, utf8(text))


WaitingAnswer = Generator[Callable[[], bool], None, MachineAnswer]
MachineOutcome = Union[MachineAnswer, WaitingAnswer]
Function = Callable[[MachineRequest, str], MachineOutcome]


class MachineRow(NamedTuple):
    """What a request does; it is given the rest of the path, decoded twice as DSF does."""

    method: str
    path: str
    function: Function
    since: tuple[int, ...] = ()
    takes_rest: bool = False
    is_open: bool = False
    """Whether strangers may ask."""


def decoded(path: str) -> str:
    """Return a path that was decoded once as one and once as a form's field."""
    return unquote_plus(unquote(path))
