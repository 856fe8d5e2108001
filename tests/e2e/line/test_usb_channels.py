"""Firmware 3.7: the channel that OctoPrint is on may be the second one over USB."""

import pytest

from octoprint_rrfmodel.simulator.hardware.blank import INPUT_NAMES
from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

pytestmark = pytest.mark.both_hosts("each has its own code for the line", once_for=("port",))

FILE = "G28\nG90\nM83\n" + "".join(
    f"G1 X{20 + number % 50} Y{number} F6000\n" for number in range(60)
)
PRINT_SECONDS = 60


def speed(server):
    response = server.get("/plugin/rrfmodel/printer/objects/query?gcode_move=speed")
    assert response.status_code == 200, response.text
    return response.json()["result"]["status"]["gcode_move"]["speed"]


@pytest.mark.parametrize(("firmware", "port"), [("3.7", "USB2"), ("3.7", "USB")])
def test_row_27_own_channel_is_found(server, board_factory, firmware, port):
    board = board_factory(firmware=firmware, speed=10)
    board.board.plug_into(port)
    helpers.connect(server, board)
    state = helpers.status(server)
    assert (state["protocol"], state["firmware"]["version"]) == ("M409", "3.7.0")
    assert helpers.value(server, "state.thisInput") == INPUT_NAMES.index(port)
    # what another channel is set to is not ours
    board.board.execute("G1 F1200", channel="telnet")
    server.commands("G1 F4320")
    server.wait_for(lambda: speed(server) == 72, 20, "the speed of the own channel")
    server.upload("part.gcode", FILE)
    before = len(board.board.received())
    with PushListener(server, ADMIN) as push:
        server.select_and_print("part.gcode")
        prints.wait_done(server, push, PRINT_SECONDS)
    sent = helpers.commands(board)[before:]
    moves = [line for line in sent if line.startswith("G1 X")]
    assert moves == [line for line in FILE.splitlines() if line.startswith("G1 X")]
    assert not [line for line in sent if line.startswith(("M408", "M301", "M304"))]
    assert helpers.polls_without_status(sent) == []
