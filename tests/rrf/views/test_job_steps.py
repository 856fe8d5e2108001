"""The board's job as a host's own: what is done between models made by hand."""

import pytest

from octoprint_rrfmodel.rrf.views.job_steps import JobSteps


def model(status, name="0:/gcodes/a.g", position=50, duration=10):
    job = {"file": {"fileName": name, "size": 100}, "filePosition": position, "duration": duration}
    return {"state": {"status": status, "upTime": 100}, "job": job if name else {}}


IDLE = model("idle", "")


def done_about(*told, steps=None):
    """Return states and calls as words in their order; strings with blanks are lines."""
    steps = steps or JobSteps()
    found = []
    for number, each in enumerate(told):
        if isinstance(each, str):
            steps.heard(each)
            continue
        found += [step.state or step.call for step in steps.look(each, float(number))]
    return found


def test_job_begun_at_the_machine_is_selected_and_begins_with_its_file():
    begun = done_about(IDLE, model("processing", ""), model("processing"))
    assert begun == ["select", "STARTING", "started", "PRINTING"]
    steps = JobSteps()
    assert steps.look(model("processing"), 0.0)[0].path == "0:/gcodes/a.g"
    assert steps.state == "PRINTING"


def test_job_that_was_paused_before_is_so():
    assert done_about(model("paused"))[2:] == ["started", "PRINTING", "PAUSED", "paused"]


def test_job_of_the_hosts_begins_without_being_told_twice():
    steps = JobSteps()
    steps.starts("0:/gcodes/a.g", 0.0)
    assert done_about(IDLE, model("processing"), steps=steps) == ["PRINTING"]


def test_pause_and_resume():
    told = [model(word) for word in ("processing", "pausing", "paused", "resuming", "processing")]
    assert done_about(*told)[4:] == [
        *("PAUSING", "PAUSED", "paused", "RESUMING", "PRINTING", "resumed"),
    ]


CANCELLED = ["cancelled", "OPERATIONAL"]
DONE = ["FINISHING", "done", "OPERATIONAL"]


@pytest.mark.parametrize(
    ("told", "end"),
    [
        ((model("processing", position=100),), DONE),
        ((model("processing"), "Finished printing file 0:/gcodes/a.g, print time was 0h 1m"), DONE),
        ((model("processing"), "Cancelled printing file 0:/gcodes/a.g, print time"), CANCELLED),
        ((model("cancelling", position=100),), CANCELLED),
        ((model("paused"),), CANCELLED),
        ((model("processing", position=10),), CANCELLED),
    ],
)
def test_end_of_a_job(told, end):
    found = done_about(model("processing"), *told, *[IDLE] * 6)
    assert found[-len(end) :] == end


def test_how_a_job_has_ended_is_said_after_it_is_gone():
    """The last lines of a file may take their time, and the model knows no end."""
    line = "Finished printing file 0:/gcodes/a.g, print time was 0h 1m"
    begun = model("processing", position=10)
    assert done_about(begun, IDLE)[4:] == []
    assert done_about(begun, IDLE, line, IDLE)[4:] == DONE
    assert done_about(begun, IDLE, line.replace("Finished", "Cancelled"), IDLE)[4:] == CANCELLED


def test_reset_ends_a_job():
    steps = JobSteps()
    done_about(model("processing"), steps=steps)
    again = {"state": {"status": "idle", "upTime": 1}}
    assert done_about({}, again, steps=steps) == CANCELLED
    assert done_about(IDLE, steps=steps) == []


def test_what_says_nothing_of_a_job_ends_none():
    """Without power, and while nothing is known, the job may go on."""
    steps = JobSteps()
    done_about(model("processing"), steps=steps)
    assert done_about(model("off"), {}, model("processing"), steps=steps) == []


def test_next_job_between_two_models():
    steps = JobSteps()
    done_about(model("processing"), "Finished printing file 0:/gcodes/a.g", steps=steps)
    following = done_about(model("processing", "0:/gcodes/b.g", duration=1), steps=steps)
    assert following == [*DONE, "select", "STARTING", "started", "PRINTING"]


def test_cancelling_is_shown_until_the_job_is_gone():
    steps = JobSteps()
    done_about(model("processing"), steps=steps)
    steps.ends(0.0)
    assert done_about(model("processing"), model("pausing"), steps=steps) == []
    # the pause was put off, and M0 came too early
    assert done_about(model("paused"), steps=steps) == ["end_again"]
    assert done_about(model("cancelling"), IDLE, steps=steps) == CANCELLED
    assert steps.state == "OPERATIONAL"


def test_job_that_was_over_before_anybody_saw_it():
    steps = JobSteps()
    done_about(IDLE, steps=steps)
    steps.starts("0:/gcodes/a.g", 0.0)
    line = "Finished printing file 0:/gcodes/a.g, print time was 0h 0m"
    assert done_about(IDLE, line, IDLE, steps=steps) == ["PRINTING", *DONE]


def test_job_that_the_board_does_not_begin_is_given_up():
    steps = JobSteps()
    steps.starts("0:/gcodes/a.g", 0.0)
    assert steps.look(IDLE, 29.0) == []
    assert [step.call or step.state for step in steps.look(IDLE, 31.0)] == CANCELLED


def test_job_that_is_not_ended_is_shown_as_going_on():
    steps = JobSteps()
    done_about(model("processing"), steps=steps)
    steps.ends(0.0)
    assert steps.look(model("processing"), 59.0) == []
    assert [step.state for step in steps.look(model("processing"), 61.0)] == ["PRINTING"]


def test_line_about_the_job_before_does_not_end_the_next():
    late = "Cancelled printing file 0:/gcodes/old.g, print time was 0h 1m"
    steps = JobSteps()
    done_about(model("processing", "0:/gcodes/old.g"), steps=steps)
    steps.ends(0.0)
    assert done_about(IDLE, steps=steps) == CANCELLED
    steps.starts("0:/gcodes/a.g", 0.0)
    assert done_about(late, IDLE, model("processing"), steps=steps) == ["PRINTING"]
    assert done_about(late, model("processing", position=100), *[IDLE] * 6, steps=steps) == DONE


def test_file_of_the_job_before_is_not_taken_for_that_of_the_next():
    """The status comes with each reply, the file only when it is asked for anew."""
    old = model("processing", "0:/gcodes/old.g")
    steps = JobSteps()
    done_about(old, "Finished printing file 0:/gcodes/old.g", IDLE, steps=steps)
    begun = model("processing", "0:/gcodes/old.g", duration=0)
    steps.look(IDLE, 10.0)
    assert steps.state == "OPERATIONAL"
    assert steps.look(begun, 3.0) == []
    step = steps.look(model("processing", "0:/gcodes/b.g", duration=0), 4.0)[0]
    assert (step.call, step.path) == ("select", "0:/gcodes/b.g")


def test_same_file_again_is_begun_a_little_later():
    old = model("processing")
    steps = JobSteps()
    done_about(old, "Finished printing file 0:/gcodes/a.g", IDLE, steps=steps)
    assert steps.look(old, 3.0) == []
    assert [step.call for step in steps.look(old, 60.0)][:1] == ["select"]
