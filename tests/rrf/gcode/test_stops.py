"""M0 and M1 of a streamed file: what is its end, and what goes out there."""

import pytest

from octoprint_rrfmodel.rrf.gcode.stops import is_at_end, stop_lines
from octoprint_rrfmodel.rrf.views.machine import Machine

MODEL = {
    "heat": {"bedHeaters": [0], "chamberHeaters": [], "heaters": [{}, {}]},
    "tools": [{"number": 2, "heaters": [1]}],
}


def lines(command, version):
    machine = Machine({"boards": [{"firmwareVersion": version}], **MODEL})
    return stop_lines(command, command.split()[0], machine)


@pytest.mark.parametrize(
    "command, line",
    [
        ("M0", "M400 M0"),
        ("M1", "M400 M1"),
        ("M0 H1", "M400 M0 H1"),
        ("M0 H0", "M400 M0"),
        ("M0 The print is done", "M400 M0"),
        ("M1 P5000", "M400 M1"),
    ],
)
def test_lines_where_the_firmware_takes_a_stop_from_any_channel(command, line):
    assert lines(command, "3.4.6") == [line]


@pytest.mark.parametrize("command", ["M0", "M1", "M0 H0", "M0 Done"])
def test_lines_where_it_refuses_it(command):
    assert lines(command, "3.5.3") == [
        "M400",
        'M98 P"stop.g"',
        "M568 P2 A0",
        "M140 P0 S{-273.15}",
    ]


@pytest.mark.parametrize("command", ["M0 H1", "M1 H1"])
def test_lines_that_keep_the_heaters(command):
    assert lines(command, "3.6") == ["M400", 'M98 P"stop.g"']


SETTINGS = "; layer_height = 0.2\n" * 2000


@pytest.mark.parametrize(
    "before, behind, wanted",
    [
        ("G1 X5\nM0\n", "", True),
        ("G1 X5\nM0", "", True),
        ("G1 X5\r\nM0 H1 ; off\r\n", "\r\n\r\n", True),
        ("G1 X5\nM0 (end)\n", SETTINGS, True),
        ("G1 X5\nN20 M00\n", "%\n", True),
        ("G1 X5\nM0\n", "G1 X6\n", False),
        ("G1 X5\nM0\n", SETTINGS + "M84\n", False),
        ("M1\n", "M0\n", False),
        ("G1 X5\nM0\n", "(not the end)\n  M30\n", False),
        # a place that was miscounted
        ("G1 X5\nM0\n; set", "tings\n", True),
        ("G1 X5\nM0\nG1 X", "6\n", False),
        ("G1 X5\nM0\nG1 X6\n", "M0\n", False),
        ("G1 X5\nM104 S0\n", "", False),
        ("", "", False),
    ],
)
def test_end(before, behind, wanted):
    assert is_at_end(before, behind) is wanted
