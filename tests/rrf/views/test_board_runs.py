"""What the board has run from its card: one entry each, whatever happens meanwhile."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.views.board_runs import BoardRuns
from octoprint_rrfmodel.rrf.views.past_job import MOST, PastJob, PastJobs, read, read_all, written

from ..strategies import ANY_JSON

FILE = "0:/gcodes/a.gcode"
OTHER = "0:/gcodes/b.gcode"
FINISHED = f"Finished printing file {FILE}, print time was 0h 5m"
CANCELLED = f"Cancelled printing file {FILE}, print time was 0h 5m"
SIMULATED = f"File {FILE} will print in 0h 2m plus heating time"
IDLE = {"state": {"status": "idle", "upTime": 100}, "job": {"duration": None}}


def job(duration, position=10, status="processing", path=FILE, paused=0, **state):
    return {
        "state": {"status": status, "upTime": 100, **state},
        "job": {
            "file": {"fileName": path, "size": 100},
            "duration": duration,
            "pauseDuration": paused,
            "filePosition": position,
        },
    }


def idle(last=None, duration=None, **state):
    return {
        "state": {"status": "idle", "upTime": 100, **state},
        "job": {"duration": None, "lastFileName": last, "lastDuration": duration},
    }


AWAY = object()


def ended(*models, runs=None, now=1000.0):
    """Return what has ended after models a second apart; texts are lines, numbers are seconds."""
    runs, past = runs or BoardRuns(), PastJobs()
    for model in models:
        if isinstance(model, str):
            runs.heard(model)
        elif isinstance(model, float):
            now += model
        elif model is AWAY:
            runs.away()
        else:
            for found in runs.look(model, now):
                past.add(found)
            now += 1.0
    return past.latest()


def outcomes(*models, **options):
    return [(each.path, each.outcome, each.duration) for each in ended(*models, **options)]


@pytest.mark.parametrize(
    "models, outcome",
    [
        ((IDLE, job(5), job(50, 99), FINISHED, IDLE), "finished"),
        ((IDLE, job(5), job(50, 50), CANCELLED, IDLE), "cancelled"),
        # as far as can be seen, where no line said it
        ((IDLE, job(5), job(50, 100), IDLE), "finished"),
        ((IDLE, job(5), job(50, 50, "cancelling"), IDLE), "cancelled"),
        ((IDLE, job(5), job(50, 50, "paused"), IDLE), "cancelled"),
        ((IDLE, job(5), job(50, 50), idle(status="halted")), "aborted"),
        ((IDLE, job(5), job(50, 50), {}, idle(upTime=3)), "aborted"),
        # nobody knows
        ((IDLE, job(5), job(50, 50), AWAY, 600.0, IDLE), None),
    ],
)
def test_how_a_print_has_ended(models, outcome):
    assert outcomes(*models) == [(FILE, outcome, 50.0)]


def test_a_lost_connection_makes_no_second_entry():
    told = ended(IDLE, job(5), AWAY, 300.0, job(306), job(310, 100), FINISHED, IDLE)
    assert [(each.began, each.ended) for each in told] == [(996.0, 1304.0)]


def test_another_print_of_the_same_file_is_another_entry():
    models = job(5), job(50, 100), FINISHED, IDLE, job(1), job(20, 100), FINISHED, IDLE
    assert outcomes(IDLE, *models) == [(FILE, "finished", 20.0), (FILE, "finished", 50.0)]


def test_the_next_one_begins_between_two_models():
    over = CANCELLED.replace(FILE, OTHER)
    told = outcomes(IDLE, job(50, 100), FINISHED, job(1, path=OTHER), over, IDLE)
    assert told == [(OTHER, "cancelled", 1.0), (FILE, "finished", 50.0)]


def test_the_file_is_told_later_than_the_status():
    early = {"state": {"status": "processing"}}
    (told,) = ended(early, job(60, paused=40), job(61), FINISHED, IDLE)
    assert (told.path, told.began) == (FILE, 901.0)


def test_the_duration_is_the_boards_own():
    models = IDLE, job(5), job(48, 100), FINISHED, idle("0:/gcodes/old.gcode", 900)
    assert outcomes(*models, idle(FILE, 51)) == [(FILE, "finished", 51.0)]
    # of a cancelled one it says 0
    models = IDLE, job(5), job(48, 30), CANCELLED, idle(FILE, 0)
    assert outcomes(*models) == [(FILE, "cancelled", 48.0)]


def test_a_simulation_and_its_result():
    simulated = job(80, 50, "simulating")
    told = outcomes(IDLE, simulated, job(90, 60, "paused"), simulated, SIMULATED, idle(FILE, 130))
    assert told == [(FILE, "simulated", 130.0)]
    assert outcomes(IDLE, simulated, CANCELLED, IDLE) == [(FILE, "cancelled", 80.0)]
    assert outcomes(IDLE, simulated, job(90, 60, "paused"), IDLE) == [(FILE, "cancelled", 90.0)]
    # and a print behind one
    told = outcomes(IDLE, simulated, SIMULATED, idle(FILE, 130), job(3), job(9, 100), IDLE)
    assert told == [(FILE, "finished", 9.0), (FILE, "simulated", 130.0)]


def resumed(*models, began=400.0, now=1000.0):
    runs = BoardRuns()
    runs.resume(PastJob("card", FILE, began))
    return ended(*models, runs=runs, now=now)


def test_a_restart_in_the_middle_of_a_print_makes_no_second_entry():
    first = {"state": {"status": "processing", "upTime": 5}}
    (told,) = resumed(first, job(560, paused=50), job(580, 100), FINISHED, IDLE)
    assert (told.began, told.outcome, told.duration) == (400.0, "finished", 580.0)


def test_a_print_that_ended_while_the_plugin_was_away():
    (told,) = resumed({"state": {"status": "idle"}}, idle(FILE, 555))
    assert (told.began, told.ended, told.outcome, told.duration) == (400.0, None, None, 555.0)
    # and another of the same file has begun since
    told = resumed(job(20), CANCELLED, IDLE)
    assert [(each.began, each.outcome) for each in told] == [(980.0, "cancelled"), (400.0, None)]


def test_a_print_of_which_M408_tells_is_resumed():
    told = resumed({"state": {"status": "idle"}, "m408": {"seq": 1}})
    assert [each.outcome for each in told] == [None]


def test_the_last_hundred_are_kept():
    past = PastJobs()
    for number in range(MOST + 5):
        past.add(PastJob("octoprint", "x.gcode", float(number)))
    assert [each.began for each in past.all()][:1] == [5.0]
    assert len(past.latest()) == MOST
    assert past.latest()[0].began == MOST + 4


def test_what_is_written_can_be_read():
    known = PastJob("card", FILE, 1.0, 2.0, "finished", 3.0)
    assert read(written(known)) == known
    assert known.name == "a.gcode"
    assert PastJob("octoprint", "folder/a.gcode", 1.0).name == "folder/a.gcode"


@given(ANY_JSON)
def test_nonsense_is_read_as_nothing(told):
    assert all(isinstance(job, PastJob) for job in read_all(told))
    assert read(told) is None or isinstance(told, dict)


@given(st.lists(ANY_JSON))
def test_no_model_is_too_odd(models):
    runs = BoardRuns()
    for model in models:
        if isinstance(model, dict):
            assert all(isinstance(job, PastJob) for job in runs.look(model, 1.0))
