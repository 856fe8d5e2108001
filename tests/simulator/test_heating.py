"""Heaters, tools, fans: what is set, when it heats, what the model and M105 show."""

from __future__ import annotations

import pytest


def heater(board, index):
    return board.board.model["heat"]["heaters"][index]


def tool(board, number):
    return board.board.tool(number)


def test_m104_without_a_tool_selected_heats_to_standby(bench):
    """The lowest-numbered tool is meant, and not being current it goes to standby."""
    board = bench()
    assert board.send("M104 S200") == "ok\n"
    assert (tool(board, 0)["active"], tool(board, 0)["standby"]) == ([200], [200])
    assert tool(board, 0)["state"] == "standby"
    assert heater(board, 1)["state"] == "standby"
    board.wait(600)
    assert board.send("M105") == "ok T0:200.0 /200.0 B:21.3 /0.0\n"


def test_m104_of_the_current_tool_heats_it(bench):
    board = bench()
    board.done("T0")
    board.send("M104 S200")
    assert heater(board, 1)["state"] == "active"
    assert tool(board, 0)["state"] == "active"
    board.wait(600)
    assert board.send("M105") == "ok T:200.0 /200.0 T0:200.0 /200.0 B:21.3 /0.0\n"


def test_m104_without_a_temperature_does_nothing(bench):
    board = bench()
    assert board.send("M104 T0") == "ok\n"
    assert heater(board, 1)["state"] == "off"


@pytest.mark.parametrize("line", ["M568 P0 S200", "G10 P0 S200"])
def test_setting_never_switches_a_heater_on(bench, line):
    board = bench()
    board.send(line)
    assert tool(board, 0)["active"] == [200]
    assert heater(board, 1)["state"] == "off"
    assert "T0:21.3 /0.0" in board.send("M105")


STATES = {
    "active": ("M568 P0 S200 R150 A2", "active", "active", "/200.0"),
    "standby": ("M568 P0 S200 R150 A1", "standby", "standby", "/150.0"),
    "off": ("M568 P0 S200 R150 A0", "off", "off", "/0.0"),
}


@pytest.mark.parametrize(("line", "heats", "state", "shown"), STATES.values(), ids=STATES)
def test_m568_state(bench, line, heats, state, shown):
    board = bench()
    board.send(line)
    assert heater(board, 1)["state"] == heats
    assert tool(board, 0)["state"] == state
    assert f"T0:21.3 {shown}" in board.send("M105")


def test_m568_a0_leaves_the_tools_own_state(bench):
    board = bench()
    board.done("T0")
    board.send("M568 P0 S200 A2", "M568 P0 A0")
    assert tool(board, 0)["state"] == "active"
    assert heater(board, 1)["state"] == "off"


def test_a_tool_of_two_heaters_takes_two_temperatures(bench):
    board = bench("idex")
    board.send("M568 P2 S200:190 R150")
    assert tool(board, 2)["active"] == [200, 190]
    assert tool(board, 2)["standby"] == [150, 150]


@pytest.mark.parametrize(
    ("firmware", "line", "states"),
    [
        ("3.3", "M568 P2 S0:0 A0", ("active", "off")),
        ("3.6", "M568 P2 S205:205 A2", ("active", "active")),
        ("3.6", "M568 P2 A1", ("active", "standby")),
        # R goes to a heater that no tool has put to standby, also to one in use
        ("2.05", "G10 P2 S-273.15:-273.15 R-273.15:-273.15", ("off", "off")),
        ("2.05", "G10 P2 S0:-273.15 R0:-273.15", ("active", "off")),
    ],
)
def test_heater_that_the_current_tool_uses(bench, firmware, line, states):
    board = bench("idex", firmware)
    board.done("T0")
    board.send("M104 T2 S190", "M104 S210")
    board.send(line)
    assert (heater(board, 2)["state"], heater(board, 3)["state"]) == states
    assert heater(board, 2)["active"] == 210


def test_far_below_zero_is_off(bench):
    board = bench()
    board.done("T0")
    board.send("M104 S200", "M568 P0 S-273.1")
    assert heater(board, 1)["state"] == "off"
    assert tool(board, 0)["active"] == [0]


def test_zero_is_not_off(bench):
    board = bench()
    board.done("T0")
    board.send("M104 S200", "M104 S0")
    assert heater(board, 1)["state"] == "active"
    assert tool(board, 0)["active"] == [0]


def test_selecting_heats_the_new_tool_and_puts_the_old_one_to_standby(bench):
    board = bench("toolchanger")
    for number in (1, 3):
        board.send(f"M568 P{number} S200 R150")
    board.done("T1")
    assert board.ask("state.currentTool") == 1
    assert heater(board, 1)["state"] == "active"
    said = board.send("T3")
    assert said == ""
    assert board.status == "changingTool"
    assert board.board.model["state"]["nextTool"] == 3
    assert board.until(lambda b: b.channels["USB"].is_idle) == "ok\n"
    assert heater(board, 1)["state"] == "standby"
    assert heater(board, 2)["state"] == "active"
    assert [t["state"] for t in board.board.tools()] == ["standby", "active", "off", "off"]


@pytest.mark.parametrize("line", ["T-1", "T2"])
def test_deselecting(bench, line):
    """A tool that doesn't exist deselects without a word."""
    board = bench("toolchanger")
    board.done("T1")
    assert board.done(line) == "ok\n"
    assert board.ask("state.currentTool") == -1
    assert tool(board, 1)["state"] == "standby"


@pytest.mark.parametrize(("line", "seconds"), [("T0", 3), ("T0 P2", 1.5), ("T0 P0", 0)])
def test_tool_change_macros_take_time(bench, line, seconds):
    board = bench()
    board.send(line)
    board.until(lambda b: b.channels["USB"].is_idle, step=0.25)
    assert board.time == seconds


def test_m109_selects_a_tool_where_none_is(bench):
    board = bench()
    assert board.done("M109 S200") == "ok\n"
    assert board.ask("state.currentTool") == 0
    assert heater(board, 1)["current"] > 197


def test_m109_s_does_not_wait_for_cooling(bench):
    board = bench()
    board.done("M109 S200")
    assert board.done("M109 S100", most=1) == "ok\n"
    assert board.send("M109 R50") == ""
    board.until(lambda b: b.channels["USB"].is_idle)
    assert heater(board, 1)["current"] < 53


@pytest.mark.parametrize(
    ("machine", "line", "index"),
    [("cartesian", "M190 S60", 0), ("corexy", "M191 S45", 2), ("idex", "M190 P1 S60", 1)],
)
def test_waiting_for_beds_and_chambers(bench, machine, line, index):
    board = bench(machine)
    assert board.done(line) == "ok\n"
    assert heater(board, index)["current"] > float(line.rpartition("S")[2]) - 3


SLOTS = {
    "on": ("M140 S60", "active", 60, 0),
    "standby temperature": ("M140 R40", "off", 0, 40),
    "off": ("M140 S-273.1", "off", 0, 0),
    "zero stays active": ("M140 S0", "active", 0, 0),
}


@pytest.mark.parametrize(("line", "state", "active", "standby"), SLOTS.values(), ids=SLOTS)
def test_bed(bench, line, state, active, standby):
    board = bench()
    assert board.send(line) == "ok\n"
    bed = heater(board, 0)
    assert (bed["state"], bed["active"], bed["standby"]) == (state, active, standby)


def test_m144(bench):
    board = bench()
    board.send("M140 S60 R40", "M144")
    assert heater(board, 0)["state"] == "standby"
    assert "B:21.3 /40.0" in board.send("M105")
    board.send("M144 S1")
    assert heater(board, 0)["state"] == "active"


@pytest.mark.parametrize(("line", "what"), [("M140 P2 S60", "bed"), ("M141 S50", "chamber")])
def test_a_slot_without_a_heater(bench, line, what):
    slot = 2 if "P2" in line else 0
    expected = f"Error: {line[:4]}: No {what} heater has been configured for slot {slot}\nok\n"
    assert bench().send(line) == expected
    assert bench().send(line.replace("S60", "S0").replace("S50", "S0")) == "ok\n"


def test_a_bed_may_be_as_hot_as_its_limit(bench):
    assert bench().send("M140 S125") == "ok\n"
    assert bench().send("M140 S126") == "Error: M140: Temperature too high for heater 0\nok\n"


@pytest.mark.parametrize("line", ["M568 P0 S400", "M104 S290"])
def test_out_of_range(bench, line):
    name = line.split()[0]
    expected = f"Error: {name}: Requested temperature out of range\nok\n"
    assert bench().send(line) == expected


M105 = {
    "several tools": (
        "toolchanger",
        "T1:21.3 /0.0 T3:21.3 /0.0 T7:21.3 /0.0 T10:21.3 /0.0 B:21.3 /0.0",
    ),
    "chamber": ("corexy", "T0:21.3 /0.0 B:21.3 /0.0 C:21.3 /0.0"),
    "two beds, a tool with two heaters": (
        "idex",
        "T0:21.3 /0.0 T1:21.3 /0.0 T2:21.3 /0.0 21.3 /0.0 B:21.3 /0.0 B1:21.3 /0.0",
    ),
    "nothing to heat": ("cnc", ""),
}


@pytest.mark.parametrize(("machine", "expected"), M105.values(), ids=M105)
def test_m105(bench, machine, expected):
    assert bench(machine).send("M105") == f"ok {expected}\n"


def test_temperatures_rise_and_fall(bench):
    board = bench()
    board.send("M140 S60")
    readings = []
    for _ in range(6):
        board.wait(20)
        readings.append(heater(board, 0)["current"])
    assert readings == sorted(readings)
    assert readings[-1] == 60
    assert 0 < heater(board, 0)["avgPwm"] < 1
    assert board.board.model["sensors"]["analog"][0]["lastReading"] == 60
    board.send("M140 S-273.1")
    board.wait(60)
    assert 21.3 < heater(board, 0)["current"] < 60
    board.wait(7200)
    assert heater(board, 0)["current"] == pytest.approx(21.3, abs=0.1)


def test_an_open_circuit_stays(bench):
    board = bench()
    heater(board, 1)["current"] = 2000.0
    board.wait(60)
    assert heater(board, 1)["current"] == 2000.0


FANS = {
    "fraction": ("M106 P0 S0.5", 0.5),
    "of 255": ("M106 P0 S127.5", 0.5),
    "one is all": ("M106 P0 S1", 1.0),
    "all": ("M106 P0 S255", 1.0),
    "off": ("M106 P0 S0", 0.0),
}


@pytest.mark.parametrize(("line", "value"), FANS.values(), ids=FANS)
def test_fan(bench, line, value):
    board = bench()
    assert board.send(line) == "ok\n"
    assert board.board.model["fans"][0]["requestedValue"] == value
    board.wait(1)
    assert board.board.model["fans"][0]["actualValue"] == value


def test_fan_without_a_number_is_the_tools(bench):
    board = bench("idex")
    board.done("T1")
    board.send("M106 S255")
    assert [fan["requestedValue"] for fan in board.board.model["fans"]] == [0, 1]
    board.send("M107")
    assert [fan["requestedValue"] for fan in board.board.model["fans"]] == [0, 0]


def test_thermostatic_fan_follows_its_heater(bench):
    board = bench()
    board.done("M109 S100")
    board.wait(1)
    fan = board.board.model["fans"][1]
    assert (fan["actualValue"], fan["rpm"]) == (1.0, 7200)


@pytest.mark.parametrize("line", ["M106 P7 S1", "M106 P-1 S1"])
def test_a_fan_that_is_not_there(bench, line):
    number = line.split("P")[1].split()[0]
    assert bench().send(line) == f"Error: M106: Fan number {number} not found\nok\n"


BUMPS = {
    "tool renamed": ('M563 P0 S"New"', "tools"),
    "tool offset": ("G10 P0 X1.5", "tools"),
    "fan name": ('M106 P0 C"Nozzle"', "fans"),
    "fan limits": ("M106 P0 L0.2", "fans"),
    "speed factor": ("M220 S110", "move"),
    "extrusion factor": ("M221 D0 S95", "move"),
    "baby step": ("M290 S0.02", "move"),
    "limits off": ("M564 H0", "move"),
    "coordinate system": ("G55", "move"),
    "mesh off": ("G29 S2", "move"),
    "relative": ("G91", "inputs"),
    "display message": ("M117 x", "state"),
    "machine name": ('M550 P"x"', "network"),
    "variable": ("set global.retries = 4", "global"),
    "new variable": ("global another = 4", "global"),
    "file selected": ('M23 "square.gcode"', "job"),
    "cold extrusion": ("M302 S150", "heat"),
    "bed heater assigned": ("M140 P1 H-1", "heat"),
    "ATX power": ("M81", "state"),
    "beep": ("M300 S1000 P500", "state"),
    "file written": ("M30 square.gcode", "volumes"),
}


@pytest.mark.parametrize(("line", "key"), BUMPS.values(), ids=BUMPS)
def test_what_is_not_live_counts_up_its_sequence_number(bench, line, key):
    board = bench()
    before = board.ask("seqs")
    board.send(line)
    after = board.ask("seqs")
    changed = {name for name in after if after[name] != before[name]}
    assert key in changed
    assert changed <= {key, "volChanges"}
    assert after[key] >= before[key] + 1


NO_BUMPS = ["M104 S200", "M140 S60", "M106 P0 S1", "M568 P0 S200", "G90", 'M409 K"heat"', "M114"]


@pytest.mark.parametrize("line", NO_BUMPS)
def test_live_values_do_not(bench, line):
    board = bench()
    before = board.ask("seqs")
    board.send(line)
    assert board.ask("seqs") == before


def test_sequence_numbers_wrap(bench):
    board = bench()
    board.board.model["seqs"]["move"] = 65535
    board.send("M220 S110")
    assert board.ask("seqs.move") == 0


def test_renamed_tool(bench):
    board = bench("toolchanger")
    board.send('M563 P7 S"Say ""hi"""')
    assert board.ask("tools[7].name") == 'Say "hi"'
    assert board.send("M563 P2") == "Error: M563: Tool 2 not found\nok\n"
