"""Lines that a host takes for no command, and asterisks, as the firmware's own code reads them."""

import json
import re

import pytest

from octoprint_rrfmodel.rrf.gcode.plain_lines import name_of, with_safe_stars
from tests.support.recordings import RECORDINGS

HOSTS = re.compile(r"^\s*([GM]\d+(\.\d+)?|T\d+|F\d+)")
"""What OctoPrint takes for a command (comm.py, regex_command)."""


@pytest.mark.parametrize(
    "line, name",
    [
        ("X20 Y5", "X20"),
        ("Y1.5", "Y1.5"),
        ("g28 x", "G28"),
        ('m98 P"a.g"', "M98"),
        ("g04 p100", "G4"),
        ("G38.2 Z-5", "G38.2"),
        ("N10 G1 X5", "G1"),
        ("n20g28", "G28"),
        ("N30 X5", "X5"),
        ("T-1", "T"),
        ("T{var.t}", "T"),
        ("t1", "T"),
        ("true", "true"),
        ("echo 1", "echo"),
        ("global a=1", "global"),
        ("(what) G1 X5", "(what)"),
        ("%", "%"),
        ("", ""),
        ("(what it is)", ""),
        ("(a) (b) ", ""),
        ("N10", ""),
        ("N10 (a)", ""),
        ("Q0", ""),
        ("q1 foo", ""),
        ("\x7fM105", ""),
        ("quit", "quit"),
    ],
)
def test_name(line, name):
    assert name_of(line) == name


@pytest.mark.parametrize(
    "command, safe",
    [
        ("M117 *** warm ***", 'M117 "*** warm ***"'),
        ("M117 it's 2*3", "M117 \"it''s 2*3\""),
        ('M117 say "hi" *', 'M117 "say ""hi"" *"'),
        ('M117 "a*b"', 'M117 "a*b"'),
        ("M117 plain", "M117 plain"),
        ("M32 a*b.g", 'M32 "a*b.g"'),
        ('M118 P1 S"a*b"', 'M118 P1 S"a*b"'),
        ("G1 X{2*3}", "G1 X{2*3}"),
        ("G1 X10 Y5*71", "G1 X10 Y5"),
        ("G1 X10 * 71 ", "G1 X10"),
        ("G1 X2*3 Y5", None),
        ('M118 S"a" *b', None),
    ],
)
def test_asterisk(command, safe):
    assert with_safe_stars(command, command.split()[0]) == safe


def recorded():
    """Give inputs of the firmware's own code that are one line and no command to a host."""
    path = RECORDINGS / "golden" / "firmware-replies.json"
    if not path.is_file():
        return
    for version, sessions in json.loads(path.read_text("utf-8"))["versions"].items():
        for entry in sessions["parser"] + sessions.get("temps", []):
            line = entry["in"].rstrip("\n")
            # a host cuts comments off and sends no numbers and NULs of its own
            if HOSTS.match(line) or set(line) & set("\n\r\0;*"):
                continue
            if line == "(comment)":
                # recorded on a printer; a CNC machine reads comments
                continue
            yield pytest.param(line, entry["usb"], id=f"{version} {line!r}")


@pytest.mark.parametrize("line, answer", recorded())
def test_acknowledged_as_recorded(line, answer):
    assert bool(name_of(line)) == bool(re.search("^ok", answer, re.MULTILINE))
