"""Commands to heaters that OctoPrint sends and shows nothing wrong of."""

from ...rrf.wire.gcode_words import words

SLOTS = (
    ("M140 ", "heatedBed", "bedHeaters"),
    ("M141 ", "heatedChamber", "chamberHeaters"),
)
"""Command, what OctoPrint's printer profile calls the heater, and its slots in the model."""


def shown_as_it_is(line, profile, machine):
    """Return a line that OctoPrint sends and shows nothing wrong of.

    It drops what its printer profile (``profile()``) has no bed or chamber for, and shows the
    target of any slot as that of the first. Behind another command on the same line it looks at
    neither.
    """
    for code, part, kind in SLOTS:
        if line.startswith(code):
            is_first = words(line).get("P") == machine.slot(kind)
            return line if is_first and profile()[part] else f"M120 {line} M121"
    return line
