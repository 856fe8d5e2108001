"""Whatever bytes come over the network, there is an answer or an end, and the board lives on."""

from __future__ import annotations

import contextlib
import socket

import hypothesis
import pytest
from hypothesis import strategies as st

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from octoprint_rrfmodel.simulator.network.rr.request_parser import Rejected, Request, read_request
from octoprint_rrfmodel.simulator.network.sbc_board import SbcBoard

NAMES = [
    "connect",
    "disconnect",
    "gcode",
    "reply",
    "model",
    "status",
    "config",
    "filelist",
    "files",
    "fileinfo",
    "thumbnail",
    "download",
    "delete",
    "move",
    "mkdir",
    "upload",
]
KEYS = [
    "password",
    "key",
    "flags",
    "gcode",
    "type",
    "dir",
    "first",
    "max",
    "name",
    "offset",
    "old",
    "new",
    "recursive",
    "flagDirs",
]
VALUES = st.sampled_from(
    [
        "",
        "0",
        "-1",
        "99999999999",
        "0:/",
        "1:/x",
        "..",
        "%2F",
        "a%00b",
        "%ZZ",
        "[",
        "#",
        "M112",
        "d9",
    ]
) | st.text(st.characters(codec="ascii", exclude_characters=" \n\r\t"), max_size=12)
PARAMETERS = st.lists(st.tuples(st.sampled_from(KEYS), VALUES), max_size=5)
METHODS = st.sampled_from(["GET", "POST", "PUT", "DELETE", "OPTIONS", "X"])
LINES = st.tuples(METHODS, st.sampled_from(NAMES), PARAMETERS)
LENGTHS = st.sampled_from(["", "Content-Length: x\r\n", "Content-Length: 3\r\n"])


@hypothesis.given(st.binary(max_size=300) | st.text(max_size=200).map(str.encode))
def test_the_parser_reads_or_rejects(data):
    with contextlib.suppress(Rejected):
        found = read_request(b"GET " + data + b"\r\n\r\n")
        assert isinstance(found, Request)


@pytest.fixture(scope="module", params=[HttpBoard, SbcBoard])
def face(request):
    with request.param(Board("cartesian", "3.5.3")) as served:
        yield served


@hypothesis.settings(max_examples=60)
@hypothesis.given(line=LINES, length=LENGTHS, is_machine=st.booleans())
def test_any_request_is_answered(face, line, length, is_machine):
    method, name, parameters = line
    query = "&".join(f"{key}={value}" for key, value in parameters)
    path = f"/machine/{name}/{query}" if is_machine else f"/rr_{name}?{query}"
    head = f"{method} {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n{length}\r\n"
    with socket.create_connection(("127.0.0.1", face.port), timeout=20) as client:
        client.sendall(head.encode() + b"G28")
        client.shutdown(socket.SHUT_WR)
        with contextlib.suppress(ConnectionResetError):
            while client.recv(65536):
                pass
    assert face._acceptor._thread.is_alive()
