"""Past prints in Moonraker's members."""

import pytest

from octoprint_rrfmodel.rrf.klipper import past_jobs
from octoprint_rrfmodel.rrf.views.past_job import (
    ABORTED,
    CANCELLED,
    CARD,
    FINISHED,
    OCTOPRINT,
    SIMULATED,
    PastJob,
)

SENT = PastJob(OCTOPRINT, "dir/a.gcode", 1000.0, 1500.0, FINISHED, 400.0)
PRINTED = PastJob(CARD, "0:/gcodes/b.gcode", 2000.0, 2600.0, CANCELLED, 500.0)


def told(job, is_over=True):
    return past_jobs.told(job, is_over, {}, exists=False)


@pytest.mark.parametrize(
    "outcome, status",
    [
        (FINISHED, "completed"),
        (SIMULATED, "completed"),
        (CANCELLED, "cancelled"),
        (ABORTED, "error"),
        (None, "interrupted"),
    ],
)
def test_how_a_print_has_ended(outcome, status):
    assert told(SENT._replace(outcome=outcome))["status"] == status
    assert told(SENT._replace(outcome=outcome), is_over=False)["status"] == "in_progress"


def test_times_and_names():
    first, second = told(SENT), told(PRINTED)
    assert (first["filename"], second["filename"]) == ("dir/a.gcode", "printer/b.gcode")
    assert (first["print_duration"], first["total_duration"]) == (400.0, 500.0)
    unseen = told(SENT._replace(ended=None, duration=None))
    assert (unseen["end_time"], unseen["print_duration"], unseen["total_duration"]) == (None, 0, 0)
    # a simulation is no print that took the time
    assert told(SENT._replace(outcome=SIMULATED))["total_duration"] == 400.0


def test_each_print_has_a_number_of_its_own():
    jobs = [SENT, PRINTED, SENT._replace(began=1000.5), SENT._replace(source=CARD)]
    assert len({past_jobs.job_id(job) for job in jobs}) == len(jobs)
    # what was learnt later doesn't change it
    assert past_jobs.job_id(SENT._replace(ended=3.0, outcome=None)) == past_jobs.job_id(SENT)


def test_totals():
    assert past_jobs.totals([told(SENT), told(PRINTED)]) == {
        "total_jobs": 2,
        "total_time": 1100.0,
        "total_print_time": 900.0,
        "total_filament_used": 0.0,
        "longest_job": 600.0,
        "longest_print": 500.0,
    }
    assert past_jobs.totals([])["longest_job"] == 0
