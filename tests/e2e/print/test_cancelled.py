"""A cancelled print leaves no heater on that OctoPrint's script meant to switch off."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each streams and cancels with its own code", once_for=("machine",)),
    pytest.mark.slow,
    pytest.mark.timeout(240),
]


def heated(board):
    return [
        index
        for index, heater in enumerate(board.board.model["heat"]["heaters"])
        if heater and heater["state"] in ("active", "standby")
    ]


@pytest.mark.parametrize("machine", ["toolchanger", "idex"])
def test_row_4_heaters_beyond_the_printer_profile(server, board_factory, machine):
    board = board_factory(machine=machine, firmware="3.5.3")
    helpers.connect(server, board)
    model = board.board.model
    tools = [tool for tool in model["tools"] if tool and tool["heaters"]]
    beds = [slot for slot, heater in enumerate(model["heat"]["bedHeaters"]) if heater >= 0]
    # a copying tool has the heaters of others
    heaters = {heater for tool in tools for heater in tool["heaters"]}
    lines = [f"M104 T{tool['number']} S150" for tool in tools]
    lines += [f"M140 P{slot} S50" for slot in beds]
    server.upload("hot.gcode", "\n".join([*lines, *["G4 P100"] * 400]) + "\n")
    with PushListener(server, ADMIN) as push:
        # from here on the login counts
        push.wait_for_plugin(bool)
        server.select_and_print("hot.gcode")
        server.wait_for(lambda: len(heated(board)) == len(heaters) + len(beds), 20, "all to heat")
        helpers.wait_polls(server, 3)
        assert server.post("/api/job", json={"command": "cancel"}).status_code == 204
        server.wait_state("Operational", 30)
        server.wait_for(lambda: heated(board) == [], 10, "all to be off")
        push.wait_for_plugin(lambda found: found.get("code") == "heaters_off")
    helpers.disconnect(server)
