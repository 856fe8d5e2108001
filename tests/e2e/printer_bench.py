"""A machine with bed and chamber at a server, in every state that OctoPrint's printer API minds."""

import contextlib

from . import helpers
from .operations import Machine

STREAMED = "".join(f"G4 P{2000 + number % 2}\n" for number in range(2000))

NOT_OF_THE_REQUEST = ("M105", "M409", "M20 S3", "M27", "M118 P1", "G4 P200")
"""What timers, the plugin, the tests and the printed file put on the wire."""


@contextlib.contextmanager
def disconnected(bench):
    helpers.disconnect(bench.server)
    yield
    bench.connect()


@contextlib.contextmanager
def operational(bench):
    yield


@contextlib.contextmanager
def released(bench):
    assert bench.post("sd", {"command": "release"}) == (204, ["M22"])
    bench.server.wait_for(lambda: not bench.is_card_ready(), 5, "the card to be gone")
    yield
    status, wire = bench.post("sd", {"command": "init"})
    assert (status, wire[0]) == (204, "M21")
    bench.server.wait_for(bench.is_card_ready, 5, "the card to be back")


@contextlib.contextmanager
def card_disabled(bench):
    bench.server.set_setting("feature.sdSupport", False)
    yield
    bench.server.set_setting("feature.sdSupport", True)


def without(*parts):
    @contextlib.contextmanager
    def profile(bench):
        bench.set_profile(dict.fromkeys(parts, False))
        yield
        bench.set_profile(dict.fromkeys(parts, True))

    return profile


@contextlib.contextmanager
def printing(bench):
    bench.server.upload("long.gcode", STREAMED)
    bench.server.select_and_print("long.gcode")
    bench.server.wait_state("Printing")
    yield
    assert bench.server.post("/api/job", json={"command": "cancel"}).status_code == 204
    bench.server.wait_state("Operational")


@contextlib.contextmanager
def paused(bench):
    with printing(bench):
        request = {"command": "pause", "action": "pause"}
        assert bench.server.post("/api/job", json=request).status_code == 204
        bench.server.wait_state("Paused")
        yield


STATES = {
    "operational": operational,
    "released": released,
    "card disabled": card_disabled,
    "no bed": without("heatedBed"),
    "no chamber": without("heatedChamber"),
    "no bed, no chamber": without("heatedBed", "heatedChamber"),
    "printing": printing,
    "paused": paused,
    "disconnected": disconnected,
}


class Bench:
    """A machine with bed and chamber at a server, in the state that a test wants."""

    def __init__(self, server, board):
        self.server = server
        self.pty = board
        self.machine = Machine(server, board)
        self._state = "operational"
        self._stack = contextlib.ExitStack()
        self.connect()

    def connect(self):
        """Connect and make everything that can be asked for possible."""
        helpers.connect(self.server, self.pty)
        self.machine.home()
        self.machine.ask("tool", command="select", tool="tool0")
        self.heat()
        self.server.wait_for(self.is_card_ready, 5, "the card")

    def heat(self):
        """Switch all heaters on, and let them have their temperatures at once."""
        for path, request in (
            ("tool", {"targets": {"tool0": 210}}),
            ("bed", {"target": 60}),
            ("chamber", {"target": 45}),
        ):
            self.machine.ask(path, command="target", **request)
        with self.machine.board.lock:
            for heater in self.machine.board.model["heat"]["heaters"]:
                heater["current"] = float(heater["active"])
        self.machine.settle()

    def enter(self, state):
        if state != self._state:
            self._stack.close()
            self._state = state
            self._stack.enter_context(STATES[state](self))

    def post(self, path, body, client=None):
        """Return the status, and what the request has put on the wire."""
        before = len(self.machine.board.received())
        response = (client or self.server).post(f"/api/printer/{path}", json=body)
        if self._state != "disconnected":
            self.machine.arrive()
        wire = self._sent_since(before)
        if response.status_code >= 400:
            assert response.json()["error"]
        return response.status_code, wire

    def post_all(self, path, bodies):
        """As ``post`` for one body after another; return the status of each, by its text."""
        before = len(self.machine.board.received())
        statuses = {}
        for body in bodies:
            response = self.server.post(f"/api/printer/{path}", json=body)
            statuses[str(body)] = response.status_code
            assert response.ok or response.json()["error"]
        self.machine.arrive()
        return statuses, self._sent_since(before)

    def _sent_since(self, before):
        lines = helpers.commands(self.pty)[before:]
        return helpers.whole_moves(
            [line for line in lines if line and not line.startswith(NOT_OF_THE_REQUEST)]
        )

    def get(self, path="", **query):
        return self.server.get(f"/api/printer{path}", params=query)

    def is_card_ready(self):
        return self.get("/sd").json()["ready"]

    def set_profile(self, changes):
        path = "/api/printerprofiles/_default"
        response = self.server.patch(path, json={"profile": changes})
        assert response.status_code == 200, response.text
