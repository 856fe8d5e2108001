"""The connector is offered in OctoPrint 2.0, and 1.11 has no trace of it."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers
from . import bench

pytestmark = pytest.mark.both_hosts("one has connectors, the other hasn't")

TRACES = ("connection_options_rrfmodel", "rrfmodel_network_host", "network.js", "rr_connect")


def test_offer(server, octoprint_version):
    is_offered = not octoprint_version.startswith("1.")
    page = server.get("/", allow_redirects=True).text
    assert ("rrfmodel_network_host" in page) is is_offered
    if is_offered:
        told = server.get("/api/connection", headers=bench.NEW).json()["options"]["connectors"]
        names = {each["connector"]: each["name"] for each in told}
        assert names["rrfmodel"] == "RepRapFirmware (network)"
        return
    assert [trace for trace in TRACES if trace in page] == []
    assert "rrfmodel" not in server.get("/api/connection").text
    refused = bench.command(server, "network_password", host="duet", password="x")
    assert refused.status_code == 400


def test_settings_tell_no_address_and_no_password(server):
    kept = server.get("/api/settings").json()["plugins"]["rrfmodel"]["network"]
    assert (kept["gap_minutes"], kept["passwords"], kept["hosts"]) == (30.0, {}, {})


def test_simulated_board_is_a_host(server, octoprint_version):
    if octoprint_version.startswith("1."):
        pytest.skip("1.11 has no connectors")
    with PushListener(server, ADMIN) as push:
        assert bench.ask_to_connect(server, "RRF-SIM").status_code == 204
        push.wait_for_event("Error", 20)
    server.wait_for(lambda: not helpers.status(server)["connected"], 20, "nobody by that name")
    server.set_setting("plugins.rrfmodel.simulator.enabled", True)
    assert bench.ask_to_connect(server, "RRF-SIM").status_code == 204
    helpers.wait_ready(server, 30)
    helpers.disconnect(server)
    server.set_setting("plugins.rrfmodel.simulator.enabled", False)
