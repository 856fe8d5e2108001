"""The sub-view Job without a print: the card's files with pictures, and the last jobs."""

import re

import pytest
from playwright.sync_api import expect

from . import SECONDS, board_value, own_errors, part, show_view
from .test_job import confirm, end_job, printed, reach_its_end

BOARD = {"machine": "cartesian"}


def prepare(board):
    board.card.write("0:/gcodes/parts/clip.gcode", printed(4))
    board.card.write("0:/gcodes/parts/plain.gcode", "G4 S1\n" * 60)


@pytest.fixture
def view(page, server, board):
    end_job(server, board)
    yield show_view(page, "job")
    end_job(server, board)


def entry(view, name):
    return part(view, "card-entry").filter(has_text=name)


def open_parts(view):
    view.get_by_role("button", name="parts", exact=True).click()
    expect(part(view, "card-folder")).to_have_text("parts")


def test_a_file_of_a_folder_is_printed_and_remembered(page, view, server, board, page_errors):
    open_parts(view)
    expect(part(view, "card-name")).to_have_text(["clip.gcode", "plain.gcode"])
    clip = entry(view, "clip.gcode")
    expect(part(clip, "card-picture")).to_be_visible()
    part(clip, "card-print").click()
    # nothing happens until it was confirmed
    expect(page.locator(".modal.in .modal-body")).to_contain_text("clip.gcode")
    assert not board.board.job.is_running
    confirm(page)
    server.wait_for(lambda: board.board.job.is_running, SECONDS, "the job to begin")
    assert board.board.job.path == "0:/gcodes/parts/clip.gcode"
    expect(part(view, "card")).to_have_count(0)
    reach_its_end(server, board)
    past = part(view, "past-job").first
    expect(part(past, "past-name")).to_have_text("parts/clip.gcode")
    expect(part(past, "past-outcome")).to_have_text("finished")
    expect(part(past, "past-duration")).to_have_text(re.compile(r"0:00:1\d"))
    part(past, "past-again").click()
    confirm(page)
    server.wait_for(lambda: board.board.job.is_running, SECONDS, "the job to begin again")
    assert own_errors(page_errors) == []


def test_the_result_of_a_simulation(view, server, board):
    open_parts(view)
    part(entry(view, "clip.gcode"), "card-simulate").click()
    server.wait_for(lambda: board.board.job.is_simulation, SECONDS, "the simulation")
    past = part(view, "past-job").first
    expect(part(past, "past-outcome")).to_have_text("simulated")
    minutes, seconds = divmod(board_value(board, "job.lastDuration"), 60)
    text = f"0:{minutes:02}:{seconds:02}"
    expect(part(past, "past-duration")).to_have_text(text)


def test_back_to_the_folder_above(view):
    open_parts(view)
    part(view, "card-up").click()
    expect(entry(view, "square.gcode")).to_be_visible()
    expect(part(view, "card-up")).to_be_hidden()


MANY = """(jobs) => {
    OctoPrint.plugins.rrfmodel.getJobs = () => $.Deferred().resolve({jobs: jobs});
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    core.fromStatus(Object.assign({}, core.status(), {jobs: 1_000_000}));
}"""


def test_the_last_five_jobs_and_all(page, view):
    job = {"path": "clip.gcode", "source": "card", "outcome": "finished", "began": 1, "duration": 9}
    kept = page.evaluate_handle("() => OctoPrint.plugins.rrfmodel.getJobs")
    page.evaluate(MANY, [{**job, "name": f"{number}.gcode"} for number in range(7)])
    expect(part(view, "past-job")).to_have_count(5)
    part(view, "past-all").click()
    expect(part(view, "past-job")).to_have_count(7)
    expect(part(view, "past-all")).to_be_hidden()
    page.evaluate("(kept) => { OctoPrint.plugins.rrfmodel.getJobs = kept; }", kept)


def test_who_may_only_look_begins_nothing(reader_page, server, board):
    end_job(server, board)
    view = show_view(reader_page, "job")
    expect(part(view, "card-print").first).to_be_disabled()
    expect(part(view, "card-simulate").first).to_be_disabled()
