"""Files, prints and history of a real server in Moonraker's forms, over HTTP and the socket."""

import hashlib
from urllib.parse import quote

import pytest

from tests.support.basedir import ADMIN, OPERATOR, READER
from tests.support.sliced import PICTURE, sliced

from .. import helpers
from .test_websocket import Socket

BASE = "/plugin/rrfmodel/server/files"

BOARD = {"machine": "cartesian", "speed": 5}

CARD = "moon/card.gcode"
LONG = "".join(f"G4 P{400 + number % 2}\n" for number in range(200))


def prepare(board):
    told = [line for line in sliced().splitlines(keepends=True) if line.startswith(";")]
    # a move of an axis that isn't homed would end it
    board.card.write(f"0:/gcodes/{CARD}", "".join(told) + LONG)


@pytest.fixture
def socket(server):
    with Socket(server) as made:
        yield made


def result(response, status=200):
    assert response.status_code == status, response.text
    return response.json()["result"]


def assert_refused(response, status):
    assert response.status_code == status, response.text
    error = response.json()["error"]
    assert error["code"] == status
    assert error["message"].endswith(".")


def upload(server, name, content, status=201, **fields):
    response = server.post(f"{BASE}/upload", files={"file": (name, content)}, data=fields)
    return result(response, status)


def as_user(server, user, method, path, **options):
    with server.client(user) as client:
        return client.request(method, path, **options)


@pytest.mark.both_hosts("each has a file manager of its own")
def test_a_large_file_there_and_back(server, socket):
    content = b"; large\n" + b"G1 X1 Y2 E0.1\n" * 250_000
    checksum = hashlib.sha256(content).hexdigest()
    item = upload(server, "large.gcode", content, path="moon/in", checksum=checksum)["item"]
    assert (item["path"], item["size"]) == ("moon/in/large.gcode", len(content))
    news = socket.wait_for(
        "notify_filelist_changed", lambda told: told[0]["item"]["path"] == item["path"]
    )
    assert (news[0]["action"], news[0]["item"]["root"]) == ("create_file", "gcodes")
    assert item["path"] in [each["path"] for each in socket.result("server.files.list")]
    fetched = server.get(f"{BASE}/gcodes/{item['path']}")
    assert fetched.content == content
    assert "large.gcode" in fetched.headers["Content-Disposition"]
    # the same file is OctoPrint's
    assert server.get(f"/api/files/local/{item['path']}").json()["size"] == len(content)
    gone = result(as_user(server, ADMIN, "DELETE", f"{BASE}/gcodes/{item['path']}"))
    assert (gone["action"], gone["item"]["path"]) == ("delete_file", item["path"])
    assert_refused(server.get(f"{BASE}/gcodes/{item['path']}"), 404)
    socket.wait_for("notify_filelist_changed", lambda told: told[0]["action"] == "delete_file")


@pytest.mark.both_hosts("each has a file manager of its own")
def test_metadata_and_pictures(server, board):
    upload(server, "moon pic.gcode", sliced())
    found = result(server.get(f"{BASE}/metadata", params={"filename": "moon pic.gcode"}))
    assert (found["slicer"], found["slicer_version"]) == ("PrusaSlicer", "2.7.4")
    (picture,) = found["thumbnails"]
    shown = server.get(f"{BASE}/gcodes/{quote(picture['relative_path'])}")
    assert (shown.status_code, shown.headers["Content-Type"]) == (200, "image/png")
    assert shown.content == PICTURE
    assert_refused(server.get(f"{BASE}/gcodes/.thumbs/moon%20pic.gcode-9x9.png"), 404)


def test_the_card(server, board, socket):
    server.wait_for(
        lambda: CARD in [each["path"] for each in result(server.get(f"{BASE}/list?root=printer"))],
        20,
        "the card to be listed",
    )
    # the board is asked, from a socket too
    found = socket.result("server.files.metadata", filename=f"printer/{CARD}")
    assert (found["slicer"], found["estimated_time"]) == ("PrusaSlicer", 3723)
    (picture,) = found["thumbnails"]
    shown = server.get(f"{BASE}/printer/moon/{picture['relative_path']}")
    assert shown.content == PICTURE
    assert_refused(server.get(f"{BASE}/printer/{CARD}"), 409)
    assert_refused(server.get(f"{BASE}/printer/moon/no.gcode"), 404)
    assert_refused(as_user(server, ADMIN, "DELETE", f"{BASE}/printer/{CARD}"), 409)


TRAVERSALS = ("..%2Fconfig.yaml", "x/..%2F..%2Fusers.yaml", "%2e%2e/config.yaml", ".metadata.json")


@pytest.mark.parametrize("path", TRAVERSALS)
def test_nothing_else_is_given_away(server, path):
    for root in ("gcodes", "printer"):
        assert_refused(server.get(f"{BASE}/{root}/{path}"), 400)
        response = as_user(server, ADMIN, "DELETE", f"{BASE}/{root}/{path}")
        assert_refused(response, 400)
    assert (server.basedir / "config.yaml").exists()


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_who_may(server):
    upload(server, "mine.gcode", "G28\n")
    path = f"{BASE}/gcodes/mine.gcode"
    sent = {"files": {"file": ("theirs.gcode", "G28\n")}}
    for user, expected in ((ADMIN, 200), (OPERATOR, 200), (READER, 200), (None, 403)):
        assert as_user(server, user, "GET", path).status_code == expected
    print_it = "/plugin/rrfmodel/printer/print/start", {"json": {"filename": "mine.gcode"}}
    for method, address, options in (
        ("DELETE", path, {}),
        ("POST", f"{BASE}/upload", sent),
        ("POST", *print_it),
    ):
        assert_refused(as_user(server, READER, method, address, **options), 403)
        # nobody has no token either, which OctoPrint sees first
        assert as_user(server, None, method, address, **options).status_code in (400, 403)
    # a token stands for who has asked for it, once
    token = as_user(server, OPERATOR, "GET", "/plugin/rrfmodel/access/oneshot_token").json()
    for expected in (200, 403):
        response = as_user(server, None, "GET", f"{path}?token={token['result']}")
        assert response.status_code == expected
    # a page of another site has none that OctoPrint asks for
    with server.session(ADMIN) as client:
        token = client.headers.pop("X-CSRF-Token")
        assert client.delete(path).status_code == 400
        client.headers["X-CSRF-Token"] = token
        assert client.delete(path).status_code == 200


@pytest.mark.both_hosts("each prints by code of its own")
def test_a_print_of_octoprints_file(server, board, socket):
    upload(server, "moon.gcode", LONG)
    assert socket.result("printer.print.start", filename="moon.gcode") == "ok"
    server.wait_state("Printing")
    (news,) = socket.wait_for("notify_history_changed", lambda told: told[0]["action"] == "added")
    assert (news["job"]["filename"], news["job"]["status"]) == ("moon.gcode", "in_progress")
    # what is printed stays
    for method, params in (
        ("server.files.delete_file", {"path": "gcodes/moon.gcode"}),
        ("server.files.move", {"source": "gcodes/moon.gcode", "dest": "gcodes/sun.gcode"}),
        ("printer.print.start", {"filename": "moon.gcode"}),
    ):
        assert socket.error(method, **params) == -32000
    again = {"file": ("moon.gcode", "G28\n")}
    assert_refused(server.post(f"{BASE}/upload", files=again), 409)
    assert socket.result("printer.print.pause") == "ok"
    server.wait_state("Paused")
    assert socket.result("printer.print.resume") == "ok"
    server.wait_state("Printing")
    assert socket.result("printer.print.cancel") == "ok"
    server.wait_state("Operational")
    (news,) = socket.wait_for(
        "notify_history_changed", lambda told: told[0]["action"] == "finished"
    )
    job = news["job"]
    assert (job["status"], job["exists"]) == ("cancelled", True)
    assert socket.result("server.history.get_job", uid=job["job_id"])["job"] == job
    assert socket.result("server.history.delete_job", uid=job["job_id"])["deleted_jobs"] == [
        job["job_id"]
    ]
    socket.result("server.files.delete_file", path="gcodes/moon.gcode")


def test_a_print_of_the_boards_file(server, board, socket):
    start = {"filename": f"printer/{CARD}"}
    server.wait_for(
        lambda: "error" not in socket.answer("server.files.metadata", **start), 20, "the card"
    )
    assert socket.result("printer.print.start", **start) == "ok"
    helpers.wait_value(server, "job.file.fileName", f"0:/gcodes/{CARD}", 45)
    helpers.wait_value(server, "state.status", "processing", 45)
    assert socket.result("printer.print.pause") == "ok"
    helpers.wait_value(server, "state.status", "paused", 45)
    assert socket.result("printer.print.cancel") == "ok"
    (news,) = socket.wait_for(
        "notify_history_changed", lambda told: told[0]["action"] == "finished"
    )
    assert (news["job"]["filename"], news["job"]["status"]) == (f"printer/{CARD}", "cancelled")
