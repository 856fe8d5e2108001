"""The table of commands: parameters, states that forbid one, lines, where that comes from."""

from __future__ import annotations

from ...wire.request import KEY_LENGTH
from ..forms import SLOT_CODES, TOOL_STATES, WORKPLACES, Slots
from . import box, heat, job, motion, parameters, system, things
from .parameters import Parameter
from .row import Command, optional
from .setup_table import SETUP
from .states import NOT_CONNECTED, NOT_RRF, PRINTING, PRINTING_FREELY, PRINTING_OR_PAUSED

MOST_MILLIMETRES = 10_000.0
MOST_SPEED = 100_000.0
MOST_PERCENT = 1000.0
"""More of these is a mistake: the firmware has no limits, or cuts without a word."""

MOST_BABYSTEP = 10.0
MOST_RPM = 1_000_000

FILAMENT_BYTES = 31
"""Longest name of a filament (3.5 Filament.h)."""

TEMPERATURE = parameters.number()
PERCENT = Parameter("percent", parameters.number(1, MOST_PERCENT))
SPEED = parameters.number(1, MOST_SPEED)
WORKPLACE = parameters.whole(1, WORKPLACES)


def _slot(name: Slots, thing: parameters.Read, states: tuple[str, ...]) -> Command:
    return Command(
        name,
        (
            optional("index", thing, 0),
            optional("active", TEMPERATURE),
            optional("standby", TEMPERATURE),
            optional("state", parameters.word(*states)),
        ),
        (),
        heat.slot_temperatures(name),
        f"3.5 GCodes2.cpp:2225 ({SLOT_CODES[name]})",
    )


COMMANDS = (
    Command(
        "refresh",
        (optional("key", parameters.text(KEY_LENGTH)),),
        (),
        system.refresh,
        "nothing is sent but what polling sends anyway",
        needs_machine=False,
    ),
    Command(
        "tool_temperatures",
        (
            Parameter("tool", things.tool),
            optional("active", parameters.several()),
            optional("standby", parameters.several()),
        ),
        (),
        heat.tool_temperatures,
        "3.5 GCodes2.cpp:3776 (M568), GCodes.cpp:3540; G10 in all",
    ),
    Command(
        "tool_state",
        (Parameter("tool", things.tool), Parameter("state", parameters.word(*TOOL_STATES))),
        (),
        heat.tool_state,
        "3.5 GCodes2.cpp:3776 (M568 A)",
    ),
    Command(
        "select_tool",
        (Parameter("tool", things.tool_or_none),),
        (PRINTING,),
        motion.select_tool,
        "3.5 GCodes2.cpp, HandleTcode; a number that doesn't exist would deselect without a word",
    ),
    _slot("bed", things.bed, TOOL_STATES),
    _slot("chamber", things.chamber, ("off", "active")),
    Command(
        "reset_heater_fault",
        (Parameter("heater", things.heater),),
        (),
        heat.reset_heater_fault,
        "3.5 GCodes2.cpp (M562)",
    ),
    Command(
        "fan",
        (Parameter("fan", things.fan), Parameter("speed", parameters.number(0, 1))),
        (),
        heat.fan,
        "3.5 GCodes2.cpp (M106): S up to 1 is a fraction",
    ),
    Command(
        "home",
        (optional("axes", things.axes, ()),),
        (PRINTING_OR_PAUSED,),
        motion.home,
        "3.5 GCodes.cpp, DoHome",
    ),
    Command(
        "jog",
        (
            Parameter("axes", things.moves),
            optional("speed", SPEED),
            optional("absolute", parameters.truth, False),
        ),
        (PRINTING,),
        motion.jog,
        "3.5 GCodeMachineState.cpp:41-60 (M120, M121)",
    ),
    Command(
        "extrude",
        (
            Parameter("amounts", parameters.several(-MOST_MILLIMETRES, MOST_MILLIMETRES)),
            Parameter("speed", SPEED),
        ),
        (PRINTING,),
        motion.extrude,
        "3.5 GCodes.cpp, LoadExtrusionAndFeedrateFromGCode",
    ),
    Command(
        "babystep",
        (
            optional("axis", things.axis, "Z"),
            Parameter("amount", parameters.number(-MOST_BABYSTEP, MOST_BABYSTEP)),
            optional("absolute", parameters.truth, False),
        ),
        (),
        motion.babystep,
        "3.5 GCodes2.cpp (M290); axes and R0 since 2.02",
    ),
    Command("speed_factor", (PERCENT,), (), motion.speed_factor, "3.5 GCodes2.cpp (M220)"),
    Command(
        "extrusion_factor",
        (Parameter("extruder", things.extruder), PERCENT),
        (),
        motion.extrusion_factor,
        "3.5 GCodes2.cpp (M221)",
    ),
    Command(
        "spindle",
        (
            Parameter("spindle", things.spindle),
            Parameter("rpm", parameters.number(0, MOST_RPM)),
            optional("direction", parameters.word("forward", "reverse"), "forward"),
        ),
        (PRINTING,),
        motion.spindle,
        "3.5 GCodes2.cpp (M3, M4, M5): S is a whole number",
    ),
    Command(
        "tool_offsets",
        (Parameter("tool", things.tool), Parameter("offsets", things.moves)),
        (PRINTING,),
        motion.tool_offsets,
        "3.5 GCodes2.cpp, SetOrReportOffsets (G10 P)",
    ),
    Command(
        "workplace",
        (Parameter("workplace", WORKPLACE),),
        (PRINTING,),
        motion.workplace,
        "3.5 GCodes2.cpp (G54 to G59.3)",
    ),
    Command(
        "set_zero",
        (optional("axes", things.axes, ()), optional("workplace", WORKPLACE)),
        (PRINTING,),
        motion.set_zero,
        "3.5 GCodes2.cpp (G10 L20)",
    ),
    Command(
        "message_box",
        (
            Parameter("action", parameters.word("ok", "cancel")),
            optional(box.NAME, box.read_value),
            optional("seq", parameters.whole(0, parameters.LARGEST)),
        ),
        (),
        box.message_box,
        "3.5 GCodes7.cpp (M292)",
    ),
    Command(
        "macro",
        (Parameter("path", parameters.path),),
        (PRINTING_OR_PAUSED,),
        job.macro,
        "3.5 GCodes2.cpp (M98)",
    ),
    Command(
        "object",
        (
            Parameter("index", job.object_index),
            Parameter("action", parameters.word("cancel", "resume")),
        ),
        (),
        job.an_object,
        "3.5 ObjectTracker.cpp (M486)",
    ),
    Command(
        "job",
        (
            Parameter("action", parameters.word(*job.JOB_ACTIONS)),
            optional("path", parameters.path),
        ),
        (),
        job.job,
        "3.5 GCodes2.cpp (M32, M25, M24, M0, M37)",
    ),
    Command(
        "filament",
        (
            Parameter("action", parameters.word("load", "unload")),
            optional("name", parameters.text(FILAMENT_BYTES)),
        ),
        (PRINTING,),
        job.filament,
        "3.5 GCodes.cpp:4227-4263 (M701, M702, M703)",
    ),
    Command(
        "mesh",
        (Parameter("action", parameters.word(*system.MESH)),),
        (PRINTING_OR_PAUSED,),
        system.mesh,
        "3.5 GCodes2.cpp:385 (G29)",
    ),
    Command(
        "power",
        (Parameter("on", parameters.truth),),
        (),
        system.power,
        "3.5 GCodes2.cpp (M80, M81)",
    ),
    Command(
        "emergency_stop",
        (),
        (NOT_CONNECTED, NOT_RRF),
        system.emergency_stop,
        "3.5 GCodes2.cpp (M112)",
        needs_machine=False,
    ),
    Command(
        "recover",
        (),
        (PRINTING_FREELY,),
        system.recover,
        "3.5 GCodes2.cpp:4718",
        needs_machine=False,
    ),
    *SETUP,
)
