"""Lines as a broken or hostile board may send them, and how long somebody takes over one."""

import time

from hypothesis import strategies as st

LONGEST = 64_000
"""OctoPrint takes lines of this length, and longer ones."""

MOST_SECONDS = 0.2
"""Of the processor, for the longest; what grows with the square takes many times that."""

BEGINNINGS = (
    "",
    "ok",
    "Error: ",
    "Error: M20: ",
    "Warning: ",
    "RepRapFirmware for ",
    "Driver ",
    "Heater ",
    "Filament error on",
    "Finished printing file ",
    "File ",
    "File opened",
    "SD printing byte ",
    "X:1 Y:1 Z:1 ",
    "- ",
    "Begin file list",
    "FIRMWARE_NAME: ",
    '{"key":"","flags":"","result":',
    '{"key":"',
    '{"err":1,"x":"',
)

PIECES = (
    "driver 1",
    "Driver 1.",
    "heater 1",
    "Heater 1 ",
    "RepRapFirmware for ",
    "Finished printing file ",
    "File a",
    " will print in ",
    "Warning: ",
    " event (",
    " event (1V)",
    '{"key":',
    '{"a":',
    '{"err":1',
    '{"dir":',
    "{",
    "}",
    "[",
    "]",
    '"',
    '""',
    '"a',
    '"é',
    "é",
    "\\",
    '\\"',
    "*1",
    "N1 ",
    "X:1 ",
    "E:",
    "T0:1 ",
    " T:",
    "M0",
    "M",
    "M 587",
    "password",
    "A ",
    "- ",
    "1",
    "1e",
    "-",
    "nan",
    " ",
    "\t",
    "ok",
    ",",
    "a",
)

LINES = st.builds(
    lambda beginning, parts, end: beginning + "".join(parts) + end,
    st.sampled_from(BEGINNINGS),
    st.lists(st.sampled_from(PIECES) | st.text(max_size=5), max_size=12),
    st.sampled_from(("", "\n", "ok", "}", "\0")),
)
"""Short ones, of what the patterns are made of."""


def long_lines(length=LONGEST):
    """Yield lines of one piece over and over, behind each beginning."""
    for beginning in BEGINNINGS:
        for piece in PIECES:
            yield beginning + piece * (length // len(piece))


def slow_ones(look, length=LONGEST):
    """Return for which of the long lines ``look(line)`` takes too long, and how long."""
    slow = {}
    most = MOST_SECONDS * length / LONGEST
    for line in long_lines(length):
        # what is slow only once was the machine
        if _seconds(look, line) > most and (seconds := _seconds(look, line)) > most:
            slow[line[:60]] = round(seconds, 3)
    return slow


def _seconds(look, line):
    began = time.thread_time()
    look(line)
    return time.thread_time() - began
