"""A connected board with OctoPrint's printer API in front of it, for tests of operations."""

import pytest

from . import helpers

PROFILE = {"extruder": {"count": 11}, "heatedChamber": True, "heatedBed": True}

SETUPS = {
    "one tool 3.5.3": ("cartesian", "3.5.3"),
    "one tool 2.05": ("cartesian", "2.05"),
    "one tool 3.3": ("cartesian", "3.3"),
    "one tool 3.6": ("cartesian", "3.6"),
    "chamber 3.5.3": ("corexy", "3.5.3"),
    "changer 3.5.3": ("toolchanger", "3.5.3"),
    "changer 3.3": ("toolchanger", "3.3"),
    "changer 2.05": ("toolchanger", "2.05"),
    "no tools 3.6": ("cnc", "3.6"),
}


class Machine:
    """A connected board, and OctoPrint's printer API in front of it."""

    def __init__(self, server, board):
        self.server = server
        self.board = board.board

    def ask(self, path, wanted=204, **request):
        """Send an operation; return the G-code that it put on the wire, without status requests."""
        before = len(self.board.received())
        response = self.server.post(f"/api/printer/{path}", json=request)
        assert response.status_code == wanted, response.text
        self.settle()
        lines = [helpers.NUMBERED.match(line)["command"] for line in self.board.received()[before:]]
        return [
            line
            for line in lines
            if line and line.split()[0] not in ("M105", "M409", "M408", "M20")
        ]

    def settle(self):
        """Return once the board has done all and the model says what has become of it."""
        self.server.wait_for(
            lambda: self.board.channels["USB"].is_idle, 60, "the board to have done all"
        )
        # a live reply that was asked for before may be on its way; the keys that moved follow
        helpers.wait_polls(self.server, 3)

    def home(self):
        self.ask("printhead", command="home", axes=["x", "y", "z"])
        assert all(axis["homed"] for axis in self.board.model["move"]["axes"][:3])

    def heater(self, number):
        """Return the heater of a tool as the board has it."""
        tools = [tool for tool in self.board.model["tools"] if tool]
        heater = next(tool for tool in tools if tool["number"] == number)["heaters"][0]
        return self.board.model["heat"]["heaters"][heater]

    def tool(self, number):
        return next(t for t in self.board.model["tools"] if t and t["number"] == number)

    @property
    def usb(self):
        return self.board.model["inputs"][3]

    def position(self):
        return [axis["machinePosition"] for axis in self.board.model["move"]["axes"][:3]]


def on(*names):
    return pytest.mark.parametrize("machine", names, indirect=True)
