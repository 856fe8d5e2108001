"""What OctoPrint cuts or flattens in a file: told when it is selected, sent whole if possible."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each reads and cuts its files with its own code"),
    pytest.mark.slow,
    pytest.mark.timeout(300),
]

BOARD = {"machine": "cartesian", "firmware": "3.5.3"}

ODD = """; a file with "everything; in it
if true
  M118 P1 S"in a body"
M118 P1 S"one; two" ; said
G4 P1
M291 P"Wait; then go" R"Look" S3
G4 P2
M117 "open
M98 P"open
"""


def select(server, name):
    response = server.post(f"/api/files/local/{name}", json={"command": "select"})
    assert response.status_code == 204, response.text


def of_the_file(server):
    found = helpers.status(server)["warnings"]
    return {told["code"]: told for told in found if told["code"].startswith("file_")}


def resume(server):
    response = server.post("/api/job", json={"command": "pause", "action": "resume"})
    assert response.status_code == 204, response.text


def test_row_21_told_at_selection_and_sent_whole(server, board):
    server.upload("odd.gcode", ODD)
    server.upload("plain.gcode", 'G4 P1 ; "nothing;\nM117 if\n')
    with PushListener(server, ADMIN) as push:
        push.wait_for_plugin(bool)
        select(server, "odd.gcode")
        notice = push.wait_for_plugin(lambda found: found.get("code") == "file_checked", 10)
        told = of_the_file(server)
        lines = {code: warning["values"]["lines"] for code, warning in told.items()}
        assert lines == {"file_blocks": "2", "file_semicolons": "4, 6", "file_quotes": "8, 9"}
        for warning in told.values():
            assert warning["text"] in notice["text"]
        assert "M98" in told["file_blocks"]["text"]

        # the same file again is not looked through again, and not told again
        select(server, "plain.gcode")
        server.wait_for(lambda: not of_the_file(server), 10, "the end of the warnings")
        select(server, "odd.gcode")
        server.wait_for(lambda: of_the_file(server) == told, 10, "what is kept")

        server.select_and_print("odd.gcode")
        # the box that this firmware can't answer pauses, with all of its text
        server.wait_state("Paused", 20)
        sent = helpers.commands(board)
        assert 'M118 P1 S"one; two"' in sent
        assert "G4 P2" not in sent
        (paused,) = server.wait_for(
            lambda: [w for w in helpers.status(server)["warnings"] if w["code"] == "print_paused"],
            10,
            "why it is paused",
        )
        assert paused["values"]["message"] == "Wait; then go"
        resume(server)
        push.wait_for_event("PrintDone", 20)
        push.wait_for_plugin(lambda found: found.get("code") == "quotes")
    server.wait_state("Operational", 20)
    sent = helpers.commands(board)
    assert 'M117 "open"' in sent
    assert not any(text.startswith(("M98", "M291")) for text in sent)


def test_quotes_that_a_person_leaves_open(server, board):
    with PushListener(server, ADMIN) as push:
        push.wait_for_plugin(bool)
        server.commands('M118 P1 S"typed; in a hurry"', 'M98 P"typed', 'M118 P1 S"through"')
        push.wait_for_plugin(lambda found: found.get("code") == "quotes", 10)
        server.wait_for(
            lambda: 'M118 P1 S"through"' in helpers.commands(board), 10, "the line behind"
        )
    sent = helpers.commands(board)
    assert 'M118 P1 S"typed"' in sent
    assert 'M98 P"typed' not in sent
