"""Which commands may take long: their ``ok`` may stay away for minutes without a byte in between.

From RepRapFirmware 3.3 to 3.6 nothing at all comes on USB while G28, G29, G32, T or a macro moves
or probes; reports come only in waits for temperatures, G4, M400 and while a move waits for room,
and only on machines with heaters (3.5 GCodes.cpp:4811, :4865). A code that the firmware hasn't got
runs the macro of its name (3.5 GCodes2.cpp, TryMacroFile), so what isn't known to be quick isn't.
"""

from __future__ import annotations

from .blocking import BLOCKING, padded
from .doing import OTHER, what_of

_G = """
    0 1 2 3 10 11 17 18 19 20 21 53 54 55 56 57 58 59 59.1 59.2 59.3 60 61 68 69 80 90 91 92 93 94
"""

_M = """
    3 4 5 17 18 20 21 22 23 26 27 28 29 30 32 36 36.1 37 39 42 73 80 81 82 83 84 85 92
    104 105 106 107 108 110 111 112 114 115 117 118 119 120 121 122 134 135 140 141 143 144 150
    154 155 200 201 201.1 203 204 205 206 207 208 209 220 221 260 261 261.1 261.2 280 290 291 292
    300 301 302 304 305 307 308 309 350 351 375 376 404 406 407 408 409 425 450 451 452 453 470 471
    472 486 503 505 540 550 551 552 553 554 555 556 557 558 558.1 558.2 558.3 559 560 561 562 563
    564 566 567 568 569 570 571 572 573 574 575 576 578 579 580 581 582 583 584 586 586.4 587 587.1
    588 589 591 592 593 594 595 596 597 599 606 650 651 665 666 667 668 669 670 671 672 673 674 851
    905 906 907 908 911 912 913 915 917 918 929 943 950 951 952 954 955 956 957 970 997 999
"""

QUICK = padded(
    frozenset(["F", *(f"G{code}" for code in _G.split()), *(f"M{code}" for code in _M.split())])
)
"""The firmware's own commands whose ``ok`` comes soon, but for moves that wait for room; ``F`` is
what a host has for the name of a line with a feed rate alone."""


def takes_long(line: str, gcode: str) -> bool:
    """Return whether a command that begins with ``gcode`` may keep the line silent for long.

    >>> takes_long("G1 X10 E2", "G1"), takes_long("G28", "G28"), takes_long("M120 G28 M121", "M120")
    (False, True, True)
    >>> takes_long("G6511", "G6511"), takes_long("T-1", "T"), takes_long("M117 G28", "M117")
    (True, True, False)
    """
    if gcode not in QUICK:
        return True
    # nearly every line of a print is one quick command and ends here
    if line.find("G", 1) < 0 and line.find("M", 1) < 0:
        return gcode in BLOCKING
    return what_of(line) != OTHER
