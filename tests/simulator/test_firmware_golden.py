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

LEAST_SHARE = 0.97
"""Share of the replies that must be equal."""

LATE = "the entries carry no times, and this one is said some seconds after what caused it"
OVERRIDE = "the config-override.g of that card, which isn't recorded"

PICTURE = "the board's file has a true picture in it"

DIFFERENT = {
    ("replies", 'M36.1 P"square.gcode" S90\n'): PICTURE,
    ("moves-homed", "M120 M83 G1 E1 F300 M121\n"): LATE,
    ("moves-homed", "M120 M83 G1 E1 F300 M121\nM83 G1 E1 F300\nM400\n"): LATE,
    ("moves-homed", "M290 R0 S0\n"): LATE,
    ("moves-homed", "M290 Z0.1\n"): LATE,
    ("moves-unhomed", "M302 P1\n"): LATE,
    ("moves-unhomed", "G1 E1 F300\n"): LATE,
    ("replies", "M501\n"): OVERRIDE,
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
    # M307 without K in config.g, and nothing of config-override.g yet: the firmware's own
    bed = bench.board.model["heat"]["heaters"][0]["model"]
    bed.update(coolingRate=0.56, coolingExp=1.35, standardVoltage=0.0)
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
    "usb-t0-while-sd-prints": [(4.5, "heated", "")],
    "buffers-hold-usb-10s": [(1.4, "hold", ""), (13.5, "read", "")],
}
"""Scenario → what happened besides what was said."""


FAULTS = {"Heater 1 fault": "heater_fault:1", "Filament error on": "filament_error:0"}
"""What the firmware tells of → the fault that it has seen."""


def faults_in(events):
    """Return the faults of the machine at the moments at which the firmware told of them."""
    return [
        (time, "inject", fault)
        for time, channel, text in events
        for told, fault in FAULTS.items()
        if channel == "usb" and told in text
    ]


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
"""Scenarios in which a heater warms up: what waits for it may be early or late by a tenth."""
TENTH = 0.1


def without_repeats(lines):
    """Return the lines, of temperature reports in a row the first only."""
    found = []
    for time, line in lines:
        if not (REPORT.fullmatch(line) and found and REPORT.fullmatch(found[-1][1])):
            found.append((time, line))
    return found


def differences(expected, said, inputs=()):
    """Return what differs: lines in another order, or the most that one is early or late.

    With the times of ``inputs`` a line may be early or late by a tenth of the time since the last.
    """
    wanted, got = lines_of(expected), lines_of(said)
    if inputs:
        wanted, got = without_repeats(wanted), without_repeats(got)
    if [line for _, line in wanted] != [line for _, line in got]:
        texts = [[line for _, line in lines] for lines in (wanted, got)]
        return "\n".join(difflib.unified_diff(*texts, "firmware", "board", n=1, lineterm=""))
    for (due, line), (time, _) in zip(wanted, got):
        since = due - max((put for put in inputs if put <= due), default=due)
        if abs(due - time) > CLOSE + TENTH * since:
            return f"{time - due:+.2f} s at {due}: {line}"
    return ""


@pytest.mark.parametrize("version", VERSIONS)
def test_timelines(recorded, version, capsys):
    found = {}
    scenarios = recorded("timelines")[version]
    for name, events in scenarios.items():
        events = [(time, channel, text) for time, channel, text in events]
        expected = [(time, utf8(text)) for time, channel, text in events if channel == "usb"][1:]
        said = said_in(name, events, VERSIONS[version])
        inputs = [time for time, channel, _ in events if channel == "in"]
        difference = differences(expected, said, inputs if name in HEATING else ())
        if difference:
            found[name] = difference
    with capsys.disabled():
        print(f"\n{version}: {len(scenarios) - len(found)} of {len(scenarios)} timelines equal")
        for name, difference in found.items():
            print(f"  {name}: {difference[:3000]}")
    assert not found


def utf8(text):
    """Return the text as :class:`Recorded` gives it: a letter for each byte."""
    return text.encode("utf-8").decode("latin-1")


STATES = {
    "idle": (),
    "homed and hot": ("G28", "T0", "M104 S205", "M140 S60", "M116"),
    "printing": ('M32 "square.gcode"', "wait 20.4"),
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
            text = bench.send(f'M409 K"{key}" F"{flags}"\n')
            said = json.loads(next(line for line in text.splitlines() if line.startswith('{"key"')))
            wanted = paths_of(shape_of(reply["result"]), key)
            got = paths_of(shape_of(said["result"]), key)
            total += 1
            differing = {p for p in wanted.keys() | got.keys() if wanted.get(p) != got.get(p)}
            differing = {path for path in differing if not OF_THE_BUILD.match(path)}
            for path in sorted(differing):
                place = (path, str(wanted.get(path)), str(got.get(path)))
                found.setdefault(place, []).append(f"{state} {flags}")
            equal += not differing
    with capsys.disabled():
        print(f"\n{version}: {equal} of {total} parts of models have the same shape")
        for (path, wanted, got), where in found.items():
            print(f"  {path}: firmware {wanted}, board {got} ({len(where)}: {where[0]})")
    assert not found
