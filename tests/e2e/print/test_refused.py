"""A line of a streamed file that the firmware refuses pauses the print, one of a person's not."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

pytestmark = [
    pytest.mark.both_hosts(
        "each streams and pauses with its own code", once_for=("lines", "code", "place", "command")
    ),
    pytest.mark.slow,
    pytest.mark.timeout(300),
]

PARKS = "G4 P7"
"""In OctoPrint's script for a pause: shows that it has run."""


@pytest.fixture(scope="module")
def server(module_server_factory):
    made = module_server_factory()
    made.set_setting("scripts", {"gcode": {"afterPrintPaused": PARKS}})
    return made


@pytest.fixture
def board(server, board_factory):
    made = board_factory(machine="cartesian", firmware="3.5.3", speed=4)
    helpers.connect(server, made)
    yield made
    if server.state().startswith(("Printing", "Paus", "Resum")):
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 40)
    helpers.disconnect(server)


def home(server):
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 30)


def resume(server):
    response = server.post("/api/job", json={"command": "pause", "action": "resume"})
    assert response.status_code == 204, response.text


def pause(server):
    """Return the warning that says why the print is paused."""
    found = helpers.status(server)["warnings"]
    return next((warning for warning in found if warning["code"] == "print_paused"), None)


def notices(push, code="print_paused"):
    return [found for found in push.of_plugin() if found.get("code") == code]


def moves(board):
    return [text for text in helpers.commands(board) if text.startswith("G1 ")]


def told(push, command):
    """Return the notice that a command was refused."""
    return push.wait_for_plugin(
        lambda found: found.get("code") == "refused" and command in found["detail"], 20
    )


MOVES = [f"G1 X{20 + number} Y20 F6000" for number in range(150)]


def print_until_paused(server, push, name, lines):
    server.upload(name, "\n".join(lines) + "\n")
    # from here on the login counts
    push.wait_for_plugin(bool)
    server.select_and_print(name)
    server.wait_state("Paused", 20)
    server.wait_for(lambda: pause(server), 5, "the warning")


def test_row_6_file_that_does_not_home(server, board):
    """Not one more line is lost; mended, the file goes through."""
    with PushListener(server, ADMIN) as push:
        print_until_paused(server, push, "unhomed.gcode", ["; a file", "M117 begins", *MOVES])
        assert moves(board) == MOVES[:1]
        told = pause(server)
        assert told["values"]["next"] == "mend"
        (cause,) = told["causes"]
        assert cause["code"] == "refused_move"
        assert f"3: {MOVES[0]}" in cause["text"]
        assert "insufficient axes homed" in cause["text"]
        assert told["text"].startswith("The print was paused.")
        assert PARKS in helpers.commands(board)
        home(server)
        resume(server)
        prints.wait_done(server, push, 60)
        assert push.count("PrintPaused", 1) == 1
        (notice,) = notices(push)
        assert MOVES[0] in notice["text"]
    assert moves(board) == MOVES
    assert pause(server) is None


def test_who_resumes_it_as_it_is_lets_it_go(server, board):
    with PushListener(server, ADMIN) as push:
        print_until_paused(server, push, "let-go.gcode", MOVES)
        resume(server)
        prints.wait_done(server, push, 60)
        assert push.count("PrintPaused", 1) == 1
        server.wait_for(lambda: notices(push), 10, "the notice")
        assert len(notices(push)) == 1
    # another print is another matter
    with PushListener(server, ADMIN) as push:
        print_until_paused(server, push, "let-go.gcode", MOVES)


@pytest.mark.parametrize(
    "lines, code, place",
    [
        pytest.param(
            ["T0", "M83", *(f"G1 X{n} E1 F3000" for n in range(20, 60)), "G4 P800"] * 20,
            "refused_extrusion",
            "E1",
            id="cold",
        ),
        pytest.param(["T0", "M104 S999", "G4 P500"], "refused_heating", "2: M104 S999", id="hot"),
        pytest.param(
            ["M83", *(f"G1 X{n} E1 F3000" for n in range(20, 60)), "G4 P800"] * 20,
            "refused_extrusion",
            "E1",
            id="no tool",
        ),
    ],
)
def test_other_kinds(server, board, lines, code, place):
    home(server)
    with PushListener(server, ADMIN) as push:
        print_until_paused(server, push, f"{code}.gcode", lines)
        (cause,) = pause(server)["causes"]
        assert cause["code"] == code
        assert place in cause["text"]
        assert push.count("PrintPaused", 1) == 1


def test_fault_that_is_no_commands(server, board):
    with PushListener(server, ADMIN) as push:
        server.upload("dwell.gcode", "\n".join(["G4 P50"] * 4000) + "\n")
        push.wait_for_plugin(bool)
        server.select_and_print("dwell.gcode")
        server.wait_for(lambda: helpers.commands(board).count("G4 P50") > 3, 20, "some lines")
        board.board.message("Error: VSSA fault, check thermistor wiring\n")
        server.wait_state("Paused", 20)
        server.wait_for(lambda: notices(push), 5, "the notice")
        assert "VSSA fault" in notices(push)[0]["text"]


def test_switching_off_what_is_not_there_spoils_nothing(server, board):
    lines = ["M141 S0", "M104 T7 S0", "M155 S2", "G4 P10"]
    server.upload("off.gcode", "\n".join(lines) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("off.gcode")
        prints.wait_done(server, push, 20)
        assert push.events("PrintPaused") == []


def test_each_can_be_switched_off(server, board):
    server.set_setting("plugins.rrfmodel.guard", {"refused_move": False})
    try:
        server.upload("free.gcode", "\n".join(MOVES) + "\n")
        with PushListener(server, ADMIN) as push:
            server.select_and_print("free.gcode")
            prints.wait_done(server, push, 60)
            assert push.events("PrintPaused") == []
    finally:
        server.set_setting("plugins.rrfmodel.guard", {"refused_move": True})


@pytest.mark.parametrize("command", ["M600", "M601", "M226", "M25"])
def test_row_6_pauses_of_a_file(server, board, command):
    lines = ["G4 P1", command, "G4 P2"]
    with PushListener(server, ADMIN) as push:
        print_until_paused(server, push, f"{command}.gcode", lines)
        sent = helpers.commands(board)
        assert "G4 P1" in sent
        assert "G4 P2" not in sent
        # OctoPrint's own script has run, and the firmware wasn't asked
        assert PARKS in sent
        assert command not in sent
        (cause,) = pause(server)["causes"]
        assert cause["code"] == ("file_filament" if command == "M600" else "file_pause")
        assert f"2: {command}" in cause["text"]
        resume(server)
        prints.wait_done(server, push, 20)
        assert push.count("PrintPaused", 1) == 1
    assert "G4 P2" in helpers.commands(board)


def test_what_a_person_sends_is_told_and_no_more(server, board):
    server.upload("dwell.gcode", "\n".join(["G4 P50"] * 4000) + "\n")
    with PushListener(server, ADMIN) as push:
        push.wait_for_plugin(bool)
        server.select_and_print("dwell.gcode")
        server.wait_state("Printing")
        for command in ("G1 X10", "M600", "M104 S999"):
            server.commands(command)
            assert command in told(push, command)["text"]
        assert server.state() == "Printing"
        assert push.events("PrintPaused") == []
