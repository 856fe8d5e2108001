"""A printer with another firmware: with the plugin all is as it was without it."""

import re
from pathlib import Path

import pytest
import yaml

from tests.support import plugins
from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers
from ..operations import AS_OCTOPRINT, PROFILE

pytestmark = pytest.mark.both_hosts("each has its own code for the serial line")

HOOK_NAMES = Path(plugins.__file__).with_name("hook_names.py")

PORT = "VIRTUAL"
LINES = ["G28", "M104 S45", "G1 X10 F6000", "G1 X20", "G1 X30 Y5", "M104 S0", "M117 end"]

BY_THE_CLOCK = re.compile(r"M105|M27|M155 S\d+|M154 S\d+|M113 S\d+")
"""Commands whose number depends on how long a session takes."""

OWN_SECTION = "rrfmodel"


def session(server):
    """Connect, jog, heat and print; return the lines that went out but for those of timers."""
    server.connect(PORT)
    server.wait_state("Operational")
    assert server.post("/api/printer/printhead", json={"command": "jog", "x": 10, "y": -5}).ok
    assert server.post("/api/printer/bed", json={"command": "target", "target": 40}).ok
    server.commands("T0", "M114", 'M409 K"state"', "M84")
    server.upload("small.gcode", "\n".join(LINES) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("small.gcode")
        push.wait_for_event("PrintDone", 60)
        assert push.of_plugin() == [] or all(
            message["type"] == "status" for message in push.of_plugin()
        )
    server.wait_state("Operational")
    return [line for line in sent(server) if not BY_THE_CLOCK.fullmatch(line)]


def sent(server):
    """Return the commands that went out, without line numbers and checksums."""
    return [helpers.NUMBERED.match(line)["command"] for line in server.sent()]


@pytest.fixture(scope="module")
def sessions(module_server_factory):
    """Return the server with the plugin, what it sent, what one without it sent, and what was.

    The last of them is the configuration and the counters before all that.
    """
    virtual = {"virtual_printer": {"enabled": True}}
    with_plugin = module_server_factory(
        plugins_config=virtual, profile=PROFILE, plugin_files=(HOOK_NAMES,)
    )
    before = without_own_section(with_plugin), helpers.status(with_plugin)["counters"]
    lines = session(with_plugin)
    without = module_server_factory(
        plugins_config=virtual,
        profile=PROFILE,
        settings={"plugins": {"_disabled": disabled(with_plugin)}},
    )
    assert without.get("/plugin/rrfmodel/status").status_code == 404
    return with_plugin, lines, session(without), before


def disabled(server):
    return [*stored(server)["plugins"]["_disabled"], OWN_SECTION]


def stored(server):
    """Return the content of config.yaml."""
    return yaml.safe_load((server.basedir / "config.yaml").read_text(encoding="utf-8"))


def without_own_section(server):
    config = stored(server)
    config["plugins"].pop(OWN_SECTION, None)
    return config


def test_no_command_more_and_none_changed(sessions):
    _, with_plugin, without, _ = sessions
    assert [line for line in with_plugin if line.startswith("M408")] == []
    # what timers send in between has its place by chance; the order of all else is the same
    assert sorted(with_plugin) == sorted(without)
    wanted = [line for line in without if line in LINES]
    assert [line for line in with_plugin if line in LINES] == wanted


def test_is_asked_about_no_line(sessions):
    server, *_ = sessions
    asked = server.get("/api/plugin/hook_names").json()
    assert "hook_names" in asked["received"]
    assert [phase for phase, names in asked.items() if "rrfmodel" in names] == []


def test_nothing_of_the_timers_is_new(sessions):
    server, *_ = sessions
    kinds = {line.split()[0] for line in sent(server) if BY_THE_CLOCK.fullmatch(line)}
    assert kinds <= {"M105", "M27", "M155", "M154", "M113"}
    # an M105 of the plugin's would follow others within moments
    count = sum(line == "M105" for line in sent(server))
    assert count < 30


def test_no_line_changed(sessions):
    server, *_ = sessions
    assert not [line for line in server.received() if "rrfmodel" in line]
    assert any("FIRMWARE_NAME:" in line for line in server.received())


@pytest.mark.parametrize("operation", AS_OCTOPRINT)
def test_operation_goes_out_as_octoprint_has_it(sessions, operation):
    server, *_ = sessions
    path, request, lines = AS_OCTOPRINT[operation]
    begun = len(sent(server))
    assert server.post(f"/api/printer/{path}", json=request).status_code == 204
    mark = f"M117 {operation}"
    server.commands(mark)
    server.wait_for(lambda: mark in sent(server)[begun:], 30, "the line behind")
    found = [line for line in sent(server)[begun:] if not BY_THE_CLOCK.fullmatch(line)]
    # what is left out or put in front by the plugin or by OctoPrint would show here
    assert found == [*lines, mark]


def test_requests_are_answered_by_octoprint_itself(sessions):
    server, *_ = sessions
    jog = {"command": "jog", "x": 1, "speed": "fast"}
    assert server.post("/api/printer/printhead", json=jog).status_code == 204
    target = {"command": "target", "target": -1}
    assert server.post("/api/printer/bed", json=target).status_code == 500


def test_state_says_so(sessions):
    server, _, _, (_, counters) = sessions
    state = helpers.status(server)
    assert (state["connected"], state["is_rrf"], state["ready"]) == (True, False, False)
    assert state["protocol"] is state["firmware"] is state["blocked"] is state["age"] is None
    assert state["warnings"] == []
    assert state["counters"] == counters
    for path in ("/plugin/rrfmodel/model", "/plugin/rrfmodel/model?key=state&flags=v"):
        response = server.get(path)
        assert response.status_code == 503
        assert "RepRapFirmware" in response.json()["error"]
    response = server.get("/plugin/rrfmodel/model/live?key=state")
    assert response.status_code in (409, 503)
    assert response.json()["error"]


def test_settings_are_as_they_were(sessions):
    server, _, _, (before, _) = sessions
    assert without_own_section(server) == before
