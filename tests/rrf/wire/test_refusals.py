"""Which replies spoil a part, from what the firmware's own code said."""

import pytest

from octoprint_rrfmodel.rrf.wire.refusals import (
    CODES,
    ROWS,
    is_plain_refusal,
    only_switches_off,
    refusal,
    text_of,
)

NOT_DRIVEN = (
    "Warning: Tool 0 was not driven because its heater temperatures were not high enough or it has"
    " a heater fault"
)

CASES = [
    ("Error: G1: insufficient axes homed", "refused_move"),
    ("Error: G0/G1: insufficient axes homed", "refused_move"),
    ("Error: M121: insufficient axes homed", "refused_move"),
    ("Error: ok M105: insufficient axes homed", "refused_move"),
    ("Error: in file macro line 3: G1: insufficient axes homed", "refused_move"),
    ("Error: G1: target position outside machine limits", "refused_move"),
    ("Error: G1/G2/G3: intermediate position outside machine limits", "refused_move"),
    ("Error: G2: no I J K or R parameter", "refused_move"),
    ("Error:  at column 5: G1: expected number after 'X'", "refused_move"),
    ("Error: G28: Failed to home axes XY", "refused_move"),
    ("Error: Attempting to extrude with no tool selected.", "refused_extrusion"),
    (NOT_DRIVEN, "refused_extrusion"),
    ("Error: T1: Tool 1 not found", "refused_selection"),
    ("Error: M104: Requested temperature out of range", "refused_heating"),
    ("Error: M140: Temperature too high for heater 0", "refused_heating"),
    ("Error: M140: No bed heater has been configured for slot 1", "refused_heating"),
    ("Error:  at column 7: M109: expected number after 'S'", "refused_heating"),
    ("Error: M568: Invalid tool number", "refused_heating"),
    ("Error: VSSA fault, check thermistor wiring", "refused_heating"),
    ("Error: M600: use M226 and M601 only within a file being printed", "refused_pause"),
    ("Error: M25: Cannot pause print, because no file is being printed!", "refused_pause"),
    # harmless, or somebody else's
    ("Warning: M155: Command is not supported", None),
    ("Warning: G1.5: Command is not supported", None),
    ("Warning: M500: No M501 command was executed in config.g", None),
    ("Error: M106: Fan number 9 not found", None),
    ("Error: M21: No SD card present", None),
    ("Error: G1: Machine is halted", None),
    ("Error: Heater 1 fault: temperature excursion exceeded 15.0", None),
    ("G1: insufficient axes homed", None),
    ("ok", None),
]


@pytest.mark.parametrize("line, code", CASES)
def test_reply(line, code):
    row = refusal(line)
    assert (row.code if row else None) == code


def test_every_row_has_a_reply_and_a_reason():
    assert {code for line, code in CASES if code} == set(CODES)
    assert all(row.reason.endswith(".") for row in ROWS)


@pytest.mark.parametrize(
    "command, is_so",
    [
        ("M104 S0", True),
        ("M104 T7 S0", True),
        ("M140 S-273.15", True),
        ("M141 P0 S0 R0", True),
        ("M104 S200", False),
        ("M568 P1 S0 R100", False),
        ("M104", False),
        ("M116 P0 S0", False),
        ("G1 S0", False),
        ("", False),
    ],
)
def test_what_only_switches_off(command, is_so):
    assert only_switches_off(command) is is_so


def test_texts():
    assert text_of("Error:  at column 7: M104: no") == "at column 7: M104: no"
    assert text_of(NOT_DRIVEN).startswith("Tool 0")
    assert is_plain_refusal("Error: M98: no")
    assert not is_plain_refusal("Error: M98: Machine is halted")
    assert not is_plain_refusal("Warning: no")
