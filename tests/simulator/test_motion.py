"""Moves, homing, limits, coordinates and what keeps them."""

from __future__ import annotations

import pytest

from octoprint_rrfmodel.simulator.hardware.planning import START_DELAY


def positions(board, member="machinePosition"):
    return [round(axis[member], 3) for axis in board.board.model["move"]["axes"]]


def test_homing_takes_its_time_axis_by_axis(bench):
    board = bench()
    board.send("G28")
    board.wait(1)
    assert board.status == "busy"
    assert board.board.model["inputs"][3]["inMacro"] is True
    board.wait(2)
    assert [axis["homed"] for axis in board.board.model["move"]["axes"]] == [True, False, False]
    assert board.wait(8) == "ok\n"
    assert all(axis["homed"] for axis in board.board.model["move"]["axes"])
    assert board.status == "idle"


@pytest.mark.parametrize(
    ("line", "homed"), [("G28 X", "X"), ("G28 X0 Z0", "XZ"), ("G28 Y", "Y"), ("G28", "XYZ")]
)
def test_homing_some_axes(bench, line, homed):
    board = bench()
    board.done(line)
    axes = board.board.model["move"]["axes"]
    assert "".join(axis["letter"] for axis in axes if axis["homed"]) == homed


def test_homing_again_unhomes_first(bench):
    board = bench().homed()
    board.send("G28 X")
    assert board.board.model["move"]["axes"][0]["homed"] is False


def test_positions_interpolate(bench):
    board = bench().homed()
    board.send("G1 X60 F600")
    board.wait(START_DELAY + 3)
    assert positions(board)[0] == pytest.approx(30, abs=0.1)
    assert board.board.model["move"]["currentMove"]["requestedSpeed"] == 10
    board.wait(3.1)
    assert positions(board)[0] == 60
    assert board.board.model["move"]["currentMove"]["requestedSpeed"] == 0


def test_feed_is_kept(bench):
    board = bench().homed()
    board.send("G1 X10 F1200", "G1 X50")
    board.wait(2.6)
    assert positions(board)[0] == 50
    assert board.ask("inputs[3].feedRate") == 20


def test_speed_factor_applies(bench):
    board = bench().homed()
    board.send("M220 S200", "G1 X60 F600")
    board.wait(3.1)
    assert positions(board)[0] == 60


def test_axis_speed_limits_the_feed(bench):
    board = bench().homed()
    board.send("G1 Z150 F60000")
    board.wait(START_DELAY + 5)
    assert positions(board)[2] == pytest.approx(75, abs=1.5)


RELATIVE = {
    "absolute": (["G90", "G1 X10", "G1 X10"], 10),
    "relative": (["G91", "G1 X10", "G1 X10"], 20),
    "inches": (["G20", "G1 X1"], 25.4),
    "millimetres again": (["G20", "G21", "G1 X10"], 10),
    "pushed and popped": (["M120 G91 G1 X10 F6000 M121", "G1 X15"], 15),
}


@pytest.mark.parametrize(("lines", "x"), RELATIVE.values(), ids=RELATIVE)
def test_modes(bench, lines, x):
    board = bench().homed()
    board.done(*lines, "M400")
    assert positions(board)[0] == pytest.approx(x)


def test_push_keeps_modes_only(bench):
    board = bench()
    board.send("G91", "M83", "G20", "M120", "G90", "M82", "G21", "M220 S50", "M121")
    modes = board.board.model["inputs"][3]
    assert (modes["axesRelative"], modes["drivesRelative"], modes["distanceUnit"]) == (
        True,
        True,
        "in",
    )
    assert board.ask("move.speedFactor") == 0.5


def test_the_stack_is_ten_deep(bench):
    board = bench()
    assert board.send(*["M120"] * 10) == "ok\n" * 10
    assert board.ask("inputs[3].stackDepth") == 10
    assert board.send("M120") == "Error: Push(): stack overflow on USB\nok\n"


def test_moves_stay_inside_the_limits(bench):
    board = bench().homed()
    assert board.done("G1 X1000 F18000", "M400") == "ok\nok\n"
    assert positions(board)[0] == 235


def test_outside_the_limits_is_an_error_on_a_router(bench):
    board = bench("cnc").homed()
    expected = "Error: G1: target position outside machine limits\nok\n"
    assert board.send("G1 X1000 F18000") == expected


@pytest.mark.parametrize("line", ["M564 S0", "M564 H0 S0"])
def test_limits_can_be_switched_off(bench, line):
    board = bench().homed()
    board.done(line, "G1 X1000 F18000", "M400")
    assert positions(board)[0] == 1000


def test_m564_h0_allows_moves_before_homing(bench):
    board = bench()
    assert board.send("M564 H0", "G1 X10 F6000") == "ok\nok\n"


def test_raw_moves_need_no_homing(bench):
    assert bench().send("G1 H2 X10") == "ok\n"


def test_homing_moves_home(bench):
    board = bench()
    board.send("G1 H1 X-300 F6000")
    assert board.ask("move.axes[0].homed") is True


def test_a_delta_needs_all_its_towers(bench):
    board = bench("delta")
    assert "insufficient axes homed" in board.send("G1 Z10")
    board.homed()
    assert positions(board) == [0, 0, 330.215]
    assert board.send("G1 Z300 F6000") == "ok\n"


def test_g92_sets_and_homes(bench):
    board = bench()
    assert board.send("G92 X12.5") == "ok\n"
    assert positions(board)[0] == 12.5
    assert board.ask("move.axes[].homed") == [True, False, False]


def test_motors_off_unhomes(bench):
    board = bench().homed()
    board.done("M84")
    assert board.ask("move.axes[].homed") == [False, False, False]
    board.homed()
    board.done("M18 X")
    assert board.ask("move.axes[].homed") == [False, True, True]


def test_m84_s_sets_the_idle_time(bench):
    board = bench().homed()
    board.done("M84 S60")
    assert board.ask("move.idle.timeout") == 60
    assert board.ask("move.axes[].homed") == [True, True, True]


BABYSTEPS = {
    "S": (["M290 S0.02"], 0.02),
    "Z": (["M290 Z-0.1"], -0.1),
    "adds up": (["M290 S0.02", "M290 S0.03"], 0.05),
    "clamped": (["M290 S5"], 1.0),
    "absolute": (["M290 S0.1", "M290 R0 S0.3"], 0.3),
}


@pytest.mark.parametrize(("lines", "offset"), BABYSTEPS.values(), ids=BABYSTEPS)
def test_babystep(bench, lines, offset):
    board = bench().homed()
    before = positions(board)[2]
    board.send(*lines)
    axis = board.board.model["move"]["axes"][2]
    assert axis["babystep"] == pytest.approx(offset)
    assert axis["machinePosition"] == pytest.approx(before + offset)
    assert axis["userPosition"] == pytest.approx(before)


def test_m290_reports(bench):
    expected = "Baby stepping offsets (mm): X:0.000 Y:0.000 Z:0.000\nok\n"
    assert bench().send("M290") == expected


SPINDLES = {
    "forward": ("M3 P0 S12000", ("forward", 12000, 12000)),
    "reverse": ("M4 P0 S500", ("reverse", 500, 500)),
    "within its limits": ("M3 P0 S50000", ("forward", 50000, 24000)),
    "stopped": ("M3 P0 S100\nM5 P0", ("stopped", 100, 0)),
    "all stopped": ("M3 P0 S100\nM5", ("stopped", 100, 0)),
    "goes on": ("M3 P0 S100\nM5 P0\nM3 P0", ("forward", 100, 100)),
}


@pytest.mark.parametrize(("lines", "expected"), SPINDLES.values(), ids=SPINDLES)
def test_spindle(bench, lines, expected):
    board = bench("cnc")
    for line in lines.splitlines():
        assert board.send(line) == "ok\n"
    spindle = board.ask("spindles[0]")
    assert (spindle["state"], spindle["active"], spindle["current"]) == expected


def test_spindle_needs_a_number_or_a_tool(bench):
    reply = bench("cnc").send("M3 S100")
    assert reply == "Error: M3: No P parameter and no active tool with spindle\nok\n"


def test_workplace_and_tool_offsets(bench):
    board = bench("toolchanger").homed()
    board.send("G10 L2 P2 X100", "G55")
    board.done("T3", "G1 X10 F6000", "M400")
    x = board.board.model["move"]["axes"][0]
    assert x["userPosition"] == pytest.approx(10)
    assert x["machinePosition"] == pytest.approx(110 - 0.21)
    assert board.ask("move.workplaceNumber") == 1


def hot(bench, machine="cartesian", number=0):
    board = bench(machine).homed()
    board.done(f"T{number}", "M109 S200")
    return board


EXTRUSION = {
    "relative": (["M83", "G1 E5 F300", "G1 E3"], 8),
    "absolute": (["M82", "G92 E0", "G1 E5 F300", "G1 E8"], 8),
    "absolute after a reset": (["M82", "G92 E0", "G1 E5 F300", "G92 E0", "G1 E2"], 7),
    "with a move": (["M83", "G1 X10 E2 F600"], 2),
    "retraction": (["M83", "G1 E5 F300", "G1 E-2"], 3),
}


@pytest.mark.parametrize(("lines", "amount"), EXTRUSION.values(), ids=EXTRUSION)
def test_extrusion(bench, lines, amount):
    board = hot(bench)
    board.done(*lines, "M400")
    extruder = board.board.model["move"]["extruders"][0]
    assert extruder["position"] == pytest.approx(amount)
    assert extruder["rawPosition"] == pytest.approx(amount)


def test_extrusion_factor_changes_what_is_extruded(bench):
    board = hot(bench)
    board.done("M221 D0 S50", "M83", "G1 E10 F600", "M400")
    extruder = board.board.model["move"]["extruders"][0]
    assert extruder["position"] == pytest.approx(5)
    assert extruder["rawPosition"] == pytest.approx(10)


def test_each_drive_of_a_tool(bench):
    board = hot(bench, "idex", 2)
    board.done("M83", "G1 E1:2 F300", "M400")
    assert board.ask("move.extruders[].position") == [1, 2]


def test_extruding_without_a_tool(bench):
    board = bench().homed()
    assert board.send("M83", "G1 E5 F300", "G1 E5") == (
        "ok\nok\nok\nError: Attempting to extrude with no tool selected.\n"
    )


def test_extruding_cold(bench):
    board = bench().homed()
    board.done("T0")
    said = board.send("G1 E5 F300")
    assert said.startswith("ok\nWarning: Tool 0 was not driven because its heater temperatures")
    assert board.send("G1 E5", "G1 E5") == "ok\nok\n"
    assert board.wait(5).count("Warning: Tool 0 was not driven") == 1
    assert board.send("M302 P1", "G1 E5") == "ok\nok\n"


def test_probing(bench):
    board = bench().homed()
    assert board.done("G30 S-1") == "Stopped at height 1.350 mm\nok\n"
    assert board.done("G29").startswith("64 points probed")
    assert board.ask("move.compensation.type") == "mesh"
    board.send("G29 S2")
    assert board.ask("move.compensation.type") == "none"
    board.send("G29 S1")
    assert board.ask("move.compensation.file") == "0:/sys/heightmap.csv"
    board.send("M561")
    assert board.ask("move.compensation.type") == "none"


def test_height_map_is_a_file_of_the_card(bench):
    board = bench().homed()
    card = board.board.card
    board.done("G29")
    lines = card.read("0:/sys/heightmap.csv").decode().splitlines()
    assert lines[0].startswith("RepRapFirmware height map file v2 generated at 2024-11-05 08:0")
    assert lines[0].endswith("mean -0.012, deviation 0.043")
    assert lines[1].startswith("axis0,axis1,min0,")
    assert lines[2] == "X,Y,15.00,215.00,15.00,195.00,-1.00,20.00,20.00,11,10"
    assert [len(line.split(",")) for line in lines[3:]] == [11] * 10
    assert {len(cell) for line in lines[3:] for cell in line.split(",")} == {7}
    board.send('G29 S3 P"other.csv"')
    assert card.read("0:/sys/other.csv") is not None
    board.send('G29 S1 P"other.csv"')
    assert board.ask("move.compensation.file") == "0:/sys/other.csv"


def test_probing_unhomed(bench):
    expected = "Error: G29: Insufficient axes homed for bed probing\nok\n"
    assert bench().done("G29") == expected


def test_probing_without_a_probe(bench):
    assert bench("cnc").done("G30") == "Error: G30: Z probe number 0 not found\nok\n"


def test_m114_while_moving(bench):
    board = bench().homed()
    board.send("G1 X60 F600")
    board.wait(START_DELAY + 3)
    told = board.send("M114")
    # where it ends, and the steps of this moment, which the acceleration keeps below 2400
    assert told == (
        "X:60.000 Y:0.000 Z:0.000 E:0.000 E0:0.0 Count 2399 0 0 Machine 60.000 0.000 0.000 "
        "Bed comp 0.000\nok\n"
    )


def seconds_of(board, *lines):
    """Return how long the moves of these lines take, in simulated seconds."""
    board.send(*lines)
    moves = board.board.motion._moves
    return [round(move.seconds, 4) for move in moves]


def test_moves_are_planned_under_acceleration_and_jerk(bench):
    board = bench().homed()
    # 3000 mm/s², 10 mm/s: from rest, around a corner, to rest; 0.2 mm of Z never get to speed
    assert seconds_of(board, "G1 X40 F2400", "G1 X40 Y40", "G1 Z0.2 F900") == [
        pytest.approx(1 + 40**2 / 240000 + 30**2 / 240000, abs=1e-3),
        pytest.approx(1 + 40**2 / 240000 + 30**2 / 240000, abs=1e-3),
        pytest.approx(2 * (0.2 / 100) ** 0.5, abs=1e-3),
    ]


def test_a_chain_of_short_moves_gets_to_speed(bench):
    board = bench().homed()
    taken = seconds_of(board, *(f"G1 X{x / 2} F6000" for x in range(1, 31)))
    assert taken[15] == pytest.approx(0.005, abs=1e-4)
    assert taken[0] == pytest.approx(taken[-1], abs=1e-3) and taken[0] > 0.01


def test_pressure_advance_makes_printing_moves_slower(bench):
    board = bench().homed()
    board.done("T0")
    board.board.model["heat"]["heaters"][1].update(current=205.0, active=205.0, state="active")
    (alone,) = seconds_of(board, "M83", "G1 X50 E5 F1200")
    # 5 mm/s of the extruder's jerk and 0.045 s: 1111 mm/s² where 1 mm takes 0.1 mm
    assert alone == pytest.approx(2.5 + 2 * 20**2 / (2 * 20 * 1111), abs=1e-3)


@pytest.mark.parametrize(("firmware", "at_once"), [("3.5.3", 4), ("3.6", 3)])
def test_room_behind_the_first_move(bench, firmware, at_once):
    board = bench(firmware=firmware).homed()
    board.send(*(f"G1 X{10 if turn % 2 else 110} F600" for turn in range(1, 8)))
    board.send("G1 X10")
    assert board.board.motion.is_full
    assert len(board.board.motion._moves) == at_once
    board.wait(0.6)
    assert len(board.board.motion._moves) == 4


def test_homing_where_it_was_homed_to_is_shorter(bench):
    board = bench().homed()
    board.send("G28")
    assert board.wait(4.2) == ""
    assert board.wait(0.3) == "ok\n"


def test_coordinates_alone_continue_on_a_router(bench):
    board = bench("cnc").homed()
    board.done("G1 X10 F6000", "X20 Y5", "M400")
    assert positions(board)[:2] == [20, 5]


def test_time_goes_on(bench):
    board = bench()
    board.wait(75.25)
    state = board.board.model["state"]
    assert (state["upTime"], state["msUpTime"]) == (75, 250)
    assert state["time"] == "2024-11-05T08:01:15"


def test_speed_makes_time_go_faster(bench):
    board = bench(speed=60)
    board.wait(1)
    assert board.ask("state.upTime") == 60
    board.board.speed = 1
    board.wait(5)
    assert board.ask("state.upTime") == 65
