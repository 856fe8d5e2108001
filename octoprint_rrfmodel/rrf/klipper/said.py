"""Lines that the printer says, as Klipper marks them."""

from __future__ import annotations

ERROR = "Error:"
"""How RepRapFirmware begins what went wrong."""

MARK = "!! "
"""How Klipper does; clients show no other line as an error."""


def as_said(line: str) -> str:
    """Return a line with Klipper's mark where it tells of an error.

    >>> as_said("Error: G28: no endstop"), as_said("Warning: cold")
    ('!! Error: G28: no endstop', 'Warning: cold')
    """
    return refusal(line) if line.startswith(ERROR) else line


def refusal(text: str) -> str:
    """Return what Klipper would say of a command that it doesn't take."""
    return f"{MARK}{text}"
