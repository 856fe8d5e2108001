"""Prints that the board runs by itself, as OctoPrint's own."""

import pytest

from .. import helpers
from . import bench

BOARD = {"machine": "cartesian", "speed": 10}

SHORT = "G28\nG1 X20 F6000\n" + "G4 S20\n" * 6 + "G1 X30\n"


def prepare(board):
    board.card.write("0:/gcodes/long.gcode", bench.LONG)
    board.card.write("0:/gcodes/parts/short.gcode", SHORT)


@pytest.fixture(autouse=True)
def _at_rest(without_print):
    """Each test leaves no print behind."""


def wait_board_status(server, face, *wanted, seconds=20):
    server.wait_for(
        lambda: bench.board_value(face, "state.status") in wanted,
        seconds,
        f"the board to be {wanted}",
    )


def test_job_begun_at_the_machine_is_octoprints(server, face):
    bench.at_panel(face, 'M32 "0:/gcodes/long.gcode"')
    server.wait_state("Printing", 20)
    assert bench.job_state(server) == ("Printing", ("printer", "long.gcode"))
    server.wait_for(
        lambda: (server.job()["progress"]["completion"] or 0) > 0, 20, "the print's progress"
    )
    bench.at_panel(face, "M25")
    server.wait_state("Paused", 20)
    bench.at_panel(face, "M24")
    server.wait_state("Printing", 20)
    bench.at_panel(face, "M25")
    server.wait_state("Paused", 20)
    bench.at_panel(face, "M0")
    server.wait_state("Operational", 20)


def test_job_is_paused_resumed_and_cancelled_by_octoprint(server, face):
    bench.at_panel(face, 'M32 "0:/gcodes/long.gcode"')
    server.wait_state("Printing", 20)
    server.post("/api/job", json={"command": "pause", "action": "pause"})
    wait_board_status(server, face, "paused")
    server.wait_state("Paused", 20)
    server.post("/api/job", json={"command": "pause", "action": "resume"})
    wait_board_status(server, face, "processing")
    server.wait_state("Printing", 20)
    server.post("/api/job", json={"command": "cancel"})
    wait_board_status(server, face, "idle", "off")
    server.wait_state("Operational", 20)
    assert bench.board_value(face, "job.lastFileName") == "0:/gcodes/long.gcode"


def test_file_of_the_card_is_printed_to_its_end(server, face):
    def is_listed():
        return server.get("/api/files/printer/parts/short.gcode").status_code == 200

    server.wait_for(is_listed, 20, "the file to be listed")
    response = server.post(
        "/api/files/printer/parts/short.gcode", json={"command": "select", "print": True}
    )
    assert response.status_code == 204, response.text
    server.wait_state("Printing", 20)
    assert bench.job_state(server)[1] == ("printer", "parts/short.gcode")
    server.wait_state("Operational", 30)
    assert server.job()["progress"]["completion"] == 100


def test_file_of_octoprints_own_is_brought_and_printed(server, face):
    server.upload("mine.gcode", SHORT)
    server.select_and_print("mine.gcode")
    server.wait_state("Printing", 30)
    assert bench.job_state(server)[1] == ("local", "mine.gcode")
    assert face.board.card.read("0:/gcodes/OctoPrint/mine.gcode").decode() == SHORT
    server.wait_state("Operational", 30)


def test_nothing_moves_beside_a_print(server, face):
    bench.at_panel(face, 'M32 "0:/gcodes/long.gcode"')
    server.wait_state("Printing", 20)
    jog = server.post("/api/printer/printhead", json={"command": "jog", "x": 10})
    assert jog.status_code == 409
    assert bench.command(server, "home").status_code == 409
    assert bench.command(server, "job", action="pause").status_code == 204
    server.wait_state("Paused", 20)
    assert bench.command(server, "job", action="cancel").status_code == 204
    server.wait_state("Operational", 20)


def test_print_goes_on_when_octoprint_disconnects(server, face):
    bench.at_panel(face, 'M32 "0:/gcodes/long.gcode"')
    server.wait_state("Printing", 20)
    server.disconnect()
    server.wait_disconnected()
    assert bench.board_value(face, "state.status") == "processing"
    bench.ask_to_connect(server, face.url)
    server.wait_state("Printing", 20)
    assert bench.job_state(server)[1] == ("printer", "long.gcode")
    helpers.wait_ready(server)
