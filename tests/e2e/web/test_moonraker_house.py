"""Methods about server, computer, power and access in a running OctoPrint: HTTP and socket."""

import pytest
import websocket

from tests.support.basedir import ADMIN, OPERATOR, READER

from .. import helpers
from .test_moonraker import assert_failure, result
from .test_websocket import Socket, session_cookie, status_of_handshake

BASE = "/plugin/rrfmodel"
ELSEWHERE = "http://dashboard.example"

BOARD = {"machine": "toolchanger"}

STARTS = [
    # what Mainsail and KlipperScreen ask before they show anything, and Fluidd
    "server.config",
    "server.database.list",
    "server.webcams.list",
    "server.announcements.list",
    "server.job_queue.status",
    "server.sensors.list",
    "machine.update.status",
    "machine.device_power.devices",
    "printer.gcode.help",
    "printer.query_endstops.status",
    "access.info",
    "access.users.list",
]


@pytest.fixture
def socket(server):
    with Socket(server) as made:
        yield made


@pytest.mark.both_hosts("the endpoints are there")
def test_clients_get_what_they_begin_with(server, socket):
    for method in STARTS:
        over_http = result(server.get(f"{BASE}/{method.replace('.', '/')}"))
        assert socket.result(method) == over_http, method
    assert socket.result("printer.gcode.help")["G28"]
    assert socket.result("machine.system_info")["system_info"]["cpu_info"]["cpu_count"] >= 1
    assert socket.result("machine.proc_stats")["websocket_connections"] >= 1
    assert socket.result("server.websocket.id")["websocket_id"] > 0
    components = socket.result("server.info")["components"]
    assert {"database", "webcam", "power", "machine", "data_store"} <= set(components)


def test_a_client_that_is_named_hears_of_the_computer(server, socket):
    told = "notify_proc_stat_update"
    socket.result("server.connection.identify", client_name="Mainsail", type="web")
    (news,) = socket.wait_for(told)
    assert {"moonraker_stats", "cpu_temp", "websocket_connections"} <= set(news)


def test_the_hour_is_there_by_object(server, socket):
    def is_kept():
        found = socket.result("server.temperature_store")
        return found if "extruder1" in found and "heater_bed" in found else None

    found = server.wait_for(is_kept, 20, "temperatures")
    assert {len(each) for each in found["extruder1"].values()} == {
        len(found["heater_bed"]["temperatures"])
    }
    assert found["extruder1"]["temperatures"][-1] > 0


# webcams


@pytest.mark.both_hosts("each has its own webcams")
def test_webcams_are_octoprints(server):
    classic = {
        "stream": "/webcam/?action=stream",
        "snapshot": "http://127.0.0.1:8080/",
        "flipH": True,
    }
    server.set_setting("plugins.classicwebcam", classic)
    try:
        (found,) = result(server.get(f"{BASE}/server/webcams/list"))["webcams"]
    finally:
        server.set_setting("plugins.classicwebcam", dict.fromkeys(classic, ""))
    assert found["stream_url"] == "/webcam/?action=stream"
    assert found["snapshot_url"] == ""
    assert found["flip_horizontal"] is True


# the database


@pytest.mark.both_hosts("requests with a body and without")
def test_database_over_http_and_socket(server, socket):
    # what other tests have kept in theirs stays on a server that they share
    item = {"namespace": "house", "key": "view.theme", "value": {"dark": True}}
    assert result(server.post(f"{BASE}/server/database/item", json=item)) == item
    assert socket.result("server.database.get_item", namespace="house", key="view.theme") == item
    query = "namespace=house&key=view"
    got = result(server.get(f"{BASE}/server/database/item?{query}"))
    assert got["value"] == {"theme": {"dark": True}}
    hinted = "namespace=house&key=count&value:int=3"
    assert result(server.post(f"{BASE}/server/database/item?{hinted}"))["value"] == 3
    assert "house" in socket.result("server.database.list")["namespaces"]
    with server.client(READER) as reader:
        assert_failure(reader.post(f"{BASE}/server/database/item", json=item), 403)
        assert_failure(reader.delete(f"{BASE}/server/database/item?{query}"), 403)
        assert result(reader.get(f"{BASE}/server/database/item?{query}"))["value"]
    for key in ("view", "count"):
        result(server.delete(f"{BASE}/server/database/item?namespace=house&key={key}"))
    assert_failure(server.get(f"{BASE}/server/database/item?{query}"), 404)
    assert socket.error("server.database.get_item", namespace="house") == -32000


# what is refused


def test_what_is_octoprints_is_refused(server, socket):
    for method in ("machine.reboot", "machine.shutdown", "server.logs.rollover"):
        assert_failure(server.post(f"{BASE}/{method.replace('.', '/')}"), 403)
        assert socket.error(method) == -32000
    login = {"username": ADMIN.name, "password": ADMIN.password}
    with server.client(READER) as reader:
        assert_failure(reader.post(f"{BASE}/access/login", json=login), 403)
    with server.client() as nobody:
        assert result(nobody.get(f"{BASE}/access/info"))["trusted"] is False
        assert_failure(nobody.get(f"{BASE}/access/oneshot_token"), 403)
        assert_failure(nobody.get(f"{BASE}/access/user"), 403)


# who is asking


def token_of(client):
    return result(client.get(f"{BASE}/access/oneshot_token"))


@pytest.mark.both_hosts("each tells by its own code who somebody is")
@pytest.mark.parametrize("way", ["client", "session"])
def test_a_token_lets_a_page_of_elsewhere_in_once(server, way):
    with getattr(server, way)(OPERATOR) as client:
        assert result(client.get(f"{BASE}/access/user"))["username"] == OPERATOR.name
        token = token_of(client)
        with Socket(server, None, f"?token={token}", origin=ELSEWHERE) as socket:
            assert socket.result("access.get_user")["username"] == OPERATOR.name
            # as good as another one's
            query = f"?token={socket.result('access.oneshot_token')}"
            assert status_of_handshake(server, query=query, origin=ELSEWHERE) == 101
            assert status_of_handshake(server, query=query, origin=ELSEWHERE) == 403
        assert status_of_handshake(server, query=f"?token={token}") == 403
    # what is wrong is wrong in spite of a session
    cookie = session_cookie(server, ADMIN)
    found = status_of_handshake(server, query="?token=a", cookie=cookie, origin=server.url)
    assert found == 403
    assert token not in server.log()


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_a_token_is_worth_no_more_than_its_user(server):
    with server.session(READER) as client:
        token = token_of(client)
        with Socket(server, None, f"?token={token}", origin=ELSEWHERE) as socket:
            assert socket.result("printer.info")
            assert socket.error("printer.gcode.script", script="M117 no") == -32000
            assert client.post("/api/logout").status_code in (200, 204)
            with pytest.raises((ConnectionError, websocket.WebSocketConnectionClosedException)):
                while True:
                    socket.receive()


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_a_token_for_one_request(server):
    token = token_of(server.client(OPERATOR))
    with server.client() as nobody:
        address = f"{BASE}/access/user?token={token}"
        assert result(nobody.get(address))["username"] == OPERATOR.name
        assert_failure(nobody.get(address), 403)


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_a_client_shows_its_key_when_it_says_who_it_is(server, board):
    identify = "server.connection.identify"
    told = {"client_name": "a", "version": "1", "type": "display", "url": ""}
    with Socket(server, READER) as socket:
        assert socket.error(identify, **told, api_key="nonsense") == -32000
        assert socket.error(identify, type="toaster") == -32602
        assert socket.result("access.get_user")["username"] == READER.name
        assert socket.result(identify, **told, api_key=OPERATOR.api_key)["connection_id"] > 0
        assert socket.result("access.get_user")["username"] == OPERATOR.name
        before = len(board.board.received())
        assert socket.result("printer.gcode.script", script="M117 as operator") == "ok"
        server.wait_for(
            lambda: "M117 as operator" in helpers.commands(board)[before:], 10, "the script"
        )


@pytest.mark.both_hosts("each has its own server in front")
@pytest.mark.parametrize("is_allowed", [False, True])
def test_other_origins_are_octoprints_to_allow(server, is_allowed):
    origin = {"Origin": ELSEWHERE}
    asked = {
        **origin,
        "Access-Control-Request-Method": "POST",
        "Access-Control-Request-Headers": "x-api-key",
    }
    server.set_setting("api.allowCrossOrigin", is_allowed)
    try:
        with server.client() as page:
            before = page.options(f"{BASE}/server/database/item", headers=asked)
            key = {**origin, "X-Api-Key": OPERATOR.api_key}
            token = page.get(f"{BASE}/access/oneshot_token", headers=key)
            wrong = page.get(f"{BASE}/server/nothing", headers=key)
    finally:
        server.set_setting("api.allowCrossOrigin", False)
    wanted = ELSEWHERE if is_allowed else None
    for answer in (before, token, wrong):
        assert answer.headers.get("Access-Control-Allow-Origin") == wanted
        # a session of another page's is never lent
        assert "Access-Control-Allow-Credentials" not in answer.headers
    assert before.headers.get("Access-Control-Allow-Headers") == ("x-api-key" if wanted else None)
