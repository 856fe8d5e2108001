"""Cases of the commands that set up, tune and try a machine, for the tables of all commands."""

from ..commanded import VERSIONS

FROM_33 = VERSIONS[1:]
FROM_34 = VERSIONS[2:]
FROM_35 = VERSIONS[3:]
OLD = VERSIONS[:1]
CHANGER = "toolchanger"
CURRENTS = {"move.extruders": [{"current": 800}, {"current": 850.0}]}
WITH_STRIP = {"ledStrips": [{"type": "NeoPixel_RGB"}]}
VARIABLES = {"global": {"material": "PLA", "retries": 3}}
COLOUR = {"red": 255, "green": 0, "blue": 10}

LINES = [
    # name, parameters, kind of machine, versions, members, lines
    (
        "pressure_advance",
        {"extruder": 0, "seconds": 0.045},
        "cartesian",
        VERSIONS,
        {},
        ["M572 D0 S0.045"],
    ),
    ("input_shaping", {"type": "none"}, "cartesian", FROM_34, {}, ['M593 P"none"']),
    (
        "input_shaping",
        {"type": "mzv", "frequency": 42.5, "damping": 0.1},
        "cartesian",
        FROM_34,
        {},
        ['M593 P"mzv" F42.5 S0.1'],
    ),
    (
        "motor_current",
        {"axis": "X", "milliamps": 1300},
        "cartesian",
        VERSIONS,
        {},
        ["M906 X1300"],
    ),
    (
        "motor_current",
        {"axis": "a", "milliamps": 900},
        "manyaxes",
        FROM_33,
        {},
        ["M906 'a900"],
    ),
    (
        "motor_current",
        {"extruder": 1, "milliamps": 900},
        "cartesian",
        VERSIONS,
        CURRENTS,
        ["M906 E800:900"],
    ),
    ("save_parameters", {}, "cartesian", VERSIONS, {}, ["M500"]),
    (
        "heater_tuning",
        {"heater": 1, "temperature": 210},
        "cartesian",
        OLD,
        {},
        ["M303 H1 S210"],
    ),
    (
        "heater_tuning",
        {"heater": 1, "temperature": 210},
        "cartesian",
        FROM_33,
        {},
        ["M303 T0 S210"],
    ),
    (
        "heater_tuning",
        {"heater": 0, "temperature": 60.5},
        "cartesian",
        VERSIONS,
        {},
        ["M303 H0 S60.5"],
    ),
    ("heater_tuning", {"heater": 3, "temperature": 220}, CHANGER, FROM_33, {}, ["M303 T7 S220"]),
    (
        "heater_monitor",
        {"heater": 1, "limit": 285},
        "cartesian",
        FROM_33,
        {},
        ["M143 H1 P0 S285 A0 C0"],
    ),
    (
        "heater_monitor",
        {"heater": 0, "monitor": 2, "limit": 10, "condition": "tooLow", "action": 3},
        "cartesian",
        FROM_33,
        {},
        ["M143 H0 P2 S10 A3 C1"],
    ),
    (
        "heater_monitor",
        {"heater": 0, "monitor": 1, "condition": "disabled"},
        "cartesian",
        FROM_33,
        {},
        ["M143 H0 P1 C-1"],
    ),
    ("probe", {"action": "measure"}, "cartesian", VERSIONS, {}, ["G30 S-1"]),
    ("probe", {"action": "set_z"}, "cartesian", VERSIONS, {}, ["G30"]),
    (
        "probe",
        {"probe": 1, "action": "measure"},
        "cartesian",
        FROM_33,
        {"sensors.probes": [{}, {}]},
        ["G30 K1 S-1"],
    ),
    ("probe_height", {"height": -0.25}, "cartesian", VERSIONS, {}, ["G31 Z-0.25"]),
    (
        "probe_height",
        {"probe": 1, "height": 1.35},
        "cartesian",
        FROM_33,
        {"sensors.probes": [{}, {}]},
        ["G31 K1 Z1.35"],
    ),
    ("output", {"output": 0, "value": 0.4}, "cartesian", VERSIONS, {}, ["M42 P0 S0.4"]),
    (
        "led",
        {"strip": 0, **COLOUR},
        "cartesian",
        FROM_35,
        WITH_STRIP,
        ["M150 E0 R255 U0 B10 P255 S1 F0"],
    ),
    (
        "led",
        {"strip": 0, **COLOUR, "brightness": 9, "count": 60},
        "cartesian",
        FROM_35,
        WITH_STRIP,
        ["M150 E0 R255 U0 B10 P9 S60 F0"],
    ),
    (
        "variable",
        {"name": "material", "value": 'a "b" it\'s'},
        "cartesian",
        FROM_33,
        VARIABLES,
        ['set global.material = "a ""b"" it\'\'s"'],
    ),
    (
        "variable",
        {"name": "retries", "value": -2.5},
        "cartesian",
        FROM_33,
        VARIABLES,
        ["set global.retries = -2.5"],
    ),
    (
        "variable",
        {"name": "retries", "value": False},
        "cartesian",
        FROM_33,
        VARIABLES,
        ["set global.retries = false"],
    ),
    ("restore_point", {"point": 3, "action": "save"}, "cartesian", VERSIONS, {}, ["G60 S3"]),
    (
        "restore_point",
        {"point": 0, "action": "go"},
        "cartesian",
        VERSIONS,
        {},
        ["M120 G21 G90 G1 R0 X0 Y0 Z0 F6000 M121"],
    ),
    (
        "restore_point",
        {"point": 1, "action": "go", "axes": "XY"},
        "cartesian",
        VERSIONS,
        {},
        ["M120 G21 G90 G1 R1 X0 Y0 F6000 M121"],
    ),
    ("resume_after_power_loss", {}, "cartesian", VERSIONS, {}, ["M916"]),
    ("firmware_update", {}, "cartesian", VERSIONS, {}, ["M997 S0"]),
    (
        "firmware_update",
        {"board": 20},
        "cartesian",
        VERSIONS,
        {"boards": lambda boards: [boards[0], {"canAddress": 20}]},
        ["M997 B20"],
    ),
]

MISSING = {
    "heater_monitor": {"2.05"},
    "input_shaping": {"2.05", "3.3"},
    "led": {"2.05", "3.3", "3.4"},
    "variable": {"2.05"},
}
"""Firmware that refuses a command."""

BAD = [
    # name, parameters, kind of machine, members, code
    ("pressure_advance", {"extruder": 1, "seconds": 0.1}, "cartesian", {}, "no_such_extruder"),
    ("pressure_advance", {"extruder": 0, "seconds": -0.1}, "cartesian", {}, "out_of_range"),
    ("input_shaping", {"type": "custom"}, "cartesian", {}, "wrong_word"),
    ("input_shaping", {"type": "mzv", "frequency": 0}, "cartesian", {}, "out_of_range"),
    ("motor_current", {"milliamps": 800}, "cartesian", {}, "one_of"),
    ("motor_current", {"axis": "X", "extruder": 0, "milliamps": 8}, "cartesian", {}, "one_of"),
    ("motor_current", {"axis": "U", "milliamps": 800}, "cartesian", {}, "no_such_axis"),
    ("motor_current", {"axis": "X", "milliamps": 800.5}, "cartesian", {}, "not_whole"),
    ("save_parameters", {"all": True}, "cartesian", {}, "unknown_parameter"),
    ("heater_tuning", {"heater": 1, "temperature": 290}, "cartesian", {}, "temperature"),
    ("heater_tuning", {"heater": 7, "temperature": 200}, "cartesian", {}, "no_such_heater"),
    ("heater_monitor", {"heater": 1}, "cartesian", {}, "missing_parameter"),
    ("heater_monitor", {"heater": 1, "monitor": 3}, "cartesian", {}, "out_of_range"),
    ("probe", {"action": "measure", "probe": 1}, "cartesian", {}, "no_such_probe"),
    ("probe_height", {"height": 101}, "cartesian", {}, "out_of_range"),
    ("output", {"output": 1, "value": 1}, "cartesian", {}, "no_such_output"),
    ("output", {"output": 0, "value": 2}, "cartesian", {}, "out_of_range"),
    ("led", {"strip": 1, **COLOUR}, "cartesian", {}, "no_such_strip"),
    ("led", {"strip": 0, **COLOUR, "count": 0}, "cartesian", {}, "out_of_range"),
    ("variable", {"name": "other", "value": 1}, "cartesian", {}, "no_such_variable"),
    ("variable", {"name": "a b", "value": 1}, "cartesian", {"global": {}}, "no_such_variable"),
    ("variable", {"name": "material", "value": "a;b"}, "cartesian", {}, "unsendable"),
    ("variable", {"name": "material", "value": [1]}, "cartesian", {}, "not_a_text"),
    ("variable", {"name": "material", "value": 1e300}, "cartesian", {}, "out_of_range"),
    ("restore_point", {"point": 6, "action": "save"}, "cartesian", {}, "out_of_range"),
    ("resume_after_power_loss", {"now": True}, "cartesian", {}, "unknown_parameter"),
    ("firmware_update", {"board": 20}, "cartesian", {}, "no_such_board"),
]

VALID = {
    "pressure_advance": {"extruder": 0, "seconds": 0.05},
    "input_shaping": {"type": "mzv"},
    "motor_current": {"axis": "X", "milliamps": 800},
    "save_parameters": {},
    "heater_tuning": {"heater": 1, "temperature": 200},
    "heater_monitor": {"heater": 1, "limit": 280},
    "probe": {"action": "measure"},
    "probe_height": {"height": 1.2},
    "output": {"output": 0, "value": 1},
    "led": {"strip": 0, **COLOUR},
    "variable": {"name": "retries", "value": 4},
    "restore_point": {"point": 0, "action": "save"},
    "resume_after_power_loss": {},
    "firmware_update": {},
}

WHILE_PAUSED = {
    "input_shaping",
    "motor_current",
    "save_parameters",
    "heater_monitor",
    "probe_height",
    "restore_point",
}
NOT_WHILE_PRINTING = WHILE_PAUSED | {
    "heater_tuning",
    "probe",
    "resume_after_power_loss",
    "firmware_update",
}
