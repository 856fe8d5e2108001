"""Scripts as Klipper's clients send them: what each comes to, and what is refused as a whole."""

import pytest

from octoprint_rrfmodel.rrf.gcode.commands import Situation, translate
from octoprint_rrfmodel.rrf.gcode.commands.outcome import Refused
from octoprint_rrfmodel.rrf.gcode.operations import Lines as Translated
from octoprint_rrfmodel.rrf.klipper.macro_names import KEYWORDS, TAKEN, macro_names
from octoprint_rrfmodel.rrf.script.help import help_texts
from octoprint_rrfmodel.rrf.script.moment import at_moment
from octoprint_rrfmodel.rrf.script.plan import planned
from octoprint_rrfmodel.rrf.script.refusals import REFUSALS
from octoprint_rrfmodel.rrf.script.steps import Asked, Given, Lines, Operation, Restart
from octoprint_rrfmodel.rrf.script.table import BY_NAME, ROWS

from ..klipper import HOST, changed, model_of, world

MACROS = HOST._replace(
    macros=("0:/macros/Load PLA.g", "pause.g", "START_PRINT.g", "unload_filament.g", "testz.g")
)

SITUATION = Situation(
    is_connected=True,
    is_rrf=True,
    octoprint_prints=False,
    octoprint_is_paused=False,
    answers_boxes=True,
)


def model(machine="toolchanger", firmware="3.5.3", **values):
    """Return a model of a machine that is ready to move and extrude."""
    made = model_of(machine, firmware)
    for axis in made["move"]["axes"]:
        axis["homed"] = True
    for heater in made["heat"]["heaters"]:
        if heater:
            heater["current"] = 220.0
    made["state"]["currentTool"] = made["tools"][-1]["number"] if made["tools"] else -1
    return changed(made, **values)


def steps(script, made=None, host=MACROS):
    return planned(script.split("\n"), at_moment(world(made or model(), host)))


def lines(script, made=None):
    """Return the lines that a script comes to."""
    made = made or model()
    at = at_moment(world(made, MACROS))
    found = []
    for step in planned(script.split("\n"), at):
        if isinstance(step, Given):
            found.append(step.line)
        elif isinstance(step, Lines):
            found.extend(step.lines)
        else:
            assert isinstance(step, Operation), step
            outcome = translate(step.name, step.parameters, at.machine, SITUATION)
            assert isinstance(outcome, Translated), outcome
            found.extend(line + step.behind for line in outcome.lines)
    return found


def refusal(script, made=None):
    with pytest.raises(Refused) as refused:
        steps(script, made)
    return refused.value.refusal.code


SENT = {
    # Mainsail, Fluidd
    "SET_HEATER_TEMPERATURE HEATER=extruder1 TARGET=200": ["M568 P1 S200 A2"],
    "SET_HEATER_TEMPERATURE HEATER=extruder1 TARGET=0": ["M568 P1 S0 A0"],
    "SET_HEATER_TEMPERATURE HEATER=heater_bed TARGET=60": ["M140 P0 S60"],
    "SET_HEATER_TEMPERATURE HEATER=heater_bed TARGET=0": ["M140 P0 S{-273.15}"],
    "SET_HEATER_TEMPERATURE HEATER=heater_bed": ["M140 P0 S{-273.15}"],
    "SET_GCODE_OFFSET Z_ADJUST=+0.025 MOVE=1": ["M290 Z0.025"],
    "SET_GCODE_OFFSET Z_ADJUST=-0.01 MOVE=0": ["M290 Z-0.01"],
    "SET_GCODE_OFFSET Z=0 MOVE=1": ["M290 R0 Z0"],
    "SET_GCODE_OFFSET X=0.1 Y=-0.2": ["M290 R0 X0.1", "M290 R0 Y-0.2"],
    "SAVE_GCODE_STATE NAME=_ui_movement\nG91\nG1 X-10 F7800\n"
    "RESTORE_GCODE_STATE NAME=_ui_movement": ["M120 G21 G91 G1 X-10 F7800 M121"],
    "SAVE_GCODE_STATE NAME=_ui_movement\nG90\nG1 X10 Y20 F6000\nG1 Z5\n"
    "RESTORE_GCODE_STATE NAME=_ui_movement": [
        "M120 G21 G90 G1 X10 Y20 F6000 M121",
        "M120 G21 G90 G1 Z5 F6000 M121",
    ],
    "SAVE_GCODE_STATE NAME=_ui_extrude\nM83\nG1 E10 F300\nRESTORE_GCODE_STATE NAME=_ui_extrude": [
        "M120 M83 G1 E10 F300 M121"
    ],
    "SAVE_GCODE_STATE\nG28 X\nRESTORE_GCODE_STATE": ["M120", "G28 X", "M121"],
    "SAVE_GCODE_STATE\nG91\nG1 X1 E1\nRESTORE_GCODE_STATE": [
        *("M120", "G91", "G1 X1 E1", "M121"),
    ],
    "SET_FAN_SPEED FAN='Tool 2' SPEED=0.5": ["M106 P2 S0.5"],
    "SET_PRESSURE_ADVANCE EXTRUDER=extruder3 ADVANCE=0.05": ["M572 D1 S0.05"],
    "SET_PRESSURE_ADVANCE ADVANCE=0.05": ["M572 D3 S0.05"],
    "SET_VELOCITY_LIMIT VELOCITY=200": ["M203 X12000 Y12000"],
    "SET_VELOCITY_LIMIT ACCEL=3000": ["M204 P3000 T3000"],
    "SET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=5": ["M566 X300 Y300"],
    "SET_RETRACTION RETRACT_LENGTH=1.5 RETRACT_SPEED=40": ["M207 S1.5 F2400"],
    "SET_RETRACTION UNRETRACT_EXTRA_LENGTH=.1 UNRETRACT_SPEED=30": ["M207 R0.1 T1800"],
    "QUAD_GANTRY_LEVEL": ["G32"],
    "Z_TILT_ADJUST": ["G32"],
    "BED_MESH_CALIBRATE": ["G29"],
    "BED_MESH_CLEAR": ["G29 S2"],
    'BED_MESH_PROFILE LOAD="default"': ["G29 S1"],
    "QUERY_ENDSTOPS": ["M119"],
    "SDCARD_RESET_FILE": [],
    "SAVE_CONFIG": ["M500"],
    "PID_CALIBRATE HEATER=extruder1 TARGET=210": ["M303 T1 S210"],
    "SET_GCODE_VARIABLE MACRO=globals VARIABLE=speed VALUE=5": ["set global.speed = 5"],
    "SET_GCODE_VARIABLE MACRO=globals VARIABLE=speed VALUE='\"a\"'": ['set global.speed = "a"'],
    "M106 S127": ["M106 S127"],
    "M84": ["M84"],
    "G28": ["G28"],
    "T1": ["T1"],
    # KlipperScreen
    'SET_HEATER_TEMPERATURE heater="extruder1" target=200': ["M568 P1 S200 A2"],
    "BED_MESH_PROFILE LOAD='default'": ["G29 S1"],
    "M83\nG1 E5 F300": ["M83", "G1 E5 F300"],
    "G91\nG0 X10 F3000\nG90": ["G91", "G0 X10 F3000", "G90"],
    "ACTIVATE_EXTRUDER EXTRUDER=extruder7": ["T7"],
    "TURN_OFF_HEATERS": [
        *("M568 P1 A0", "M568 P3 A0", "M568 P7 A0", "M568 P10 A0", "M140 P0 S{-273.15}"),
    ],
    # others
    "_CLIENT_LINEAR_MOVE X=-10 F=7800": ["M120 G21 G91 G1 X-10 F7800 M121"],
    "_CLIENT_LINEAR_MOVE Z=5 F=600 ABSOLUTE=1": ["M120 G21 G90 G1 Z5 F600 M121"],
    "_CLIENT_EXTRUDE LENGTH=10 SPEED=5": ["M120 M83 G1 E10 F300 M121"],
    "_CLIENT_RETRACT LENGTH=2": ["M120 M83 G1 E-2 F300 M121"],
    "GET_POSITION": ["M114"],
    "PROBE": ["G30 S-1"],
    "RESPOND MSG='all is well'": ['M118 S"all is well"'],
    "SET_DISPLAY_TEXT MSG=Hello": ['M117 "Hello"'],
    "set_display_text msg=hello": ['M117 "hello"'],
    "SET_FILAMENT_SENSOR SENSOR=extruder0 ENABLE=0": ["M591 D0 S0"],
    # the machine's own language
    "set global.speed = 5": ["set global.speed = 5"],
    'echo "a"': ['echo "a"'],
    "T{global.tool}": ["T{global.tool}"],
    "M117 LOAD_PLA is a word": ["M117 LOAD_PLA is a word"],
    # macro files
    "LOAD_PLA": ['M98 P"0:/macros/Load PLA.g"'],
    "MACRO_PAUSE": ['M98 P"0:/macros/pause.g"'],
    "START_PRINT S=200 H='a b' X=": ['M98 P"0:/macros/START_PRINT.g" S200 H"a b" X""'],
    "UNLOAD_FILAMENT": ['M98 P"0:/macros/unload_filament.g"'],
    "TESTZ Z=5": ['M98 P"0:/macros/testz.g" Z5'],
}


@pytest.mark.parametrize("script", SENT)
def test_a_script_comes_to_lines(script):
    made = model(**{"global": {"speed": 1}})
    made["sensors"]["filamentMonitors"] = [
        {"type": "simple", "status": "ok", "enableMode": 1},
    ]
    assert lines(script, made) == SENT[script]


def test_each_heater_of_a_tool_is_one_of_its_own():
    made = model("idex")
    tool = next(tool for tool in made["tools"] if len(tool["heaters"]) > 1)
    number, (first, second) = tool["number"], tool["heaters"]
    assert first != second
    tool["active"] = [100, 150]
    assert lines(f"SET_HEATER_TEMPERATURE HEATER=tool{number}_h1 TARGET=210", made) == [
        f"M568 P{number} S100:210 A2"
    ]
    assert lines(f"SET_HEATER_TEMPERATURE HEATER=extruder{number} TARGET=0", made) == [
        f"M568 P{number} S0:150 A2"
    ]


def test_a_chamber_by_either_name():
    made = model("corexy")
    for name in ("chamber", '"heater_generic chamber"'):
        found = lines(f"SET_HEATER_TEMPERATURE HEATER={name} TARGET=40", made)
        assert found == ["M141 P0 S40"]


def test_outputs_by_number():
    made = model()
    made["state"]["gpOut"] = [None, {"pwm": 0, "freq": 500}]
    assert lines("SET_PIN PIN=gpOut1 VALUE=0.5", made) == ["M42 P1 S0.5"]


OBJECTS = {
    "job__build": {
        "currentObject": 1,
        "objects": [
            {"name": "cube", "cancelled": True},
            {"name": "Ball_id_1", "cancelled": False},
        ],
    }
}


@pytest.mark.parametrize(
    "script, wanted",
    [
        ("EXCLUDE_OBJECT NAME=cube", ["M486 P0"]),
        ("EXCLUDE_OBJECT NAME=BALL_ID_1", ["M486 P1"]),
        ("EXCLUDE_OBJECT CURRENT=1", ["M486 P1"]),
        ("EXCLUDE_OBJECT RESET=1", ["M486 U0"]),
        ("EXCLUDE_OBJECT RESET=1 NAME=cube", ["M486 U0"]),
    ],
)
def test_objects_by_name(script, wanted):
    assert lines(script, model(**OBJECTS)) == wanted


@pytest.mark.parametrize(
    "script, step",
    [
        ("PAUSE", Asked("printer.print.pause")),
        ("pause", Asked("printer.print.pause")),
        ("RESUME", Asked("printer.print.resume")),
        ("CANCEL_PRINT", Asked("printer.print.cancel")),
        (
            'SDCARD_PRINT_FILE FILENAME="a b.gcode"',
            Asked("printer.print.start", {"filename": "a b.gcode"}),
        ),
        ("RESTART", Restart()),
        ("FIRMWARE_RESTART", Restart()),
    ],
)
def test_what_is_done_otherwise_than_by_lines(script, step):
    assert steps(script) == [step]


REFUSED = {
    "FOO": "macro_unknown",
    "FOO BAR=1": "macro_unknown",
    "PROBE_CALIBRATE": "macro_by_hand",
    "ACCEPT": "macro_by_hand",
    "SCREWS_TILT_CALCULATE": "macro_by_hand",
    "Z_OFFSET_APPLY_PROBE": "macro_in_config",
    "SHAPER_CALIBRATE": "macro_resonances",
    "EXCLUDE_OBJECT_START NAME=a": "macro_of_files",
    "SET_HEATER_TEMPERATURE TARGET=1": "macro_misses",
    "SET_HEATER_TEMPERATURE HEATER=extruder TARGET=1": "no_such_object_name",
    "SET_HEATER_TEMPERATURE HEATER=extruder1 TARGET=9999": "temperature",
    "SET_HEATER_TEMPERATURE HEATER=extruder1 TARGET=hot": "not_a_number",
    "SET_HEATER_TEMPERATURE HEATER=extruder1 TARGET=inf": "not_a_number",
    "SET_HEATER_TEMPERATURE extruder1": "macro_form",
    "SET_HEATER_TEMPERATURE HEATER='extruder1": "macro_form",
    "SET_GCODE_OFFSET": "macro_misses",
    "SET_GCODE_OFFSET E=1": "macro_parameter",
    "SET_VELOCITY_LIMIT MINIMUM_CRUISE_RATIO=0.5": "macro_parameter",
    "SET_VELOCITY_LIMIT ACCEL=-1": "out_of_range",
    "SET_PRESSURE_ADVANCE SMOOTH_TIME=0.04": "macro_smooth_time",
    "SET_FAN_SPEED FAN=none SPEED=1": "no_such_object_name",
    "BED_MESH_PROFILE SAVE=a": "macro_profiles",
    "BED_MESH_PROFILE LOAD=a": "macro_profiles",
    "SAVE_GCODE_STATE": "macro_unpaired",
    "RESTORE_GCODE_STATE": "macro_unpaired",
    "SAVE_GCODE_STATE\nPAUSE\nRESTORE_GCODE_STATE": "macro_unpaired",
    "SAVE_GCODE_STATE\nG91\nRESTORE_GCODE_STATE MOVE=1": "macro_move_back",
    "EXCLUDE_OBJECT NAME=a": "no_objects",
    "LOAD_FILAMENT": "macro_filament",
    "SET_GCODE_VARIABLE MACRO=start VARIABLE=a VALUE=1": "macro_variables",
    "START_PRINT EXTRUDER=200": "macro_letters",
    "START_PRINT P=1": "macro_letters",
    "RESPOND TYPE=command MSG=action:cancel": "macro_parameter",
    "RESPOND MSG='a;b'": "unsendable",
    "G28\nM117 a\nFOO": "macro_unknown",
}


@pytest.mark.parametrize("script", REFUSED)
def test_what_is_refused(script):
    assert refusal(script) == REFUSED[script]


def test_nothing_is_known_without_a_model():
    at = at_moment(world())
    for row in ROWS:
        try:
            planned([row.name], at)
        except Refused:
            continue
    assert planned(["TURN_OFF_HEATERS"], at) == []


@pytest.mark.parametrize("machine", ["cartesian", "toolchanger", "idex", "cnc", "delta"])
@pytest.mark.parametrize("firmware", ["2.05", "3.5.3", "3.7"])
def test_every_heater_and_fan_that_is_listed_can_be_set(machine, firmware):
    made = model_of(machine, firmware)
    at = at_moment(world(made, MACROS))
    for name in at.view.objects:
        kind = name.partition(" ")[0].rstrip("0123456789")
        if kind in ("extruder", "heater_bed", "heater_generic"):
            assert planned([f"SET_HEATER_TEMPERATURE HEATER='{name}' TARGET=40"], at)
        if kind in ("fan", "fan_generic"):
            found = planned([f"SET_FAN_SPEED FAN='{name}' SPEED=1"], at)[0]
            assert isinstance(translate("fan", found.parameters, at.machine, SITUATION), Translated)


# names


def test_names_that_are_taken_are_those_of_the_table():
    assert {row.name for row in ROWS if not row.gives_way} == TAKEN
    assert not set(REFUSALS) & set(BY_NAME)
    assert all(word.islower() for word in KEYWORDS)


@pytest.mark.parametrize(
    "files, names",
    [
        (["0:/macros/Load PLA.g"], ["Load_PLA"]),
        (["pause.g", "Resume.G"], ["MACRO_pause", "MACRO_Resume"]),
        (["T0.g", "1st.g", "x.g", "while.g"], ["MACRO_T0", "MACRO_1st", "MACRO_x", "MACRO_while"]),
        (["a b.g", "A-B.g", "a_b"], ["a_b", "A_B_", "a_b__"]),
        (["sub/level.g", "globals.g", ".g", "", "ß.g"], ["sub_level", "globals_"]),
    ],
)
def test_names_of_macros(files, names):
    assert list(macro_names(files)) == names


def test_each_macro_runs_by_its_name():
    at = at_moment(world(model(), MACROS))
    for name, path in macro_names(MACROS.macros).items():
        (step,) = planned([name], at)
        assert (step.name, step.parameters) == ("macro", {"path": path})


# help


def test_help_is_about_what_the_machine_has():
    texts = help_texts(world(model(), MACROS))
    assert {"G28", "PAUSE", "SET_HEATER_TEMPERATURE", "LOAD_PLA", "MACRO_PAUSE"} <= set(texts)
    assert "EXCLUDE_OBJECT" not in texts and "PROBE_CALIBRATE" not in texts
    assert not any(name.startswith("_") for name in texts)
    assert all(text and "\n" not in text for text in texts.values())
    assert "SET_HEATER_TEMPERATURE" not in help_texts(world())
