"""The last jobs over HTTP: each once, whoever has run it, and over OctoPrint's restart."""

import pytest

from .. import helpers

PATH = "/plugin/rrfmodel/jobs"

# what others have printed would be among them
SERVER = {"own": True}
BOARD = {"machine": "cartesian", "speed": 5}

CARD = "0:/gcodes/card.gcode"
LINES = "".join(f"G4 P{400 + number % 2}\n" for number in range(200))


def jobs(server):
    response = server.get(PATH)
    assert response.status_code == 200, response.text
    return response.json()["jobs"]


def wait_jobs(server, *wanted):
    """Return the jobs once they are these, the last one first."""
    found = []

    def are_there():
        found[:] = jobs(server)
        return [(each["name"], each["source"], each["outcome"]) for each in found] == list(wanted)

    server.wait_for(are_there, 45, f"the jobs {wanted}; there were {found}")
    return found


SENT_CANCELLED = ("sent.gcode", "octoprint", "cancelled")
SENT = ("short.gcode", "octoprint", "finished")
PRINTED = ("card.gcode", "card", "finished")
CANCELLED = ("card.gcode", "card", "cancelled")


def begin(server, board):
    board.board.execute(f'M32 "{CARD}"', channel="http")
    helpers.wait_value(server, "job.file.fileName", CARD, 45)


@pytest.mark.both_hosts("each tells of its prints by events of its own")
def test_each_print_is_there_once(server, board):
    board.board.card.write(CARD, LINES)
    assert jobs(server) == []
    server.upload("sent.gcode", LINES)
    server.select_and_print("sent.gcode")
    server.wait_state("Printing")
    server.post("/api/job", json={"command": "cancel"})
    (sent,) = wait_jobs(server, SENT_CANCELLED)
    assert sent["began"] < sent["ended"]
    server.wait_state("Operational")
    server.upload("short.gcode", "G4 P100\n" * 5)
    server.select_and_print("short.gcode")
    wait_jobs(server, SENT, SENT_CANCELLED)
    server.wait_state("Operational")
    begin(server, board)
    board.board.speed = 60
    last, *_ = wait_jobs(server, PRINTED, SENT, SENT_CANCELLED)
    assert last["path"] == CARD
    duration = helpers.wait_value(server, "job.lastDuration", lambda told: told, 45)
    server.wait_for(lambda: jobs(server)[0]["duration"] == duration, 45, "the board's own duration")
    board.board.speed = 5


def test_a_restart_in_the_middle_of_a_print(server, board):
    before = [(each["name"], each["source"], each["outcome"]) for each in jobs(server)]
    # as long as a server takes to start on a busy machine
    board.board.card.write(CARD, LINES * 20)
    board.board.speed = 1
    begin(server, board)
    began_at = board.board.job.progress.duration
    server.restart()
    helpers.connect(server, board)
    helpers.wait_value(server, "state.status", "processing", 45)
    assert board.board.job.progress.duration > began_at
    board.board.execute("M25", channel="http")
    helpers.wait_value(server, "state.status", "paused", 45)
    board.board.execute("M0", channel="http")
    last, *_ = wait_jobs(server, CANCELLED, *before)
    # since its beginning, and not since the restart
    assert last["ended"] - last["began"] >= last["duration"] - 5
