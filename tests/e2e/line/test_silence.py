"""Long commands during which the firmware says nothing at all, whatever was asked before.

With RRF_SILENCE (``make silence``) as long as that, in seconds, and with OctoPrint's own timeouts.
"""

import os

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

REAL = int(os.environ.get("RRF_SILENCE", 0))

SECONDS = REAL or 14
"""More than twice what OctoPrint waits in all, with short timeouts."""

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line"),
    pytest.mark.slow,
    pytest.mark.timeout(240 + 2 * REAL),
]

MACRO = 'M98 P"0:/macros/wait.g"'
"""OctoPrint's settings don't know it as one that takes long."""


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(**({} if REAL else {"serial": helpers.SHORT_TIMEOUTS}))


@pytest.fixture
def board(server, board_factory):
    made = board_factory(firmware="3.5.3")
    made.board.card.write("0:/macros/wait.g", f"G4 S{SECONDS}\n")
    helpers.connect(server, made)
    return made


def silence(server, board, command):
    """Return once a command runs, of which nothing is to be heard from now on."""
    usb = board.board.channels["USB"]
    server.wait_for(lambda: command in helpers.commands(board), 20, f"{command} to arrive")
    # then the firmware's reports go elsewhere
    usb.status_request = "M409"


@pytest.mark.parametrize("command", [MACRO, f"G4 S{SECONDS}"])
def test_row_1_silent_command(server, board, command):
    with PushListener(server, ADMIN) as push:
        server.commands(command, "M117 behind")
        silence(server, board, command)
        server.wait_for(
            lambda: "M117 behind" in helpers.commands(board), 40 + REAL, "the line behind"
        )
        assert server.state() == "Operational"
        assert push.events("Disconnected") == push.events("Error") == []
    helpers.assert_quiet(server, board, command)
    helpers.wait_polls(server, 2)


def test_row_1_silent_command_in_a_print(server, board):
    moves = [f"G1 F{6000 + number}" for number in range(60)]
    server.upload("silent.gcode", "\n".join([*moves[:20], MACRO, *moves[20:]]) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("silent.gcode")
        silence(server, board, MACRO)
        prints.wait_done(server, push, 60 + REAL)
        assert push.events("Disconnected") == push.events("Error") == []
    # OctoPrint has sent nothing to wake the printer up, which would earn an ok too many
    helpers.assert_quiet(server, board, MACRO)
    assert helpers.sent_until_acknowledged(server, MACRO) == []
    sent = helpers.commands(board)
    assert [command for command in sent if command.startswith("G1 F")] == moves


def test_row_1_a_dead_board_is_found_after_the_time_of_the_setting(server, board):
    server.set_setting("plugins.rrfmodel.silence_minutes", 0.1)
    try:
        server.commands("G4 S200")
        silence(server, board, "G4 S200")
        server.wait_disconnected(60)
        assert server.state() != "Operational"
    finally:
        server.set_setting("plugins.rrfmodel.silence_minutes", 60.0)


def test_a_port_that_is_gone_is_noticed_at_once(server, board):
    server.commands("G4 S200")
    silence(server, board, "G4 S200")
    board.board.inject("disconnect")
    server.wait_disconnected(5)
    assert not helpers.status(server)["connected"]
