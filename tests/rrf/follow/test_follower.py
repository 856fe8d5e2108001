"""A board followed without faults: first fetch, live values, what moved, resets."""

import json

import pytest

from octoprint_rrfmodel.rrf.follow.follower import NOT_SUPPORTED_AFTER, Follower, answers
from octoprint_rrfmodel.rrf.follow.live import LIVE_KEYS
from octoprint_rrfmodel.rrf.follow.poll import FETCHES_BETWEEN_LIVE
from octoprint_rrfmodel.rrf.model.merge import paths
from octoprint_rrfmodel.rrf.wire.reply import ModelReply, NoBuffers, StatusReply
from octoprint_rrfmodel.rrf.wire.request import (
    KEY_FLAGS,
    LIVE_FLAGS,
    OUTLINE_FLAGS,
    ModelRequest,
    StatusRequest,
)

from ..board import Board, following, machine, serve
from ..strategies import compact, model_reply

LIVE = ModelRequest("", LIVE_FLAGS)


def test_first_of_all_come_counters_and_names():
    board, follower = Board(), Follower()
    assert follower.protocol is None
    serve(follower, board, 2)
    assert board.asked == [ModelRequest("seqs", LIVE_FLAGS), ModelRequest("", OUTLINE_FLAGS)]
    assert follower.protocol == "M409"
    assert not follower.ready
    assert follower.behind


def test_every_key_is_fetched_once_and_the_model_is_the_boards():
    board = Board()
    follower = following(board)
    keys = [request.key for request in board.asked if request.flags == KEY_FLAGS]
    assert sorted(keys) == sorted(set(board.model) - {"seqs"})
    assert keys[0] == "state"
    assert follower.store.model == board.model
    assert follower.resets == 0
    assert follower.counters == {
        "replies": len(board.asked),
        "malformed": 0,
        "out_of_buffers": 0,
        "timeouts": 0,
    }


def test_live_values_come_between_the_first_keys():
    board = Board()
    following(board)
    live = [index for index, request in enumerate(board.asked) if request == LIVE]
    assert live
    gaps = [later - sooner for sooner, later in zip(live, live[1:])]
    assert max(gaps) <= FETCHES_BETWEEN_LIVE + 1


def test_only_live_values_are_asked_for_when_nothing_moves():
    board = Board()
    follower = following(board)
    asked = len(board.asked)
    serve(follower, board, 20)
    assert set(board.asked[asked:]) == {LIVE}


@pytest.mark.parametrize("axes", [9, 10, 14])
def test_all_axes_are_known(axes):
    board = Board(machine(axes))
    follower = following(board)
    assert follower.store.model == board.model
    assert board.keys_asked().count("move.axes") == 1


CHANGES = [
    ("state.status", "busy"),
    ("state.messageBox", {"mode": 2, "seq": 1, "message": "a", "title": ""}),
    ("state.displayMessage", "hello"),
    ("heat.heaters[0].current", 60.5),
    ("heat.heaters[0].max", 300.0),
    ("heat.bedHeaters", [0]),
    ("move.axes[0].homed", True),
    ("move.axes[0].machinePosition", 12.5),
    ("move.kinematics", {"name": "delta", "towers": [{"xPos": 1.0}]}),
    ("move.speedFactor", 0),
    ("tools", []),
    ("tools[1].name", "b"),
    ("fans[1]", {"actualValue": 1.0, "name": "b"}),
    ("fans[0]", None),
    ("global", {}),
    ("global.mine", None),
    ("global.other", [True, [None], {"a": {}}]),
    ("network.name", "other"),
    ("job.file", {"fileName": "0:/gcodes/a.g", "size": 5}),
    ("job.filePosition", 3),
    ("volumes[0].freeSpace", 4),
    ("sensors.analog", [None, {"lastReading": 3, "type": "x"}]),
    ("inputs[0].lineNumber", 7),
    ("boards[0].mcuTemp.current", 31.0),
]


@pytest.mark.parametrize(("path", "value"), CHANGES, ids=[path for path, _ in CHANGES])
def test_change_is_seen_with_two_requests(path, value):
    board = Board()
    follower = following(board)
    asked = len(board.asked)
    board.set(path, value)
    serve(follower, board, 2)
    assert follower.store.model == board.model
    key = path.partition(".")[0].partition("[")[0]
    assert board.keys_asked(asked) == ["", key], "only what moved is fetched again"


def test_live_value_is_seen_with_one_request():
    board = Board()
    follower = following(board)
    board.set("heat.heaters[0].current", 61.5)
    taken = serve(follower, board)
    assert list(paths(taken.changes["heat"])) == ["heaters[0].current"]
    assert set(taken.changes) == {"heat", "seqs"}
    assert not taken.reset


def test_live_value_that_came_with_its_key_and_went_back_is_seen():
    board = Board()
    follower = following(board)
    board.set("heat.heaters[0].max", 300.0)
    serve(follower, board)
    known = board.model["heat"]["heaters"][0]["current"]
    board.model["heat"]["heaters"][0]["current"] = known + 5
    assert follower.next_request().key == "heat"
    serve(follower, board)
    board.model["heat"]["heaters"][0]["current"] = known
    assert follower.next_request() == LIVE
    serve(follower, board)
    assert follower.store.model["heat"]["heaters"][0]["current"] == known


def test_message_box_opens_and_closes_with_live_replies():
    board = Board()
    follower = following(board)
    for box in ({"mode": 1, "seq": 3}, None, {"mode": 2, "seq": 4}, None):
        board.model = json.loads(json.dumps(board.model))
        board.model["state"]["messageBox"] = box  # no counter: i alone must do
        serve(follower, board)
        assert follower.store.model["state"]["messageBox"] == box


def test_message_box_of_version_3_3_comes_by_its_counter():
    board = Board(ignored="i", axes_shown=None)
    follower = following(board)
    assert follower.store.model == board.model
    for box in ({"mode": 1, "seq": 3}, None):
        board.set("state.messageBox", box)
        serve(follower, board, 2)
        assert follower.store.model["state"]["messageBox"] == box


def test_counter_that_moves_during_the_fetch_leads_to_another_one():
    board = Board(machine(10))
    follower = following(board)
    board.set("move.speedFactor", 2.0)
    serve(follower, board)
    assert follower.next_request().key == "move"
    serve(follower, board)
    board.set("move.kinematics", {"name": "coreXY"})
    assert follower.next_request().key == "move.axes"
    serve(follower, board, 4)
    assert follower.store.model == board.model


@pytest.mark.parametrize("after", range(1, 16))
def test_change_during_the_first_fetch_is_not_missed(after):
    board, follower = Board(), Follower()
    serve(follower, board, after)
    board.set("move.kinematics", {"name": "coreXY"})
    board.set("state.displayMessage", "x")
    board.set("volumes[0].mounted", False)
    serve(follower, board, 40)
    assert follower.ready
    assert follower.store.model == board.model


@pytest.mark.parametrize("start", [65534, 65535, 0])
def test_counter_that_wraps_is_one_that_moved(start):
    board = Board()
    board.model["seqs"]["tools"] = start
    follower = following(board)
    for name in ("a", "b"):
        board.set("tools[0].name", name)
        serve(follower, board, 2)
        assert follower.store.model == board.model


def test_card_that_changed_by_its_own_counter_is_fetched():
    board = Board()
    follower = following(board)
    board.model["volumes"][0]["freeSpace"] = 1
    board.model["seqs"]["volChanges"] = [1]
    serve(follower, board, 2)
    assert follower.store.model == board.model


def test_limits_are_fetched_once():
    board = Board()
    follower = following(board)
    for round_ in range(10):
        for key in ("heat", "state", "move"):
            board.bump(key)
        serve(follower, board, 5 + round_)
    assert board.keys_asked().count("limits") == 1


def test_keys_of_an_sbc_come_without_flags():
    board = Board(from_host=("network", "volumes"))
    follower = following(board)
    assert follower.store.model == board.model


def test_key_without_a_counter_or_a_name_of_ours_is_fetched_too():
    model = machine()
    model["somethingNew"] = {"a": {"b": [1]}}
    board = Board(model)
    assert following(board).store.model == model


@pytest.mark.parametrize("key", ["", "tools", "limits"])
def test_refetch_asks_again(key):
    board = Board()
    follower = following(board)
    asked = len(board.asked)
    board.model["tools"][0]["name"] = "changed without a word"
    board.model["limits"]["axes"] = 11
    follower.refetch(key)
    assert follower.behind
    assert follower.ready, "it was once, and nothing is lost"
    serve(follower, board, 30)
    again = [request.key for request in board.asked[asked:] if request.flags == KEY_FLAGS]
    wanted = [key] if key else sorted(set(board.model) - {"seqs"})
    assert sorted(again) == wanted
    assert (follower.store.model["limits"]["axes"] == 11) is (key in ("", "limits"))


@pytest.mark.parametrize("behind", [False, True], ids=["live", "key"])
def test_refetch_while_a_request_is_under_way(behind):
    """The answer that is on its way is one; the key's turn comes afterwards."""
    board = Board()
    follower = following(board)
    if behind:
        follower.refetch("limits")
    request = follower.next_request()
    follower.refetch("tools")
    board.model["tools"][0]["name"] = "changed without a word"
    assert follower.next_request() == request
    assert follower.take(board.reply(request)) is not None
    serve(follower, board, 4)
    assert follower.store.model["tools"] == board.model["tools"]
    assert follower.counters["malformed"] == follower.counters["timeouts"] == 0


def test_refetch_of_an_unknown_key_asks_nothing():
    board = Board()
    follower = following(board)
    follower.refetch("nothing")
    assert not follower.behind


@pytest.mark.parametrize("after", range(22))
def test_reset_in_each_phase_leads_to_the_new_model(after):
    board, follower = Board(), Follower()
    serve(follower, board, after)
    board.reset(displayMessage="new")
    board.model["tools"] = []
    board.model["global"] = {}
    for _ in range(45):
        board.model["state"]["upTime"] += 1
        serve(follower, board)
    assert follower.ready
    assert follower.store.model == board.model
    assert follower.resets <= 1


def test_reset_is_told_once_and_the_model_begins_anew():
    board = Board()
    follower = following(board)
    board.reset()
    revision = follower.store.revision
    # a second answer has to say so
    assert serve(follower, board).is_doubted
    assert serve(follower, board).reset
    assert follower.store.model == {}
    assert follower.store.revision > revision
    assert not follower.ready
    assert follower.resets == 1
    assert not serve(follower, board).reset
    assert follower.next_request() == ModelRequest("", OUTLINE_FLAGS)


def test_time_that_goes_on_is_no_reset():
    board = Board()
    follower = following(board)
    for up_time in (100, 101, 101, 5000):
        board.model["state"]["upTime"] = up_time
        assert not serve(follower, board).reset


def test_forgetting_is_a_new_connection():
    board = Board()
    follower = following(board)
    follower.forget()
    assert (follower.store.model, follower.protocol, follower.ready) == ({}, None, False)
    other = Board(machine(5))
    serve(follower, other, 40)
    assert follower.store.model == other.model
    assert follower.resets == 0


def test_snapshot_of_a_reader_stays_as_it_was():
    board = Board()
    follower = following(board)
    snapshot = follower.store.model
    text = json.dumps(snapshot)
    board.set("heat.heaters[0].current", 99.5)
    board.set("tools", [])
    serve(follower, board, 5)
    assert json.dumps(snapshot) == text
    assert follower.store.model != snapshot


@pytest.mark.parametrize("outline", [None, [], {}, 5])
def test_board_that_does_not_name_its_keys_is_asked_for_the_live_ones(outline):
    board, follower = Board(), Follower()
    serve(follower, board)
    follower.take(model_reply(outline, flags=OUTLINE_FLAGS))
    serve(follower, board, 30)
    assert follower.ready
    assert follower.store.model == {key: board.model[key] for key in LIVE_KEYS}


ANSWERS = [
    (ModelReply("", LIVE_FLAGS, {}, 0), LIVE, True),
    (ModelReply("heat", LIVE_FLAGS, {}, 0), LIVE, False),
    (ModelReply("", KEY_FLAGS, {}, 0), LIVE, False),
    (ModelReply("network", None, {}, 0), ModelRequest("network", KEY_FLAGS), True),
    (ModelReply("volumes", None, {}, 0), ModelRequest("network", KEY_FLAGS), False),
    (StatusReply({"status": "I"}), LIVE, False),
    (NoBuffers(), StatusRequest(2), False),
    (StatusReply({"status": "I"}), StatusRequest(2), True),
    (ModelReply("", LIVE_FLAGS, {}, 0), StatusRequest(2), False),
]


@pytest.mark.parametrize(("reply", "request_", "expected"), ANSWERS)
def test_reply_answers_the_request_that_it_echoes(reply, request_, expected):
    assert answers(reply, request_) is expected


def test_unknown_members_pass_untouched():
    board = Board()
    follower = following(board)
    board.model["heat"]["strange"] = {"x": [None, {}]}
    board.bump("heat")
    serve(follower, board, 2)
    assert follower.store.model["heat"]["strange"] == {"x": [None, {}]}


def test_m408_reply_to_an_m409_request_is_not_taken():
    follower = Follower()
    assert follower.take(compact({"status": "I", "heaters": [1.0]})) is None
    assert follower.protocol is None


def test_silence_is_taken_for_an_unknown_command_only_after_some_time():
    follower = Follower()
    for _ in range(NOT_SUPPORTED_AFTER):
        assert isinstance(follower.next_request(), ModelRequest)
        follower.timed_out()
    assert isinstance(follower.next_request(), StatusRequest)
