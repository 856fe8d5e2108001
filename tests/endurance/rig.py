"""OctoPrint and a board on a pseudo-terminal, and what was seen of both."""

import contextlib
import os
import re
import threading
import time

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.pty import PtyBoard
from tests.e2e import helpers
from tests.support.waiting import wait_for

from .scene import Harmed

COMMAND = "/api/plugin/rrfmodel"

MACHINES = (
    ("toolchanger", "3.5.3"),
    ("toolchanger", "3.7"),
    ("idex", "3.6.4"),
    ("cartesian", "3.4"),
    ("toolchanger", "3.6"),
    ("corexy", "3.3"),
)
"""The machines of a week, one after the other."""

TOLD = (
    *("Connected", "Disconnected", "Error"),
    *("PrintStarted", "PrintDone", "PrintFailed", "PrintCancelled", "PrintPaused", "PrintResumed"),
)
"""OctoPrint's events of which each scene says how many come."""

ENTRY = re.compile(r"^(?=\d{4}-\d\d-\d\d \d\d:\d\d:\d\d,\d{3} - )", re.MULTILINE)
"""Between two entries of octoprint.log."""

BAD_IN_LOG = re.compile(
    r"octoprint\.plugins\.rrfmodel\S* - ERROR|tornado\.access - ERROR - 500"
    r"|octoprint_rrfmodel/.*, line"
)
"""What may not be in an entry of octoprint.log. OctoPrint has errors of its own where a port
vanishes."""

REST_SECONDS = 45
"""From the end of a fault: OctoPrint's timeouts, and the plugin's longest wait after failures."""

CHANNELS = {"http": "HTTP", "aux": "Aux"}
"""What somebody at the machine uses: the network's page, and the panel."""

MOST_PATIENCE = 4
"""Times the usual, however busy the machine."""


class Rig:
    """``server`` and ``board`` (the pseudo-terminal), ``push`` and ``picture`` who listen to both.

    ``speed`` are simulated seconds in one of the clock. ``random`` is another one in each turn.
    """

    def __init__(self, server, folder, speed):
        self.server, self.speed = server, speed
        self.push = self.picture = self.random = None
        self.turn = self.lines = 0
        self._link = os.fspath(folder / "rrf-board")
        self._hours_before = 0.0
        self.board = self._scene = None
        self._timers = []
        self.machine = 0
        """Where the board that is plugged in stands in ``MACHINES``."""
        self._log_length = 0

    ##~~ the board

    def another_board(self, machine, firmware):
        """Plug in another board, with OctoPrint connected to it."""
        self.unplug_for_good()
        self.machine = MACHINES.index((machine, firmware))
        self.board = PtyBoard(Board(machine, firmware, speed=self.speed), self._link).start()
        self.connect()

    def unplug_for_good(self):
        """Disconnect, and take the board away."""
        with contextlib.suppress(AssertionError):
            helpers.disconnect(self.server)
        if self.board is not None:
            self._hours_before = self.hours
            self.board.stop()
            self.board = None

    @property
    def hours(self):
        """The simulated hours that have gone by."""
        board = self.board.board if self.board is not None else None
        return self._hours_before + (board.clock.now / 3600 if board else 0.0)

    def at(self, speed):
        """Let the board's time go by so fast from now on; ``None`` for as fast as usual."""
        self.board.board.speed = speed or self.speed

    def at_the_machine(self, gcode, channel="http"):
        """Run G-code as somebody at the machine does; the board has to take it.

        What opens a box waits for its answer, and isn't waited for.
        """
        board = self.board.board
        replies = [board.execute(gcode, channel=channel)]

        def is_through():
            replies.append(board.execute("", channel=channel))
            return board.channels[CHANNELS[channel]].is_idle or gcode.startswith("M291")

        self.wait(is_through, 20, f"the machine to be through with {gcode}")
        if "Error" in "".join(replies):
            raise Harmed(f"{gcode} at the machine: {replies}")

    def tools(self):
        """Return the numbers of the tools that there are."""
        return [tool["number"] for tool in self.board.board.tools()]

    def received(self):
        """Return how many lines have come to the board until now."""
        return len(self.board.board.log)

    def commands(self, since):
        """Return the G-code that has come since there were so many lines."""
        with self.board.board.lock:
            texts = [entry.text for entry in self.board.board.log[since:]]
        return [helpers.command_of(text) for text in texts]

    ##~~ OctoPrint

    def wait(self, predicate, seconds, what):
        """Return what is waited for; what doesn't come is harm, and so is an event too many."""

        until = time.monotonic() + MOST_PATIENCE * seconds

        def has_come():
            self._look_at_most()
            found = predicate()
            if not found and time.monotonic() > until:
                raise Harmed("it has not come")
            return found

        try:
            return wait_for(has_come, seconds, what)
        except Harmed as error:
            raise Harmed(f"while waiting for {what}: {error}") from None

    def connect(self):
        """Return when OctoPrint has the board and the plugin its whole model."""
        self.wait(lambda: os.path.lexists(self._link), 20, "the port")
        self.server.connect(self.board.link)
        self.server.wait_state("Operational", 60)
        helpers.wait_ready(self.server, 60)

    def disconnect(self):
        """Return when OctoPrint has let go, and the plugin has noticed."""
        helpers.disconnect(self.server)

    def status(self):
        """Return what the plugin says of its state."""
        return helpers.status(self.server)

    def codes(self):
        """Return the warnings, those about OctoPrint's settings apart."""
        found = self.status()["warnings"]
        return [each["code"] for each in found if not each.get("fix", "").startswith("fix_")]

    def wait_value(self, key, wanted, seconds=20):
        """Return the value once the model has that one."""
        return helpers.wait_value(self.server, key, wanted, seconds)

    def command(self, name, **parameters):
        """Give the plugin a command, which has to take it."""
        response = self.server.post(COMMAND, json={"command": name, **parameters})
        assert response.status_code == 204, f"{name} {parameters}: {response.text}"

    def job(self, **command):
        """Pause, resume or cancel OctoPrint's job."""
        response = self.server.post("/api/job", json=command)
        assert response.status_code == 204, response.text

    def home(self):
        """Return when no axis is unknown."""
        axes = self.board.board.model["move"]["axes"]
        if not all(axis["homed"] for axis in axes):
            # the ok of a command that takes long, where a fault spoils it, is left to OctoPrint
            has_faults = bool(self.board.board.faults.names())
            (self.at_the_machine if has_faults else self.server.commands)("G28")
        self.wait_value("move.axes[].homed", lambda homed: homed and all(homed), 40)

    def events(self, name):
        """Return OctoPrint's events of that name in this scene."""
        return self.push.events(name)

    ##~~ a scene

    def begin(self, turn, scene, random):
        """Forget what was seen before."""
        self.turn, self.random, self._scene = turn, random, scene
        del self.push.messages[:]
        self._log_length = len(self.server.log())
        # nobody looks at it again, and a week's lines are many
        with self.board.board.lock:
            del self.board.board.log[:]
        self.at(None)

    def inject(self, name, text, lasts):
        """Switch a fault on; with ``lasts`` it is over after so many seconds of the clock."""
        board = self.board.board
        board.inject(text)
        if lasts:
            timer = threading.Timer(lasts, board.clear, [name])
            self._timers.append(timer)
            timer.start()

    def clear_faults(self):
        """End all faults, and close the box that one of them has opened."""
        while self._timers:
            self._timers.pop().cancel()
        board = self.board.board
        for name in list(board.faults.names()):
            board.clear(name)
        if board.model["state"].get("messageBox"):
            # another one would wait behind it
            self.at_the_machine("M292 P0", channel="aux")

    def at_rest(self, scene):
        """What holds after every scene, once its faults are over."""
        server = self.server
        assert self.board.error is None, f"the simulated board has failed: {self.board.error!r}"
        server.wait_state("Operational", REST_SECONDS)
        helpers.wait_ready(server, REST_SECONDS)
        self.wait(lambda: not self.codes(), REST_SECONDS, "the end of all warnings")
        self.wait(lambda: self.status()["blocked"] is None, REST_SECONDS, "an unblocked line")
        self.wait(lambda: not self.status()["stale"], REST_SECONDS, "fresh data")
        helpers.wait_equal(server, self.board, REST_SECONDS)
        self._wait_picture()
        self._look_at_events(scene)
        self._look_at_lines(scene)
        self._look_at_log()

    def _wait_picture(self):
        last = []

        def is_right():
            last[:] = self.picture.differences()
            return not last

        try:
            self.wait(is_right, 20, "the subscriber to have been told everything")
        except AssertionError as error:
            raise Harmed(f"{error}: {last}") from None
        if not self.picture.is_open:
            raise Harmed("the subscriber that stays was thrown out")

    def _look_at_events(self, scene):
        self._look_at_most()
        for name in TOLD:
            least, _ = scene.wanted(name)
            # OctoPrint tells of things later than its state shows them
            self.wait(
                lambda name=name, least=least: len(self.events(name)) >= least,
                10,
                f"{least} events {name}",
            )

    def _look_at_most(self):
        """No event has come that doesn't belong here."""
        if self._scene is None:
            return
        for name in {told for told, _ in self.push.events()}:
            if name in TOLD and len(self.events(name)) > self._scene.wanted(name)[1]:
                raise Harmed(f"the event {name} doesn't belong here: {self.events(name)}")

    def _look_at_lines(self, scene):
        sent = self.commands(0)
        stops = [line for line in sent if line.startswith("M112")]
        if stops and "emergency" not in scene.name:
            raise Harmed("an emergency stop that nobody wanted")
        if not scene.breaks_line and helpers.polls_without_status(sent):
            raise Harmed(f"a poll without M105: {helpers.polls_without_status(sent)[:3]}")

    def _look_at_log(self):
        entries = ENTRY.split(self.server.log()[self._log_length :])
        bad = [entry[:1500] for entry in entries if BAD_IN_LOG.search(entry)]
        if bad:
            raise Harmed(f"in octoprint.log: {bad[:3]}")
