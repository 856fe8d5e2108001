"""A board set up as the firmware was when its answers were recorded, and how both are compared."""

from __future__ import annotations

import dataclasses
import re

from octoprint_rrfmodel.simulator import machines
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.hardware import parts

MACHINE = "recorded"
TICK = 0.05
"""Simulated seconds between two looks at the board."""
PACE = 0.6
"""Simulated seconds from one input to the next where nothing has to be awaited."""
LONGEST = 900.0
HOTEND = 21.0

REPORT = re.compile(r"T\d*:(<now>|[-\d.]+) /[-\d.]+.*")
"""A temperature line that nobody has asked for."""

MONITOR = {"enableMode": 0, "enabled": False, "status": "ok", "type": "simple"}

MACROS = {
    "bed": "M400\n",
    "pause": "M83\nG1 E-2 F2400\nG91\nG1 Z5 F900\nG90\n",
    "resume": "M83\nG1 E2 F2400\n",
    "cancel": "M104 S0\nM140 S0\nM107\n",
}

_MASKS = (
    (re.compile(r"RepRapFirmware for .*? version [^ \n(]+( \([^)]*\))?"), "<firmware>"),
    (re.compile(r"FIRMWARE_VERSION: \S+"), "FIRMWARE_VERSION: <version>"),
    (re.compile(r"ELECTRONICS: Duet 3 Mini5plus \S+"), "ELECTRONICS: <electronics>"),
    (re.compile(r"FIRMWARE_DATE: \S+ \S+"), "FIRMWARE_DATE: <date>"),
    (re.compile(r'("date":|"lastModified":)"[^"]*"'), r"\1<date>"),
    (re.compile(r"\b([TBC]\d*:)[-\d.]+ /([-\d.]+)"), r"\1<now> /\2"),
    (re.compile(r"Count( -?\d+)+"), "Count <steps>"),
    (re.compile(r"E0:-?[\d.]+"), "E0:<mm>"),
    (re.compile(r"(is currently at|, reading) [-\d.]+"), r"\1 <now>"),
    (re.compile(r'"size":\d+'), '"size":<bytes>'),
    (re.compile(r"capacity [\d.]+[GM][Bb]"), "capacity <bytes>"),
    (re.compile(r"cluster size \d+"), "cluster size <bytes>"),
    (re.compile(r'"clsize":\d+'), '"clsize":<bytes>'),
    (re.compile(r"SD printing byte \d+/\d+"), "SD printing byte <n>"),
    (re.compile(r"(partition size|free space) [\d.]+GB"), r"\1 <bytes>"),
    (re.compile(r'"(capacity|partitionSize|free)":\d+'), r'"\1":<bytes>'),
    (re.compile(r'"(?:ledStrips|reply)":\d+,'), ""),
    (re.compile(r"(Heater \d+ fault: ).*"), r"\1<why>"),
    (re.compile(r"\d+ points probed, .*"), "<n> points probed"),
    (re.compile(r"(Printing paused at X).*"), r"\1<mm>"),
    (re.compile(r'"time":("[^"]*"|null)'), '"time":<now>'),
    (re.compile(r"line \d+ column \d+"), "line <n> column <n>"),
    (re.compile(r"=== RTOS ===\n[^=]*"), ""),
    (re.compile(r"(?m)^(HTTP|Telnet|LCD|SBC) is .*\n"), ""),
    (re.compile(r"(running on Duet 3 Mini5plus|Board ID:) .*"), r"\1 <board>"),
    (re.compile(r"((Driver|Extruder) \d+( sensor)?:) .*"), r"\1 <state>"),
    (re.compile(r"under-voltage event \([\d.]+V\)"), "under-voltage event (<volts>)"),
)
"""What is of the moment, of the build or of the card: measurements, dates, names, sizes."""


def masked(text):
    """Return a reply with everything masked that isn't said of every such board at any time."""
    for pattern, replacement in _MASKS:
        text = pattern.sub(replacement, text)
    return text


def lines_of(said):
    """Return (time, masked line) of everything said, JSON by its shape."""
    return [(time, _shaped(line)) for time, text in said for line in masked(text).splitlines()]


def _shaped(line):
    """Return the line, numbers of JSON left out, and those that M122 has counted or measured."""
    if _COUNTS.match(line):
        return _ANY_NUMBER.sub("#", line)
    return _NUMBER.sub(r"\1#", line) if line.startswith('{"') else line


_COUNTS = re.compile(
    r"Used output|Last reset|Supply voltage|Heap OK|Date/time|Slowest|SD card longest|check |"
    r"DMs created|Segments created"
)
_ANY_NUMBER = re.compile(r"-?\d[-\d.:]*")
_NUMBER = re.compile(r"([:\[,])-?\d[-+.\de]*")


def without_reports(text):
    """Return the reply without temperature lines that nobody has asked for."""
    return "".join(
        line for line in text.splitlines(keepends=True) if not REPORT.fullmatch(line.rstrip("\n"))
    )


def _sensors():
    """The sensors of that configuration."""
    found = machines.MACHINES["cartesian"].sensors()[:2]
    for sensor in found:
        sensor.update(beta=4092.0, c=0.0)
    return found


def machine():
    """Return the machine whose configuration the firmware had, as :mod:`machines` writes it."""
    return dataclasses.replace(
        machines.MACHINES["cartesian"],
        has_atx=False,
        has_probe=False,
        led_strips=(),
        sensors=_sensors,
        tools=lambda: [parts.tool(0, "E0", [1], [0], [0], ((0,), (1,), (2,)), (0, 0, 0))],
    )


class Recorded:
    """A board with that machine on simulated time that goes on as a test says."""

    def __init__(self, firmware):
        self.time = 0.0
        self.is_held = False
        """Whether the host doesn't read."""
        self.board = Board(MACHINE, firmware, clock=lambda: self.time)
        self.board.transmit()
        self.board.model["heat"]["heaters"][1]["current"] = HOTEND
        self.board.model["sensors"]["filamentMonitors"] = [dict(MONITOR)]
        self._fill_card()

    def _fill_card(self):
        card = self.board.card
        for name in ("tfree", "tpre", "tpost"):
            card.delete(f"0:/sys/{name}.g")
        for name, text in MACROS.items():
            card.write(f"0:/sys/{name}.g", text)
        for name in ("homex.g", "homey.g", "homez.g", "homeall.g"):
            card.write(f"0:/sys/{name}", "; homing\n")
        for entry in card.entries("0:/gcodes") + card.entries("0:/gcodes/Spare parts"):
            self._shrink_thumbnail(entry)

    def _shrink_thumbnail(self, entry):
        """Make the picture in a print file as small as it was there."""
        card = self.board.card
        for folder in ("0:/gcodes", "0:/gcodes/Spare parts"):
            path = f"{folder}/{entry.name}"
            content = card.read(path)
            if content is not None:
                text = content.decode("utf-8").replace("begin 32x32 12", "begin 2x2 12")
                card.write(path, text, card.date(path))

    def send(self, text):
        """Give the board bytes, and return what it says at once."""
        self.board.receive(text.encode("latin-1"))
        return self.said()

    def said(self):
        return self.board.transmit().decode("latin-1")

    def wait(self, seconds):
        """Let time go on in ticks; return what the board says meanwhile."""
        end = self.time + seconds
        text = ""
        while self.time < end - 1e-9:
            self.time = min(end, self.time + TICK)
            text += self.said()
        return text

    @property
    def is_done(self):
        board = self.board
        return board.channels["USB"].is_idle and not board.job.is_running

    def until(self, time):
        """Let time go on to that moment; return (time, text) of what the board says."""
        said = []
        while self.time < time - 1e-9:
            self.time = min(time, self.time + TICK)
            if not self.is_held:
                said += self.stamped(self.said())
        return said

    def stamped(self, text):
        """Return the text with the time, nothing without a text."""
        return [(self.time, text)] if text else []

    def answer(self, text, waits):
        """Return what the board says to an input; with ``waits`` however long it takes."""
        started = self.time
        said = self.send(text)
        while waits and not self.is_done and self.time < started + LONGEST:
            said += self.wait(TICK)
        return said + self.wait(max(TICK, started + PACE - self.time))


def stretches(session):
    """Return the session's entries in groups, each of which ends with everything answered.

    Where the recording went on without waiting for an ``ok``, an answer is part of what came later.
    """
    found, group = [], []
    for entry in session:
        group.append(entry)
        lacks_answer = without_reports(entry["usb"]) == "" and entry["in"][:1] in "GMT"
        if not lacks_answer or entry["in"].startswith(NEVER_ANSWERED):
            found.append(group)
            group = []
    return found + ([group] if group else [])


NEVER_ANSWERED = ("M105\n",)
"""What may be a line of an upload, which nobody answers."""
