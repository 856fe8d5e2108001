"""One key fetched whole: pages, axes beyond the ninth, and parts where the board is short."""

import copy

import pytest

from octoprint_rrfmodel.rrf.follow.fetch import Fetch
from octoprint_rrfmodel.rrf.wire.reply import ModelReply, NoBuffers, decode
from octoprint_rrfmodel.rrf.wire.request import KEY_FLAGS, LIVE_FLAGS, ModelRequest

from ..board import Board, machine


def fetched(board, key, flags=KEY_FLAGS, most=60):
    """Return the value that a fetch brings; it splits whenever the board has no room twice."""
    fetch = Fetch(key, flags)
    short = 0
    for _ in range(most):
        reply = decode(board.reply(fetch.request))
        if isinstance(reply, NoBuffers):
            short += 1
            if short >= 2:
                assert fetch.split(), f"{fetch.request} can't be split"
            continue
        short = 0
        if fetch.take(reply):
            return fetch.value
    raise AssertionError(f"{key} not complete after {most} requests: {board.asked}")


@pytest.mark.parametrize("key", machine())
def test_each_key_comes_whole_in_one_request(key):
    board = Board()
    assert fetched(board, key) == board.model[key]
    assert board.asked == [ModelRequest(key, KEY_FLAGS)]


def test_key_that_is_not_there_is_null():
    board = Board()
    assert fetched(board, "scanner") is None


def long_list(count):
    return [{"name": f"tool {index}", "filament": "x" * 150} for index in range(count)]


@pytest.mark.parametrize("count", [1, 20, 40, 120])
def test_long_array_comes_in_pages(count):
    board = Board({"tools": long_list(count)})
    assert fetched(board, "tools") == board.model["tools"]
    flags = [request.flags for request in board.asked]
    assert flags[0] == KEY_FLAGS
    assert all(later.startswith(KEY_FLAGS + "a") for later in flags[1:])
    assert (len(flags) > 1) is (count > 20)


@pytest.mark.parametrize("flags", [KEY_FLAGS, LIVE_FLAGS])
def test_live_arrays_come_in_pages_too(flags):
    board = Board({"inputs": [{"state": "x" * 90, "lineNumber": n} for n in range(90)]})
    assert fetched(board, "inputs", flags) == board.model["inputs"]


def test_board_that_has_more_and_sends_nothing_is_not_asked_forever():
    fetch = Fetch("tools")
    assert not fetch.take(ModelReply("tools", KEY_FLAGS, [1, 2], 2))
    assert fetch.request == ModelRequest("tools", KEY_FLAGS + "a2")
    assert fetch.take(ModelReply("tools", KEY_FLAGS + "a2", [], 2))
    assert fetch.value == [1, 2]


def test_array_that_shrank_between_two_pages_ends():
    fetch = Fetch("tools")
    assert not fetch.take(ModelReply("tools", KEY_FLAGS, [1, 2], 2))
    assert fetch.take(ModelReply("tools", KEY_FLAGS + "a2", [], 0))


@pytest.mark.parametrize(("axes", "requests"), [(3, 1), (8, 1), (9, 2), (10, 2), (14, 2)])
def test_axes_beyond_the_ninth_are_asked_for(axes, requests):
    board = Board(machine(axes))
    assert fetched(board, "move") == board.model["move"]
    assert len(board.asked) == requests
    if requests == 2:
        assert board.asked[1] == ModelRequest("move.axes", KEY_FLAGS + "a0")


def test_axes_that_fill_pages_are_all_asked_for():
    model = machine(14)
    for axis in model["move"]["axes"]:
        axis["workplaceOffsets"] = ["x" * 90] * 9
    board = Board(model, room=20000)
    assert fetched(board, "move") == model["move"]
    assert [request.flags for request in board.asked[1:3]] == ["d99vnoa0", "d99vnoa6"]


def test_axes_are_complete_before_version_3_5():
    board = Board(machine(12), axes_shown=None)
    assert fetched(board, "move") == board.model["move"]


def test_live_move_is_never_limited():
    board = Board(machine(12))
    value = fetched(board, "move", LIVE_FLAGS)
    assert [axis["machinePosition"] for axis in value["axes"]] == [0.5] * 12
    assert len(board.asked) == 1


SHORT = {
    "heat": 250,
    "move": 450,
    "tools": 150,
    "boards": 110,
    "fans": 110,
    "network": 80,
    "global": 60,
    "sensors": 110,
    "state": 140,
}


@pytest.mark.parametrize("axes", [3, 9, 11])
@pytest.mark.parametrize("key", SHORT)
def test_key_that_does_not_fit_is_put_together_from_parts(key, axes):
    model = machine(axes)
    whole = Board(copy.deepcopy(model))
    fetched(whole, key)
    board = Board(model, rooms={key: 0})
    # the outline, which is shorter, still fits
    board.reply = _only_outlines(board, key)
    assert fetched(board, key) == model[key]


def _only_outlines(board, key):
    answered = board.reply

    def reply(request):
        board.rooms = {key: 0} if request == ModelRequest(key, KEY_FLAGS) else {}
        return answered(request)

    return reply


@pytest.mark.parametrize("room", range(200, 400, 25))
def test_parts_are_split_again_where_they_do_not_fit(room):
    model = machine(10)
    model["heat"]["heaters"] *= 2
    board = Board(model, room=room)
    axes_need = len('{"key":"move.axes","flags":"d99vnoa0","result":[],"next":0}') + 1300
    board.rooms = {"move.axes": axes_need}
    for key in ("boards", "tools", "fans", "network"):
        assert fetched(board, key) == model[key], key


def test_outline_of_a_long_array_comes_in_pages():
    model = {"tools": [{**tool, "retraction": {"length": 2.0}} for tool in long_list(60)]}
    board = Board(model)
    board.reply = _only_outlines(board, "tools")
    assert fetched(board, "tools", most=100) == model["tools"]


@pytest.mark.parametrize(
    ("key", "flags"), [("move.axes", KEY_FLAGS), ("move", LIVE_FLAGS), ("tools", LIVE_FLAGS)]
)
def test_what_can_not_be_split_says_so(key, flags):
    assert not Fetch(key, flags).split()


def test_outline_can_not_be_split_again():
    fetch = Fetch("heat")
    assert fetch.split()
    assert fetch.request == ModelRequest("heat", "d2vno")
    assert not fetch.split()


def test_member_that_is_gone_when_its_turn_comes_is_null():
    fetch = Fetch("heat")
    assert fetch.split()
    assert not fetch.take(ModelReply("heat", "d2vno", {"a": {}, "b": 1}, 0))
    assert fetch.request.key == "heat.a"
    assert fetch.take(ModelReply("heat.a", KEY_FLAGS, None, 0))
    assert fetch.value == {"a": None, "b": 1}


def test_key_that_turned_null_while_it_was_split_is_null():
    fetch = Fetch("heat")
    assert fetch.split()
    assert fetch.take(ModelReply("heat", "d2vno", None, 0))
    assert fetch.value is None
