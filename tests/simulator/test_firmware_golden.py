"""What the board says, against what the firmware's own code has said to the same inputs."""

from __future__ import annotations

import difflib
import json
import re

import pytest

from octoprint_rrfmodel.simulator import machines
from octoprint_rrfmodel.simulator.hardware import parts

from .golden_bench import (
    MACHINE,
    REPORT,
    Recorded,
    lines_of,
    machine,
    masked,
    stretches,
    without_reports,
)

VERSIONS = {"3.5.3": "3.5.3", "3.6.0-beta.1": "3.6"}
"""Recorded version → the board's."""

LEAST_SHARE = 0.95
"""Share of the replies that must be equal."""

LATE = "when it is said depends on the pace of the recording, which isn't known"
HEATER = "the recorded machine's heater"

DIFFERENT = {
    ("meta2", "echo 7%2\n"): "the message of a slip of the firmware's parser, which prints a digit",
    ("moves-homed", "G1 X300 M105 M114\nM105 G1 X300\n"): "where the axes were at that moment",
    ("moves-homed", "M120 M83 G1 E1 F300 M121\n"): LATE,
    ("moves-homed", "M120 M83 G1 E1 F300 M121\nM83 G1 E1 F300\nM400\n"): LATE,
    ("moves-homed", "M290 R0 S0\n"): LATE,
    ("moves-homed", "M290 Z0.1\n"): LATE,
    ("moves-unhomed", "M302 P1\n"): LATE,
    ("moves-unhomed", "G1 E1 F300\n"): LATE,
    ("parser", "'\n"): "a lone apostrophe, which the firmware doesn't repeat",
    ("replies", "M307 H0\n"): HEATER,
    ("replies", "M501\n"): HEATER,
    ("temps", "M109\n"): LATE,
    ("temps", "M109 T0 S25\n"): LATE,
}
"""Session and input → why the board answers it in another way."""


@pytest.fixture(scope="module")
def recorded(shared_dir):
    """Return the function that reads a file of recorded answers."""

    def read(name):
        path = shared_dir / "golden" / f"firmware-{name}.json"
        if not path.is_file():
            pytest.skip(f"{path} isn't there, set RRF_SHARED")
        return json.loads(path.read_text(encoding="utf-8"))["versions"]

    return read


@pytest.fixture(autouse=True)
def recorded_machine(monkeypatch):
    """The machine of the recordings among those that can be asked for."""
    monkeypatch.setitem(machines.MACHINES, MACHINE, machine())


def replayed(name, session, firmware):
    """Return (input, number of inputs, expected, said) of each stretch."""
    bench = Recorded(firmware)
    for entry in session:
        if entry["in"] == "M503\n":
            bench.board.card.write("0:/sys/config.g", entry["usb"].removesuffix("\nok\n"))
    groups = stretches(session) if name.startswith("moves") else [[entry] for entry in session]
    found = []
    for group in groups:
        expected = "".join(entry["usb"] for entry in group)
        said = "".join(bench.answer(entry["in"], "ok" in entry["usb"]) for entry in group)
        if len(group) > 1:
            expected, said = without_reports(expected), without_reports(said)
        found.append(("".join(entry["in"] for entry in group), len(group), expected, said))
    return found


@pytest.mark.parametrize("version", VERSIONS)
def test_replies(recorded, version, capsys):
    equal = total = 0
    different, unexpected = set(), []
    for name, session in recorded("replies")[version].items():
        for text, count, expected, said in replayed(name, session, VERSIONS[version]):
            total += count
            if masked(expected) == masked(said):
                equal += count
                continue
            different.add((name, text))
            if (name, text) not in DIFFERENT and not is_of_the_build(version, text):
                unexpected.append((name, text, expected, said))
    with capsys.disabled():
        print(f"\n{version}: {equal} of {total} replies equal ({equal / total:.1%})")
        for name, text, expected, said in unexpected:
            print(f"  {name}: {text!r}\n    firmware {expected!r}\n    board    {said!r}")
    assert not unexpected
    assert not DIFFERENT.keys() - different, "equal by now"
    assert equal >= LEAST_SHARE * total


def is_of_the_build(version, text):
    """Return whether an answer of the recorded build isn't the firmware's: heights in 3.6."""
    return version.startswith("3.6") and text.startswith("M36 ")


CLOSE = 0.16
"""Seconds that an answer may be early or late: a tenth and a tick."""


def prepared(name, bench):
    """Set up what a scenario had on its card; switch on what happened in it."""
    card = bench.board.card
    card.write("0:/macros/heat", "T0\nM109 S60\n")
    if name == "g32-slow":
        card.write("0:/sys/bed.g", "G4 S40\n")
    if name == "t0-with-m116":
        card.write("0:/sys/tpost0.g", "M116 P0\n")
    if name == "g29-mesh":
        bench.board.model["sensors"]["probes"] = [parts.probe()]
    if name == "buffers-hold-usb-10s":
        bench.board.inject("unread")


EVENTS = {
    "vin-low": [(4.5, "message", "Warning: VIN under-voltage event (8.0V)")],
    "usb-t0-while-sd-prints": [(20.0, "heated", "")],
    "buffers-hold-usb-10s": [(1.4, "hold", ""), (13.5, "read", "")],
}
"""Scenario → what happened besides what was said."""


def faults_in(events):
    """Return the faults of heaters at the moments at which the firmware told of them."""
    told = [time for time, channel, text in events if channel == "usb" and "Heater 1 fault" in text]
    return [(time, "inject", "heater_fault:1") for time in told]


def said_in(name, events, firmware):
    """Return (time, text) of what the board says in a scenario."""
    bench = Recorded(firmware)
    prepared(name, bench)
    bench.until(events[0][0])
    said = []
    happened = [*EVENTS.get(name, ()), *faults_in(events)]
    for time, channel, text in sorted([*events[1:], *happened], key=lambda event: event[0]):
        said += bench.until(time)
        if channel == "in":
            bench.board.receive(text.encode("utf-8"))
            if not bench.is_held:
                said += bench.stamped(bench.said())
        elif channel == "auxin":
            bench.board.execute(text.strip(), "aux")
        elif channel == "inject":
            bench.board.inject(text)
        elif channel == "message":
            bench.board.message(text)
        elif channel == "heated":
            for heater in bench.board.model["heat"]["heaters"]:
                heater["current"] = heater["active"]
        elif channel in ("hold", "read"):
            bench.is_held = channel == "hold"
    end = events[-1][0] + (30.0 if name in HEATING else 1.0)
    return said + bench.until(end)


OTHER_COURSE = {
    "buffers-m122": "diagnostics are those of a build",
    "m122": "diagnostics are those of a build",
    "filament-error-host-stream": "filament monitors of M591 aren't simulated",
    "queue-full-after-m105": "3.6 takes half a second longer for the first move",
    "sd-print-pause-resume-cancel": "in which move a pause falls",
    "usb-t0-while-sd-prints": "the whole print takes some seconds more",
}
"""Scenario → why the board goes through it in another way."""

HEATING = (
    "heater-fault-in-m109",
    "m109-after-m105",
    "m109-after-m409",
    "m109-no-status-request",
    "m112-during-m109",
    "m190-after-m408",
    "m98-macro-m109",
    "sd-print",
    "t0-with-m116",
)
"""Scenarios in which a heater warms up: it does so some seconds faster or slower there."""


def without_repeats(lines):
    """Return the lines, of temperature reports in a row the first only."""
    found = []
    for time, line in lines:
        if not (REPORT.fullmatch(line) and found and REPORT.fullmatch(found[-1][1])):
            found.append((time, line))
    return found


def differences(expected, said, is_heating):
    """Return what differs: lines in another order, or the most that one is early or late."""
    wanted, got = lines_of(expected), lines_of(said)
    if is_heating:
        wanted, got = ([(0.0, line) for _, line in without_repeats(ls)] for ls in (wanted, got))
    if [line for _, line in wanted] != [line for _, line in got]:
        texts = [[line for _, line in lines] for lines in (wanted, got)]
        return "\n".join(difflib.unified_diff(*texts, "firmware", "board", n=1, lineterm=""))
    times = zip(wanted, got)
    late = max((abs(one[0] - other[0]) for one, other in times), default=0.0)
    return f"{late:.2f} s early or late" if late > CLOSE else ""


@pytest.mark.parametrize("version", VERSIONS)
def test_timelines(recorded, version, capsys):
    found = {}
    scenarios = recorded("timelines")[version]
    for name, events in scenarios.items():
        events = [(time, channel, text) for time, channel, text in events]
        expected = [(time, utf8(text)) for time, channel, text in events if channel == "usb"][1:]
        said = said_in(name, events, VERSIONS[version])
        difference = differences(expected, said, name in HEATING)
        if difference:
            found[name] = difference
    unexpected = found.keys() - OTHER_COURSE.keys()
    with capsys.disabled():
        print(f"\n{version}: {len(scenarios) - len(found)} of {len(scenarios)} timelines equal")
        for name in sorted(unexpected):
            print(f"  {name}: {found[name][:3000]}")
    assert not unexpected
    if version == "3.6.0-beta.1":
        needless = {name for name in OTHER_COURSE if name in scenarios} - found.keys()
    else:
        needless = OTHER_COURSE.keys() - found.keys() - {"queue-full-after-m105"}
    assert not needless, "equal by now"


def utf8(text):
    """Return the text as :class:`Recorded` gives it: a letter for each byte."""
    return text.encode("utf-8").decode("latin-1")


STATES = {
    "idle": (),
    "homed and hot": ("G28", "T0", "M104 S205", "M140 S60", "M116"),
    "printing": ('M32 "square.gcode"', "wait 40"),
    "paused": ("M25",),
    "cancelled": ("M0",),
    "heater fault": ("M104 S200", "inject heater_fault:1"),
    "halted": ("M112",),
}
"""State → what brings a board there from the one before."""


OF_THE_BUILD = re.compile(
    r"boards\[0\]\.(accelerometer|canAddress|directDisplay|iapFileNameSBC|mcuTemp|v12|wifi\w+)"
    r"|inputs\[[0178]\]|ledStrips|limits\.ledStrips|network\.|seqs\.(ledStrips|reply)|state\.time"
)
"""Members that the recorded build had no hardware for, or inputs that it lacked."""

OTHER_MEMBERS = {
    "job.timesLeft.filament": "how far the print has come",
    "job.timesLeft.file": "how far the print has come",
}
"""Path → why the board shows something else."""


def shape_of(value):
    """Return members and types of a value; an array's by its elements, numbers all alike."""
    if isinstance(value, dict):
        return {name: shape_of(member) for name, member in value.items()}
    if isinstance(value, list):
        return [shape_of(element) for element in value]
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, (int, float)):
        return "number"
    return "null" if value is None else "text"


def paths_of(shape, path=""):
    """Return path → type of every member."""
    if isinstance(shape, dict):
        found = {}
        for name, member in shape.items():
            found.update(paths_of(member, f"{path}.{name}"))
        return found or {path: "object"}
    if isinstance(shape, list):
        found = {f"{path}#": len(shape)}
        for index, element in enumerate(shape):
            found.update(paths_of(element, f"{path}[{index}]"))
        return found
    return {path: shape}


def bring_to(state, bench):
    for step in STATES[state]:
        word, _, rest = step.partition(" ")
        if word == "wait":
            bench.wait(float(rest))
        elif word == "inject":
            bench.board.inject(rest)
        else:
            bench.answer(step + "\n", not step.startswith("M32"))


@pytest.mark.parametrize("version", VERSIONS)
def test_models(recorded, version, capsys):
    equal = total = 0
    found = {}
    states = next(s for name, s in recorded("models").items() if name.startswith(version))
    bench = Recorded(VERSIONS[version])
    for state, replies in states.items():
        bring_to(state, bench)
        for reply in replies:
            key, flags = reply["key"], reply["flags"]
            text = bench.answer(f'M409 K"{key}" F"{flags}"\n', False)
            said = json.loads(next(line for line in text.splitlines() if line.startswith('{"key"')))
            wanted = paths_of(shape_of(reply["result"]), key)
            got = paths_of(shape_of(said["result"]), key)
            total += 1
            differing = {p for p in wanted.keys() | got.keys() if wanted.get(p) != got.get(p)}
            differing = {path for path in differing if not OF_THE_BUILD.match(path)}
            for path in sorted(differing):
                if path not in OTHER_MEMBERS:
                    place = (path, str(wanted.get(path)), str(got.get(path)))
                    found.setdefault(place, []).append(f"{state} {flags}")
            equal += not differing
    with capsys.disabled():
        print(f"\n{version}: {equal} of {total} parts of models have the same shape")
        for (path, wanted, got), where in found.items():
            print(f"  {path}: firmware {wanted}, board {got} ({len(where)}: {where[0]})")
    assert not found
