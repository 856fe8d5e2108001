"""``gcode_move``, ``toolhead``, ``motion_report``, ``bed_mesh``: one row a field and case."""

import pytest

from octoprint_rrfmodel.rrf.card.height_map import HeightMap
from octoprint_rrfmodel.rrf.klipper import names

from . import HOST, Machine, changed, get, model_of, whole, world


def channel(name, **members):
    return {
        "name": name,
        "feedRate": 50.0,
        "axesRelative": False,
        "drivesRelative": True,
        **members,
    }


CHANNELS = [
    channel("HTTP", feedRate=1.0),
    channel("File", feedRate=20.0, axesRelative=True, drivesRelative=False),
    channel("USB", feedRate=30.0),
    None,
    channel("Aux", feedRate=40.0),
]

# status, inputs, thisInput -> the speed of the channel that counts
CHANNELS_BY_STATUS = [
    *((status, CHANNELS, None, 30.0) for status in ("idle", "busy", "cancelling", "changingTool")),
    *(
        (status, CHANNELS, None, 20.0)
        for status in ("processing", "simulating", "pausing", "resuming", "paused")
    ),
    ("idle", CHANNELS, 2, 30.0),
    ("idle", CHANNELS, 4, 40.0),
    ("idle", CHANNELS, 0, 30.0),
    ("idle", CHANNELS, 3, 30.0),
    ("idle", [None, *CHANNELS[3:]], None, 40.0),
    ("idle", [None], None, 0.0),
    ("processing", [channel("USB")], None, 0.0),
    ("idle", None, None, 0.0),
]


@pytest.mark.parametrize(("status", "inputs", "own", "speed"), CHANNELS_BY_STATUS)
def test_speed_is_that_of_the_channel_that_feeds_motion(status, inputs, own, speed):
    model = {"state": {"status": status, "thisInput": own}, "inputs": inputs}
    assert get(world(model), "gcode_move", "speed") == speed


@pytest.mark.parametrize(
    ("status", "absolute_coordinates", "absolute_extrude"),
    [("idle", True, False), ("processing", False, True), ("paused", False, True)],
)
def test_modes_are_those_of_the_channel(status, absolute_coordinates, absolute_extrude):
    at = world({"state": {"status": status}, "inputs": CHANNELS})
    assert get(at, "gcode_move", "absolute_coordinates") is absolute_coordinates
    assert get(at, "gcode_move", "absolute_extrude") is absolute_extrude


AXES = [
    {
        "letter": letter,
        "machinePosition": position,
        "userPosition": position - 1,
        "babystep": babystep,
        "homed": homed,
        "speed": speed,
        "acceleration": acceleration,
        "jerk": 600.0,
        "min": -5.0,
        "max": maximum,
    }
    for letter, position, babystep, homed, speed, acceleration, maximum in (
        ("X", 10.5, 0.0, True, 18000.0, 3000.0, 200.0),
        ("Y", 20.5, 0.01, False, 12000.0, 2500.0, 210.0),
        ("Z", 3.5, -0.05, True, 900.0, 100.0, 220.0),
        ("U", 99.0, 0.5, True, 60.0, 1.0, 300.0),
    )
]
EXTRUDERS = [
    {"factor": 0.9, "position": 1.0},
    {"factor": 1.1, "position": 2.0},
]
TOOLS = [
    {"number": 0, "extruders": [1], "heaters": [0]},
    None,
    {"number": 2, "extruders": []},
]
MOVE = {
    "axes": AXES,
    "extruders": EXTRUDERS,
    "virtualEPos": 12.5,
    "speedFactor": 1.2,
    "printingAcceleration": 2000.0,
    "currentMove": {"topSpeed": 80.0, "requestedSpeed": 100.0, "extrusionRate": 4.5},
}
MODEL = {
    "move": MOVE,
    "state": {"status": "idle", "currentTool": 0, "upTime": 100, "msUpTime": 250},
    "tools": TOOLS,
    "heat": {"heaters": [{"current": 20.0, "state": "off"}]},
}

# object, field, what is changed, the value
FIELDS = [
    ("gcode_move", "speed_factor", {}, 1.2),
    ("gcode_move", "speed_factor", {"move.speedFactor": None}, 1.0),
    (
        "gcode_move",
        "speed_factor",
        {"move.speedFactor": None, "move.motionSystems": [{"speedFactor": 0.5}]},
        0.5,
    ),
    ("gcode_move", "extrude_factor", {}, 1.1),
    ("gcode_move", "extrude_factor", {"state.currentTool": -1}, 0.9),
    ("gcode_move", "extrude_factor", {"state.currentTool": 2}, 1.0),
    ("gcode_move", "extrude_factor", {"state.currentTool": 9}, 0.9),
    ("gcode_move", "extrude_factor", {"move.extruders": []}, 1.0),
    ("gcode_move", "homing_origin", {}, [0.0, 0.01, -0.05, 0.0]),
    ("gcode_move", "homing_origin", {"move.axes": None}, [0.0] * 4),
    ("gcode_move", "position", {}, [10.5, 20.5, 3.5, 12.5]),
    ("gcode_move", "position", {"move.axes[1].machinePosition": None}, [10.5, 0.0, 3.5, 12.5]),
    ("gcode_move", "position", {"move.virtualEPos": None}, [10.5, 20.5, 3.5, 0.0]),
    ("gcode_move", "position", {"move.axes": AXES[::-1]}, [10.5, 20.5, 3.5, 12.5]),
    ("gcode_move", "position", {"move.axes": AXES[:1]}, [10.5, 0.0, 0.0, 12.5]),
    ("gcode_move", "position", {"move.axes[0].letter": None}, [10.5, 20.5, 3.5, 12.5]),
    ("gcode_move", "gcode_position", {}, [9.5, 19.5, 2.5, 12.5]),
    ("gcode_move", "gcode_position", {"move": {}}, [0.0] * 4),
    ("gcode_move", "axis_map", {}, {"X": 0, "Y": 1, "Z": 2, "E": 3}),
    ("toolhead", "homed_axes", {}, "xz"),
    ("toolhead", "homed_axes", {"move.axes[1].homed": True}, "xyz"),
    ("toolhead", "homed_axes", {"move.axes": None}, ""),
    ("toolhead", "homed_axes", {"move.axes": [AXES[2], AXES[0]]}, "zx"),
    ("toolhead", "homed_axes", {"move.axes": [{"letter": "x", "homed": True}]}, ""),
    ("toolhead", "print_time", {}, 100.25),
    ("toolhead", "print_time", {"state.msUpTime": None}, 100.0),
    ("toolhead", "print_time", {"state.upTime": None}, None),
    ("toolhead", "estimated_print_time", {}, 100.25),
    ("toolhead", "extruder", {}, "extruder"),
    ("toolhead", "extruder", {"tools[0].number": 7, "state.currentTool": 7}, "extruder7"),
    ("toolhead", "extruder", {"state.currentTool": -1}, ""),
    ("toolhead", "extruder", {"state.currentTool": 2}, ""),
    ("toolhead", "extruder", {"state.currentTool": None}, ""),
    ("toolhead", "position", {}, [10.5, 20.5, 3.5, 12.5]),
    ("toolhead", "max_velocity", {}, 200.0),
    ("toolhead", "max_velocity", {"move.axes[1].speed": None}, 300.0),
    ("toolhead", "max_velocity", {"move.axes": []}, None),
    ("toolhead", "max_accel", {}, 2000.0),
    ("toolhead", "max_accel", {"move.printingAcceleration": 20000.0}, 2500.0),
    ("toolhead", "max_accel", {"move": {}}, None),
    ("toolhead", "max_accel_to_decel", {}, 1000.0),
    ("toolhead", "max_accel_to_decel", {"move": {}}, None),
    ("toolhead", "square_corner_velocity", {}, 10.0),
    ("toolhead", "square_corner_velocity", {"move": {}}, None),
    ("toolhead", "axis_minimum", {}, [-5.0, -5.0, -5.0, 0.0]),
    ("toolhead", "axis_minimum", {"move": {}}, [None, None, None, 0.0]),
    ("toolhead", "axis_maximum", {}, [200.0, 210.0, 220.0, 0.0]),
    ("toolhead", "stalls", {}, 0),
    ("toolhead", "minimum_cruise_ratio", {}, 0.5),
    ("toolhead", "extra_axes", {}, {"extruder": 3}),
    ("toolhead", "extra_axes", {"state.currentTool": -1}, {}),
    ("toolhead", "cone_start_z", {}, None),
    ("motion_report", "live_position", {}, [10.5, 20.5, 3.5, 12.5]),
    ("motion_report", "live_velocity", {}, 80.0),
    ("motion_report", "live_velocity", {"move.currentMove.topSpeed": None}, 100.0),
    ("motion_report", "live_velocity", {"move.currentMove": None}, None),
    ("motion_report", "live_extruder_velocity", {}, 4.5),
    ("motion_report", "live_extruder_velocity", {"move.currentMove.extrusionRate": None}, None),
    ("motion_report", "steppers", {}, ["X", "Y", "Z", "U"]),
    ("motion_report", "trapq", {}, []),
]


@pytest.mark.parametrize(("name", "field", "changes", "value"), FIELDS)
def test_field(name, field, changes, value):
    assert get(world(changed(MODEL, **changes)), name, field) == value


def test_defaults_where_nothing_is_known():
    at = world({})
    assert whole(at, "gcode_move") == {
        "speed_factor": 1.0,
        "speed": 0.0,
        "extrude_factor": 1.0,
        "absolute_coordinates": True,
        "absolute_extrude": True,
        "homing_origin": [0.0] * 4,
        "position": [0.0] * 4,
        "gcode_position": [0.0] * 4,
        "axis_map": {"X": 0, "Y": 1, "Z": 2, "E": 3},
    }
    assert "motion_report" not in names(at)


@pytest.mark.parametrize("machine", ["toolchanger", "manyaxes", "cnc", "delta"])
def test_coordinates_have_four_entries(machine):
    at = world(model_of(machine))
    for name, field in (
        ("gcode_move", "position"),
        ("gcode_move", "gcode_position"),
        ("gcode_move", "homing_origin"),
        ("toolhead", "position"),
        ("toolhead", "axis_minimum"),
        ("toolhead", "axis_maximum"),
        ("motion_report", "live_position"),
    ):
        assert len(get(at, name, field)) == 4


@pytest.mark.parametrize("firmware", ["2.05", "3.3", "3.6", "3.7"])
def test_machine_position_is_user_position_and_babystep(firmware):
    machine = Machine("cartesian", firmware)
    machine.send("G28")
    machine.until(lambda machine: machine.status == "idle")
    machine.send("M290 S0.05", "G1 X10 Y20 Z5 F6000")
    machine.wait(30)
    position = machine.get("gcode_move", "position")
    user = machine.get("gcode_move", "gcode_position")
    origin = machine.get("gcode_move", "homing_origin")
    assert origin == [0.0, 0.0, 0.05, 0.0]
    assert user[:3] == pytest.approx([10.0, 20.0, 5.0], abs=0.001)
    assert position == pytest.approx([u + o for u, o in zip(user, origin)], abs=0.001)
    assert machine.get("toolhead", "homed_axes") == "xyz"


TOWER = {"diagonal": 250.0, "endstopAdjustment": 0.0}
DELTA = {
    "name": "delta",
    "deltaRadius": 150.0,
    "homedHeight": 300.0,
    "towers": [TOWER, {**TOWER, "endstopAdjustment": -0.5}, TOWER],
}


@pytest.mark.parametrize(
    ("changes", "value"),
    [
        # 300 - 0.5 + sqrt(250² - 150²) - 250
        pytest.param({}, 249.5, id="lowest tower"),
        pytest.param({"homedHeight": None}, None, id="no height"),
        pytest.param({"deltaRadius": 300.0}, None, id="radius beyond the arm"),
        pytest.param({"towers": []}, None, id="no towers"),
        pytest.param({"towers": [None]}, None, id="tower is null"),
    ],
)
def test_cone_of_a_delta(changes, value):
    at = world({"move": {"kinematics": {**DELTA, **changes}}})
    assert get(at, "toolhead", "cone_start_z") == value
    assert "cone_start_z" in whole(at, "toolhead")


@pytest.mark.parametrize("name", ["cartesian", "coreXY", "Rotary delta", None, 5])
def test_only_a_delta_has_a_cone(name):
    at = world({"move": {"kinematics": {"name": name}}})
    assert "cone_start_z" not in whole(at, "toolhead")


def test_simulated_delta_has_a_cone():
    cone = get(world(model_of("delta")), "toolhead", "cone_start_z")
    assert 0 < cone < 330


GRID = {"axes": ["X", "Y"], "mins": [15.0, 20.0], "maxs": [215.0, 195.0]}

MESHES = [
    (None, "", [0.0, 0.0], [0.0, 0.0]),
    ({"type": "none", "file": None, "liveGrid": None}, "", [0.0, 0.0], [0.0, 0.0]),
    (
        {"type": "mesh", "file": "0:/sys/heightmap.csv", "liveGrid": GRID},
        "heightmap",
        [15.0, 20.0],
        [215.0, 195.0],
    ),
    ({"type": "mesh", "file": "cold.CSV", "liveGrid": None}, "cold", [0.0, 0.0], [0.0, 0.0]),
    ({"type": "mesh", "file": None}, "default", [0.0, 0.0], [0.0, 0.0]),
    ({"type": "Mesh"}, "default", [0.0, 0.0], [0.0, 0.0]),
    (
        {"type": "mesh", "file": "a.csv", "liveGrid": {**GRID, "axes": ["Y", "X"]}},
        "a",
        [20.0, 15.0],
        [195.0, 215.0],
    ),
    ({"type": "mesh", "liveGrid": {"mins": [1.0], "maxs": "x"}}, "default", [0, 0], [0, 0]),
]


@pytest.mark.parametrize(("compensation", "profile", "low", "high"), MESHES)
def test_bed_mesh(compensation, profile, low, high):
    assert whole(world({"move": {"compensation": compensation}}), "bed_mesh") == {
        "profile_name": profile,
        "mesh_min": low,
        "mesh_max": high,
        "probed_matrix": [[]],
        "mesh_matrix": [[]],
        "profiles": {},
    }


HEIGHTS = HeightMap(
    ("X", "Y"), (15.0, 20.0), (100.0, 175.0), (3, 2), -1.0, ((0.1, None, -0.2), (0.0, 0.3, 0.4))
)

ROWS = [[0.1, None, -0.2], [0.0, 0.3, 0.4]]


@pytest.mark.parametrize(
    ("heights", "kind", "matrix"),
    [
        (HEIGHTS, "mesh", ROWS),
        (HEIGHTS._replace(axes=("Y", "X")), "mesh", [[0.1, 0.0], [None, 0.3], [-0.2, 0.4]]),
        (HEIGHTS._replace(axes=("X", "Z")), "mesh", [[]]),
        (HEIGHTS, "none", [[]]),
        (None, "mesh", [[]]),
    ],
)
def test_matrix_is_that_of_the_mesh_in_use(heights, kind, matrix):
    compensation = {"type": kind, "file": "0:/sys/heightmap.csv", "liveGrid": GRID}
    at = world({"move": {"compensation": compensation}}, HOST._replace(heights=heights))
    assert get(at, "bed_mesh", "probed_matrix") == matrix
    assert get(at, "bed_mesh", "mesh_matrix") == matrix


RETRACTION = {"length": 0.8, "speed": 35.0, "unretractSpeed": 25.0, "extraRestart": 0.1, "zHop": 1}


def test_firmware_retraction_is_the_current_tools():
    model = {
        "tools": [{"number": 0, "retraction": {}}, {"number": 4, "retraction": RETRACTION}],
        "state": {"currentTool": 4},
    }
    assert whole(world(model), "firmware_retraction") == {
        "retract_length": 0.8,
        "retract_speed": 35.0,
        "unretract_extra_length": 0.1,
        "unretract_speed": 25.0,
    }
    model["state"]["currentTool"] = -1
    assert set(whole(world(model), "firmware_retraction").values()) == {None}


@pytest.mark.parametrize("tools", [[], [None], [{"number": 0}]])
def test_no_firmware_retraction_without_tools_that_retract(tools):
    at = world({"tools": tools})
    assert "firmware_retraction" not in names(at)
    assert whole(at, "firmware_retraction") == {}


@pytest.mark.parametrize(
    ("skew", "profile"),
    [
        ({"tanXY": 0.0, "tanXZ": 0, "tanYZ": 0.0, "compensateXY": True}, None),
        ({"tanXY": 0.01, "tanXZ": 0, "tanYZ": 0.0}, "default"),
        ({"tanYZ": -0.01}, "default"),
    ],
)
def test_skew_correction(skew, profile):
    at = world({"move": {"compensation": {"skew": skew}}})
    assert whole(at, "skew_correction") == {"current_profile_name": profile}


def test_no_skew_correction_where_none_is_told():
    assert "skew_correction" not in names(world(model_of("cartesian", "2.05")))
