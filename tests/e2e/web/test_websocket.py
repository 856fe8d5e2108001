"""The websocket: who is let in, what is answered, what is told."""

import asyncio
import json
import sys
import time
from urllib.parse import urlsplit

import aiohttp
import pytest
import websocket

from tests.support import coroutines
from tests.support.basedir import ADMIN, OPERATOR, READER

from .. import helpers

PATH = "/plugin/rrfmodel/websocket"


BOARD = {"machine": "toolchanger"}


class Socket:
    """A client that sends one call after the other and keeps what comes between."""

    def __init__(self, server, user=ADMIN, query="", **options):
        if user is not None:
            options.setdefault("header", {"X-Api-Key": user.api_key})
        address = server.url.replace("http", "ws", 1) + PATH + query
        self._socket = websocket.WebSocket(skip_utf8_validation=True)
        self._socket.settimeout(10)
        try:
            self._socket.connect(address, **options)
        except websocket.WebSocketBadStatusException:
            self._socket.shutdown()
            raise
        self._last_id = 0
        self.notifications = []

    def __enter__(self):
        return self

    def __exit__(self, *exc_info):
        self._socket.close()
        # of a connection that the server has closed the library leaves the socket open
        self._socket.shutdown()

    def send(self, text):
        self._socket.send(text)

    def receive(self):
        text = self._socket.recv()
        if not text:
            raise ConnectionError("the server has closed the connection")
        return json.loads(text)

    def answer(self, method, **params):
        self._last_id += 1
        message = {"jsonrpc": "2.0", "method": method, "params": params, "id": self._last_id}
        self._socket.send(json.dumps(message))
        while True:
            answer = self.receive()
            if answer.get("id") == self._last_id:
                return answer
            self.notifications.append(answer)

    def result(self, method, **params):
        answer = self.answer(method, **params)
        assert "error" not in answer, answer
        return answer["result"]

    def error(self, method, **params):
        answer = self.answer(method, **params)
        assert answer["error"]["message"].endswith("."), answer
        return answer["error"]["code"]

    def wait_for(self, method, fits=lambda params: True):
        """Return the parameters of the first notification that fits, an earlier one too."""
        for message in self.notifications:
            if message["method"] == method and fits(message["params"]):
                return message["params"]
        while True:
            message = self.receive()
            self.notifications.append(message)
            if message.get("method") == method and fits(message["params"]):
                return message["params"]


@pytest.fixture
def socket(server):
    with Socket(server) as made:
        yield made


# who is let in


def status_of_handshake(server, user=None, query="", **options):
    try:
        with Socket(server, user, query, **options):
            return 101
    except websocket.WebSocketBadStatusException as error:
        return error.status_code


def session_cookie(server, user):
    with server.session(user) as client:
        return "; ".join(f"{cookie.name}={cookie.value}" for cookie in client.cookies)


@pytest.mark.both_hosts("each tells by its own code who somebody is")
@pytest.mark.parametrize("user", [ADMIN, OPERATOR, READER], ids=lambda user: user.name)
def test_lets_in_who_has_the_permission(server, user):
    assert status_of_handshake(server, user) == 101
    assert status_of_handshake(server, query=f"?apikey={user.api_key}") == 101
    cookie = session_cookie(server, user)
    assert status_of_handshake(server, cookie=cookie, origin=server.url) == 101


@pytest.mark.both_hosts("each tells by its own code who somebody is")
@pytest.mark.parametrize(
    "options",
    [
        {},
        {"query": "?apikey=nonsense"},
        {"header": {"X-Api-Key": "nonsense"}},
        {"cookie": "session=nonsense"},
    ],
    ids=["nobody", "unknown key", "unknown key in the header", "unknown session"],
)
def test_refuses_who_shows_nothing(server, options):
    assert status_of_handshake(server, **options) == 403


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_refuses_a_session_on_another_page(server):
    cookie = session_cookie(server, ADMIN)
    own = server.url
    for origin in (
        "http://evil.example",
        "null",
        "file://",
        "data:",
        "",
        own.replace("http", "https", 1),
        own + "1",
        own.rpartition(":")[0],
        own + "/",
        own.replace("//", "//user@", 1),
        own + ".evil.example",
    ):
        assert status_of_handshake(server, cookie=cookie, header=[f"Origin: {origin}"]) == 403
    # a page that knows a key may be anywhere
    assert status_of_handshake(server, ADMIN, origin="http://dashboard.example") == 101


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_refuses_an_unknown_key_in_spite_of_a_session(server):
    cookie = session_cookie(server, ADMIN)
    found = status_of_handshake(server, query="?apikey=nonsense", cookie=cookie, origin=server.url)
    assert found == 403


# what is answered


def test_answers_a_client_s_first_questions(socket, server):
    info = socket.result("server.info")
    assert info["klippy_connected"] is True
    assert info["klippy_state"] == "ready"
    assert info["websocket_count"] >= 1
    assert isinstance(socket.result("server.connection.identify")["connection_id"], int)
    assert socket.result("printer.info")["state"] == "ready"
    listed = socket.result("printer.objects.list")["objects"]
    assert {"webhooks", "toolhead", "extruder1", "heater_bed"} <= set(listed)
    over_http = server.get("/plugin/rrfmodel/printer/objects/list").json()["result"]["objects"]
    assert listed == over_http


def test_queries(socket):
    answer = socket.result(
        "printer.objects.query",
        objects={"toolhead": ["homed_axes", "nonsense"], "fan": None, "nosuch": None},
    )
    assert answer["eventtime"] > 0
    assert answer["status"]["toolhead"]["nonsense"] is None
    assert set(answer["status"]["toolhead"]) == {"homed_axes", "nonsense"}
    assert set(answer["status"]["fan"]) >= {"speed", "rpm"}
    assert answer["status"]["nosuch"] == {}


@pytest.mark.parametrize(
    "method, params, code",
    [
        ("printer.objects.nonsense", {}, -32601),
        ("printer.objects.query", {}, -32602),
        ("printer.objects.query", {"objects": ["toolhead"]}, -32602),
        ("printer.objects.query", {"objects": {"toolhead": 5}}, -32602),
        ("printer.objects.subscribe", {"objects": {"toolhead": [1]}}, -32602),
        ("printer.gcode.script", {}, -32602),
        ("printer.gcode.script", {"script": "M117 a\x07"}, -32602),
        ("printer.gcode.script", {"script": 'M117 "a'}, -32602),
    ],
)
def test_refuses_what_it_can_not_read(socket, board, method, params, code):
    before = len(board.board.received())
    assert socket.error(method, **params) == code
    assert not [line for line in board.board.received()[before:] if "M117" in line]


@pytest.mark.both_hosts("lines go through the queue of the host")
def test_script_goes_to_the_printer(socket, board, server):
    before = len(board.board.received())
    started = time.time()
    assert socket.result("printer.gcode.script", script="M117 over the socket\nM115") == "ok"
    server.wait_for(lambda: "M115" in helpers.commands(board)[before:], 10, "the script")
    assert "M117 over the socket" in helpers.commands(board)[before:]
    (line,) = socket.wait_for("notify_gcode_response", lambda found: "FIRMWARE_NAME" in found[0])
    assert "RepRapFirmware" in line
    store = server.get("/plugin/rrfmodel/server/gcode_store").json()["result"]["gcode_store"]
    store = [entry for entry in store if entry["time"] >= started]
    assert {"M117 over the socket", "M115"} <= {
        entry["message"] for entry in store if entry["type"] == "command"
    }
    assert any("FIRMWARE_NAME" in entry["message"] for entry in store)
    assert not [entry for entry in store if "M409" in entry["message"]]
    assert not [entry for entry in store if '{"key"' in entry["message"]]


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_reader_may_not_control(server, board):
    before = len(board.board.received())
    with Socket(server, READER) as socket:
        assert socket.error("printer.gcode.script", script="M117 no") == -32000
        assert socket.error("printer.emergency_stop") == -32000
        assert socket.result("printer.info")["state"] == "ready"
    sent = helpers.commands(board)[before:]
    assert not {"M117 no", "M112"} & set(sent)


# what is told


def test_tells_changes_and_only_those(socket, server):
    wanted = {"heater_bed": ["target"], "webhooks": None}
    complete = socket.result("printer.objects.subscribe", objects=wanted)
    assert complete["status"]["heater_bed"] == {"target": 0.0}
    assert complete["status"]["webhooks"]["state"] == "ready"
    server.commands("M140 S41")
    difference, eventtime = socket.wait_for("notify_status_update")
    assert difference == {"heater_bed": {"target": 41.0}}
    assert eventtime > complete["eventtime"]
    server.commands("M140 S0")
    socket.wait_for(
        "notify_status_update", lambda found: found[0].get("heater_bed") == {"target": 0.0}
    )


def test_new_subscription_replaces_the_old(socket, server):
    socket.result("printer.objects.subscribe", objects={"heater_bed": ["target"]})
    socket.result("printer.objects.subscribe", objects={"display_status": ["message"]})
    server.commands("M140 S42", "M117 seen")
    difference, _ = socket.wait_for("notify_status_update")
    assert difference == {"display_status": {"message": "seen"}}
    assert socket.result("printer.objects.subscribe", objects={})["status"] == {}
    server.commands("M140 S0", "M117 not seen")
    helpers.wait_value(server, "state.displayMessage", "not seen", 10)
    helpers.wait_polls(server, 2)
    socket.result("server.info")
    updates = [found for found in socket.notifications if found["method"] == "notify_status_update"]
    assert len(updates) == 1


def test_a_hostile_name_is_text(socket, server):
    socket.result("printer.objects.subscribe", objects={"display_status": ["message"]})
    server.commands('M117 "<img src=x onerror=alert(1)>"')
    difference, _ = socket.wait_for("notify_status_update")
    assert "<img" in difference["display_status"]["message"]


# permissions that change


@pytest.fixture
def somebody(server):
    """A further user with READ, and what takes it away."""
    made = server.post(
        "/api/access/users",
        json={"name": "somebody", "password": "x-y-z", "active": True, "groups": ["users"]},
    )
    assert made.status_code in (200, 201), made.text
    key = server.post("/api/access/users/somebody/apikey").json()["apikey"]
    yield key
    server.delete("/api/access/users/somebody")


CHANGES = {
    "deleted": lambda server: server.delete("/api/access/users/somebody"),
    "without groups": lambda server: server.put(
        "/api/access/users/somebody", json={"active": True, "groups": [], "permissions": []}
    ),
}


@pytest.mark.both_hosts("each tells by its own code who somebody is")
@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_drops_who_may_read_no_longer(server, somebody, change):
    with Socket(server, None, f"?apikey={somebody}") as socket:
        assert socket.result("printer.info")["state"] == "ready"
        assert change(server).status_code in (200, 204)
        with pytest.raises((ConnectionError, websocket.WebSocketConnectionClosedException)):
            while True:
                socket.receive()


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_drops_a_session_that_logs_out(server):
    with server.session(OPERATOR) as client:
        cookie = "; ".join(f"{found.name}={found.value}" for found in client.cookies)
        with Socket(server, None, cookie=cookie, origin=server.url) as socket:
            assert socket.result("printer.info")["state"] == "ready"
            assert client.post("/api/logout").status_code in (200, 204)
            with pytest.raises((ConnectionError, websocket.WebSocketConnectionClosedException)):
                while True:
                    socket.receive()


def test_others_stay_when_somebody_goes(server, socket, somebody):
    server.delete("/api/access/users/somebody")
    assert socket.result("printer.info")["state"] == "ready"


# a client that others wrote


@pytest.mark.both_hosts("the sockets are there")
@pytest.mark.skipif(sys.version_info < (3, 10), reason="moonraker-api wants a newer Python")
def test_moonraker_api_subscribes(server):
    from moonraker_api import MoonrakerClient, MoonrakerListener

    class Listener(MoonrakerListener):
        def __init__(self):
            self.updates = asyncio.Queue()

        async def on_notification(self, method, data):
            if method == "notify_status_update":
                await self.updates.put(data)

    async def run():
        listener = Listener()
        address = urlsplit(server.url)
        session = aiohttp.ClientSession()
        client = MoonrakerClient(
            listener,
            address.hostname,
            address.port,
            api_key=OPERATOR.api_key,
            route_prefix="plugin/rrfmodel",
            session=session,
        )
        await client.connect()
        try:
            info = await client.call_method("server.info")
            listed = await client.get_supported_modules()
            status = await client.call_method("printer.objects.query", objects={"toolhead": None})
            await client.call_method("printer.objects.subscribe", objects={"heater_bed": None})
            await client.call_method("printer.gcode.script", script="M140 S43")
            while True:
                found = await asyncio.wait_for(listener.updates.get(), 15)
                if found[0].get("heater_bed", {}).get("target") == 43.0:
                    return info, listed, status
        finally:
            await client.disconnect()
            await session.close()

    info, listed, status = coroutines.run(run())
    assert info["klippy_state"] == "ready"
    assert "toolhead" in listed["objects"] if isinstance(listed, dict) else "toolhead" in listed
    assert len(status["status"]["toolhead"]["position"]) == 4
    server.commands("M140 S0")


# a client that doesn't read


@pytest.mark.slow
def test_drops_a_client_that_does_not_read(server, socket):
    call = {"jsonrpc": "2.0", "method": "printer.objects.query", "id": 1}
    everything = dict.fromkeys(socket.result("printer.objects.list")["objects"])
    text = json.dumps([{**call, "params": {"objects": everything}}] * 20)
    with Socket(server) as deaf:

        def is_dropped():
            deaf.send(text)
            return socket.result("server.info")["websocket_count"] == 1

        try:
            server.wait_for(is_dropped, 60, "the end of the client that doesn't read")
        except (OSError, websocket.WebSocketException):
            # the server has cut the connection meanwhile
            server.wait_for(
                lambda: socket.result("server.info")["websocket_count"] == 1, 10, "its end"
            )
    assert server.state() == "Operational"
    server.wait_for(lambda: not helpers.status(server)["stale"], 10, "fresh values")
