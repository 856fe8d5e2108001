"""Lines of text by which the firmware tells of something before the model does.

Looked for in what it says unasked (3.5 ``SendSimpleAlert``, RepRap.cpp:589-705); the model is
what counts, a line only says that it is worth asking now.
"""

from __future__ import annotations

import re

WORDS = (
    ("reset", r"RepRapFirmware for .{1,100}? is up and running"),  # 3.5 RepRap.cpp:705
    ("box", r"Send M292 "),  # 3.5 Platform.cpp, SendAlert
    ("fault", r"Heater \d+ fault"),  # 3.3 LocalHeater.cpp:743
    ("fault", r"^- (?:Printing paused|Event notification) -"),  # 3.4 and later
    ("fault", r"Driver [\d.]+ error"),
    ("fault", r"^Error: .* on drivers? \d"),  # 3.3 Platform.cpp, ReportDrivers
    ("fault", r"Filament error on"),
    ("fault", r"^Emergency Stop!"),  # 3.5 GCodes2.cpp, M112
    ("fault", r"VIN under-voltage"),  # 3.5 Platform.cpp:1396
    ("card", r"^Error: .*M(?:20|36|36\.1): "),  # a question about the card, as by a halted board
    ("silence", r"\A\Z"),  # what a host reads when its patience is over, as after a lost ok
)
"""What is told, and a pattern of a line that tells it; none looks far from each place."""

TELLING = frozenset(("", *"RS-HEDFW"))
"""First letters of lines worth looking at; ``heard`` is too slow for every line."""

_KINDS = [(kind, re.compile(pattern)) for kind, pattern in WORDS]


def heard(line: str) -> str | None:
    """Return what a line tells: ``reset``, ``box``, ``fault``, ``card``, ``silence``;
    ``None`` for most lines."""
    return next((kind for kind, pattern in _KINDS if pattern.search(line)), None)
