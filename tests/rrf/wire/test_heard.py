"""Lines by which the firmware tells of something before the model does."""

import pytest

from octoprint_rrfmodel.rrf.wire.errors import guarded_warning, is_serious
from octoprint_rrfmodel.rrf.wire.heard import TELLING, WORDS, heard

LINES = [
    ("RepRapFirmware for Duet 3 Mini 5+ is up and running.\n", "reset"),
    ("Send M292 to continue\n", "box"),
    ("Send M292 to continue or M292 P1 to cancel\n", "box"),
    ("Heater 1 fault: temperature excursion exceeded 15.0°C\n", "fault"),
    ("Error: Heater 1 fault: temperature excursion exceeded 15.0°C\n", "fault"),
    ("- Printing paused -\n", "fault"),
    ("- Event notification -\n", "fault"),
    ("Driver 0.3 error: over temperature shutdown\n", "fault"),
    ("Error: Driver 0 error: over temperature shutdown\n", "fault"),
    ("Filament error on extruder 0: noFilament\n", "fault"),
    ("Emergency Stop! Reset the controller to continue.\n", "fault"),
    ("Warning: VIN under-voltage event (11.0V)ok\n", "fault"),
    ("Error: M20: Machine is halted\n", "card"),
    ("RepRapFirmware for Duet 2 WiFi/Ethernet version 3.5.3\n", None),
    ("Error: G0/G1: insufficient axes homed\n", None),
    ("Done printing file\n", None),
    ("", "silence"),
    ("\n", None),
]


@pytest.mark.parametrize("line, told", LINES)
def test_heard(line, told):
    assert heard(line) == told
    # only such lines are looked at
    assert told is None or line[:1] in TELLING


def test_each_pattern_has_an_example():
    assert len(WORDS) <= sum(1 for _, told in LINES if told)


@pytest.mark.parametrize(
    "text, code",
    [
        ("Heater 2 fault: heating fault", "heater_fault"),
        ("Driver 0.3 error: short to ground", "driver_error"),
        ("short-to-ground", None),
    ],
)
def test_guarded(text, code):
    assert is_serious(text)
    assert guarded_warning(text) == code
