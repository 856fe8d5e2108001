"""Commands that keep a channel of the board busy until they are through.

While one runs, the channel takes no other: its ``ok`` comes at the end, and what was asked in
between is answered afterwards (RepRapFirmware 3.5 GCodes4.cpp:1885, GCodes.cpp:4865).
"""

from __future__ import annotations

BLOCKING = frozenset(
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

TARGETING = frozenset(("G10", "M104", "M109", "M140", "M141", "M190", "M191", "M568"))
"""Commands that may give a heater another target."""

SETTLING = BLOCKING | {"M18", "M84", "G92", "M120", "M564"}
"""Commands after which what was known of axes, heaters and tools may be wrong."""


def blocks(line: str) -> bool:
    """Return whether a line begins with a command that blocks.

    >>> blocks("T-1"), blocks('M98 P"a.g"'), blocks("M106 S1")
    (True, True, False)
    """
    first = line.split(None, 1)[0]
    return first in BLOCKING or first.startswith("T")
