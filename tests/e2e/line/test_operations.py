"""Jogging, homing and the feed rate on the wire, and what the board has made of them."""

import threading

import pytest

from octoprint_rrfmodel.rrf.gcode.recognition import ROWS
from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers
from ..operations import AS_OCTOPRINT, on

pytestmark = pytest.mark.both_hosts(
    "each has its own code for the serial line", once_for=("machine",)
)

MOVED = on(
    "one tool 2.05",
    "one tool 3.3",
    "one tool 3.5.3",
    "one tool 3.7",
    "changer 2.05",
    "changer 3.6",
    "no tools 2.05",
    "no tools 3.3",
    "no tools 3.5.3",
    "no tools 3.6",
)


def modes(machine):
    return {name: machine.usb.get(name) for name in ("axesRelative", "drivesRelative")}


@MOVED
def test_jog_is_one_line_and_leaves_the_modes(machine):
    machine.home()
    before = machine.position()
    left = modes(machine)
    lines = machine.ask("printhead", command="jog", x=10, y=5, z=0.02)
    assert lines == ["M120 G21 G91 G1 X10 Y5 Z0.02 F200 M121"]
    assert machine.position() == pytest.approx([before[0] + 10, before[1] + 5, before[2] + 0.02])
    assert modes(machine) == left
    assert machine.wire("printhead", command="jog", x=20, absolute=True, speed=1200) == [
        "M120 G21 G90 G1 X20 F1200 M121"
    ]
    assert machine.position()[0] == pytest.approx(20)
    assert machine.wire("printhead", command="jog", x=1, speed=False) == ["M120 G21 G91 G1 X1 M121"]
    assert machine.position()[0] == pytest.approx(21)
    assert modes(machine) == left


@pytest.mark.parametrize(
    "machine, refusals",
    [
        (
            "no tools 3.6",
            {
                "not_homed": ("printhead", {"command": "jog", "x": 10}),
                "no_such_tool": ("tool", {"command": "select", "tool": "tool1"}),
                "no_tool_selected": ("tool", {"command": "flowrate", "factor": 95}),
                "no_bed": ("bed", {"command": "target", "target": 60}),
                "no_chamber": ("chamber", {"command": "target", "target": 50}),
            },
        ),
        (
            "changer 3.6",
            {
                "not_homed": ("printhead", {"command": "jog", "y": 10}),
                "no_such_tool": ("tool", {"command": "target", "targets": {"tool2": 200}}),
                "too_cold": ("tool", {"command": "extrude", "amount": 5}),
            },
        ),
    ],
    indirect=["machine"],
)
def test_what_is_refused_is_told(machine, refusals):
    if machine.board.tools():
        machine.ask("tool", command="select", tool="tool1")
    with PushListener(machine.server, ADMIN) as push:
        for code, (path, request) in refusals.items():
            assert machine.wire(path, **request) == []
            notice = push.wait_for_plugin(lambda found, code=code: found.get("code") == code)
            assert notice["type"] == "notice"
            assert notice["text"].endswith(".")
    assert machine.server.state() == "Operational"


@on("one tool 3.3", "one tool 3.5.3")
def test_jog_that_the_board_refuses_shifts_no_ok(machine):
    before = len(machine.server.received())
    # the server has had other tests
    timeouts = helpers.status(machine.server)["counters"]["timeouts"]

    def is_refused():
        # the board loses its position behind the plugin's back, so that the jog does go out; once
        # more where the plugin was told before
        machine.home()
        machine.board.execute("M84")
        machine.server.post("/api/printer/printhead", json={"command": "jog", "x": 10})
        machine.server.commands("M115", "M114", "M119")
        machine.settle()
        received = machine.server.received()[before:]
        return any("insufficient axes homed" in line for line in received)

    machine.server.wait_for(is_refused, 60, "the jog to be refused by the board")
    assert machine.server.state() == "Operational"
    # what is sent from here on is still answered before the next line leaves
    helpers.wait_polls(machine.server, 3)
    assert helpers.status(machine.server)["counters"]["timeouts"] == timeouts


def test_twenty_clients_jog_at_once(machine):
    machine.home()
    machine.ask("printhead", command="jog", x=100, y=100, absolute=True)
    start = machine.position()

    def jog(number):
        way = 1 if number % 2 else -1
        request = {"command": "jog", "x": way * 2, "y": 1}
        response = machine.server.post("/api/printer/printhead", json=request)
        assert response.status_code == 204

    clients = [threading.Thread(target=jog, args=(number,)) for number in range(20)]
    for client in clients:
        client.start()
    for client in clients:
        client.join()
    machine.settle()
    assert machine.position() == pytest.approx([start[0], start[1] + 20, start[2]])
    assert machine.usb["axesRelative"] is False


@on("one tool 2.05", "one tool 3.5.3", "changer 3.6", "no tools 3.6")
def test_home_names_the_axes_only(machine):
    assert machine.ask("printhead", command="home", axes=["x", "y"]) == ["G28 X Y"]
    homed = [axis["homed"] for axis in machine.board.model["move"]["axes"][:3]]
    assert homed == [True, True, False]


@on("one tool 2.05", "one tool 3.5.3", "changer 3.6", "no tools 3.3")
@pytest.mark.parametrize("factor", [105, 1.05], ids=["percent", "fraction"])
def test_feedrate_is_read_back(machine, factor):
    assert machine.ask("printhead", command="feedrate", factor=factor) == ["M220 S105"]
    assert machine.board.model["move"]["speedFactor"] == pytest.approx(1.05)
    speed = helpers.value(machine.server, "move.speedFactor")
    assert speed == pytest.approx(1.05)


@on("one tool 3.5.3", "no tools 2.05")
def test_what_a_person_types_stays_as_typed(machine):
    lines = ["G91", "M104 S50", "M140 S40", "T0", "M220 S90", "G90"]
    assert machine.wire("command", commands=lines) == lines


# rows that are switched off


@pytest.fixture
def switched_off(machine):
    """Function that switches rows off until the test is over."""

    def switch(*names, to=False):
        machine.server.set_setting("plugins.rrfmodel.operations", dict.fromkeys(names, to))

    yield switch
    switch(*(row.name for row in ROWS), to=True)


def test_all_switched_off(machine, switched_off):
    machine.home()
    switched_off(*(row.name for row in ROWS))
    # commands that would hang the line have rows of their own
    for operation in set(AS_OCTOPRINT) - {"commands"}:
        path, request, lines = AS_OCTOPRINT[operation]
        assert machine.wire(path, **request) == lines, operation
    machine.wire("tool", command="offset", offsets={"tool0": 0})
    assert machine.server.state() == "Operational"


JOG = ("printhead", {"command": "jog", "x": 10})
HOME = ("printhead", {"command": "home", "axes": ["x"]})
EXTRUDE = ("tool", {"command": "extrude", "amount": 5})

SWITCHED_OFF = {
    # a jog that goes out as it is needs its modes
    "jog": (*JOG, ["G91", "G0 X10 F6000", "G90"]),
    "jog_mode": (*JOG, ["G91", "M120 G21 G91 G1 X10 F6000 M121", "G90"]),
    "home": (*HOME, ["G91", "G28 X0", "G90"]),
    "home_mode": (*HOME, ["G91", "G28 X", "G90"]),
    "extrude": (*EXTRUDE, ["G91", "M83", "G1 E5 F300", "M82", "G90"]),
    "extrude_mode": (*EXTRUDE, ["G91", "M83", "M120 M83 G1 E5 F300 M121", "M82", "G90"]),
    "tool_select": ("tool", {"command": "select", "tool": "tool0"}, ["T0"]),
    "tool_target": ("tool", {"command": "target", "targets": {"tool0": 45}}, ["M104 T0 S45"]),
    "bed_target": ("bed", {"command": "target", "target": 41}, ["M140 S41"]),
    "chamber_target": ("chamber", {"command": "target", "target": 42}, ["M141 S42"]),
    "flow_rate": ("tool", {"command": "flowrate", "factor": 95}, ["M221 S95"]),
}


@on("chamber 3.5.3")
def test_each_switched_off_alone(machine, switched_off):
    assert set(SWITCHED_OFF) == {row.name for row in ROWS}
    machine.home()
    machine.wire("tool", command="select", tool="tool0")
    machine.wire("tool", command="target", targets={"tool0": 210})
    machine.warm(0)
    for row, (path, request, lines) in SWITCHED_OFF.items():
        switched_off(row)
        before = machine.position()[0]
        assert machine.wire(path, **request) == lines, row
        if request["command"] == "jog":
            assert machine.position()[0] - before == pytest.approx(10), row
        switched_off(row, to=True)
