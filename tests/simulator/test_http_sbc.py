"""A board behind a single-board computer over HTTP (rrf-network.md 9)."""

from __future__ import annotations

import contextlib
import http.client
import json
import socket
import zlib
from urllib.parse import quote

import pytest

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.sbc_board import SbcBoard
from tests.simulator.patched import applied
from tests.support.waiting import wait_for

websocket = pytest.importorskip("websocket")


class Answer:
    def __init__(self, reply):
        self.status = reply.status
        self.body = reply.read()
        self.kind = reply.getheader("Content-Type")

    @property
    def json(self):
        return json.loads(self.body)


def close_code(client):
    """Return why the server ends the socket; nothing is answered, it may be gone already."""
    frame = client.recv_frame()
    while frame.opcode != websocket.ABNF.OPCODE_CLOSE:
        frame = client.recv_frame()
    return int.from_bytes(frame.data[:2], "big")


class SbcBench:
    """A board behind a computer, and a client that keeps its connection."""

    def __init__(self, firmware="3.5.3", password=""):
        self.time = 0.0
        self.board = Board("cartesian", firmware, clock=lambda: self.time)
        self.board.network_access.password = password
        self.face = SbcBoard(self.board, clock=lambda: self.time)
        self.key = None
        self.sockets = contextlib.ExitStack()
        self.client = http.client.HTTPConnection("127.0.0.1", self.face.port, timeout=20)

    def wait(self, seconds):
        with self.board.lock:
            self.time += seconds
            self.board.advance()

    def ask(self, method, path, body=None, **headers):
        if self.key is not None:
            headers["X-Session-Key"] = self.key
        self.client.request(
            method, path, body, {k.replace("_", "-"): v for k, v in headers.items()}
        )
        return Answer(self.client.getresponse())

    def get(self, path):
        return self.ask("GET", path)

    def code(self, text, query=""):
        return self.ask("POST", f"/machine/code{query}", text.encode()).body.decode()

    def log_in(self, password=""):
        answer = self.get(f"/machine/connect?password={password}")
        if answer.status == 200:
            self.key = answer.json["sessionKey"]
        return answer

    def socket(self, key=None, **options):
        """Return a websocket and the first message, which is acknowledged."""
        key = self.key if key is None else key
        query = f"?sessionKey={key}" if key else ""
        url = f"ws://127.0.0.1:{self.face.port}/machine{query}"
        client = websocket.create_connection(
            url, timeout=20, **{"suppress_origin": True, **options}
        )
        self.sockets.callback(client.shutdown)
        model = json.loads(client.recv())
        client.send("OK\n")
        return client, model


@contextlib.contextmanager
def sbc_bench(*arguments, **options):
    bench = SbcBench(*arguments, **options)
    with bench.face, contextlib.closing(bench.client), bench.sockets:
        yield bench


@pytest.fixture
def bench():
    with sbc_bench() as bench:
        bench.log_in()
        yield bench


def test_sessions():
    with sbc_bench(password="secret") as bench:
        assert bench.get("/machine/model").status == 401
        assert bench.log_in("wrong").status == 403
        assert len(bench.log_in("secret").json["sessionKey"]) == 32
        assert bench.get("/machine/model").status == 200
        bench.wait(7)
        assert bench.get("/machine/noop").status == 204
        bench.wait(7)
        assert bench.get("/machine/disconnect").status == 204
        assert bench.get("/machine/model").status == 401


def test_a_session_ends_unless_a_socket_is_open(bench):
    client, _ = bench.socket()
    bench.wait(20)
    assert bench.get("/machine/noop").status == 204
    bench.sockets.close()
    wait_for(lambda: not any(s.uses for s in bench.face.sessions._by_key.values()), what="the end")
    bench.wait(20)
    assert bench.get("/machine/noop").status == 401


VERSIONS = {
    "3.3": {"connect": 404, "model": 404, "status": 200, "emulated": 404},
    "3.4": {"connect": 200, "model": 200, "status": 200, "emulated": 404},
    "3.5.3": {"connect": 200, "model": 200, "status": 200, "emulated": 200},
}


@pytest.mark.parametrize(("firmware", "statuses"), VERSIONS.items(), ids=VERSIONS)
def test_versions(firmware, statuses):
    with sbc_bench(firmware) as bench:
        assert {
            "connect": bench.get("/machine/connect?password=").status,
            "model": bench.get("/machine/model").status,
            "status": bench.get("/machine/status").status,
            "emulated": bench.get("/rr_connect?password=").status,
        } == statuses


def test_the_model_is_whole_and_not_the_boards(bench):
    model = bench.get("/machine/model").json
    assert model["sbc"]["dsf"]["version"] == "3.5.3"
    assert model["messages"] == [] and model["plugins"] == {}
    assert "seqs" not in model
    assert model["heat"]["heaters"][0]["current"] == 21.3


def test_code_is_answered_when_it_has_finished(bench):
    assert bench.code("M115").startswith("FIRMWARE_NAME: RepRapFirmware")
    assert bench.code("G92 X1") == ""
    assert bench.code('M118 P3 S"a"\nM118 P3 S"b"') == "a\nb"
    other = http.client.HTTPConnection("127.0.0.1", bench.face.port, timeout=20)
    with contextlib.closing(other):
        other.request("POST", "/machine/code", "G4 S5\nM115", {"X-Session-Key": bench.key})
        wait_for(lambda: not bench.board.channels["HTTP"].is_idle, what="the code to begin")
        assert bench.get("/machine/noop").status == 204
        bench.wait(6)
        assert other.getresponse().read().startswith(b"FIRMWARE_NAME")


def test_code_that_is_not_awaited_says_it_in_a_message(bench):
    client, model = bench.socket()
    assert bench.code("M115", "?async=true") == ""
    patch = json.loads(client.recv())
    (message,) = patch["messages"]
    assert message["type"] == 0 and message["content"].startswith("FIRMWARE_NAME")


@pytest.mark.parametrize("urgent", ["M112", "M122", "M292 P0"])
def test_some_codes_do_not_wait(bench, urgent):
    bench.code("G4 S100", "?async=true")
    bench.code(urgent)
    assert (bench.board.model["state"]["status"] == "halted") == (urgent == "M112")


def test_a_print_and_its_layers(bench):
    bench.code('M32 "Two layers.gcode"')
    layers = []
    for _ in range(400):
        bench.wait(2)
        bench.log_in()
        layers = bench.face._model.whole()["job"]["layers"]
        if layers:
            break
    assert layers[0]["height"] == 0.2 and layers[0]["duration"] > 0


def test_errors_are_messages_of_their_kind(bench):
    bench.board.message("Error: something\n")
    bench.board.message("Warning: else\n")
    messages = bench.get("/machine/model").json["messages"]
    assert [(m["type"], m["content"]) for m in messages] == [(2, "something"), (1, "else")]
    bench.wait(61)
    bench.log_in()
    assert bench.get("/machine/model").json["messages"] == []


def test_the_socket_tells_what_changes_after_each_ok(bench):
    client, model = bench.socket()
    bench.code("M104 S50", "?async=true")
    patch = json.loads(client.recv())
    assert patch["heat"]["heaters"][1]["active"] == 50
    model = applied(model, patch)
    bench.wait(3)
    client.send("PING\n")
    assert client.recv() == "PONG\n"
    client.send("OK\n")
    model = applied(model, json.loads(client.recv()))
    now = bench.get("/machine/model").json
    assert {**model, "inputs": None} == {**now, "inputs": None}


def test_a_message_may_be_garbled_like_any_answer(bench):
    client, _ = bench.socket()
    bench.board.inject("net_garbled")
    bench.code("M104 S60", "?async=true")
    with pytest.raises(ValueError):
        json.loads(client.recv())
    client.send("OK\n")
    bench.code("M104 S70", "?async=true")
    assert json.loads(client.recv())["heat"]["heaters"][1]["active"] == 70


def test_a_stop_ends_what_is_waited_for(bench):
    """Past a heat-up whose request is still open."""
    other = http.client.HTTPConnection("127.0.0.1", bench.face.port, timeout=20)
    with contextlib.closing(other):
        other.request("POST", "/machine/code", "T0\nM109 S200", {"X-Session-Key": bench.key})
        wait_for(lambda: not bench.board.channels["HTTP"].is_idle, what="the heat-up to begin")
        assert bench.code("M112") == ""
        assert bench.board.model["state"]["status"] == "halted"
        assert other.getresponse().status == 200


BAD = {
    "other text": ("send", "X\n", 1007),
    "bytes": ("send_binary", b"OK\n", 1003),
    "too long": ("send", "x" * 200, 1003),
}


@pytest.mark.parametrize(("how", "what", "code"), BAD.values(), ids=BAD)
def test_the_socket_ends_where_it_does_not_understand(bench, how, what, code):
    client, _ = bench.socket()
    getattr(client, how)(what)
    assert close_code(client) == code


REFUSED = {
    "a bad key": ({"key": "0" * 32}, 403),
    "a foreign page": ({"suppress_origin": False, "origin": "http://evil.example"}, 403),
}


@pytest.mark.parametrize(("options", "status"), REFUSED.values(), ids=REFUSED)
def test_the_socket_is_refused(bench, options, status):
    with pytest.raises(websocket.WebSocketBadStatusException) as refused:
        bench.socket(**options)
    assert refused.value.status_code == status


def test_the_socket_wants_an_upgrade(bench):
    assert bench.get("/machine").status == 400


def test_files(bench):
    path = quote("0:/gcodes/new folder/a b.g", safe="")
    put = bench.ask("PUT", f"/machine/file/{path}?timeModified=2026-11-29T12:00:01", b"G28\n")
    assert put.status == 201
    assert bench.get(f"/machine/file/{path}").body == b"G28\n"
    listed = bench.get("/machine/directory/0%3A%2Fgcodes%2Fnew%20folder").json
    assert listed == [
        {"type": "f", "name": "a b.g", "size": 4, "date": "2026-11-29T12:00:00.0000000+00:00"}
    ]
    assert bench.ask("DELETE", "/machine/file/0%3A%2Fgcodes%2Fnew%20folder").status == 500
    assert bench.ask("DELETE", f"/machine/file/{path}").status == 204
    assert bench.ask("DELETE", f"/machine/file/{path}").status == 404
    assert bench.get(f"/machine/fileinfo/{path}").status == 404
    assert bench.get("/machine/directory/0%3A%2Fnowhere").status == 404
    assert bench.ask("PUT", "/machine/directory/0%3A%2Fsome%2Fwhere").status == 201
    assert bench.ask("DELETE", "/machine/file/0%3A%2Fsome?recursive=true").status == 204


NAMES = {"a%252Bb": "a+b", "a+b": "a b", "50%2525": "50%", "a%2Bb": "a b"}


@pytest.mark.parametrize(("sent", "name"), NAMES.items(), ids=NAMES)
def test_paths_are_decoded_twice(bench, sent, name):
    bench.ask("PUT", f"/machine/file/0%3A%2Fgcodes%2F{sent}", b"x")
    assert bench.board.card.read(f"0:/gcodes/{name}") == b"x"


def form(kind, **fields):
    if kind == "urlencoded":
        text = "&".join(f"{name}={quote(value)}" for name, value in fields.items())
        return text.encode(), "application/x-www-form-urlencoded"
    parts = "".join(
        f'--B\r\nContent-Disposition: form-data; name="{name}"\r\n\r\n{value}\r\n'
        for name, value in fields.items()
    )
    return f"{parts}--B--\r\n".encode(), "multipart/form-data; boundary=B"


@pytest.mark.parametrize("kind", ["urlencoded", "multipart"])
def test_moves(bench, kind):
    def move(old, new, **more):
        body, kind_of_body = form(kind, **{"from": old, "to": new, **more})
        return bench.ask("POST", "/machine/file/move", body, Content_Type=kind_of_body).status

    square, other = "0:/gcodes/square.gcode", "0:/gcodes/other.gcode"
    assert move("0:/none.g", other) == 404
    assert move("0:/none.g", other, force="true") == 204
    assert move(square, "0:/gcodes/Two layers.gcode") == 409
    assert move(square, other) == 204
    assert bench.board.card.read(square) is None
    assert move(other, "0:/gcodes/Two layers.gcode", force="true") == 204


def test_information_with_pictures(bench):
    path = "/machine/fileinfo/0%3A%2Fgcodes%2Fsquare.gcode"
    (without,) = bench.get(path).json["thumbnails"]
    (given,) = bench.get(f"{path}?readThumbnailContent=true").json["thumbnails"]
    assert without["data"] is None
    assert len(given["data"]) == given["size"]


def test_what_is_emulated_differs_from_a_board(bench):
    bench.key = None
    assert bench.get("/rr_connect?password=").json == {
        "apiLevel": 1,
        "err": 0,
        "isEmulated": True,
        "sessionTimeout": 8000,
        "boardType": "duet5lcwifi",
    }
    assert bench.get("/rr_gcode?gcode=M115").json == {"bufferSpace": 255, "err": 0}
    wait_for(lambda: b"FIRMWARE_NAME" in bench.get("/rr_reply").body, what="the reply")
    assert bench.get("/rr_model?key=state.status").json["result"] == "idle"
    assert bench.get("/rr_model?key=%23tools").json == {"err": 1}
    assert isinstance(bench.get("/rr_filelist?dir=0:/gcodes").json, list)
    assert bench.get("/rr_filelist?dir=0:/gcodes&first=0").json["err"] == 0
    assert bench.get("/rr_filelist?dir=0:/none").kind.startswith("text/plain")
    crc = f"{zlib.crc32(b'G28'):08x}"
    upload = "/rr_upload?name=0:/gcodes/a.g&crc32="
    assert bench.ask("POST", upload + crc, b"G28").json == {"err": 0}
    assert bench.ask("POST", upload + "1", b"G29").json == {"err": 1}
    assert bench.get("/rr_download?name=0:/gcodes/a.g").status == 404
    assert bench.get("/rr_disconnect").status == 204


def test_the_socket_is_closed_when_the_client_wants_that(bench):
    client, _ = bench.socket()
    client.send_close()
    while client.recv_frame().opcode != websocket.ABNF.OPCODE_CLOSE:
        pass
    assert client.sock.recv(1) == b""


TROUBLES = {"net_sbc_down": (503, 1001), "net_sbc_version": (502, 1011)}


@pytest.mark.parametrize(("fault", "codes"), TROUBLES.items(), ids=TROUBLES)
def test_the_control_server_can_not_be_talked_with(bench, fault, codes):
    client, _ = bench.socket()
    bench.board.inject(f"{fault}:10")
    status, code = codes
    assert close_code(client) == code
    for path in ("model", "connect?password="):
        assert bench.get(f"/machine/{path}").status == status
    assert bench.get("/rr_connect?password=").status == status
    with pytest.raises(websocket.WebSocketBadStatusException) as refused:
        bench.socket()
    assert refused.value.status_code == status
    bench.wait(11)
    bench.log_in()
    assert bench.get("/machine/model").status == 200


def test_a_reset_of_the_board_leaves_the_computer(bench):
    bench.wait(100)
    bench.log_in()
    client, model = bench.socket()
    bench.code("M999")
    bench.wait(2)
    patch = json.loads(client.recv())
    while "upTime" not in patch.get("state", {}):
        client.send("OK\n")
        patch = json.loads(client.recv())
    assert patch["state"]["upTime"] < model["state"]["upTime"]
    assert bench.get("/machine/noop").status == 204


def test_a_connection_that_is_cut_within_a_body_harms_nobody(bench):
    with socket.create_connection(("127.0.0.1", bench.face.port)) as client:
        client.sendall(b"PUT /machine/file/0%3A%2Fa HTTP/1.1\r\nContent-Length: 100\r\n\r\nabc")
    assert bench.get("/machine/noop").status == 204
    assert bench.board.card.read("0:/a") is None
