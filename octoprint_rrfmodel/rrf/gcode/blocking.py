"""Commands that keep a channel of the board busy until they are through.

While one runs, the channel takes no other: its ``ok`` comes at the end, and what was asked in
between is answered afterwards (RepRapFirmware 3.5 GCodes4.cpp:1885, GCodes.cpp:4865).
"""

from __future__ import annotations

_BLOCKING = frozenset(
    (
        "T",  # tfree, tpre and tpost macros
        "G4",
        "G28",
        "G29",
        "G30",
        "G32",
        "M0",  # cancel.g or stop.g
        "M1",
        "M24",  # waits for resume.g
        "M25",  # waits for pause.g
        "M98",
        "M109",
        "M116",
        "M125",
        "M190",
        "M191",
        "M226",
        "M400",
        "M600",
        "M701",
        "M702",
        "M703",
    )
)


def padded(names: frozenset[str]) -> frozenset[str]:
    """Return names with those that files of other programs write as ``G04`` and ``M00``."""
    return names | {f"{name[0]}0{name[1]}" for name in names if len(name) == 2}


BLOCKING = padded(_BLOCKING)

TARGETING = frozenset(("G10", "M104", "M109", "M140", "M141", "M190", "M191", "M568"))
"""Commands that may give a heater another target."""

SETTLING = BLOCKING | {"M18", "M84", "G92", "M120", "M564"}
"""The commonest commands after which what was known of axes, heaters and tools may be wrong."""

MOVES = padded(frozenset(("G0", "G1", "G2", "G3")))

# fmt: off
_PLAIN = padded(
    frozenset(
        (
            "G10", "G11", "G17", "G18", "G19", "G20", "G21", "G90", "G91", "G93", "G94",
            "M3", "M4", "M5", "M20", "M21", "M22", "M23", "M26", "M27", "M30", "M31", "M36",
            "M37", "M38", "M39", "M42", "M73", "M82", "M83", "M104", "M105", "M106", "M107",
            "M110", "M111", "M114", "M115", "M117", "M118", "M119", "M122", "M140", "M141",
            "M144", "M150", "M201", "M203", "M204", "M205", "M207", "M220", "M221", "M260",
            "M261", "M280", "M290", "M291", "M292", "M300", "M404", "M408", "M409", "M486",
            "M552", "M566", "M568", "M572", "M573", "M579", "M593", "M595",
        )
    )
)
# fmt: on
"""Commands that leave homed axes, tools and what is warm as they are; a new target warms nothing
yet."""


def may_change(gcode: str, command: str = "") -> bool:
    """Return whether axes, tools and heat may be other than they were, once a command is through.

    Any command that isn't known to be harmless may run a macro of the machine's own, which may do
    anything (3.5 GCodes2.cpp, the end of HandleMcode). A move with H may home, and so may what
    stands behind a move on its line.

    >>> may_change("G28"), may_change("M1234"), may_change("G1", "G1 H1 X-9"), may_change("M106")
    (True, True, True, False)
    """
    if gcode in MOVES:
        return not is_plain_move(command)
    return gcode[:1] in ("G", "M", "T") and gcode not in _PLAIN


def is_plain_move(line: str) -> bool:
    """Return whether a line that begins with a move is nothing else, and homes nothing.

    >>> is_plain_move("G1 X1 E2"), is_plain_move("G1 H1 X1"), is_plain_move("G0 X1 G28")
    (True, False, False)
    """
    return "M" not in line and "H" not in line and line.rfind("G") <= 0


def blocks(line: str) -> bool:
    """Return whether a line begins with a command that blocks.

    >>> blocks("T-1"), blocks('M98 P"a.g"'), blocks("M106 S1")
    (True, True, False)
    """
    first = line.split(None, 1)[0]
    return first in BLOCKING or first.startswith("T")
