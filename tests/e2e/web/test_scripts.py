"""Klipper's commands as clients send them: what reaches the board, and what is done to a print."""

import pytest

from tests.support.basedir import ADMIN, OPERATOR, READER

from .. import helpers, prints

BASE = "/plugin/rrfmodel"

BOARD = {"machine": "cartesian"}

CARD_FILE = "0:/gcodes/clips.gcode"


def prepare(board):
    board.card.write("0:/macros/More/Park it.g", "M117 parked\n")
    board.card.write("0:/macros/pause.g", "M117 mine\n")
    board.card.write(CARD_FILE, "G4 S2\n" * 300)


def send(server, script, user=ADMIN):
    with server.client(user) as client:
        return client.post(f"{BASE}/printer/gcode/script", json={"script": script})


def refused(response):
    error = response.json()["error"]
    assert error["message"].endswith("."), error
    return response.status_code


def sent_since(board, before, line):
    return line in helpers.commands(board)[before:]


def objects(server):
    return server.get(f"{BASE}/printer/objects/list").json()["result"]["objects"]


def query(server, name):
    found = server.get(f"{BASE}/printer/objects/query?{name}").json()["result"]
    return found["status"][name]


def test_macros_of_the_card_are_listed_and_run(server, board):
    wanted = {"gcode_macro Say_hello", "gcode_macro More_Park_it", "gcode_macro MACRO_pause"}
    server.wait_for(lambda: wanted <= set(objects(server)), 20, "the macros")
    before = len(helpers.commands(board))
    assert send(server, "MORE_PARK_IT").json() == {"result": "ok"}
    line = 'M98 P"0:/macros/More/Park it.g"'
    server.wait_for(lambda: sent_since(board, before, line), 10, "the macro")


@pytest.mark.both_hosts("lines go through the queue of the host")
def test_a_script_goes_out_in_its_order(server, board):
    before = len(helpers.commands(board))
    script = (
        "M117 one\nSET_HEATER_TEMPERATURE HEATER=extruder TARGET=45\nTURN_OFF_HEATERS\nM117 two"
    )
    assert send(server, script).json() == {"result": "ok"}
    server.wait_for(lambda: sent_since(board, before, "M117 two"), 10, "the last line")
    found = [line for line in helpers.commands(board)[before:] if line[:4] in ("M117", "M568")]
    assert found[:2] == ["M117 one", "M568 P0 S45 A2"]
    assert found[-1] == "M117 two" and "M568 P0 A0" in found


@pytest.mark.parametrize(
    "script, status",
    [
        ("M117 a\nPROBE_CALIBRATE", 409),
        ("M117 a\nNOSUCH X=1", 409),
        ("M117 a\nSET_FAN_SPEED FAN=fan SPEED=7", 400),
        ("M117 a\nRESUME", 400),
        ("RESTART\nM117 a", 400),
    ],
)
def test_of_what_is_refused_nothing_goes_out(server, board, script, status):
    before = len(board.board.received())
    assert refused(send(server, script)) == status
    helpers.wait_polls(server, 1)
    assert not [line for line in board.board.received()[before:] if "M117" in line]


def test_who_may_not_control_sends_nothing(server):
    assert refused(send(server, "PAUSE", READER)) == 403
    assert refused(send(server, "RESTART", READER)) == 403


@pytest.mark.both_hosts("each pauses with its own code")
def test_a_print_of_octoprints_is_paused_resumed_and_cancelled(server, board):
    prints.print_long(server)
    server.wait_state("Printing")
    assert send(server, "PAUSE", OPERATOR).json() == {"result": "ok"}
    server.wait_for(lambda: server.state().startswith("Paused"), 30, "the pause")
    assert refused(send(server, "PAUSE")) == 409
    assert send(server, "RESUME").json() == {"result": "ok"}
    server.wait_for(lambda: server.state().startswith("Printing"), 30, "the print going on")
    assert refused(send(server, "RESTART")) == 409
    assert refused(server.post(f"{BASE}/printer/firmware_restart")) == 409
    answer = server.post(f"{BASE}/printer/print/cancel")
    assert answer.json() == {"result": "ok"}
    server.wait_for(lambda: server.state().startswith("Operational"), 30, "the end")


def test_a_print_of_the_card_s_is_paused_and_cancelled(server, board):
    helpers.wait_value(server, "state.status", "idle", 30)
    server.wait_state("Operational")
    server.commands(f'M32 "{CARD_FILE}"')
    helpers.wait_value(server, "state.status", "processing", 30)
    assert send(server, "PAUSE").json() == {"result": "ok"}
    helpers.wait_value(server, "state.status", "paused", 30)
    assert query(server, "print_stats")["state"] == "paused"
    assert send(server, "RESUME").json() == {"result": "ok"}
    helpers.wait_value(server, "state.status", "processing", 30)
    assert send(server, "CANCEL_PRINT").json() == {"result": "ok"}
    helpers.wait_value(server, "state.status", "idle", 30)


@pytest.mark.both_hosts("each closes and opens its port with its own code")
def test_a_restart_brings_the_board_back(server, board):
    helpers.wait_value(server, "state.status", "idle", 30)
    server.wait_state("Operational")
    before = len(board.board.received())
    restarts_before = helpers.restarts(server)
    assert send(server, "FIRMWARE_RESTART").json() == {"result": "ok"}
    server.wait_for(
        lambda: any("M999" in line for line in board.board.received()[before:]), 30, "the restart"
    )
    helpers.wait_restarted(server, restarts_before)
