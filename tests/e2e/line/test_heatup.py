"""Commands that block the line for longer than OctoPrint would ever wait without a sign of life."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line", once_for=("firmware",)),
    pytest.mark.slow,
]

HEATING_SECONDS = 18
"""More than twice what OctoPrint waits in all."""

FIRMWARE = ("3.5.1", "3.5.3")


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(serial=helpers.SHORT_TIMEOUTS)


def cold_bed(board):
    """Make the bed so slow that it takes that long to 60 °C; return the heater."""
    heater = board.board.data["heat"]["heaters"][0]
    with board.board.lock:
        rate = heater["model"]["heatingRate"]
        # the wait ends 2.5 °C below
        heater["current"] = 57.5 - rate * HEATING_SECONDS
    return heater


def wait_through(server, board, command, is_over, seconds):
    """Return the reasons for not polling that the plugin gave while a command ran."""
    server.wait_for(lambda: command in helpers.commands(board), 20, f"{command} to arrive")
    reasons = set()

    def is_through():
        assert server.state().startswith(("Operational", "Printing", "Finishing")), server.state()
        if is_over():
            return True
        reasons.add(helpers.status(server)["blocked"])
        return False

    server.wait_for(is_through, seconds, f"the end of {command}")
    return reasons


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_heating_in_a_print(server, board_factory, firmware):
    board = board_factory(firmware=firmware)
    helpers.connect(server, board)
    heater = cold_bed(board)
    moves = [f"G1 F{6000 + number}" for number in range(300)]
    name = f"heat-{firmware}.gcode"
    server.upload(name, "\n".join([*moves[:20], "M190 S60", *moves[20:]]) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print(name)
        reasons = wait_through(
            server, board, "M190 S60", lambda: heater["current"] >= 57.5, HEATING_SECONDS + 15
        )
        # by name the printer is at the temperature; whatever comes now comes after the wait
        push.wait_for_event("PrintDone", 30)
        assert push.events("Disconnected") == push.events("Error") == []
    assert "heating" in reasons
    assert reasons <= {None, "heating", "long_command"}
    helpers.assert_quiet(board, "M190 S60", moves[20])
    sent = helpers.commands(board)
    assert [command for command in sent if command.startswith("G1 F")] == moves
    helpers.wait_polls(server, 2)
    helpers.wait_equal(server, board)


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_heating_by_a_command(server, board_factory, firmware):
    board = board_factory(firmware=firmware)
    helpers.connect(server, board)
    heater = cold_bed(board)
    with PushListener(server, ADMIN) as push:
        server.commands("M190 S60", "M117 done")
        reasons = wait_through(
            server, board, "M190 S60", lambda: heater["current"] >= 57.5, HEATING_SECONDS + 15
        )
        server.wait_for(lambda: "M117 done" in helpers.commands(board), 10, "the next command")
        assert push.events("Disconnected") == push.events("Error") == []
    assert "heating" in reasons
    helpers.assert_quiet(board, "M190 S60", "M117 done")
    helpers.wait_polls(server, 2)
    helpers.wait_equal(server, board)


def test_silence_would_have_ended_the_connection(server, board_factory):
    """The timeouts are as short as the other tests need them: proof by a board that is silent."""
    board = board_factory(firmware="3.5.3")
    helpers.connect(server, board)
    cold_bed(board)
    server.commands("M190 S60")
    server.wait_for(lambda: "M190 S60" in helpers.commands(board), 10, "the command to arrive")
    # what the firmware would do after an M409 as the last request
    board.board.channels["USB"].status_request = "M409"
    server.wait_disconnected(HEATING_SECONDS)
    assert server.state() != "Operational"
