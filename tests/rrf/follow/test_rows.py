"""A slow line beside a print: small answers, little time, and the guard's needs first."""

import pytest

from octoprint_rrfmodel.rrf.follow.freshness import BOX
from octoprint_rrfmodel.rrf.follow.pace import IDLE_SHARE
from octoprint_rrfmodel.rrf.follow.parts import MOST_BYTES, parts_of
from octoprint_rrfmodel.rrf.wire.request import ModelRequest
from octoprint_rrfmodel.simulator import captured
from octoprint_rrfmodel.simulator.board import Board as SimulatedBoard
from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.machines import MACHINES
from octoprint_rrfmodel.web.audience import VIEWS

from ..board import Board
from ..independent import same
from ..slow_line import ACKNOWLEDGED, AIM, BYTES_A_SECOND, NUMBERED, SHARE, SlowLine

WATCHED_SECONDS = 100

TURN_SECONDS = 300
"""By then each part has had its turn, whoever looks at which."""


def streamed(model):
    return SlowLine(Board(model)).ready().spare()


@pytest.fixture(params=MACHINES)
def simulated(request):
    return SimulatedBoard(request.param).data


def exceeded(line):
    """Return what a print is promised and doesn't get, with the value that it has instead."""
    line.serve(20)
    started = line.now
    asked = line.serve(WATCHED_SECONDS)
    taken = sum(taken for *_, taken, _ in asked) / BYTES_A_SECOND
    is_open = line.follower.store.model["state"].get("messageBox") is not None
    measured = {
        "longest answer": (max(length for *_, length in asked), MOST_BYTES),
        "longest stop": (max(taken for *_, taken, _ in asked) / BYTES_A_SECOND, 0.04),
        "share": (taken / (line.now - started), SHARE),
    }
    assert line.rows.guarded
    for path in line.rows.guarded:
        # a box that is open is long, and waits for a person anyway
        limit = 6.0 if path == BOX and is_open else 2.0
        measured[f"age of {path}"] = line.oldest(path, asked), limit
    while not {key for _, key, *_ in line.asked} >= set(line.rows.paths):
        if line.now >= started + TURN_SECONDS:
            measured["seconds until each has had a turn"] = float("inf"), TURN_SECONDS
            break
        line.serve(10)
    return {name: value for name, (value, limit) in measured.items() if value > limit}


def test_a_print_on_each_machine_hardly_sees_it(simulated):
    assert exceeded(streamed(simulated)) == {}


def test_a_print_on_each_machine_hardly_sees_it_when_somebody_looks_at_all(simulated):
    line = streamed(simulated)
    line.interest.look("", seconds=3600)
    assert exceeded(line) == {}


def test_a_print_on_captured_machines_hardly_sees_it(shared_dir):
    checked = 0
    for path in sorted((shared_dir / "captures").glob("om*.json*")):
        try:
            model = captured.load(path)
        except captured.UnreadableModel:
            continue
        model = captured.completed(model, VERSIONS[captured.firmware_of(model)])
        assert exceeded(streamed(model)) == {}, path.name
        checked += 1
    assert checked >= 8


PANELDUE, DUET_WEB_CONTROL = "d99fp", "d99fno"
"""Flags with which others ask for the whole live root, twice and four times a second."""

SHOWN_SECONDS = 2.0
"""Age at which temperatures and positions are asked for while somebody looks at them."""

SCATTER_SECONDS = 0.4

MOST_OF_OTHERS = 0.5


@pytest.mark.parametrize("view", ["", "machine", "job", "chart"])
@pytest.mark.parametrize("prints", [False, True])
def test_at_most_half_the_bytes_of_other_plans_for_the_same_freshness(simulated, view, prints):
    line = SlowLine(Board(simulated)).ready()
    share, is_free = (AIM, False) if prints else (IDLE_SHARE, True)
    line.follower.spare(BYTES_A_SECOND, share, is_free)
    line.interest.look(*VIEWS[view], seconds=3600)
    line.serve(10)
    started = line.now
    asked = line.serve(60)
    ours = sum(taken for _, _, taken, _ in asked) / (line.now - started)
    for flags in (PANELDUE, DUET_WEB_CONTROL):
        request = ModelRequest("", flags)
        whole = len(line.board.reply(request)) + len(request.line) + NUMBERED + ACKNOWLEDGED
        assert ours <= MOST_OF_OTHERS * whole / SHOWN_SECONDS
    if is_free:
        for path in line.rows.paths:
            if path in ("heat.heaters[].current", "move.axes"):
                assert line.oldest(path, asked) <= SHOWN_SECONDS + SCATTER_SECONDS


def test_temperatures_that_a_line_tells_are_not_asked_for(simulated):
    line = streamed(simulated)
    if "heat.heaters[].current" not in parts_of("heat", "fin", simulated):
        return
    line.interest.look("heat", seconds=3600)
    line.serve(30)
    heaters = sum(heater is not None for heater in simulated["heat"]["heaters"])
    since = len(line.asked)
    for _ in range(30):
        line.rows.came("heat.heaters[].current", heaters)
        line.serve(1)
    assert "heat.heaters[].current" not in {key for _, key, *_ in line.asked[since:]}


def test_reports_of_some_heaters_do_not_stand_for_all():
    line = streamed(SimulatedBoard("toolchanger").data)
    line.serve(60)
    assert not line.rows.came("heat.heaters[].current", 1)


def test_a_fault_of_the_firmwares_own_words_brings_the_guards_parts_at_once(simulated):
    line = streamed(simulated)
    line.serve(30)
    line.rows.hurry()
    started, since = line.now, len(line.asked)
    while line.now < started + 0.5:
        line.take(line.ask()[1])
    assert {key for _, key, *_ in line.asked[since:]} >= set(line.rows.guarded)


def test_what_changed_that_decides_about_commands_is_known_soon(simulated):
    line = streamed(simulated)
    line.serve(60)
    for axis in range(3):
        line.board.set(f"move.axes[{axis}].homed", True)
    line.board.set("move.speedFactor", 0.5)
    since = len(line.asked)
    line.serve(40)
    move = line.follower.store.model["move"]
    assert move["speedFactor"] == 0.5
    assert all(axis["homed"] for axis in move["axes"][:3])
    assert max(length for *_, length in line.asked[since:]) <= MOST_BYTES
    # and all of the key when the print is over
    line.follower.spare(0, 1)
    line.ready()
    assert same(line.follower.store.model["move"]["axes"], line.board.model["move"]["axes"])


def test_list_that_got_longer_is_fetched_beside_the_guards_parts():
    line = streamed(SimulatedBoard("idex").data)
    line.serve(30)
    fans = line.board.model["fans"]
    line.board.set("fans", [*fans, fans[0]])
    # by then the guard has had its turns in between
    asked = line.serve(60)
    assert len(line.follower.store.model["fans"]) == len(fans) + 1
    for path in line.rows.guarded:
        assert line.oldest(path, asked) < 4.0


def test_doubted_part_is_asked_for_again_before_all_others():
    line = streamed(SimulatedBoard("idex").data)
    line.serve(30)
    line.board.set("heat.heaters[1].state", "fault")
    while not (taken := line.take(line.ask()[1])).is_doubted:
        pass
    doubted = line.asked[-1][1]
    again = line.take(line.ask()[1])
    assert line.asked[-1][1] == doubted
    assert not again.is_doubted
    assert line.follower.store.model["heat"]["heaters"][1]["state"] == "fault"
    assert taken is not again
