"""A connected board with OctoPrint's printer API in front of it, for tests of operations."""

import itertools

import pytest

from octoprint_rrfmodel.rrf.request import LIVE_FLAGS, ModelRequest

from . import helpers

PROFILE = {"extruder": {"count": 11}, "heatedChamber": True, "heatedBed": True}

SETUPS = {
    f"{name} {firmware}": (kind, firmware)
    for name, kind, versions in (
        ("one tool", "cartesian", ("2.05", "3.3", "3.5.3", "3.6")),
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

BESIDE = ("M105", "M409", "M408", "M20", "M118")
"""What comes from timers, from the plugin and from the tests beside an operation."""

MARKS = itertools.count()


class Machine:
    """A connected board, and OctoPrint's printer API in front of it."""

    def __init__(self, server, board):
        self.server = server
        self.pty = board
        self.board = board.board
        self._history_begins = 0

    def ask(self, path, wanted=204, **request):
        """Send an operation; return the G-code that it put on the wire, without status requests."""
        before = len(self.board.received())
        response = self.server.post(f"/api/printer/{path}", json=request)
        assert response.status_code == wanted, response.text
        self.settle()
        lines = helpers.commands(self.pty)[before:]
        return [line for line in lines if line and line.split()[0] not in BESIDE]

    def settle(self):
        """Return once the board has done all and the model says what has become of it."""
        self.arrive()
        asked = len(self.board.received())
        # with two live requests in a row no key that has changed waits to be fetched
        self.server.wait_for(lambda: self.look() or self._asks_live(asked), 20, "nothing new")

    def _asks_live(self, since):
        polls = [line for line in helpers.commands(self.pty)[since:] if helpers.is_poll(line)]
        return len(polls) > 1 and all(poll.startswith(LIVE) for poll in polls[-2:])

    def arrive(self):
        """Return once all that OctoPrint has queued until now was sent and is done."""
        mark = f'M118 P1 S"{next(MARKS)}"'
        self.server.commands(mark)
        self.server.wait_for(lambda: mark in helpers.commands(self.pty)[-20:], 60, "the last line")
        usb = self.board.channels["USB"]
        self.server.wait_for(lambda: usb.is_idle, 60, "the board to have done all")

    def look(self):
        """Let the plugin ask at once, as it does when the board has something to say."""
        before = helpers.status(self.server)["counters"]["replies"]
        self.board.message("- Event notification -\n")
        self.server.wait_for(
            lambda: helpers.status(self.server)["counters"]["replies"] > before, 10, "a reply"
        )

    def rest(self):
        """Make the board cold, deselect its tool, forget where its axes are and what was shown."""
        numbers = [tool["number"] for tool in self.board.model["tools"] if tool]
        with self.board.lock:
            self.board.execute("T-1 P0")
            for number in numbers:
                self.board.execute(f"G10 P{number} S0 R0")
            for heater in self.board.model["heat"]["heaters"]:
                heater.update(state="off", active=0, standby=0, current=21.3)
            self.board.bump("heat", "tools")
            self.board.execute("M84\nM220 S100")
        self.settle()
        self._history_begins = 0
        self._history_begins = len(self.history("tool"))

    def home(self):
        self.ask("printhead", command="home", axes=["x", "y", "z"])
        assert all(axis["homed"] for axis in self.board.model["move"]["axes"][:3])

    def warm(self, number):
        """Give a tool the temperature that it was set to, at once."""
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
