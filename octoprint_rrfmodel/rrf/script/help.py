"""What can be sent as a script, as ``printer.gcode.help`` tells it."""

from __future__ import annotations

from ..klipper.host import HELP
from ..klipper.world import World
from .moment import at_moment
from .table import ROWS


def help_texts(world: World) -> dict[str, str]:
    """Return command to one line of help: G-code, Klipper's commands, the machine's macros.

    Commands about what the machine has not got are left out, for clients make buttons of them, and
    those for clients themselves, which begin with ``_``.
    """
    at = at_moment(world)
    listed = {
        row.name: row.help for row in ROWS if not row.name.startswith("_") and row.is_listed(at)
    }
    files = {name: f"Run {path} (M98)" for name, path in at.macros.items()}
    return {**HELP, **listed, **files}
