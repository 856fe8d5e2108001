"""Requests to OctoPrint's printer API with what its documents answer: one row each.

The list is docs.octoprint.org, "Printer operations". It has ranges of feed and flow rate too, but
OctoPrint itself has given up their ends (OctoPrint/OctoPrint #3503).
"""

from typing import NamedTuple

from tests.support.basedir import is_version_2

from .printer_bench import STATES

SCRIPT = 'M117 {{ parameters.word }} {{ context.number }}\nM118 P0 S"{{ parameters.word }}"\n'
"""What the script ``greeting`` is."""


class By(NamedTuple):
    """What is another thing in 1.11 and in 2.0."""

    first: object
    second: object

    @staticmethod
    def version(value, version):
        if not isinstance(value, By):
            return value
        return value.second if is_version_2(version) else value.first


JOG = {"command": "jog"}
HOME = {"command": "home"}
FEEDRATE = {"command": "feedrate"}
SELECT = {"command": "select"}
TARGET = {"command": "target"}
OFFSET = {"command": "offset"}
EXTRUDE = {"command": "extrude"}
FLOWRATE = {"command": "flowrate"}

RIGHT = {
    "printhead": [
        ({**JOG, "x": 10}, ["M120 G21 G91 G1 X10 F6000 M121"]),
        ({**JOG, "x": -1.5, "y": 2, "z": 0.02}, ["M120 G21 G91 G1 X-1.5 Y2 Z0.02 F200 M121"]),
        ({**JOG, "x": 0.00002, "speed": 600}, ["M120 G21 G91 G1 X0.00002 F600 M121"]),
        ({**JOG, "y": 20, "absolute": True}, ["M120 G21 G90 G1 Y20 F6000 M121"]),
        ({**JOG, "x": 1, "speed": False}, ["M120 G21 G91 G1 X1 M121"]),
        ({**HOME, "axes": ["x", "y"]}, ["G28 X Y"]),
        ({**HOME, "axes": ["z"]}, ["G28 Z"]),
        ({**FEEDRATE, "factor": 105}, ["M220 S105"]),
        ({**FEEDRATE, "factor": 0.95}, ["M220 S95"]),
        ({**FEEDRATE, "factor": 30}, ["M220 S30"]),
        ({**FEEDRATE, "factor": 100}, ["M220 S100"]),
    ],
    "tool": [
        ({**SELECT, "tool": "tool0"}, ["T0"]),
        ({**TARGET, "targets": {"tool0": 211}}, ["M568 P0 S211 A2"]),
        ({**TARGET, "targets": {"tool": 210.5}}, ["M568 P0 S210.5 A2"]),
        ({**TARGET, "targets": {}}, []),
        ({**OFFSET, "offsets": {"tool0": 5}}, []),
        ({**OFFSET, "offsets": {"tool0": -50, "tool1": 50}}, []),
        ({**OFFSET, "offsets": {"tool0": 0, "tool1": 0}}, []),
        ({**EXTRUDE, "amount": 1}, ["M120 M83 G1 E1 F300 M121"]),
        ({**EXTRUDE, "amount": -1, "speed": 100}, ["M120 M83 G1 E-1 F100 M121"]),
        ({**FLOWRATE, "factor": 95}, ["M221 D0 S95"]),
        ({**FLOWRATE, "factor": 1.0}, ["M221 D0 S100"]),
    ],
    "bed": [
        ({**TARGET, "target": 61}, ["M140 P0 S61"]),
        ({**TARGET, "target": 0}, ["M140 P0 S{-273.15}"]),
        ({**OFFSET, "offset": -5}, []),
        ({**OFFSET, "offset": 0}, []),
    ],
    "chamber": [
        ({**TARGET, "target": 46.5}, ["M141 P0 S46.5"]),
        ({**TARGET, "target": 0}, ["M141 P0 S{-273.15}"]),
        ({**OFFSET, "offset": 5}, []),
        ({**OFFSET, "offset": 0}, []),
    ],
    # OctoPrint leaves out what is already done
    "sd": [({"command": "refresh"}, ["M20"]), ({"command": "init"}, [])],
    "command": [
        ({"command": "M117 one"}, ["M117 one"]),
        ({"commands": ["M117 one", "m117 two"]}, ["M117 one", "m117 two"]),
        ({"commands": []}, []),
        ({"command": "M117 %(a)s", "parameters": {"a": "b"}}, ["M117 b"]),
        (
            {"script": "greeting", "parameters": {"word": "hi"}, "context": {"number": 7}},
            ["M117 hi 7", 'M118 P0 S"hi"'],
        ),
    ],
}

MALFORMED = {
    "printhead": [
        {},
        {"command": "nonsense"},
        JOG,
        {**JOG, "u": 10},
        {**JOG, "x": "10"},
        {**JOG, "x": None},
        {**JOG, "x": True},
        {**JOG, "x": 1, "y": [1]},
        {**JOG, "x": 1, "speed": "fast"},
        {**JOG, "x": 1, "speed": -600},
        HOME,
        {**HOME, "axes": ["u"]},
        {**HOME, "axes": ["x", 1]},
        {**HOME, "axes": 5},
        FEEDRATE,
        {**FEEDRATE, "factor": "105"},
        {**FEEDRATE, "factor": 0},
        {**FEEDRATE, "factor": -50},
        {**FEEDRATE, "factor": True},
        {**FEEDRATE, "factor": None},
    ],
    "tool": [
        {},
        {"command": "nonsense"},
        SELECT,
        {**SELECT, "tool": 0},
        {**SELECT, "tool": "tool"},
        {**SELECT, "tool": "0"},
        {**SELECT, "tool": "tool0x"},
        TARGET,
        {**TARGET, "targets": {"tool0": "210"}},
        {**TARGET, "targets": {"tool0": -1}},
        {**TARGET, "targets": {"tool0": True}},
        {**TARGET, "targets": {"bed": 50}},
        {**TARGET, "targets": {"tool0": 50, "toolx": 50}},
        {**TARGET, "targets": [50]},
        OFFSET,
        {**OFFSET, "offsets": {"tool0": 51}},
        {**OFFSET, "offsets": {"tool0": -51}},
        {**OFFSET, "offsets": {"tool0": "5"}},
        {**OFFSET, "offsets": {"tool": 5}},
        {**OFFSET, "offsets": {"tool0x": 5}},
        {**OFFSET, "offsets": 5},
        EXTRUDE,
        {**EXTRUDE, "amount": "5"},
        {**EXTRUDE, "amount": False},
        {**EXTRUDE, "amount": 5, "speed": "fast"},
        FLOWRATE,
        {**FLOWRATE, "factor": "95"},
        {**FLOWRATE, "factor": 0},
    ],
    **{
        path: [
            {},
            {"command": "nonsense"},
            TARGET,
            {**TARGET, "target": "60"},
            {**TARGET, "target": -1},
            {**TARGET, "target": None},
            OFFSET,
            {**OFFSET, "offset": 51},
            {**OFFSET, "offset": -51},
            {**OFFSET, "offset": "5"},
            {**OFFSET, "offset": True},
        ]
        for path in ("bed", "chamber")
    },
    "sd": [{}, {"command": "nonsense"}],
    "command": [
        {},
        {"command": "M115", "commands": ["M115"]},
        {"command": "M115", "script": "greeting"},
        {"commands": ["M115"], "script": "greeting"},
        {"commands": "M115"},
    ],
}

ANY = {
    "printhead": [{**JOG, "x": 1}, {**HOME, "axes": ["x"]}, {**FEEDRATE, "factor": 100}],
    "tool": [
        {**SELECT, "tool": "tool0"},
        {**TARGET, "targets": {"tool0": 50}},
        {**OFFSET, "offsets": {"tool0": 5}},
        {**EXTRUDE, "amount": 1},
        {**FLOWRATE, "factor": 95},
    ],
    "bed": [{**TARGET, "target": 50}, {**OFFSET, "offset": 5}],
    "chamber": [{**TARGET, "target": 50}, {**OFFSET, "offset": 5}],
    "sd": [{"command": "init"}, {"command": "refresh"}, {"command": "release"}],
    "command": [{"command": "M117"}, {"script": "greeting"}],
}
"""One request of each command."""


def state_rows():
    """Yield the requests whose status depends on the server's state."""
    for path, bodies in ANY.items():
        for body in bodies:
            yield "disconnected", path, body, 409, []
    for state, paths in (
        ("no bed", ["bed"]),
        ("no chamber", ["chamber"]),
        ("no bed, no chamber", ["bed", "chamber"]),
    ):
        for path in paths:
            for body in ANY[path]:
                yield state, path, body, 409, []
    for body in ANY["sd"]:
        yield "card disabled", "sd", body, 404, []
        yield "printing", "sd", body, 409, []
        yield "paused", "sd", body, 409, []
    yield "released", "sd", {"command": "refresh"}, 409, []
    yield "released", "sd", {"command": "release"}, 409, []
    # all but moving, selecting and extruding is for prints too
    yield "printing", "printhead", {**JOG, "x": 1}, 409, []
    yield "printing", "printhead", {**HOME, "axes": ["x"]}, 409, []
    yield "printing", "printhead", {**FEEDRATE, "factor": 100}, 204, ["M220 S100"]
    yield "printing", "tool", {**SELECT, "tool": "tool0"}, 409, []
    yield "printing", "tool", {**EXTRUDE, "amount": 1}, 409, []
    yield "printing", "tool", {**TARGET, "targets": {"tool0": 50}}, 204, ["M568 P0 S50 A2"]
    yield "printing", "tool", {**OFFSET, "offsets": {"tool0": 0}}, 204, []
    yield "printing", "tool", {**FLOWRATE, "factor": 100}, 204, ["M221 D0 S100"]
    yield "printing", "bed", {**TARGET, "target": 50}, 204, ["M140 P0 S50"]
    yield "printing", "chamber", {**TARGET, "target": 40}, 204, ["M141 P0 S40"]
    yield "printing", "command", {"command": "M117 now"}, 204, ["M117 now"]
    jog, refused = ["M120 G21 G91 G1 X1 F6000 M121"], []
    yield "paused", "printhead", {**JOG, "x": 1}, By(204, 409), By(jog, refused)
    yield "paused", "printhead", {**FEEDRATE, "factor": 100}, 204, ["M220 S100"]
    yield "paused", "tool", {**SELECT, "tool": "tool0"}, 204, ["T0"]
    yield "operational", "command", {"script": "nonsense"}, 404, []
    yield "operational", "storage", {"command": "refresh"}, By(404, 204), By([], ["M20"])


def rows():
    """Yield state, path, body, status and G-code on the wire, by the states."""
    for path, pairs in RIGHT.items():
        for body, wire in pairs:
            yield "operational", path, body, 204, wire
    yield from sorted(state_rows(), key=lambda row: list(STATES).index(row[0]))


def name_of(state, path, body, *_):
    """Return what a row is called among the tests."""
    values = [f"{name}={value}" for name, value in body.items() if name != "command"]
    return "-".join([state, path, str(body.get("command", "")), *values])
