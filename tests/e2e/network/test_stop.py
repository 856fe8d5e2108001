"""An emergency stop past all that waits, and the way back from it."""

from .. import helpers
from . import bench

BOARD = {"machine": "cartesian", "speed": 1}


def test_stop_during_a_heat_up_and_the_way_back(server, face):
    assert bench.stop_in_a_heat_up(server, face) == "off"
    assert bench.command(server, "fan", fan=0, speed=1).status_code == 409
    bench.restart(server)
    helpers.wait_ready(server, 60)
    helpers.wait_value(server, "state.status", "idle", 30)
    assert server.state() == "Operational"
