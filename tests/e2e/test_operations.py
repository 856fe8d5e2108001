"""Jogging, homing and the feed rate on the wire, and what the board has made of them."""

import threading

import pytest

from . import helpers
from .operations import on

HOMED = on("one tool 3.5.3", "one tool 2.05", "one tool 3.3", "one tool 3.6", "changer 3.5.3")


@HOMED
def test_jog_is_one_line_and_leaves_the_modes(machine):
    machine.home()
    before = machine.position()
    modes = {name: machine.usb.get(name) for name in ("axesRelative", "drivesRelative")}
    lines = machine.ask("printhead", command="jog", x=10, y=5, z=0.02)
    assert [line.split()[:3] for line in lines] == [["M120", "G21", "G91"]]
    assert machine.position() == pytest.approx([before[0] + 10, before[1] + 5, before[2] + 0.02])
    assert {name: machine.usb.get(name) for name in modes} == modes
    assert machine.ask("printhead", command="jog", x=20, absolute=True, speed=1200) == [
        "M120 G21 G90 G1 X20 F1200 M121"
    ]
    assert machine.position()[0] == pytest.approx(20)
    assert machine.ask("printhead", command="jog", x=1, speed=False) == ["M120 G21 G91 G1 X1 M121"]
    assert {name: machine.usb.get(name) for name in modes} == modes


def test_jog_of_an_axis_that_is_not_homed_is_refused_with_a_notice(machine):
    assert machine.ask("printhead", command="jog", x=10) == []
    assert machine.server.state() == "Operational"


@on("one tool 3.3", "one tool 3.5.3")
def test_jog_that_the_board_refuses_shifts_no_ok(machine):
    # the board loses its position behind the plugin's back, so that the jog does go out
    machine.home()
    machine.board.execute("M84")
    before = len(machine.server.received())
    machine.server.post("/api/printer/printhead", json={"command": "jog", "x": 10})
    machine.server.commands("M115", "M114", "M119")
    machine.settle()
    received = machine.server.received()[before:]
    assert any("insufficient axes homed" in line for line in received)
    assert machine.server.state() == "Operational"
    # what is sent from here on is still answered before the next line leaves
    helpers.wait_polls(machine.server, 3)
    counters = helpers.status(machine.server)["counters"]
    assert counters["timeouts"] == 0


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


@HOMED
def test_home_names_the_axes_only(machine):
    assert machine.ask("printhead", command="home", axes=["x", "y"]) == ["G28 X Y"]
    homed = [axis["homed"] for axis in machine.board.model["move"]["axes"][:3]]
    assert homed[:2] == [True, True]


@on("one tool 3.5.3", "one tool 2.05")
@pytest.mark.parametrize("factor", [105, 1.05], ids=["percent", "fraction"])
def test_feedrate_is_read_back(machine, factor):
    assert machine.ask("printhead", command="feedrate", factor=factor) == ["M220 S105"]
    speed = helpers.value(machine.server, "move.speedFactor")
    assert speed == pytest.approx(1.05)


def test_what_a_person_types_stays_as_typed(machine):
    lines = ["G91", "M104 S50", "M140 S40", "G90"]
    assert machine.ask("command", commands=lines) == lines
