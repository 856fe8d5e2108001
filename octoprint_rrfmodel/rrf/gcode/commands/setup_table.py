"""Rows of the table of commands: what one sets up, tunes and tries at a machine."""

from __future__ import annotations

from . import machine_setup, parameters, things
from .parameters import Parameter
from .row import Command, optional
from .states import PRINTING, PRINTING_OR_PAUSED

MOST_MILLIAMPERES = 10_000.0
MOST_ADVANCE = 2.0
MOST_FREQUENCY = 1000.0
MOST_DAMPING = 0.99
COLDEST, HOTTEST = -273.0, 2000.0
MOST_HEIGHT = 100.0
MOST_LEDS = 1000
MOST_ACTION = 3
"""A monitor's: fault, off for good, off for a while, power off."""

NAME_BYTES = 100
"""Longest name of a variable (3.5 GCodeBuffer.h, MaxVariableNameLength)."""

COLOUR = parameters.whole(0, 255)

SETUP = (
    Command(
        "pressure_advance",
        (
            Parameter("extruder", things.extruder),
            Parameter("seconds", parameters.number(0, MOST_ADVANCE)),
        ),
        (),
        machine_setup.pressure_advance,
        "3.5 GCodes2.cpp (M572 D)",
    ),
    Command(
        "input_shaping",
        (
            Parameter("type", parameters.word(*machine_setup.SHAPERS)),
            optional("frequency", parameters.number(1, MOST_FREQUENCY)),
            optional("damping", parameters.number(0, MOST_DAMPING)),
        ),
        (PRINTING,),
        machine_setup.input_shaping,
        "3.5 AxisShaper.cpp, Configure (M593); names since 3.4",
    ),
    Command(
        "motor_current",
        (
            optional("axis", things.axis),
            optional("extruder", things.extruder),
            Parameter("milliamps", parameters.whole(0, int(MOST_MILLIAMPERES))),
        ),
        (PRINTING,),
        machine_setup.motor_current,
        "3.5 GCodes2.cpp (M906): one E for all extruders",
    ),
    Command(
        "save_parameters",
        (),
        (PRINTING,),
        machine_setup.save_parameters,
        "3.5 GCodes6.cpp, WriteConfigOverrideFile (M500)",
    ),
    Command(
        "heater_tuning",
        (Parameter("heater", things.heater), Parameter("temperature", parameters.number())),
        (PRINTING_OR_PAUSED,),
        machine_setup.heater_tuning,
        "3.5 Heat.cpp, TuneHeater (M303); T with the tool's fans since 3.2",
    ),
    Command(
        "heater_monitor",
        (
            Parameter("heater", things.heater),
            optional("monitor", parameters.whole(0, 2), 0),
            optional("limit", parameters.number(COLDEST, HOTTEST)),
            optional("condition", parameters.word(*machine_setup.CONDITIONS), "tooHigh"),
            optional("action", parameters.whole(0, MOST_ACTION), 0),
        ),
        (PRINTING,),
        machine_setup.heater_monitor,
        "3.5 Heater.cpp, ConfigureMonitor (M143)",
    ),
    Command(
        "probe",
        (
            optional("probe", things.probe, 0),
            Parameter("action", parameters.word(*machine_setup.PROBINGS)),
        ),
        (PRINTING_OR_PAUSED,),
        machine_setup.probe,
        "3.5 GCodes.cpp, ExecuteG30 (G30)",
    ),
    Command(
        "probe_height",
        (
            optional("probe", things.probe, 0),
            Parameter("height", parameters.number(-MOST_HEIGHT, MOST_HEIGHT)),
        ),
        (PRINTING,),
        machine_setup.probe_height,
        "3.5 GCodes.cpp, SetOrReportZProbe (G31)",
    ),
    Command(
        "output",
        (Parameter("output", things.output), Parameter("value", parameters.number(0, 1))),
        (),
        machine_setup.output,
        "3.5 GCodes2.cpp (M42): up to 1 a fraction",
    ),
    Command(
        "led",
        (
            Parameter("strip", things.led_strip),
            Parameter("red", COLOUR),
            Parameter("green", COLOUR),
            Parameter("blue", COLOUR),
            optional("brightness", COLOUR, 255),
            optional("count", parameters.whole(1, MOST_LEDS), 1),
        ),
        (),
        machine_setup.led,
        "3.5 LedStripManager.cpp (M150 E)",
    ),
    Command(
        "variable",
        (
            Parameter("name", parameters.text(NAME_BYTES)),
            Parameter("value", machine_setup.read_value),
        ),
        (),
        machine_setup.variable,
        "3.5 GCodeBuffer.cpp, ProcessSetCommand (set global.)",
    ),
    Command(
        "restore_point",
        (
            Parameter("point", parameters.whole(0, 5)),
            Parameter("action", parameters.word("save", "go")),
            optional("axes", things.axes, ()),
        ),
        (PRINTING,),
        machine_setup.restore_point,
        "3.5 GCodes.cpp, SavePosition (G60), G1 R",
    ),
    Command(
        "resume_after_power_loss",
        (),
        (PRINTING_OR_PAUSED,),
        machine_setup.resume_after_power_loss,
        "3.5 GCodes2.cpp (M916): runs resurrect.g of the card",
    ),
    Command(
        "firmware_update",
        (optional("board", things.board, 0),),
        (PRINTING_OR_PAUSED,),
        machine_setup.firmware_update,
        "3.5 GCodes2.cpp (M997 S0, M997 B)",
    ),
)
