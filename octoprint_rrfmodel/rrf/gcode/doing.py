"""What the line is busy with, told by the command that went out and has no ``ok`` yet.

``ROWS`` is the table: what a person calls it, the commands that do it, why. What is through at
once is in no row, but for M303; nor are commands that are macros of the machine's own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Callable, NamedTuple

from .unsendable import waits_for_answer, without_texts

OTHER = "other"
"""What every command does that is in no row."""

HEATING = "heating"
"""What a wait for temperatures is called."""

_EXPRESSION = re.compile(r"\{(?:[^{}]|\{[^{}]*\})*\}")
"""An expression in braces, with braces in it at most once: letters in it begin no command."""

_BEGINNING = re.compile(r"(?=(?<!')[GM]\s*\d)", re.IGNORECASE)
"""Where a command begins, also behind another one (3.5 StringParser.cpp, DecodeCommand)."""

_NAME = re.compile(
    r"\s*(?:(?P<letter>[GM])\s*0*(?P<number>\d+(?:\.\d+)?)|(?P<tool>T)\s*[-\d{R])", re.IGNORECASE
)
"""The name of a command; groups: ``letter`` and ``number``, or ``tool`` where it selects one."""

_S = re.compile(r"S\s*(?P<value>-?\d+)", re.IGNORECASE)
"""The parameter S; group ``value`` is its whole number."""

TO_THE_END = frozenset(("M23", "M28", "M30", "M32", "M36", "M37", "M38", "M117"))
"""Commands whose text goes on to the end of the line, whatever stands in it."""


class Row(NamedTuple):
    """One line of the table."""

    what: str
    """As the public status tells it."""
    gcodes: tuple[str, ...]
    reason: str
    """Why, with the source."""
    hits: Callable[[str], bool] = lambda command: True
    """Whether a command, without the texts in it, is one of those."""


def _probes(command: str) -> bool:
    mode = _S.search(command)
    return mode is None or int(mode["value"]) == 0


def _saves(command: str) -> bool:
    mode = _S.search(command)
    return mode is not None and int(mode["value"]) == 3


ROWS = (
    Row("homing", ("G28",), "homeall.g and its kin run to their end (3.5 GCodes.cpp, DoHome)."),
    Row(
        HEATING,
        ("M109", "M116", "M190", "M191"),
        "Wait until temperatures are reached, M109 after a tool change where none is selected"
        " (3.5 GCodes2.cpp:1759, :2342).",
    ),
    Row(
        HEATING,
        ("M303",),
        "Tunes a heater; its ok comes at once, the heat for minutes (3.5 Heat.cpp, TuneHeater).",
    ),
    Row(
        "probing",
        ("G29",),
        "Without S mesh.g runs, S0 probes itself (3.5 GCodes2.cpp:385); S1 loads a height map, S2"
        " clears it, S4 reads where to probe.",
        _probes,
    ),
    Row(
        "probing",
        ("G30", "G38.2", "G38.3", "G38.4", "G38.5"),
        "Move until the probe says so (3.5 GCodes2.cpp, ExecuteG30, StraightProbe).",
    ),
    Row(
        "probing",
        ("M401", "M402"),
        "Run deployprobe.g and retractprobe.g (3.5 GCodes2.cpp, M401).",
    ),
    Row(
        "probing",
        ("M585", "M675"),
        "Probe a tool and the walls of a cavity (3.5 GCodes2.cpp, ProbeTool, FindCenterOfCavity).",
    ),
    Row(
        "calibrating",
        ("G32",),
        "bed.g, which levels the bed or calibrates a delta (3.5 GCodes2.cpp, G32).",
    ),
    Row("tool_change", ("T",), "tfree, tpre and tpost macros (3.5 GCodes2.cpp, HandleTcode)."),
    Row("macro", ("M98",), "The ok comes when the macro ends (3.5 GCodes.cpp:770)."),
    Row("macro", ("M501", "M502"), "Run config-override.g and config.g (3.5 GCodes2.cpp)."),
    Row(
        "filament",
        ("M701", "M702", "M703"),
        "load.g, unload.g and config.g of a filament (3.5 GCodes.cpp:4227-4263).",
    ),
    Row("pausing", ("M25",), "Waits for pause.g (3.5 GCodes2.cpp, DoAsynchronousPause)."),
    Row(
        "pausing",
        ("M125", "M600", "M601"),
        "Pauses of a print's own; M600 and M601 are refused outside of a file on the card"
        " (3.5 GCodes2.cpp, M226).",
    ),
    Row(
        "resuming",
        ("M24", "M916"),
        "M24 waits for resume.g where a print is paused, M916 runs resurrect.g (3.5 GCodes2.cpp).",
    ),
    Row(
        "cancelling",
        ("M0", "M1", "M2"),
        "From this line they end a print that is paused: cancel.g, else stop.g (3.5 GCodes2.cpp,"
        " M0).",
    ),
    Row("waiting", ("G4",), "A dwell (3.5 GCodes.cpp, DoDwell)."),
    Row(
        "waiting",
        ("M226", "M400", "M577", "M598"),
        "Wait for moves to end, for an input, or for the other motion system (3.5 GCodes2.cpp);"
        " M226 only in a file.",
    ),
    Row(
        "answer",
        ("M291",),
        "From S2 on the box wants an answer; without S it is 1 (3.5 GCodes7.cpp).",
        waits_for_answer,
    ),
    Row("saving", ("G29",), "S3 writes the height map to a file (3.5 GCodes2.cpp:385).", _saves),
    Row(
        "saving",
        ("M374", "M500"),
        "Write the height map and config-override.g (3.5 GCodes2.cpp).",
    ),
)


def what_of(line: str) -> str:
    """Return what the line is busy with after one that went out: the first command that counts.

    >>> what_of("G28 X"), what_of("M120 G28 M121"), what_of('M117 "G28"'), what_of("T-1")
    ('homing', 'homing', 'other', 'tool_change')
    """
    for gcode, command in _commands(line):
        for row in ROWS:
            if gcode in row.gcodes and row.hits(command):
                return row.what
    return OTHER


def _commands(line: str) -> Iterator[tuple[str, str]]:
    """Give name and text of each command of a line, without texts and comment."""
    bare = _EXPRESSION.sub("{}", without_texts(line)).partition(";")[0]
    for command in filter(str.strip, _BEGINNING.split(bare)):
        name = _NAME.match(command)
        if name is None:
            # a meta command, which has the whole line
            return
        gcode = "T" if name["tool"] else name["letter"].upper() + name["number"]
        yield gcode, command
        if gcode in TO_THE_END:
            return
