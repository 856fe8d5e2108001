"""Commands of the plugin's own, as they lie in OctoPrint's queue and as they go on from there.

Other plugins look at what is queued. Some take a command for one to themselves and switch the
machine by the plugin, which queues it again: to them it has to be another one. Others count what
moves, and know none of the forms that leave a board's modes alone.
"""

from ...host.tags import COMMAND_TAG
from ...rrf.wire.gcode_words import KEEPS_MODES, apart

DISGUISED = {"M80": "M080", "M81": "M081"}
"""Commands that PSUControl answers by itself, and as the same command to a board."""

MEANT = {disguised: line for line, disguised in DISGUISED.items()}


def to_queue(lines):
    """Return lines as nobody answers them in the board's stead."""
    return [DISGUISED.get(line, line) for line in lines]


def from_queue(cmd, gcode, tags):
    """Return the lines for which a command stands, ``None`` where that is itself.

    What it stands for goes through the hooks of plugins behind this one, and OctoPrint tells of it
    in its events.
    """
    if cmd in MEANT:
        return (MEANT[cmd],)
    if gcode == KEEPS_MODES and COMMAND_TAG in tags:
        return apart(cmd)
    return None
