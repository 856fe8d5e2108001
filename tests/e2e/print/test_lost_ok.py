"""An ok that is lost or late in a print costs little, and no line."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

pytestmark = [
    pytest.mark.both_hosts("each waits for acknowledgements with its own code"),
    pytest.mark.slow,
    pytest.mark.timeout(240),
]

LINES = [f"G1 X{20 + number}.5 F6000" for number in range(40)]


@pytest.mark.parametrize("fault, seconds", [("lost_ok:once", 15), ("slow:5", 5 * 12 + 30)])
def test_row_16_print(server_factory, board_factory, fault, seconds):
    # OctoPrint's own patience is half a minute
    server = server_factory()
    board = board_factory(speed=20)
    helpers.connect(server, board)
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 20)
    lines = LINES if fault.startswith("lost") else LINES[:6]
    server.upload("short.gcode", "\n".join(lines) + "\n")
    before = len(board.board.received())
    board.board.inject(fault)
    with PushListener(server, ADMIN) as push:
        server.select_and_print("short.gcode")
        prints.wait_done(server, push, seconds)
    # its own way to find out, which takes the whole of its patience
    assert "Communication timeout" not in server.serial_log()
    board.board.clear(fault.partition(":")[0])
    arrived = [text for text in helpers.commands(board)[before:] if text.startswith("G1 ")]
    assert arrived == lines
