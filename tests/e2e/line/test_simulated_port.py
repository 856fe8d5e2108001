"""The serial port RRF-SIM inside OctoPrint."""

import pytest

from .. import helpers

pytestmark = pytest.mark.both_hosts(
    "each has its own code for the serial line", once_for=("machine", "firmware")
)

PORT = "RRF-SIM"


def ports(server):
    return server.get("/api/connection").json()["options"]["ports"]


def test_is_not_offered_unless_wanted(server_factory):
    assert PORT not in ports(server_factory())


@pytest.mark.parametrize("machine, firmware", [("cartesian", "3.5.3"), ("toolchanger", "2.05")])
def test_connects_to_the_board_of_the_settings(server_factory, machine, firmware):
    simulator = {"enabled": True, "machine": machine, "firmware": firmware}
    server = server_factory(plugins_config={"rrfmodel": {"simulator": simulator}})
    assert PORT in ports(server)
    server.connect(PORT)
    helpers.wait_ready(server)
    assert helpers.status(server)["firmware"]["version"].startswith(firmware)
    assert helpers.value(server, "state.status") in ("idle", "off")
    server.disconnect()
    server.wait_disconnected()
    server.connect(PORT)
    helpers.wait_ready(server)
