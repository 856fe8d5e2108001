"""Tools, targets and extruding on the wire, and what the board has made of them."""

import pytest

from ..operations import on

pytestmark = pytest.mark.both_hosts(
    "each has its own code for the serial line", once_for=("machine",)
)

TOOLED = on("one tool 2.05", "one tool 3.3", "one tool 3.5.3", "one tool 3.7")
CHANGERS = on("changer 2.05", "changer 3.3", "changer 3.5.3", "changer 3.6")
BARE = on("no tools 2.05", "no tools 3.3", "no tools 3.5.3", "no tools 3.6")
TWO_BEDS = on("two beds 2.05", "two beds 3.3", "two beds 3.6")
CHAMBERS = on("chamber 2.05", "chamber 3.5.3")
BEDS = on("one tool 2.05", "one tool 3.5.3", "changer 3.6", "two beds 2.05", "two beds 3.6")


def target_lines(machine, number, target):
    """Return how a tool with one heater that isn't the current one is heated, or switched off."""
    if not machine.is_old:
        return [f"M568 P{number} S{target} A{2 if target else 0}"]
    return [f"M104 T{number} S{target}" if target else f"G10 P{number} S-273.15 R-273.15"]


def off(machine, code):
    """Return how the first bed or chamber is switched off."""
    return f"M120 {code} P0 S-273.15 M121" if machine.is_old else f"{code} P0 S{{-273.15}}"


@TOOLED
def test_target_heats_and_zero_switches_off(machine):
    wire = machine.ask("tool", command="target", targets={"tool0": 205})
    assert wire == target_lines(machine, 0, 205)
    assert machine.heater(0)["state"] in ("active", "standby")
    assert machine.tool(0)["active"] == [205]
    assert machine.shown("tool", "tool0")["target"] == 205
    wire = machine.ask("tool", command="target", targets={"tool0": 0})
    assert wire == target_lines(machine, 0, 0)
    assert machine.heater(0)["state"] == "off"
    assert machine.shown("tool", "tool0")["target"] == 0


@on("one tool 2.05", "one tool 3.3", "changer 2.05", "changer 3.6")
def test_target_of_the_current_tool_leaves_standby_alone(machine):
    number = min(tool["number"] for tool in machine.board.model["tools"] if tool)
    machine.ask("tool", command="select", tool=f"tool{number}")
    machine.execute(f"G10 P{number} R120")
    # without a number OctoPrint means the current tool
    wire = machine.ask("tool", command="target", targets={"tool": 190})
    assert wire == target_lines(machine, number, 190) + (
        [f"G10 P{number} R120"] if machine.is_old else []
    )
    assert machine.tool(number)["active"] == [190]
    assert machine.tool(number)["standby"] == [120]
    assert machine.heater(number)["state"] == "active"
    assert machine.shown("tool", f"tool{number}")["target"] == 190


@CHANGERS
def test_targets_of_tools_by_their_numbers(machine):
    wire = machine.ask("tool", command="target", targets={"tool3": 190, "tool10": 200})
    assert sorted(wire) == sorted(target_lines(machine, 3, 190) + target_lines(machine, 10, 200))
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
    assert machine.ask("tool", command="target", targets={"tool3": 0}) == (
        target_lines(machine, 3, 0)
    )
    assert machine.heater(3)["state"] == "off"
    assert machine.heater(10)["state"] != "off"


@on("changer 3.5.3", "changer 3.3")
def test_target_leaves_standby_alone(machine):
    machine.execute("M568 P3 R120")
    machine.ask("tool", command="target", targets={"tool3": 190})
    assert machine.tool(3)["standby"] == [120]


@TWO_BEDS
def test_all_heaters_of_a_tool(machine):
    wire = machine.ask("tool", command="target", targets={"tool2": 205})
    assert wire == ["M104 T2 S205" if machine.is_old else "M568 P2 S205:205 A2"]
    assert machine.tool(2)["active"] == [205, 205]
    assert {heater["state"] for heater in machine.heaters(2)} <= {"active", "standby"}
    assert machine.shown("tool", "tool2")["target"] == 205
    wire = machine.ask("tool", command="target", targets={"tool2": 0})
    off = "-273.15:-273.15"
    assert wire == [f"G10 P2 S{off} R{off}" if machine.is_old else "M568 P2 S0:0 A0"]
    assert [heater["state"] for heater in machine.heaters(2)] == ["off", "off"]
    assert machine.shown("tool", "tool2")["target"] == 0


@TWO_BEDS
def test_heater_that_another_current_tool_uses_stays_on(machine):
    machine.ask("tool", command="select", tool="tool0")
    machine.ask("tool", command="target", targets={"tool0": 210})
    machine.ask("tool", command="target", targets={"tool2": 0})
    assert machine.heater(0)["state"] == "active"
    assert [heater["state"] for heater in machine.heaters(2)] == ["active", "off"]
    assert machine.shown("tool", "tool0")["target"] == 210


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
    machine.wire(where, **request)
    machine.server.wait_for(
        lambda: machine.shown(path, heater)["target"] == target, 1, "the new target to show"
    )
    for _ in range(4):
        machine.look()
    targets = [entry[heater]["target"] for entry in machine.history(path)]
    assert set(targets[targets.index(target) :]) == {target}


@CHANGERS
def test_tool_is_selected_by_its_number(machine):
    assert machine.ask("tool", command="select", tool="tool3") == ["T3"]
    assert machine.current_tool == 3


@CHANGERS
def test_a_tool_that_does_not_exist_is_not_sent(machine):
    machine.ask("tool", command="select", tool="tool1")
    assert machine.ask("tool", command="select", tool="tool2") == []
    assert machine.current_tool == 1


@on(
    "one tool 2.05", "one tool 3.3", "one tool 3.7", "changer 2.05", "changer 3.5.3", "two beds 3.6"
)
def test_extruding_keeps_the_mode_and_needs_heat(machine):
    number = max(tool["number"] for tool in machine.board.model["tools"] if tool)
    machine.ask("tool", command="select", tool=f"tool{number}")
    assert machine.wire("tool", command="extrude", amount=5) == []
    machine.ask("tool", command="target", targets={"tool": 210})
    machine.warm(number)
    relative = machine.usb.get("drivesRelative")
    before = machine.filament(number)
    assert machine.ask("tool", command="extrude", amount=5) == ["M120 M83 G1 E5 F300 M121"]
    assert machine.filament(number) - before == pytest.approx(5)
    assert machine.wire("tool", command="extrude", amount=-2.5, speed=120) == [
        "M120 M83 G1 E-2.5 F120 M121"
    ]
    assert machine.filament(number) - before == pytest.approx(2.5)
    assert machine.usb.get("drivesRelative") == relative
    assert machine.server.state() == "Operational"


@pytest.mark.parametrize("factor, share", [(95, 0.95), (1.1, 1.1)], ids=["percent", "fraction"])
@on("one tool 2.05", "one tool 3.7", "changer 3.3", "changer 3.5.3", "two beds 3.6")
def test_flowrate_is_that_of_the_current_tool(machine, factor, share):
    number = max(tool["number"] for tool in machine.board.model["tools"] if tool)
    assert machine.wire("tool", command="flowrate", factor=factor) == []
    machine.ask("tool", command="select", tool=f"tool{number}")
    extruders = machine.tool(number)["extruders"]
    assert machine.ask("tool", command="flowrate", factor=factor) == [
        f"M221 D{extruder} S{round(share * 100)}" for extruder in extruders
    ]
    factors = [extruder["factor"] for extruder in machine.board.model["move"]["extruders"]]
    assert [factors[extruder] for extruder in extruders] == [pytest.approx(share)] * len(extruders)
    others = set(range(len(factors))) - set(extruders)
    assert all(factors[extruder] == 1 for extruder in others)


@BEDS
def test_bed_heats_and_zero_switches_off(machine):
    assert machine.ask("bed", command="target", target=60) == ["M140 P0 S60"]
    assert machine.slot("bedHeaters")["state"] == "active"
    assert machine.shown("bed", "bed")["target"] == 60
    assert machine.ask("bed", command="target", target=0) == [off(machine, "M140")]
    assert machine.slot("bedHeaters")["state"] == "off"
    targets = {entry["bed"]["target"] for entry in machine.history("bed") if "bed" in entry}
    assert targets <= {None, 0, 60}


@TWO_BEDS
def test_the_other_bed_is_another_one(machine):
    machine.ask("bed", command="target", target=60)
    machine.execute("M140 P1 S70")
    assert machine.slot("bedHeaters", 1)["active"] == 70
    assert machine.ask("bed", command="target", target=0) == [off(machine, "M140")]
    assert machine.slot("bedHeaters", 1)["state"] == "active"
    targets = {entry["bed"]["target"] for entry in machine.history("bed") if "bed" in entry}
    assert targets <= {None, 0, 60}


@CHAMBERS
def test_chamber_heats_and_zero_switches_off(machine):
    assert machine.ask("chamber", command="target", target=50) == ["M141 P0 S50"]
    assert machine.slot("chamberHeaters")["state"] == "active"
    assert machine.shown("chamber", "chamber")["target"] == 50
    assert machine.ask("chamber", command="target", target=0) == [off(machine, "M141")]
    assert machine.slot("chamberHeaters")["state"] == "off"


@BARE
@pytest.mark.parametrize(
    "path, request_",
    [
        ("tool", {"command": "target", "targets": {"tool0": 200}}),
        ("tool", {"command": "target", "targets": {"tool": 200}}),
        ("tool", {"command": "select", "tool": "tool0"}),
        ("tool", {"command": "extrude", "amount": 5}),
        ("tool", {"command": "flowrate", "factor": 95}),
        ("bed", {"command": "target", "target": 60}),
        ("chamber", {"command": "target", "target": 50}),
    ],
    ids=lambda value: value if isinstance(value, str) else value["command"],
)
def test_what_the_machine_has_not_got_is_not_sent(machine, path, request_):
    assert machine.wire(path, **request_) == []
    assert machine.server.state() == "Operational"


OFFSETS = {"tool": {"offsets": {"tool0": 5}}, "bed": {"offset": -3}, "chamber": {"offset": 2}}


@pytest.fixture
def offsets(machine):
    for path, offset in OFFSETS.items():
        assert machine.wire(path, command="offset", **offset) == []
    yield
    machine.wire("tool", command="offset", offsets={"tool0": 0})
    for path in ("bed", "chamber"):
        machine.wire(path, command="offset", offset=0)


@CHAMBERS
def test_offsets_are_added_once_and_only_to_a_file(machine, offsets):
    lines = ["M140 S60", "M141 S40", "M104 T0 S200", "M104 T0 S0", "M140 S0"]
    machine.server.upload("heats.gcode", "\n".join(lines) + "\n")
    before = len(machine.board.received())
    machine.server.select_and_print("heats.gcode")
    machine.server.wait_for(
        lambda: "M140 S0" in machine.sent_since(before), 20, "the end of the file"
    )
    machine.server.wait_state("Operational", 20)
    wanted = {"M140": [57, 0], "M141": [42], "M104": [205, 0]}
    sent = [line for line in machine.sent_since(before) if line.split()[0] in wanted]
    assert {
        code: [float(line.rpartition("S")[2]) for line in sent if line.startswith(code)]
        for code in wanted
    } == wanted
    # what a person sets is what the machine gets
    machine.ask("chamber", command="target", target=50)
    assert machine.slot("chamberHeaters")["active"] == 50
    machine.ask("tool", command="target", targets={"tool0": 210})
    assert machine.tool(0)["active"] == [210]
    assert machine.shown("tool", "tool0")["offset"] == 5
    assert machine.shown("bed", "bed")["offset"] == -3
