"""One spoilt reply is no reset and no fault; what is really so is believed with the next answer."""

import pytest

from octoprint_rrfmodel.rrf.follow.doubts import MOST_DOUBTS
from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.views.warnings import faults
from octoprint_rrfmodel.rrf.wire.request import LIVE_FLAGS, ModelRequest

from ..board import Board, following, machine, serve

LIVE = ModelRequest("", LIVE_FLAGS)


def guarded():
    """Return a model with a heater, a driver and a monitor, all well."""
    model = machine()
    model["heat"]["heaters"][1]["state"] = "active"
    model["boards"][0]["drivers"] = [{"status": 0}]
    model["state"]["currentTool"] = 0
    model["tools"][0]["extruders"] = [0]
    model["sensors"]["filamentMonitors"] = [{"enableMode": 2, "status": "ok"}]
    return model


def spoilt(follower, board, old, new):
    """Serve one reply with some of its bytes changed; return what it did."""
    text = board.reply(follower.next_request())
    assert old in text
    return follower.take(text.replace(old, new, 1))


def pass_time(board, seconds=1):
    board.model["state"]["upTime"] += seconds


# what the reply says, what is read instead
SPOILT = {
    "heater": ('"state":"active"', '"state":"fault"'),
    "driver": ('"status":0', '"status":2'),
    "filament": ('"status":"ok"', '"status":"nk"'),
    "motors off": ('"status":"idle"', '"status":"off"'),
    "halted": ('"status":"idle"', '"status":"halted"'),
    "up-time low": ('"upTime":100', '"upTime":00'),
}


@pytest.mark.parametrize("old, new", SPOILT.values(), ids=SPOILT)
def test_one_spoilt_reply_changes_nothing_and_is_asked_again_at_once(old, new):
    board = Board(guarded())
    follower = following(board)
    before = follower.store.model
    taken = spoilt(follower, board, old, new.replace(":00", ":20"))
    assert taken.is_doubted
    assert (taken.changes, taken.reset) == ({}, False)
    assert follower.store.model is before
    assert follower.next_request() == LIVE
    for _ in range(6):
        taken = serve(follower, board)
        assert not taken.reset
        assert not taken.is_doubted
        assert faults(follower.store.model) == []
        pass_time(board)
    assert follower.resets == 0


# one flipped bit each: 1 and 9, 5 and 7, 0 and 8
@pytest.mark.parametrize("true, read", [(17, 97), (27, 97), (25, 27), (25, 29), (100, 180)])
def test_up_time_that_was_ahead_once_is_no_reset(true, read):
    board = Board(guarded())
    board.model["state"]["upTime"] = true - 2
    follower = following(board)
    pass_time(board)
    serve(follower, board)
    pass_time(board)
    spoilt(follower, board, f'"upTime":{true}', f'"upTime":{read}')
    for _ in range(20):
        assert not serve(follower, board).reset
        pass_time(board)
    assert follower.resets == 0
    assert follower.store.model["state"]["upTime"] == board.model["state"]["upTime"] - 1


TRUE = {
    "heater": ("heat.heaters[1].state", "fault"),
    "driver": ("boards[0].drivers[0].status", 2),
    "filament": ("sensors.filamentMonitors[0].status", "noFilament"),
    "motors off": ("state.status", "off"),
    "halted": ("state.status", "halted"),
}


@pytest.mark.parametrize("path, value", TRUE.values(), ids=TRUE)
def test_second_answer_is_believed(path, value):
    board = Board(guarded())
    follower = following(board)
    board.set(path, value)
    assert serve(follower, board).is_doubted
    assert not serve(follower, board).is_doubted
    assert len(faults(follower.store.model)) == 1


@pytest.mark.parametrize("path, value", TRUE.values(), ids=TRUE)
def test_what_the_firmware_has_said_by_itself_is_believed_at_once(path, value):
    board = Board(guarded())
    follower = following(board)
    board.set(path, value)
    follower.told()
    assert not serve(follower, board).is_doubted
    assert len(faults(follower.store.model)) == 1


@pytest.mark.parametrize("before", [0, 1, 5, 100])
def test_reset_is_believed_with_the_second_answer(before):
    board = Board(guarded())
    follower = following(board)
    for _ in range(3):
        pass_time(board, before)
        serve(follower, board)
    board.reset()
    serve(follower, board)
    assert serve(follower, board).reset
    assert follower.resets == 1


def test_answer_that_comes_late_is_no_reset():
    board = Board(guarded())
    follower = following(board)
    late = board.reply(follower.next_request())
    follower.timed_out()
    pass_time(board, 30)
    serve(follower, board)
    assert follower.take(late).is_doubted
    for _ in range(5):
        assert not serve(follower, board).reset


def test_fault_in_the_answer_about_a_key_is_doubted_too():
    board = Board(guarded())
    follower = following(board)
    follower.refetch("heat")
    assert spoilt(follower, board, '"state":"active"', '"state":"fault"').is_doubted
    assert faults(follower.store.model) == []
    for _ in range(4):
        serve(follower, board)
    assert faults(follower.store.model) == []
    assert follower.store.model == board.model


def test_key_is_not_known_as_long_as_its_first_answer_is_doubted():
    board = Board(guarded())
    follower = Follower()
    # it is the last one to be fetched
    board.model["heat"] = board.model.pop("heat")
    answers = []
    while len(answers) < 2:
        asked = follower.next_request()
        if not asked.line.startswith('M409 K"heat"'):
            serve(follower, board)
        elif answers:
            answers.append(serve(follower, board))
        else:
            answers.append(spoilt(follower, board, '"state":"active"', '"state":"fault"'))
        assert follower.ready == (len(answers) == 2)
    assert answers[0].is_doubted
    assert follower.store.model == board.model


def test_fault_that_is_known_by_another_name_once_more_is_known_is_the_same():
    """Live values tell no board's address: its drivers' faults are called by its place before."""
    model = guarded()
    first = model["boards"][0]
    model["boards"].append({**first, "canAddress": 20, "drivers": [{"status": 2}]})
    board = Board(model)
    follower = Follower()
    serve(follower, board, 60)
    assert follower.store.model == board.model
    assert [each.numbers for each in faults(follower.store.model)] == [(20, 0)]


def test_line_that_tells_something_else_each_time_is_not_doubted_for_ever():
    board = Board(guarded())
    follower = following(board)
    board.model["heat"]["heaters"] = [{"state": "off"}] * 10
    board.bump("heat")
    serve(follower, board, 3)
    for heater in range(MOST_DOUBTS + 1):
        text = board.reply(follower.next_request())
        parts = text.split('"state":"off"')
        where = heater + 1
        text = (
            '"state":"off"'.join(parts[:where])
            + '"state":"fault"'
            + '"state":"off"'.join(parts[where:])
        )
        taken = follower.take(text)
    assert not taken.is_doubted
