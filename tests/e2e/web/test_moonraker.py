"""Printer objects over HTTP in Moonraker's forms, also for a client that others wrote."""

import threading
import urllib.request
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from moonrakerpy import MoonrakerPrinter

from tests.support.basedir import OPERATOR

from .. import helpers

BASE = "/plugin/rrfmodel"


BOARD = {"machine": "toolchanger"}


def result(response):
    assert response.status_code == 200, response.text
    assert set(response.json()) == {"result"}
    return response.json()["result"]


def assert_failure(response, status):
    assert response.status_code == status, response.text
    error = response.json()["error"]
    assert error["code"] == status
    assert error["message"].endswith(".")


# forms


@pytest.mark.both_hosts("the endpoints are there", once_for=("query", "wanted"))
@pytest.mark.parametrize(
    "query, wanted",
    [
        ("heater_bed", {"heater_bed": {"temperature", "target", "power"}}),
        ("heater_bed=target", {"heater_bed": {"target"}}),
        ("heater_bed=target,nonsense", {"heater_bed": {"target", "nonsense"}}),
        ("heater_bed=target&nosuch", {"heater_bed": {"target"}, "nosuch": set()}),
        ("temperature_sensor%20mcu_0=temperature", {"temperature_sensor mcu_0": {"temperature"}}),
        ("", {}),
        ("apikey=" + OPERATOR.api_key, {}),
    ],
)
def test_query_by_address(server, query, wanted):
    answer = result(server.get(f"{BASE}/printer/objects/query?{query}"))
    assert answer["eventtime"] > 0
    assert {name: set(fields) for name, fields in answer["status"].items()} == wanted
    assert answer["status"].get("heater_bed", {}).get("nonsense") is None


@pytest.mark.parametrize(
    "objects, wanted",
    [
        ({"heater_bed": ["target"]}, {"heater_bed": {"target"}}),
        ({"heater_bed": None, "nosuch": None}, None),
        ({"heater_bed": []}, None),
        ({}, {}),
    ],
)
def test_query_by_body(server, objects, wanted):
    answer = result(server.post(f"{BASE}/printer/objects/query", json={"objects": objects}))
    assert set(answer["status"]) == set(objects)
    if wanted is not None:
        assert {name: set(fields) for name, fields in answer["status"].items()} == wanted
    else:
        assert "temperature" in answer["status"]["heater_bed"]


@pytest.mark.parametrize(
    "body",
    [b"", b"{", b"[]", b"{}", b'{"objects": []}', b'{"objects": {"a": 1}}', b'{"objects": "a"}'],
)
def test_query_refuses_other_bodies(server, body):
    assert_failure(server.post(f"{BASE}/printer/objects/query", data=body), 400)


@pytest.mark.parametrize("count, status", [("0", 200), ("3", 200), ("-1", 400), ("x", 400)])
def test_count_of_the_store(server, count, status):
    response = server.get(f"{BASE}/server/gcode_store?count={count}")
    if status == 200:
        assert len(result(response)["gcode_store"]) <= int(count)
    else:
        assert_failure(response, status)


BAD_SCRIPTS = {
    "none": {},
    "empty": {"script": " \n "},
    "a number": {"script": 1},
    "control character": {"script": "M117 a\x1b"},
    "null": {"script": "M117 a\x00"},
    "lone quote": {"script": 'M117 "a'},
    "comment in quotes": {"script": 'M117 "a;b"'},
    "too long": {"script": "M117 " + "a" * 200},
    "too many": {"script": "M117 a\n" * 51},
}


@pytest.mark.parametrize("body", BAD_SCRIPTS.values(), ids=BAD_SCRIPTS)
def test_script_is_refused_as_a_whole(server, board, body):
    before = len(board.board.received())
    assert_failure(server.post(f"{BASE}/printer/gcode/script", json=body), 400)
    helpers.wait_polls(server, 1)
    assert not [line for line in board.board.received()[before:] if "M117" in line]


@pytest.mark.both_hosts("lines go through the queue of the host")
def test_script_by_address_and_by_body(server, board):
    before = len(board.board.received())
    address = f"{BASE}/printer/gcode/script"
    assert result(server.post(address, params={"script": "M117 one\r\nM117 two"})) == "ok"
    assert result(server.post(address, data={"script": "M117 Grüße 3"})) == "ok"
    assert result(server.post(address, json={"script": "M117 Grüße 4"})) == "ok"
    server.wait_for(
        lambda: "M117 Grüße 4" in helpers.commands(board)[before:], 10, "the fourth line"
    )
    sent = [line for line in helpers.commands(board)[before:] if line.startswith("M117")]
    assert sent == ["M117 one", "M117 two", "M117 Grüße 3", "M117 Grüße 4"]


def test_without_a_printer(server_factory):
    server = server_factory()
    info = result(server.get(f"{BASE}/server/info"))
    assert (info["klippy_connected"], info["klippy_state"]) == (False, "disconnected")
    status = result(server.get(f"{BASE}/printer/objects/query?webhooks"))["status"]
    assert status["webhooks"]["state"] == "shutdown"
    assert_failure(server.post(f"{BASE}/printer/gcode/script", json={"script": "M115"}), 409)


# the job


@pytest.mark.both_hosts("each streams and pauses with its own code")
@pytest.mark.slow
def test_a_print_of_octoprints_is_the_job(server, board):
    def queried():
        found = result(
            server.get(f"{BASE}/printer/objects/query?print_stats&virtual_sdcard&display_status")
        )
        return found["status"]

    server.commands("G28")
    helpers.wait_value(server, "move.axes[0].homed", True, 60)
    text = "".join(f"G1 X{20 + number % 50} F3000\n" for number in range(400))
    server.upload("streamed.gcode", text)
    server.select_and_print("streamed.gcode")
    # OctoPrint forgets a pause that comes while it starts
    server.wait_state("Printing")
    server.wait_for(lambda: queried()["print_stats"]["state"] == "printing", 15, "the print")
    seen = queried()
    assert seen["print_stats"]["filename"] == "streamed.gcode"
    assert seen["virtual_sdcard"]["is_active"] is True
    server.post("/api/job", json={"command": "pause", "action": "pause"})
    server.wait_for(lambda: queried()["print_stats"]["state"] == "paused", 45, "the pause")
    assert queried()["virtual_sdcard"]["is_active"] is False
    server.wait_state("Paused")
    speed, board.board.speed = board.board.speed, 300
    server.post("/api/job", json={"command": "pause", "action": "resume"})
    server.wait_for(lambda: queried()["print_stats"]["state"] == "complete", 60, "the end")
    board.board.speed = speed
    done = queried()
    assert done["virtual_sdcard"]["progress"] == done["display_status"]["progress"] == 1.0
    assert done["virtual_sdcard"]["file_position"] == len(text)


# a client that others wrote


@contextmanager
def proxy(server, headers):
    """Yield the address of a proxy that puts headers on what goes to OctoPrint."""

    class Proxy(BaseHTTPRequestHandler):
        def do_GET(self):
            length = int(self.headers.get("Content-Length") or 0)
            request = urllib.request.Request(
                server.url + self.path,
                data=self.rfile.read(length) if self.command == "POST" else None,
                headers=headers,
                method=self.command,
            )
            try:
                with direct.open(request, timeout=10) as response:
                    status, body = response.status, response.read()
            except urllib.error.HTTPError as error:
                status, body = error.code, error.read()
            self.send_response(status)
            self.send_header("Content-Type", "application/json")
            self.end_headers()
            self.wfile.write(body)

        do_POST = do_GET

        def log_message(self, *arguments):
            pass

    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    with ThreadingHTTPServer(("127.0.0.1", 0), Proxy) as running:
        thread = threading.Thread(target=running.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{running.server_port}{BASE}"
        running.shutdown()
        thread.join()


def test_moonrakerpy_through_a_proxy(server, board, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    before = len(board.board.received())
    with proxy(server, {"X-Api-Key": OPERATOR.api_key}) as address:
        printer = MoonrakerPrinter(address)
        assert {"extruder1", "extruder10", "heater_bed"} <= set(printer.list_temp_sensors())
        temperatures = printer.query_temperatures()
        assert temperatures["extruder1"]["temperature"] > 0
        assert printer.query_status("toolhead")["position"][3:] == [0.0]
        assert printer.send_gcode("M117 moonrakerpy") is True
        server.wait_for(
            lambda: "M117 moonrakerpy" in helpers.commands(board)[before:], 10, "the command"
        )
        assert "M117 moonrakerpy" in printer.get_gcode(20, msg_type="command")


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_moonrakerpy_as_a_guest(server, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    with pytest.raises(KeyError):
        MoonrakerPrinter(server.url + BASE)
    group = server.get("/api/access/groups/guests").json()
    permissions = [*group["permissions"], "PLUGIN_RRFMODEL_READ"]
    server.put("/api/access/groups/guests", json={**group, "permissions": permissions})
    try:
        printer = MoonrakerPrinter(server.url + BASE)
        assert printer.query_status("webhooks")["state"] == "ready"
        assert printer.send_gcode("M117 no") is False
    finally:
        server.put("/api/access/groups/guests", json=group)


# addresses


@pytest.mark.both_hosts("each has its own way with what is not found")
def test_errors_have_moonrakers_form_everywhere(server):
    with server.client(OPERATOR) as client:
        assert_failure(client.get(f"{BASE}/server/nothing"), 404)
        assert_failure(client.get(f"{BASE}/nothing/at/all"), 404)
        told = client.get(f"{BASE}/printer/gcode/script")
        assert_failure(told, 405)
        assert told.headers["Allow"] == "POST"


@pytest.mark.parametrize("count, status", [("count:int=2", 200), ("count:int=x", 400)])
def test_a_value_may_have_its_kind_behind_its_name(server, count, status):
    assert server.get(f"{BASE}/server/gcode_store?{count}").status_code == status
