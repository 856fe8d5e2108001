"""The HTTP endpoints: shapes, keys and flags, refusals, permissions."""

import concurrent.futures
import time

import pytest

from tests.support.basedir import ADMIN
from tests.support.waiting import within

from .. import helpers

MODEL = "/plugin/rrfmodel/model"
LIVE = "/plugin/rrfmodel/model/live"
STATUS = "/plugin/rrfmodel/status"
SIMPLE = "/api/plugin/rrfmodel"

STATUS_TYPES = {
    "version": str,
    "connected": bool,
    "is_rrf": bool,
    "protocol": (str, type(None)),
    "firmware": (dict, type(None)),
    "ready": bool,
    "stale": bool,
    "link": str,
    "beside": (bool, type(None)),
    "doing": (dict, type(None)),
    "heater_ages": dict,
    "simulated_file": (str, type(None)),
    "jobs": (int,),
    "blocked": (str, type(None)),
    "age": (int, float, type(None)),
    "ages": (dict,),
    "at": (int, float),
    "revision": int,
    "resets": int,
    "counters": dict,
    "warnings": list,
    "too_large": list,
    "first_run": bool,
}
COUNTERS = {"polls", "replies", "bytes", "malformed", "out_of_buffers", "timeouts", "rewritten"}


BOARD = {"machine": "toolchanger"}


@pytest.fixture
def ready(server, board):
    """The server with its line free."""
    server.wait_for(lambda: helpers.status(server)["blocked"] is None, 60, "the line to be free")
    helpers.wait_polls(server, 1)
    return server


def assert_error(response, status):
    assert response.status_code == status, response.text
    error = response.json()["error"]
    assert error[0].isupper() and error.endswith(".")
    return error


# the plugin's state


@pytest.mark.both_hosts("the endpoints are there")
@pytest.mark.parametrize("path", [STATUS, SIMPLE])
def test_status_has_the_contract_s_shape(ready, path):
    state = ready.get(path).json()
    assert set(state) == set(STATUS_TYPES)
    for name, kind in STATUS_TYPES.items():
        assert isinstance(state[name], kind), name
    assert set(state["counters"]) == COUNTERS
    assert set(state["firmware"]) == {"name", "version", "electronics", "date"}


# the cached model

ANSWERS = [
    ("", "", lambda result: result["heat"] == {} and "limits" in result),
    ("heat.heaters[1].state", "", "off"),
    ("#move.axes", "", 4),
    ("tools[1].number", "", 1),
    ("move.axes[].letter", "", ["X", "Y", "Z", "C"]),
    ("state", "d1", {}),
    ("state.messageBox", "", None),
    ("nothing.here", "", None),
    ("heat[", "", None),
    ("move.axes[99]", "", None),
    ("é", "xyz", None),
    ("state.thisInput", "", None),
    ("state.thisInput", "v", 3),
]


@pytest.mark.parametrize("key, flags, wanted", ANSWERS, ids=[f"{a[0]}-{a[1]}" for a in ANSWERS])
def test_model_answers_as_m409(ready, key, flags, wanted):
    answer = helpers.answer(ready, key, flags)
    result = answer["result"]
    assert (answer["key"], answer["flags"]) == (key, flags)
    assert wanted(result) if callable(wanted) else result == wanted
    assert ("next" in answer) == isinstance(result, list)
    assert answer.get("next", 0) == 0


def test_live_flag_brings_live_values_of_the_whole_model(ready):
    result = helpers.value(ready, "", "f")
    assert set(result) >= {"heat", "move", "seqs", "state", "tools"}
    assert set(result["heat"]) == {"heaters"}
    assert "limits" not in result


@pytest.mark.both_hosts("the endpoints are there")
def test_model_is_unknown_without_a_printer(server_factory):
    server = server_factory()
    assert "Connect" in assert_error(server.get(MODEL), 503)
    assert_error(server.get(LIVE), 409)


# the printer itself


@pytest.mark.both_hosts("lines go through the queue of the host")
def test_live_asks_the_printer(ready, board):
    before = len(board.board.received())
    response = ready.get(LIVE, params={"key": "move.axes[].letter", "flags": "v"})
    assert response.status_code == 200
    assert response.json()["result"] == ["X", "Y", "Z", "C"]
    assert response.json()["next"] == 0
    sent = [helpers.NUMBERED.match(line)["command"] for line in board.board.received()[before:]]
    assert 'M409 K"move.axes[].letter" F"v"' in sent


@pytest.mark.parametrize(
    "key, flags",
    [
        ("x" * 101, ""),
        ("state", "v" * 21),
        ("state\nM112", ""),
        ("state", "v\rM112"),
        ("stäte", ""),
        ("state;x", ""),
        ("state\x00", ""),
    ],
    ids=["long key", "long flags", "line feed", "return", "not ASCII", "semicolon", "NUL"],
)
def test_live_refuses_what_can_not_be_sent(ready, board, key, flags):
    before = len(board.board.received())
    assert_error(ready.get(LIVE, params={"key": key, "flags": flags}), 400)
    assert not any("M112" in line or "state" in line for line in board.board.received()[before:])


@pytest.mark.parametrize("key", ['a"b', "a'b", '" M112 "', "''"])
def test_live_quotes_what_the_firmware_reads_otherwise(ready, key):
    response = ready.get(LIVE, params={"key": key})
    assert response.status_code == 200, response.text
    assert response.json()["key"] == key
    assert response.json()["result"] is None
    assert ready.state() == "Operational"


@pytest.mark.both_hosts("lines go through the queue of the host")
def test_live_is_refused_while_polls_are_held_back(ready):
    ready.commands("G4 S15")
    ready.wait_for(
        lambda: helpers.status(ready)["blocked"] == "long_command", 10, "the line to be blocked"
    )
    assert_error(ready.get(LIVE, params={"key": "state"}), 409)


def test_four_may_wait_and_the_fifth_may_not(ready, board):
    board.board.inject("no_reply")
    try:
        with concurrent.futures.ThreadPoolExecutor(12) as clients:
            asked = [clients.submit(ready.client(ADMIN).get, LIVE) for _ in range(12)]
            # nobody who waits holds one of the threads that answer other requests
            started = time.monotonic()
            assert ready.get("/api/version").status_code == 200
            assert time.monotonic() - started < within(5)
            statuses = sorted(request.result().status_code for request in asked)
    finally:
        board.board.clear("no_reply")
    assert set(statuses) == {503, 504}
    # one may be under way besides the four
    assert statuses.count(504) in (4, 5)
    helpers.wait_polls(ready, 2, 90)
