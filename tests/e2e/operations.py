"""A connected board with OctoPrint's printer API in front of it, for tests of operations."""

import itertools
import re

import pytest

from octoprint_rrfmodel.rrf.wire.request import LIVE_FLAGS, ModelRequest

from . import helpers

PROFILE = {"extruder": {"count": 11}, "heatedChamber": True, "heatedBed": True}

SETUPS = {
    f"{name} {firmware}": (kind, firmware)
    for name, kind, versions in (
        ("one tool", "cartesian", ("2.05", "3.3", "3.5.3", "3.7")),
        ("changer", "toolchanger", ("2.05", "3.3", "3.5.3", "3.6")),
        ("no tools", "cnc", ("2.05", "3.3", "3.5.3", "3.6")),
        ("two beds", "idex", ("2.05", "3.3", "3.5.3", "3.6")),
        ("chamber", "corexy", ("2.05", "3.5.3")),
    )
    for firmware in versions
}
"""Machine and firmware by the name of both."""

LIVE = (ModelRequest("", LIVE_FLAGS).line, "M408")
"""How polls begin that ask for what changes all the time."""

BESIDE = re.compile(r'M(105|409|408|20|27)\b|M118 P1 S"\d+"$')
"""What comes from timers, from the plugin and from the tests beside an operation."""

MARKS = itertools.count()

MOST_LOOKS = 60
"""Requests after which all that has changed must have been fetched."""

AS_OCTOPRINT = {
    "jog": (
        "printhead",
        {"command": "jog", "x": 10, "y": -5, "z": 0.02},
        ["G91", "G0 X10 Y-5 Z0.02 F200", "G90"],
    ),
    "jog absolute": (
        "printhead",
        {"command": "jog", "x": 10, "absolute": True, "speed": 1200},
        ["G90", "G0 X10 F1200"],
    ),
    "home": (
        "printhead",
        {"command": "home", "axes": ["x", "y"]},
        ["G91", "G28 X0 Y0", "G90"],
    ),
    "feedrate": ("printhead", {"command": "feedrate", "factor": 105}, ["M220 S105"]),
    "select": ("tool", {"command": "select", "tool": "tool0"}, ["T0"]),
    "target": ("tool", {"command": "target", "targets": {"tool0": 45}}, ["M104 T0 S45"]),
    "target current": ("tool", {"command": "target", "targets": {"tool": 0}}, ["M104 S0"]),
    "offset": ("tool", {"command": "offset", "offsets": {"tool0": 5}}, []),
    "extrude": (
        "tool",
        {"command": "extrude", "amount": 5},
        ["G91", "M83", "G1 E5 F300", "M82", "G90"],
    ),
    "flowrate": ("tool", {"command": "flowrate", "factor": 0.95}, ["M221 S95"]),
    "bed": ("bed", {"command": "target", "target": 41}, ["M140 S41"]),
    "bed off": ("bed", {"command": "target", "target": 0}, ["M140 S0"]),
    "chamber": ("chamber", {"command": "target", "target": 42}, ["M141 S42"]),
    "chamber off": ("chamber", {"command": "target", "target": 0}, ["M141 S0"]),
    "commands": (
        "command",
        {"commands": ["M111", 'M291 P"Is it there?" S3', "G28 X"]},
        ["M111", 'M291 P"Is it there?" S3', "G28 X"],
    ),
}
"""Path, request and G-code of each operation as OctoPrint has it, for Marlin."""


class Machine:
    """A connected board, and OctoPrint's printer API in front of it."""

    def __init__(self, server, board):
        self.server = server
        self.pty = board
        self.board = board.board
        self._history_begins = 0
        self._is_at_rest = False

    def ask(self, path, **request):
        """Send an operation; return the G-code that it put on the wire, without status requests.

        By then the board has done it all and the model says what has become of it.
        """
        wire = self.wire(path, **request)
        self.settle()
        return wire

    def wire(self, path, **request):
        """As ``ask``, but what the plugin knows of the outcome may be old."""
        before = len(self.board.received())
        response = self.server.post(f"/api/printer/{path}", json=request)
        assert response.status_code == 204, response.text
        self.arrive()
        wire = self.sent_since(before)
        self._is_at_rest = self._is_at_rest and not wire
        return wire

    def sent_since(self, since):
        """Return the G-code that has come in since there were so many lines, moves as one line."""
        lines = helpers.commands(self.pty)[since:]
        return helpers.whole_moves([line for line in lines if line and not BESIDE.match(line)])

    def execute(self, gcode):
        """Run G-code at the machine, as its own panel does, and let the model know."""
        self._is_at_rest = False
        self.board.execute(gcode)
        self.settle()

    def command(self, name, lines, /, **parameters):
        """Send a command to the plugin; return once these lines came, and nothing else."""
        before = len(self.board.received())
        self.post(name, **parameters)
        try:
            self.server.wait_for(lambda: self._have_come(before, len(lines)), 20)
        finally:
            assert self.sent_since(before) == lines
        self.wait_idle()

    def _have_come(self, since, count):
        lines = self.sent_since(since)
        return len(lines) >= count and not helpers.is_in_parts(lines)

    def post(self, name, wanted=204, /, **parameters):
        """Send a command to the plugin; return the response."""
        request = {"command": name, **parameters}
        response = self.server.post("/api/plugin/rrfmodel", json=request)
        assert response.status_code == wanted, response.text
        return response

    def wait_idle(self):
        """Return once the board has done all that has come in."""
        self.server.wait_for(
            lambda: self.board.channels["USB"].is_idle and not self.board.motion.is_moving,
            60,
            "the board to have done all",
        )

    def told(self):
        """Return the plugin's model."""
        return helpers.value(self.server, "")

    def settle(self):
        """Return once the board has done all and the model says what has become of it."""
        self.arrive()
        asked = len(self.board.received())
        for _ in range(MOST_LOOKS):
            self.look()
            # with two live requests in a row no key that has changed waits to be fetched
            polls = [line for line in self._since(asked) if helpers.is_poll(line)]
            are_live = [poll.startswith(LIVE) for poll in polls]
            if any(one and following for one, following in zip(are_live, are_live[1:])):
                return
        pytest.fail(f"there is always something new to fetch: {polls}")

    def _since(self, since):
        return [helpers.command_of(line) for line in self.board.received()[since:]]

    def arrive(self):
        """Return once all that OctoPrint has queued until now was sent and is done."""
        mark = f'M118 P1 S"{next(MARKS)}"'
        asked = len(self.board.received())
        self.server.commands(mark)
        self.server.wait_for(lambda: mark in self._since(asked), 60, "the last line")
        self.wait_idle()

    def look(self):
        """Let the plugin ask at once, as it does when the board has something to say."""
        before = helpers.status(self.server)["counters"]["replies"]
        asked = len(self.board.received())
        self.board.message("- Event notification -\n")
        self.server.wait_for(lambda: any(map(helpers.is_poll, self._since(asked))), 10, "a request")
        self.server.wait_for(
            lambda: helpers.status(self.server)["counters"]["replies"] > before, 10, "a reply"
        )

    def rest(self):
        """Make the board cold, deselect its tool, forget where its axes are and what was shown."""
        if self._is_at_rest:
            return
        numbers = [tool["number"] for tool in self.board.model["tools"] if tool]
        with self.board.lock:
            self.board.execute("T-1 P0")
            for number in numbers:
                self.board.execute(f"G10 P{number} S0 R0")
            for heater in self.board.model["heat"]["heaters"]:
                heater.update(state="off", active=0, standby=0, current=21.3)
            self.board.bump("heat", "tools")
            for extruder in self.board.model["move"]["extruders"]:
                extruder["factor"] = 1.0
            self.board.bump("move")
            self.board.execute("M84\nM220 S100")
        self.settle()
        self._is_at_rest = True
        self._history_begins = 0
        self._history_begins = len(self.history("tool"))

    @property
    def is_old(self):
        """Whether M568 doesn't set temperatures."""
        return not self.board.firmware.has_m568

    def home(self):
        assert self.ask("printhead", command="home", axes=["x", "y", "z"]) == ["G28 X Y Z"]
        assert all(axis["homed"] for axis in self.board.model["move"]["axes"][:3])

    def warm(self, number):
        """Give a tool the temperature that it was set to, at once."""
        self._is_at_rest = False
        with self.board.lock:
            for heater in self.heaters(number):
                heater["current"] = float(heater["active"])
        self.settle()

    def heaters(self, number):
        """Return the heaters of a tool as the board has them."""
        heaters = self.board.model["heat"]["heaters"]
        return [heaters[index] for index in self.tool(number)["heaters"]]

    def heater(self, number):
        """Return the first heater of a tool as the board has it."""
        return self.heaters(number)[0]

    def tool(self, number):
        return next(t for t in self.board.model["tools"] if t and t["number"] == number)

    def filament(self, number):
        """Return how far the extruders of a tool have gone together, in mm."""
        extruders = self.board.model["move"]["extruders"]
        return sum(extruders[index]["position"] for index in self.tool(number)["extruders"])

    def slot(self, kind, slot=0):
        """Return the heater of a slot of ``bedHeaters`` or ``chamberHeaters``."""
        heat = self.board.model["heat"]
        return heat["heaters"][heat[kind][slot]]

    def shown(self, path, name):
        """Return what OctoPrint shows of a heater: actual, target and offset."""
        return self.server.get(f"/api/printer/{path}").json()[name]

    def history(self, path):
        """Return what OctoPrint has shown of the heaters since the board was cold."""
        response = self.server.get(f"/api/printer/{path}?history=true&limit=10000")
        return response.json()["history"][self._history_begins :]

    @property
    def current_tool(self):
        return self.board.model["state"]["currentTool"]

    @property
    def usb(self):
        return self.board.model["inputs"][3]

    def position(self):
        return [axis["machinePosition"] for axis in self.board.model["move"]["axes"][:3]]


def on(*names):
    return pytest.mark.parametrize("machine", names, indirect=True)
