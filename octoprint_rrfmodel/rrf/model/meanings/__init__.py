"""What each member of the object model says: its unit and one sentence, as tables.

Units are those of RepRapFirmware 3.3 to 3.6, which mixes them: limits of speed are in mm/min,
speeds of moves in mm/s.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from .boards import BOARDS, LED_STRIPS, NETWORK, VOLUMES
from .heat import FANS, HEAT
from .job import JOB
from .meaning import Meaning, read
from .move import MOVE
from .roots import ROOTS
from .sensors import SENSORS
from .state import INPUTS, STATE
from .tools import SPINDLES, TOOLS

MEANINGS: Mapping[str, Meaning] = read(
    (
        ROOTS,
        BOARDS,
        FANS,
        HEAT,
        INPUTS,
        JOB,
        LED_STRIPS,
        MOVE,
        NETWORK,
        SENSORS,
        SPINDLES,
        STATE,
        TOOLS,
        VOLUMES,
    )
)
"""Path pattern (``[]`` for any element) to meaning. A list's values mean what the list means."""

OPEN = ("global", "job.file.customInfo")
"""Objects whose members anybody can name; they mean what the object means."""

_INDEX = re.compile(r"\[[0-9]*\]")


def meaning_of(path: str) -> Meaning | None:
    """Return what the value at a path says, ``None`` where that isn't known.

    ``heat.heaters[0].current`` and ``heat.heaters[].current`` mean the same.
    """
    pattern = _INDEX.sub("[]", path)
    while pattern.endswith("[]") and pattern not in MEANINGS:
        pattern = pattern[:-2]
    for parent in OPEN:
        if pattern.startswith((f"{parent}.", f"{parent}[")):
            pattern = parent
    return MEANINGS.get(pattern)
