"""OctoPrint's printer operations and its terminal on a board of the network."""

import pytest
import requests

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers
from ..operations import PROFILE
from . import bench

BOARD = {"machine": "cartesian", "speed": 20}

SERVER = {"profile": PROFILE}


@pytest.fixture(scope="module", autouse=True)
def homed(server, face):
    bench.printer(server, "printhead", command="home", axes=["x", "y", "z"])
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 20)


def wait_board(server, face, key, wanted, seconds=10):
    server.wait_for(
        lambda: bench.board_value(face, key) == wanted, seconds, f"{key} to be {wanted!r}"
    )


def position(face, axis):
    return bench.board_value(face, f"move.axes.{axis}.userPosition")


def test_jog(server, face):
    before, *others = (position(face, axis) for axis in range(3))
    bench.printer(server, "printhead", command="jog", x=10)
    wait_board(server, face, "move.axes.0.userPosition", before + 10)
    bench.printer(server, "printhead", command="jog", x=30, absolute=True, speed=6000)
    wait_board(server, face, "move.axes.0.userPosition", 30)
    # the other axes stay where they were
    assert [position(face, axis) for axis in (1, 2)] == others


def test_tool_bed_and_their_targets(server, face):
    bench.printer(server, "tool", command="select", tool="tool0")
    wait_board(server, face, "state.currentTool", 0)
    bench.printer(server, "tool", command="target", targets={"tool0": 45})
    bench.printer(server, "bed", command="target", target=40)
    server.wait_for(
        lambda: (
            server.get("/api/printer").json()["temperature"].get("tool0", {}).get("target") == 45
            and server.get("/api/printer").json()["temperature"]["bed"]["target"] == 40
        ),
        10,
        "the targets in OctoPrint",
    )
    assert bench.board_value(face, "heat.heaters.0.active") == 40
    assert bench.board_value(face, "heat.heaters.1.active") == 45
    bench.printer(server, "tool", command="target", targets={"tool0": 0})
    bench.printer(server, "bed", command="target", target=0)


def test_factors(server, face):
    bench.printer(server, "printhead", command="feedrate", factor=110)
    bench.printer(server, "tool", command="flowrate", factor=95)
    helpers.wait_value(server, "move.speedFactor", 1.1, 10)
    helpers.wait_value(server, "move.extruders[0].factor", 0.95, 10)
    assert bench.board_value(face, "move.speedFactor") == 1.1
    server.commands("M220 S100", "M221 S100")


def test_what_the_machine_has_not_is_refused_with_a_notification(server, face):
    """REST checks neither tools nor axes."""
    with PushListener(server, ADMIN) as push:
        bench.printer(server, "tool", command="target", targets={"tool5": 200})
        bench.printer(server, "chamber", command="target", target=40)
        for code in ("no_such_tool", "no_chamber"):
            push.wait_for_plugin(lambda data, code=code: data.get("code") == code, 10, code)
    assert bench.board_value(face, "heat.heaters.1.active") == 0


class OtherClient:
    """What else may be connected to a board: the vendor's page, for example."""

    def __init__(self, face):
        self._url = face.url
        self._headers = {}
        self._replies = None

    def get(self, name, **parameters):
        url = f"{self._url}/rr_{name}"
        return requests.get(url, params=parameters, headers=self._headers, timeout=20)

    def log_in(self):
        told = self.get("connect", password="", sessionKey="yes").json()
        self._headers = {"X-Session-Key": str(told["sessionKey"])}
        self.news()

    def news(self):
        count = self.get("model", key="seqs", flags="").json()["result"]["reply"]
        if count == self._replies:
            return []
        self._replies = count
        return [self.get("reply").text]


def store(server):
    found = server.get("/plugin/rrfmodel/server/gcode_store?count=1000").json()
    return [(entry["type"], entry["message"]) for entry in found["result"]["gcode_store"]]


def test_reply_of_each_command_comes_once(server, face):
    server.commands(*(f'echo "reply {number}"' for number in range(8)))
    server.wait_for(
        lambda: ("response", "reply 7") in store(server), 10, "the reply of the last command"
    )
    told = [text for kind, text in store(server) if kind == "response" and "reply " in text]
    assert told == [f"reply {number}" for number in range(8)]
    sent = [text for kind, text in store(server) if kind == "command" and "reply " in text]
    assert len(sent) == 8


def test_another_client_gets_its_replies_whole(server, face):
    """Who fetches more often than replies come takes another's copy."""
    other = OtherClient(face)
    other.log_in()
    other.get("gcode", gcode='echo "for the other"')
    server.commands('echo "for octoprint"')
    heard = []

    def has_both():
        heard.extend(other.news())
        text = "".join(heard)
        return "for the other" in text and "for octoprint" in text

    server.wait_for(has_both, 20, "both replies at the other client")
    server.wait_for(
        lambda: {"for octoprint", "for the other"} <= {text for _, text in store(server)},
        20,
        "both replies in OctoPrint",
    )
    other.get("disconnect")
    text = "".join(heard)
    assert (text.count("for the other"), text.count("for octoprint")) == (1, 1)


def test_long_lines_and_a_bare_m122_do_no_harm(server, face):
    """A bare M122 would delete what waits in the board's input."""
    server.commands("G4 P500", "set global.retries = 41", "M122", "set global.retries = 42")
    helpers.wait_value(server, "global.retries", 42, 20)
    server.commands(f'M117 "{"x" * 300}"', "set global.retries = 43")
    helpers.wait_value(server, "global.retries", 43, 20)
    assert server.state().startswith("Operational")


def test_plugins_commands(server, face):
    assert bench.command(server, "fan", fan=0, speed=0.5).status_code == 204
    helpers.wait_value(server, "fans[0].requestedValue", 0.5, 10)
    assert bench.command(server, "bed", active=500).status_code == 400
    live = server.get("/plugin/rrfmodel/model/live?key=state.status").json()
    assert live["result"] in ("idle", "busy")


def test_message_box_is_answered(server, face):
    bench.at_panel(face, 'M291 P"go on?" R"ask" S3')
    box = helpers.wait_value(server, "state.messageBox", bool, 10)
    assert bench.command(server, "message_box", action="ok", seq=box["seq"]).status_code == 204
    helpers.wait_value(server, "state.messageBox", lambda value: not value, 10)
