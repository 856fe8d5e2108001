"""M0 and M1 as the last command of a streamed file: the board ends the print as from its card."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import prints

pytestmark = [
    pytest.mark.both_hosts("each streams and pauses with its own code", once_for=("stop",)),
    pytest.mark.slow,
    pytest.mark.timeout(240),
]

BOARD = {"machine": "toolchanger", "firmware": "3.5.3"}

SETTINGS = "; layer_height = 0.2\n" * 500


def macro(board):
    """Put a stop.g on the card that says that it runs."""
    with board.board.lock:
        board.board.card.write("0:/sys/stop.g", 'M118 S"stop.g runs"\n')


@pytest.mark.parametrize("stop", ["M0 H1", "M00", "M1"])
@pytest.mark.parametrize("behind", ["", SETTINGS], ids=["bare", "settings"])
def test_row_7_last_command(server, board, stop, behind):
    macro(board)
    name = f"{stop.replace(' ', '-')}-{len(behind)}.gcode"
    server.upload(name, f"M140 P0 S50\nM568 P3 S120 A2\nG4 P1\n{stop}\n{behind}")
    with PushListener(server, ADMIN) as push:
        server.select_and_print(name)
        prints.wait_done(server, push, 30)
        assert push.events("PrintPaused") == []
    # the log is written by a thread of its own
    server.wait_for(lambda: "stop.g runs" in server.serial_log(), 5, "the macro's word")
    states = [heater["state"] for heater in board.board.model["heat"]["heaters"] if heater]
    assert states.count("active") == (2 if "H1" in stop else 0)
    if "H1" in stop:
        server.commands("M140 P0 S-273.15", "M568 P3 A0")
