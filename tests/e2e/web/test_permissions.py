"""Who may do what: every endpoint, for everybody who may ask, in every way to say who one is."""

import pytest
import websocket

from tests.support.basedir import ADMIN, OPERATOR, READER
from tests.support.push import PushListener

from .. import helpers

BASE = "/plugin/rrfmodel"
SIMPLE = "/api/plugin/rrfmodel"

READ = "read"
WATCH = "watch"
"""Reading, and watching OctoPrint's terminal, which guests may not."""

CONTROL = "control"
SETTINGS = "settings"

# method, path, body, what it needs, the status for who has that
ENDPOINTS = [
    ("GET", f"{BASE}/status", None, READ, 200),
    ("GET", SIMPLE, None, READ, 200),
    ("GET", f"{BASE}/model", None, READ, 200),
    ("GET", f"{BASE}/model/live?key=state.upTime", None, READ, 200),
    ("GET", f"{BASE}/history", None, READ, 200),
    ("GET", f"{BASE}/jobs", None, READ, 200),
    ("GET", f"{BASE}/meanings", None, READ, 200),
    # over a line no file can be read
    ("GET", f"{BASE}/heightmap", None, READ, 409),
    ("GET", f"{BASE}/files?path=0:/macros", None, READ, 200),
    # nobody has put a picture there
    ("GET", f"{BASE}/thumbnail?path=square.gcode", None, READ, 200),
    ("GET", f"{BASE}/machine_files?path=0:/sys", None, SETTINGS, 409),
    ("GET", f"{BASE}/machine_file?path=0:/sys/config.g", None, SETTINGS, 409),
    ("PUT", f"{BASE}/machine_file", {"path": "0:/sys/a.g", "text": ""}, SETTINGS, 409),
    ("GET", f"{BASE}/bundle", None, SETTINGS, 200),
    ("GET", f"{BASE}/setup", None, SETTINGS, 200),
    ("GET", f"{BASE}/metrics", None, READ, 200),
    ("GET", f"{BASE}/openapi.json", None, READ, 200),
    ("GET", f"{BASE}/printer/objects/list", None, READ, 200),
    ("GET", f"{BASE}/printer/objects/query?toolhead", None, READ, 200),
    ("POST", f"{BASE}/printer/objects/query", {"objects": {"toolhead": None}}, READ, 200),
    ("GET", f"{BASE}/printer/info", None, READ, 200),
    ("GET", f"{BASE}/server/info", None, READ, 200),
    ("GET", f"{BASE}/server/gcode_store", None, READ, 200),
    ("GET", f"{BASE}/server/database/list", None, READ, 200),
    ("GET", f"{BASE}/machine/proc_stats", None, READ, 200),
    ("GET", f"{BASE}/access/user", None, READ, 200),
    (
        "POST",
        f"{BASE}/server/database/item",
        {"namespace": "table", "key": "a", "value": 1},
        CONTROL,
        200,
    ),
    ("POST", f"{BASE}/machine/device_power/device", {"device": "a", "action": "on"}, CONTROL, 404),
    ("GET", f"{BASE}/console", None, WATCH, 200),
    ("POST", f"{BASE}/printer/gcode/script", {"script": "M117 table"}, CONTROL, 200),
    ("POST", SIMPLE, {"command": "fan", "fan": 0, "speed": 0.5}, CONTROL, 204),
    ("POST", SIMPLE, {"command": "refresh"}, CONTROL, 204),
    ("POST", SIMPLE, {"command": "fix_settings"}, SETTINGS, 204),
    # which leaves all as it was
    ("POST", SIMPLE, {"command": "restore_settings"}, SETTINGS, 204),
    ("POST", SIMPLE, {"command": "wizard_done"}, SETTINGS, 204),
]

MAY = {
    None: (),
    READER: (
        READ,
        WATCH,
    ),
    OPERATOR: (READ, WATCH, CONTROL),
    ADMIN: (READ, WATCH, CONTROL, SETTINGS),
}


BOARD = {}


@pytest.fixture
def open_to_guests(server):
    group = server.get("/api/access/groups/guests").json()
    permissions = [*group["permissions"], "PLUGIN_RRFMODEL_READ"]
    response = server.put("/api/access/groups/guests", json={**group, "permissions": permissions})
    assert response.status_code == 200, response.text
    yield server
    server.put("/api/access/groups/guests", json=group)


def name_of(row):
    return f"{row[0]} {row[1]} {row[2] or ''}".strip()


def ask(client, row, **options):
    method, path, body, _, _ = row
    return client.request(method, path, json=body, **options)


def ask_for_all(client, **options):
    """Return the status of each row; a refusal has a sentence and nothing else."""
    statuses = {}
    for row in ENDPOINTS:
        response = ask(client, row, **options)
        statuses[name_of(row)] = response.status_code
        if response.status_code == 403:
            assert response.json()["error"], name_of(row)
            assert set(response.json()) == {"error"}, name_of(row)
    return statuses


def wanted(may, without_token=False):
    """Return the status of each row for who may so much; without a token OctoPrint refuses POST."""
    return {
        name_of(row): 400 if without_token and row[0] != "GET" else row[4] if row[3] in may else 403
        for row in ENDPOINTS
    }


@pytest.mark.parametrize("user", [ADMIN, OPERATOR, READER], ids=lambda user: user.name)
@pytest.mark.parametrize("way", ["client", "session"])
@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_user_with_key_and_session(server, user, way):
    with getattr(server, way)(user) as client:
        assert ask_for_all(client) == wanted(MAY[user])


@pytest.mark.parametrize("user", [ADMIN, READER], ids=lambda user: user.name)
@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_session_without_token(server, user):
    with server.session(user) as client:
        client.headers.pop("X-CSRF-Token", None)
        # OctoPrint's own check comes first
        assert ask_for_all(client) == wanted(MAY[user], without_token=True)


@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_nobody(server):
    with server.client() as client:
        assert ask_for_all(client) == wanted((), without_token=True)


@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_nobody_with_a_token(server):
    with server.client() as client:
        client.take_token()
        assert ask_for_all(client) == wanted(())


@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_unknown_key(server):
    with server.client() as client:
        client.take_token()
        assert ask_for_all(client, headers={"X-Api-Key": "nonsense"}) == wanted(())


@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_guest_where_guests_may_read(open_to_guests):
    with open_to_guests.client() as client:
        assert ask_for_all(client) == wanted((READ,), without_token=True)


@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_guest_with_a_token_where_guests_may_read(open_to_guests):
    with open_to_guests.client() as client:
        client.take_token()
        assert ask_for_all(client) == wanted((READ,))


@pytest.mark.both_hosts("each reads keys and sessions with its own code")
def test_socket_is_for_those_with_credentials(open_to_guests):
    address = open_to_guests.url.replace("http", "ws", 1) + f"{BASE}/websocket"
    socket = websocket.WebSocket()
    with pytest.raises(websocket.WebSocketBadStatusException) as refused:
        socket.connect(address, timeout=10)
    socket.shutdown()
    assert refused.value.status_code == 403


def test_no_refused_command_reached_the_printer(server, board):
    before = len(board.board.received())
    for user in (None, READER):
        with server.client(user) as client:
            for row in ENDPOINTS:
                if row[3] == CONTROL:
                    assert ask(client, row).status_code in (400, 403)
    helpers.wait_polls(server, 2)
    sent = helpers.commands(board)[before:]
    assert not [line for line in sent if line.startswith(("M106", "M117"))]


@pytest.mark.both_hosts("each pushes to its own sockets")
def test_push_reaches_only_who_has_the_permission(server):
    with PushListener(server, READER) as reader, PushListener(server, None) as nobody:
        message = reader.wait_for_plugin(lambda data: data["type"] == "model")
        helpers.wait_polls(server, 3)
        assert set(message["changed"]) & {"state", "heat", "seqs", "move"}
        assert message["status"]["connected"] is True
        assert nobody.of_plugin() == []
