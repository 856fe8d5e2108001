"""Boards that have no ``M409``: forms tried, the best of them asked, and the way back."""

import pytest

from octoprint_rrfmodel.rrf.follow.follower import NOT_SUPPORTED_AFTER, Follower
from octoprint_rrfmodel.rrf.follow.poll408 import FILE_EVERY
from octoprint_rrfmodel.rrf.views.job import card_job, progress
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply
from octoprint_rrfmodel.rrf.wire.request import (
    LIVE_FLAGS,
    JobFileRequest,
    ModelRequest,
    StatusRequest,
)

from ..board import Board, serve
from ..strategies import compact, model_reply

S2 = {
    "status": "I",
    "coords": {"axesHomed": [1, 0], "xyz": [1.0, 2.0], "machine": [1.0, 2.0], "extr": [0.0]},
    "currentTool": -1,
    "params": {"atxPower": -1, "fanPercent": [30], "speedFactor": 100.0},
    "temps": {
        "bed": {"current": 21.5, "active": 60.0, "standby": 0.0, "state": 2, "heater": 0},
        "current": [21.5, 20.0],
        "state": [2, 0],
        "tools": {"active": [[200.0]], "standby": [[150.0]]},
    },
    "time": 100.0,
}
REPLIES = {
    0: {"status": "I", "heaters": [21.5, 20.0], "hstat": [2, 0], "msgBox.mode": -1},
    1: {"status": "I", "heaters": [21.5, 20.0], "hstat": [2, 0], "axisNames": "XY", "myName": "a"},
    2: S2,
    3: {**S2, "axisNames": "XY", "name": "a", "tools": [{"number": 0, "heaters": [1]}]},
    4: {**S2, "currentLayer": 3, "timesLeft": {"file": 9.0}},
    5: {"axisMins": [0.0, 0.0], "axisMaxes": [300.0, 200.0], "firmwareName": "RRF"},
}


FORMS = range(6)


class OldBoard:
    """Answers ``M408`` in the forms that it knows."""

    def __init__(self, forms=FORMS, file=None):
        self.replies = {form: dict(REPLIES[form]) for form in forms}
        self.file = file
        self.asked = []

    def reply(self, request):
        self.asked.append(request)
        if isinstance(request, JobFileRequest) and self.file is not None:
            return compact(self.file)
        if isinstance(request, StatusRequest) and request.form in self.replies:
            return compact(self.replies[request.form])
        return None

    def set(self, **members):
        for form in self.replies:
            if form != 5:
                self.replies[form].update(members)

    def forms_asked(self, since):
        asked = self.asked[since:]
        return [request.form for request in asked if isinstance(request, StatusRequest)]


def run(follower, board, requests=1, refuse=True):
    """Serve; a command that isn't known is refused with a text, or met with silence."""
    for _ in range(requests):
        text = board.reply(follower.next_request())
        if text is not None:
            follower.take(text)
        elif refuse:
            follower.not_supported()
        else:
            follower.timed_out()


def following(board, requests=30, refuse=True):
    follower = Follower()
    run(follower, board, requests, refuse)
    assert follower.ready
    assert follower.protocol == "M408"
    return follower


@pytest.mark.parametrize("refuse", [True, False], ids=["refused", "silent"])
@pytest.mark.parametrize("forms", [range(6), (0, 1), (2, 3, 4, 5), (0,), (2,)])
def test_board_without_m409_is_followed_by_the_forms_it_has(forms, refuse):
    board = OldBoard(forms)
    follower = following(board, 40, refuse)
    heaters = follower.store.model["heat"]["heaters"]
    assert [heater["current"] for heater in heaters] == [21.5, 20.0]
    assert follower.store.model["state"]["status"] == "idle"
    asked = len(board.asked)
    run(follower, board, 20)
    assert set(board.forms_asked(asked)) <= set(forms)


def test_one_refusal_of_m409_is_enough():
    follower = Follower()
    follower.not_supported()
    assert follower.next_request() == StatusRequest(2)


def test_settings_come_again_now_and_then():
    board = OldBoard()
    follower = following(board)
    asked = len(board.asked)
    run(follower, board, 40)
    forms = board.forms_asked(asked)
    assert set(forms) == {2, 3}
    assert forms.count(3) == 4


@pytest.mark.parametrize(("letter", "form"), [("P", 4), ("M", 4), ("S", 4), ("I", 2), ("B", 2)])
def test_job_is_asked_for_while_one_is_printed(letter, form):
    board = OldBoard()
    follower = following(board)
    board.set(status=letter)
    run(follower, board, 3)
    asked = len(board.asked)
    run(follower, board, 20)
    assert set(board.forms_asked(asked)) == {form, 3}


def test_firmware_with_s0_and_s1_alone_is_polled_by_them():
    board = OldBoard((0, 1))
    follower = following(board)
    asked = len(board.asked)
    run(follower, board, 20)
    assert set(board.forms_asked(asked)) == {0, 1}
    assert follower.store.model["move"]["axes"][0]["letter"] == "X"


def test_change_is_seen_with_the_next_status():
    board = OldBoard()
    follower = following(board)
    board.set(currentTool=0)
    run(follower, board)
    assert follower.store.model["state"]["currentTool"] == 0


def test_time_that_falls_is_a_reset():
    board = OldBoard()
    follower = following(board)
    board.set(time=3.0)
    run(follower, board, 2)
    assert follower.resets == 1
    assert follower.store.model == {}
    assert not follower.ready
    run(follower, board, 12)
    assert follower.ready
    assert follower.store.model["state"]["upTime"] == 3
    assert follower.protocol == "M408"


def test_nothing_known_alternates_and_recovers():
    follower, silent = Follower(), OldBoard(())
    asked = set()
    for _ in range(60):
        asked.add(type(follower.next_request()))
        run(follower, silent)
    assert asked == {ModelRequest, StatusRequest}
    assert follower.protocol is None
    board = OldBoard()
    run(follower, board, 40)
    assert (follower.ready, follower.protocol) == (True, "M408")


@pytest.mark.parametrize("refuse", [True, False], ids=["refused", "silent"])
@pytest.mark.parametrize("before", range(0, 50, 7))
def test_board_with_m409_is_found_however_late(before, refuse):
    follower = Follower()
    run(follower, OldBoard(()), before, refuse)
    board = Board()
    run(follower, board, 70, refuse)
    assert (follower.ready, follower.protocol) == (True, "M409")
    assert follower.store.model == board.model


def test_m409_has_its_three_times_in_each_turn():
    follower = Follower()
    kinds = []
    for _ in range(60):
        kinds.append("M" if isinstance(follower.next_request(), ModelRequest) else "S")
        follower.timed_out()
    turns = [turn for turn in "".join(kinds).split("S") if turn]
    assert turns[0] == turns[1] == "M" * NOT_SUPPORTED_AFTER


def test_refetch_asks_each_form_again_and_stays_ready():
    board = OldBoard()
    follower = following(board)
    asked = len(board.asked)
    follower.refetch()
    assert follower.behind
    assert follower.ready, "everything was fetched once since the connection"
    run(follower, board, 6)
    assert set(board.forms_asked(asked)) == set(range(6))
    assert not follower.behind


def test_refetch_while_a_request_is_under_way_takes_its_answer_for_what_it_is():
    board = OldBoard()
    follower = following(board)
    request = follower.next_request()
    follower.refetch()
    assert follower.next_request() == request
    follower.take(board.reply(request))
    asked = len(board.asked)
    run(follower, board, 6)
    assert set(board.forms_asked(asked)) == set(range(6))


def test_refetch_asks_only_forms_that_the_firmware_has():
    board = OldBoard(forms=(0, 1))
    follower = following(board)
    asked = len(board.asked)
    follower.refetch()
    run(follower, board, 6)
    assert set(board.forms_asked(asked)) == {0, 1}


@pytest.mark.parametrize("after", range(6))
def test_refetch_before_all_forms_were_tried_leaves_none_out(after):
    board, follower = OldBoard(), Follower()
    follower.not_supported()
    run(follower, board, after)
    follower.refetch()
    run(follower, board, 12)
    assert {request.form for request in board.asked} == set(range(6))
    assert follower.ready


def test_silence_during_a_refetch_does_not_lose_the_board():
    """Forms that were answered are known, whatever happens to their later answers."""
    board = OldBoard()
    follower = following(board)
    follower.refetch()
    for _ in range(40):
        follower.timed_out()
    board.set(currentTool=0)
    run(follower, board, 20)
    assert (follower.ready, follower.protocol) == (True, "M408")
    assert follower.store.model["state"]["currentTool"] == 0


def test_silence_after_a_reset_does_not_lose_the_board():
    board = OldBoard()
    follower = following(board)
    board.set(time=3.0)
    run(follower, board, 2)
    assert follower.resets == 1
    for _ in range(40):
        follower.timed_out()
    run(follower, board, 60)
    assert (follower.ready, follower.protocol) == (True, "M408")


def test_malformed_replies_to_every_form_do_not_lose_the_board():
    follower = Follower()
    follower.not_supported()
    for _ in range(30):
        if isinstance(follower.next_request(), StatusRequest):
            with pytest.raises(MalformedReply):
                follower.take('{"status":"I",,}')
        else:
            follower.not_supported()
    run(follower, OldBoard(), 60)
    assert (follower.ready, follower.protocol) == (True, "M408")


def test_lost_reply_to_a_form_is_asked_for_once_more():
    board, follower = OldBoard(), Follower()
    follower.not_supported()
    while follower.behind:
        follower.timed_out()
        run(follower, board)
    assert {request.form for request in board.asked} == set(range(6))


def test_late_answer_shows_that_m409_is_known():
    """A board that was busy for long answers afterwards; it must not stay with M408."""
    board, follower = Board(), Follower()
    late = board.reply(follower.next_request())
    for _ in range(NOT_SUPPORTED_AFTER):
        follower.timed_out()
    assert isinstance(follower.next_request(), StatusRequest)
    follower.take(late)
    serve(follower, board, 40)
    assert (follower.ready, follower.protocol) == (True, "M409")
    assert follower.store.model == board.model


def test_m409_reply_of_whatever_key_shows_that_it_is_known():
    old, follower = OldBoard(), Follower()
    follower.not_supported()
    run(follower, old, 3)
    follower.take(model_reply({"x": 1}, key="global", flags=""))
    assert follower.next_request() == ModelRequest("seqs", LIVE_FLAGS)
    board = Board()
    serve(follower, board, 40)
    assert follower.protocol == "M409"
    assert follower.store.model == board.model, "nothing of M408 is left"


FILE = {
    "err": 0,
    "size": 2000,
    "height": 5.0,
    "filament": [12.5],
    "generatedBy": "slicer",
    "printDuration": 10,
    "fileName": "0:/gcodes/a.gcode",
}
"""An answer to M36 without a name, as firmware 2.05 gives it."""


def printing(forms=FORMS, file=FILE, **members):
    board = OldBoard(forms, file)
    follower = following(board)
    board.set(status="P", **members)
    run(follower, board, 3)
    return board, follower


def job_of(follower):
    return follower.store.model.get("job", {})


def file_name(follower):
    return job_of(follower).get("file", {}).get("fileName")


def test_row_24_file_being_printed_is_asked_for_and_has_its_place():
    board, follower = printing(fractionPrinted=25.0, printDuration=10.0)
    file = job_of(follower)["file"]
    assert file == {
        "fileName": "0:/gcodes/a.gcode",
        "size": 2000,
        "height": 5.0,
        "filament": [12.5],
        "generatedBy": "slicer",
    }
    assert job_of(follower)["filePosition"] == 500
    assert card_job(follower.store.model) == ("processing", "0:/gcodes/a.gcode", 2000, 500)


def test_row_24_position_that_is_told_comes_first():
    _, follower = printing(fractionPrinted=25.0, filePosition=480)
    assert job_of(follower)["filePosition"] == 480


@pytest.mark.parametrize("forms", [(0, 1), (0,)])
def test_row_24_share_of_s0_gives_the_position(forms):
    board, follower = printing(forms, fraction_printed=0.5)
    assert card_job(follower.store.model) == ("processing", "0:/gcodes/a.gcode", 2000, 1000)
    board.set(status="I")
    for form in forms:
        del board.replies[form]["fraction_printed"]
    run(follower, board)
    assert file_name(follower) is None
    assert "filePosition" not in job_of(follower)
    assert progress(follower.store.model) is None


def test_row_24_name_without_a_folder_is_one_of_the_g_codes():
    _, follower = printing(file={**FILE, "fileName": "a.gcode"})
    assert file_name(follower) == "0:/gcodes/a.gcode"


def test_row_24_file_is_gone_with_its_job():
    board, follower = printing()
    board.set(status="I")
    run(follower, board)
    assert file_name(follower) is None
    asked = len(board.asked)
    run(follower, board, 30)
    assert JobFileRequest() not in board.asked[asked:]


def test_row_24_next_job_never_has_the_name_of_the_one_before():
    board, follower = printing(printDuration=90.0)
    board.set(printDuration=2.0)
    board.file = {**FILE, "fileName": "0:/gcodes/b.gcode"}
    run(follower, board)
    assert file_name(follower) is None
    run(follower, board)
    assert file_name(follower) == "0:/gcodes/b.gcode"


def test_row_24_another_file_is_noticed_however_it_came():
    board, follower = printing()
    board.file = {**FILE, "fileName": "0:/gcodes/b.gcode"}
    run(follower, board, FILE_EVERY + 2)
    assert file_name(follower) == "0:/gcodes/b.gcode"


def test_row_24_board_that_tells_no_file_is_not_asked_for_ever():
    board, follower = printing(file=None)
    asked = len(board.asked)
    run(follower, board, 60)
    assert board.asked[asked:].count(JobFileRequest()) <= 2
    assert (follower.protocol, follower.ready) == ("M408", True)
    board.set(status="I")
    run(follower, board)
    board.set(status="P")
    board.file = FILE
    run(follower, board, 3)
    assert file_name(follower) == "0:/gcodes/a.gcode"


def test_row_24_no_file_yet_is_asked_again():
    board, follower = printing(file={"err": 1})
    assert file_name(follower) is None
    board.file = FILE
    run(follower, board, FILE_EVERY + 2)
    assert file_name(follower) == "0:/gcodes/a.gcode"


@pytest.mark.parametrize("odd", [None, [], {}, "x", -1, 1e300, True])
def test_row_24_members_that_make_no_sense_are_left_out(odd):
    _, follower = printing(file={**FILE, "size": odd, "height": odd, "filament": [odd]})
    assert "size" not in job_of(follower)["file"]
    assert file_name(follower) == "0:/gcodes/a.gcode"
