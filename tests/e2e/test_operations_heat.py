"""Tools, targets and extruding on the wire, and what the board has made of them."""

import pytest

from .operations import on

TOOLED = on("one tool 3.5.3", "one tool 2.05", "one tool 3.3", "one tool 3.6")
CHANGERS = on("changer 3.5.3", "changer 3.3", "changer 2.05")


@TOOLED
def test_target_heats_and_zero_switches_off(machine):
    machine.ask("tool", command="target", targets={"tool0": 205})
    assert machine.heater(0)["state"] in ("active", "standby")
    assert machine.tool(0)["active"] == [205]
    tool = machine.server.get("/api/printer/tool").json()["tool0"]
    assert tool["target"] == 205
    machine.ask("tool", command="target", targets={"tool0": 0})
    assert machine.heater(0)["state"] == "off"
    assert machine.server.get("/api/printer/tool").json()["tool0"]["target"] == 0


@CHANGERS
def test_targets_of_tools_by_their_numbers(machine):
    machine.ask("tool", command="target", targets={"tool3": 190, "tool10": 200})
    assert machine.heater(3)["state"] != "off"
    assert machine.tool(3)["active"] == [190]
    assert machine.tool(10)["active"] == [200]
    assert machine.heater(1)["state"] == "off"
    shown = machine.server.get("/api/printer/tool").json()
    assert {name: tool["target"] for name, tool in shown.items()} == {
        "tool1": 0,
        "tool3": 190,
        "tool7": 0,
        "tool10": 200,
    }
    machine.ask("tool", command="target", targets={"tool3": 0})
    assert machine.heater(3)["state"] == "off"
    assert machine.heater(10)["state"] != "off"


@on("changer 3.5.3", "changer 3.3")
def test_target_leaves_standby_alone(machine):
    machine.board.execute("M568 P3 R120")
    machine.ask("tool", command="target", targets={"tool3": 190})
    assert machine.tool(3)["standby"] == [120]


@pytest.mark.parametrize(
    "path, heater, target, request_",
    [
        pytest.param(
            "tool",
            "tool0",
            211,
            ("tool", {"command": "target", "targets": {"tool0": 211}}),
            id="operation",
        ),
        pytest.param("tool", "tool0", 212, ("command", {"command": "M104 S212"}), id="typed"),
        pytest.param("bed", "bed", 61, ("bed", {"command": "target", "target": 61}), id="bed"),
    ],
)
def test_target_shows_within_a_second_and_stays(machine, path, heater, target, request_):
    # so that there is something else to ask about before the heaters
    machine.board.bump("fans", "network", "sensors", "volumes")
    machine.look()
    where, request = request_
    assert machine.server.post(f"/api/printer/{where}", json=request).status_code == 204
    machine.server.wait_for(
        lambda: machine.shown(path, heater)["target"] == target, 1, "the new target to show"
    )
    for _ in range(4):
        machine.look()
    targets = [entry[heater]["target"] for entry in machine.history(path)]
    assert set(targets[targets.index(target) :]) == {target}


@CHANGERS
def test_tool_is_selected_by_its_number(machine):
    assert "T3" in machine.ask("tool", command="select", tool="tool3")
    assert machine.board.model["state"]["currentTool"] == 3


@CHANGERS
def test_a_tool_that_does_not_exist_is_not_sent(machine):
    machine.ask("tool", command="select", tool="tool1")
    assert machine.ask("tool", command="select", tool="tool2") == []
    assert machine.board.model["state"]["currentTool"] == 1


@TOOLED
def test_extruding_keeps_the_mode_and_needs_heat(machine):
    machine.ask("tool", command="select", tool="tool0")
    assert machine.ask("tool", command="extrude", amount=5) == []
    machine.ask("tool", command="target", targets={"tool0": 210})
    machine.server.wait_for(
        lambda: machine.heater(0)["current"] > 200, 120, "the simulated tool to be hot"
    )
    machine.settle()
    relative = machine.usb.get("drivesRelative")
    lines = machine.ask("tool", command="extrude", amount=5)
    assert [line.split()[:3] for line in lines] == [["M120", "M83", "G1"]]
    assert machine.usb.get("drivesRelative") == relative
    assert machine.server.state() == "Operational"


@on("one tool 3.5.3", "one tool 2.05", "changer 3.5.3")
def test_flowrate_is_that_of_the_current_tool(machine):
    number = next(t for t in machine.board.model["tools"] if t)["number"]
    assert machine.ask("tool", command="flowrate", factor=95) == []
    machine.ask("tool", command="select", tool=f"tool{number}")
    assert machine.ask("tool", command="flowrate", factor=0.9) == ["M221 D0 S90"]
    assert machine.board.model["move"]["extruders"][0]["factor"] == pytest.approx(0.9)


@on("one tool 3.5.3", "one tool 2.05", "changer 3.5.3")
def test_bed_heats_and_zero_switches_off(machine):
    bed = machine.board.model["heat"]["bedHeaters"][0]
    machine.ask("bed", command="target", target=60)
    assert machine.board.model["heat"]["heaters"][bed]["state"] == "active"
    assert machine.server.get("/api/printer/bed").json()["bed"]["target"] == 60
    machine.ask("bed", command="target", target=0)
    assert machine.board.model["heat"]["heaters"][bed]["state"] == "off"
    targets = {entry["bed"]["target"] for entry in machine.history("bed") if "bed" in entry}
    assert targets <= {None, 0, 60}


@on("chamber 3.5.3")
def test_chamber_heats_and_zero_switches_off(machine):
    chamber = machine.board.model["heat"]["chamberHeaters"][0]
    machine.ask("chamber", command="target", target=50)
    assert machine.board.model["heat"]["heaters"][chamber]["state"] == "active"
    assert machine.server.get("/api/printer/chamber").json()["chamber"]["target"] == 50
    machine.ask("chamber", command="target", target=0)
    assert machine.board.model["heat"]["heaters"][chamber]["state"] == "off"


@on("no tools 3.6")
@pytest.mark.parametrize(
    "path, request_",
    [
        ("tool", {"command": "target", "targets": {"tool0": 200}}),
        ("tool", {"command": "select", "tool": "tool0"}),
        ("tool", {"command": "extrude", "amount": 5}),
        ("tool", {"command": "flowrate", "factor": 95}),
        ("bed", {"command": "target", "target": 60}),
        ("chamber", {"command": "target", "target": 50}),
    ],
    ids=lambda value: value if isinstance(value, str) else value["command"],
)
def test_what_the_machine_has_not_got_is_not_sent(machine, path, request_):
    assert machine.ask(path, **request_) == []
    assert machine.server.state() == "Operational"
