"""A board followed over a bad line: no room, silence, spoilt and misplaced replies."""

import copy

import pytest

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.follow.live import LIVE_KEYS
from octoprint_rrfmodel.rrf.follow.poll import PATIENCE
from octoprint_rrfmodel.rrf.model.merge import DEEPEST
from octoprint_rrfmodel.rrf.wire.line import NO_BUFFERS
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply
from octoprint_rrfmodel.rrf.wire.request import KEY_FLAGS, LIVE_FLAGS, ModelRequest, StatusRequest

from ..board import Board, following, machine, serve
from ..strategies import compact, model_reply

LIVE = ModelRequest("", LIVE_FLAGS)


def settle(follower, board, requests=60):
    """Serve without faults and check that the model is the board's."""
    for _ in range(requests):
        text = board.reply(follower.next_request())
        follower.take(text)
        if follower.ready and not follower.behind and follower.store.model == board.model:
            return
    assert follower.ready
    assert follower.store.model == board.model


# ---- {"err":-1}


@pytest.mark.parametrize("after", range(20))
def test_no_room_once_is_asked_again_the_same(after):
    board, follower = Board(), Follower()
    serve(follower, board, after)
    request = follower.next_request()
    assert follower.take(NO_BUFFERS).changes == {}
    assert follower.short_of_buffers == 1
    assert follower.counters["out_of_buffers"] == 1
    assert follower.next_request() == request
    serve(follower, board)
    assert follower.short_of_buffers == 0
    settle(follower, board)


@pytest.mark.parametrize("key", [key for key in machine() if key != "seqs"])
def test_no_room_twice_makes_a_key_come_in_parts(key):
    board, follower = Board(), Follower()
    while follower.next_request() != ModelRequest(key, KEY_FLAGS):
        serve(follower, board)
    follower.take(NO_BUFFERS)
    follower.take(NO_BUFFERS)
    assert follower.next_request() == ModelRequest(key, "d2vno")
    settle(follower, board)


@pytest.mark.parametrize("times", range(2, 9))
@pytest.mark.parametrize("key", ["move", "tools", "heat"])
def test_no_room_for_a_while_loses_nothing(key, times):
    board, follower = Board(machine(10)), Follower()
    while follower.next_request() != ModelRequest(key, KEY_FLAGS):
        serve(follower, board)
    for _ in range(times):
        follower.take(NO_BUFFERS)
    assert follower.counters["out_of_buffers"] == times
    settle(follower, board, 90)


def test_live_root_without_room_comes_in_parts():
    board = Board()
    board.rooms = {"": len(board.reply(LIVE)) - 1}
    follower = following(board, most=120)
    assert follower.store.model == board.model
    asked = len(board.asked)
    serve(follower, board, 2 * len(LIVE_KEYS))
    # the whole is tried again now and then
    assert set(board.keys_asked(asked)) - {""} == set(LIVE_KEYS)
    board.set("heat.heaters[0].current", 12.5)
    board.set("tools[0].name", "new")
    serve(follower, board, 30)
    assert follower.store.model == board.model


def test_row_11_whole_live_answers_come_back_as_soon_as_there_is_room():
    board = Board()
    follower = following(board)
    follower.take(NO_BUFFERS)
    follower.take(NO_BUFFERS)
    asked = len(board.asked)
    serve(follower, board, len(LIVE_KEYS) + 3)
    assert board.keys_asked(asked) == [*LIVE_KEYS, "", "", ""]


def test_whole_live_answer_is_tried_less_often_where_there_is_never_room():
    board = Board()
    board.rooms = {"": len(board.reply(LIVE)) - 1}
    follower = following(board, most=120)
    serve(follower, board, 200)
    asked = len(board.asked)
    serve(follower, board, 600)
    tries = board.keys_asked(asked).count("")
    assert 1 <= tries <= 600 / len(LIVE_KEYS) / 10
    assert follower.short_of_buffers == 0


def test_row_11_fault_is_believed_where_live_values_come_in_parts():
    board = Board()
    board.model["heat"]["heaters"][1]["state"] = "active"
    board.rooms = {"": len(board.reply(LIVE)) - 1}
    follower = following(board, most=120)
    serve(follower, board, 30)
    board.set("heat.heaters[1].state", "fault")
    while not serve(follower, board).is_doubted:
        pass
    serve(follower, board)
    assert follower.store.model["heat"]["heaters"][1]["state"] == "fault"


def test_key_that_never_fits_lets_the_others_have_their_turn():
    board = Board(machine(10))
    follower = Follower()
    board.rooms = {"move": 0}
    for _ in range(150):
        serve(follower, board)
    others = {key: value for key, value in board.model.items() if key != "move"}
    known = {key: value for key, value in follower.store.model.items() if key != "move"}
    assert known == others
    # said to be so, and asked for rarely
    assert follower.ready
    assert not follower.behind
    assert follower.too_large == ("move",)
    asked = len(board.asked)
    for _ in range(200):
        serve(follower, board)
    assert 1 <= board.keys_asked(asked).count("move") <= 5
    assert follower.short_of_buffers == 0
    board.set("heat.heaters[0].max", 5.0)
    board.set("state.status", "busy")
    for _ in range(60):
        serve(follower, board)
    assert follower.store.model["heat"] == board.model["heat"]
    board.rooms = {}
    settle(follower, board, 90)


@pytest.mark.parametrize("path", ["global", "global.big"])
def test_row_25_member_that_never_fits_is_left_out_and_the_rest_is_there(path):
    board = Board()
    board.model["global"] = {"big": {"x": {"y": "z" * 500}}, "mine": [1, {"a": None}], "n": 5}
    follower = Follower()
    board.rooms = {"global": 0 if path == "global" else 150, "global.big": 0}
    serve(follower, board, 90)
    assert follower.ready
    assert not follower.behind
    assert follower.too_large == (path,)
    expected = {**board.model, "global": {"mine": [1, {"a": None}], "n": 5}}
    if path == "global":
        del expected["global"]
    assert follower.store.model == expected
    # all else goes on as if it weren't there, however often it changes
    asked = len(board.asked)
    for number in range(100):
        board.bump("global")
        board.set("state.displayMessage", str(number))
        serve(follower, board, 3)
    serve(follower, board, 5)
    assert follower.store.model["state"]["displayMessage"] == "99"
    assert board.keys_asked(asked).count(path) <= 8
    board.rooms = {}
    follower.refetch("global")
    settle(follower, board, 90)
    assert follower.too_large == ()


def test_live_part_that_never_fits_lets_the_others_have_their_turn():
    board = Board()
    follower = following(board)
    board.rooms = {"": 0, "move": 0}
    for step in range(3):
        board.set("state.status", f"status {step}")
        board.set("boards[0].mcuTemp.current", 40.0 + step)
        board.set("tools[0].name", f"name {step}")
        for _ in range(60):
            serve(follower, board)
        for key in ("state", "boards", "tools", "seqs"):
            assert follower.store.model[key] == board.model[key]


def test_no_room_for_anything_is_counted_and_not_the_end():
    board, follower = Board(), Follower()
    for count in range(1, 40):
        follower.take(NO_BUFFERS)
        assert follower.short_of_buffers == count
    settle(follower, board)


# ---- silence


@pytest.mark.parametrize("times", [1, 2, 3, 10])
@pytest.mark.parametrize("after", [2, 5, 9, 25])
def test_lost_replies_delay_only(after, times):
    board, follower = Board(), Follower()
    serve(follower, board, after)
    for _ in range(times):
        follower.timed_out()
    assert follower.counters["timeouts"] == times
    assert isinstance(follower.next_request(), ModelRequest)
    settle(follower, board)


def test_live_root_that_never_comes_does_not_keep_keys_from_being_fetched():
    board = Board()
    follower = following(board)
    follower.refetch("tools")
    follower.refetch("heat")
    board.set("tools[0].name", "new")
    for _ in range(80):
        if follower.next_request() == LIVE:
            follower.timed_out()
        else:
            serve(follower, board)
    assert not follower.behind
    assert follower.store.model["tools"] == board.model["tools"]


def test_silent_key_gives_way_to_live_values_and_comes_back():
    board = Board()
    follower = following(board)
    board.set("tools[0].name", "new")
    serve(follower, board)
    for _ in range(PATIENCE):
        assert follower.next_request().key == "tools"
        follower.timed_out()
    assert follower.next_request() == LIVE
    settle(follower, board)


# ---- spoilt replies

SPOILT = {
    "cut": lambda text: text[:-20],
    "cut behind the envelope": lambda text: text[:40],
    "lost brace": lambda text: text.replace("}", "", 1),
    "NUL": lambda text: text[:60] + "\0" + text[61:],
    "text in between": lambda text: text[:40] + text[40:].replace(":", ":T:21.3 /0.0", 1),
    "list too deep": lambda text: text[:-1] + ',"x":' + "[" * 5000 + "]" * 5000 + "}",
}


@pytest.mark.parametrize("spoil", SPOILT.values(), ids=SPOILT)
@pytest.mark.parametrize("after", [0, 1, 2, 3, 6, 9, 22, 23])
def test_spoilt_reply_is_counted_and_asked_for_again(after, spoil):
    board, follower = Board(), Follower()
    serve(follower, board, after)
    before, request = copy.deepcopy(follower.store.model), follower.next_request()
    text = spoil(board.reply(request))
    try:
        follower.take(text)
    except MalformedReply:
        assert follower.counters["malformed"] == 1
        assert follower.store.model == before
        assert follower.next_request() == request
    settle(follower, board)


def test_spoilt_live_replies_are_followed_by_right_ones():
    board = Board()
    follower = following(board)
    for length in range(1, 400, 7):
        board.set("heat.heaters[0].current", length / 2)
        text = board.reply(follower.next_request())
        with pytest.raises(MalformedReply):
            follower.take(text[: len(text) - length])
        serve(follower, board)
        assert follower.store.model["heat"] == board.model["heat"]


def test_value_deeper_than_any_model_is_malformed_and_changes_nothing():
    deep = 1
    for _ in range(DEEPEST + 1):
        deep = [deep]
    board = Board()
    follower = following(board)
    before = copy.deepcopy(follower.store.model)
    board.set("global.deep", deep)
    serve(follower, board)
    for _ in range(3):
        request = follower.next_request()
        if request.key == "global":
            with pytest.raises(MalformedReply):
                follower.take(board.reply(request))
        else:
            serve(follower, board)
    assert follower.counters["malformed"] >= 1
    assert follower.store.model["global"] == before["global"]
    board.set("global", {})
    settle(follower, board)


ODD_LIVE = {
    "nan": ('"upTime":100', '"upTime":nan'),
    "number for the counters": ('"seqs":{', '"seqs":5,"x":{'),
    "text for the time": ('"upTime":100', '"upTime":"later"'),
    "null for the counters": ('"seqs":{', '"seqs":null,"x":{'),
}


@pytest.mark.parametrize(("found", "odd"), ODD_LIVE.values(), ids=ODD_LIVE)
def test_odd_live_reply_does_no_lasting_harm(found, odd):
    board = Board()
    follower = following(board)
    text = board.reply(LIVE)
    assert found in text
    for _ in range(3):
        follower.take(text.replace(found, odd))
    board.set("tools[0].name", "new")
    for _ in range(60):
        serve(follower, board)
    known = {key: follower.store.model[key] for key in board.model}
    assert known == board.model


# ---- misplaced replies

UNSOLICITED = [
    model_reply({"current": 1}, key="heat.heaters[0]", flags=""),
    model_reply({"heaters": []}, key="heat", flags="d99"),
    model_reply(None, key="nothing", flags=LIVE_FLAGS),
    compact({"status": "I", "heaters": [1.0], "hstat": [0]}),
    compact({"status": "I", "temps": {"current": [1.0]}}),
]


@pytest.mark.parametrize("text", UNSOLICITED)
@pytest.mark.parametrize("after", [0, 1, 2, 8, 25])
def test_reply_to_somebody_else_changes_nothing(after, text):
    board, follower = Board(), Follower()
    serve(follower, board, after)
    request, before = follower.next_request(), copy.deepcopy(follower.store.model)
    assert follower.take(text) is None
    assert follower.next_request() == request
    assert follower.store.model == before
    settle(follower, board)


def test_replies_that_come_twice_do_no_harm():
    board, follower = Board(machine(10)), Follower()
    for _ in range(80):
        text = board.reply(follower.next_request())
        follower.take(text)
        follower.take(text)
    assert follower.ready
    assert follower.store.model == board.model


def test_reply_that_comes_a_request_too_late_does_no_harm():
    board, follower = Board(machine(10)), Follower()
    late = None
    for step in range(200):
        text = board.reply(follower.next_request())
        if late is not None:
            follower.take(late)
            late = None
        if step % 3 == 1:
            late = text
            follower.timed_out()
        else:
            follower.take(text)
    assert follower.ready
    assert follower.store.model == board.model
    assert follower.resets == 0


def test_take_raises_nothing_but_malformed_reply():
    board, follower = Board(), Follower()
    for text in ("", "{", '{"key":', "ok", "[]", "null", '{"status":1}', '{"axisMins":1}'):
        for _ in range(4):
            try:
                follower.take(text)
            except MalformedReply:
                continue
    assert isinstance(follower.next_request(), (ModelRequest, StatusRequest))
    settle(follower, board)
