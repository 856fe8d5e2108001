"""OctoPrint and a board on the network that counts what it is asked, and what was seen of both."""

import collections
import json
import threading
import time

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from tests.e2e import helpers
from tests.e2e.network import bench

from .rig import BAD_IN_LOG, ENTRY, REST_SECONDS
from .scene import Harmed

MOST_A_SECOND = 3.0

COMMANDED = ("rr_gcode", "rr_reply")

WINDOW_SECONDS = 10.0

SLOW = 20
"""Simulated seconds in one of the clock where a thing is to be seen while it happens."""

PEACE_SECONDS = 4.0

QUIET_REPLIES = 6
"""Polls that a quiet time lasts for."""


class CountedBoard(HttpBoard):
    """Notes when it was asked something, whatever became of it."""

    def __init__(self, board):
        super().__init__(board)
        self.asked = []
        self.of_itself = []
        """The same without commands and what is said to them, of which people decide how many."""
        delivered = self.delivery.of

        def counted(answer, path):
            if not path.endswith(COMMANDED):
                self.of_itself.append(time.monotonic())
            return delivered(answer, path)

        self.delivery.of = counted

    def converse(self, client, address):
        self.asked.append(time.monotonic())
        super().converse(client, address)


def busiest(times, seconds=WINDOW_SECONDS):
    """Return the most requests a second of any so long time."""
    most, window = 0, collections.deque()
    for at in sorted(times):
        window.append(at)
        while window[0] < at - seconds:
            window.popleft()
        most = max(most, len(window))
    return most / seconds


class NetworkRig:
    """``server`` is connected to ``face``; ``push`` and ``picture`` listen to it."""

    def __init__(self, server, machine, firmware, speed):
        self.server, self.speed = server, speed
        self.face = CountedBoard(Board(machine=machine, firmware=firmware, speed=speed))
        self.push = self.picture = self.random = None
        self.quiet_rates = []
        """Requests a second of each quiet time."""
        self._log_length = 0
        self._timers = []

    @property
    def board(self):
        """The board behind its face."""
        return self.face.board

    def connect(self):
        """Return when OctoPrint has the board and the plugin its whole model."""
        bench.connect(self.server, self.face, 60)

    def at(self, speed):
        """Let the board's time go by so fast from now on; ``None`` for as fast as usual."""
        with self.board.lock:
            self.board.advance()
            self.board.speed = speed or self.speed

    def at_the_machine(self, gcode):
        """Run G-code as somebody at its panel does."""
        bench.at_panel(self.face, gcode)

    def fault(self, text, lasts=None):
        """Switch a fault of the network on; with ``lasts`` it is over after so many seconds.

        A board that has one takes small steps, and none keeps up with days in a minute by those.
        """
        self.at(SLOW)
        self.board.inject(text)
        if lasts is not None:
            timer = threading.Timer(lasts, self.board.clear, [text.partition(":")[0]])
            self._timers.append(timer)
            timer.start()
            timer.join()

    def value(self, key):
        """Return a value of the board's own model."""
        return bench.board_value(self.face, key)

    def status(self):
        """Return what the plugin says of its state."""
        return helpers.status(self.server)

    def wait(self, predicate, seconds, what):
        """Return what is waited for."""
        return self.server.wait_for(predicate, seconds, what)

    def wait_reachable(self):
        """Return when the board answers again."""
        self.wait(lambda: self.status()["blocked"] is None, REST_SECONDS, "the end of the gap")

    def events(self, name):
        """Return OctoPrint's events of that name in this scene."""
        return self.push.events(name)

    def begin(self, random):
        """Forget what was seen before."""
        self.random = random
        del self.push.messages[:]
        self._log_length = len(self.server.log())
        with self.board.lock:
            del self.board.log[:]

    def clear_faults(self):
        """End all faults."""
        for name in list(self.board.faults.names()):
            self.board.clear(name)

    def at_rest(self):
        """What holds after every scene, and for a quiet time behind it."""
        server = self.server
        server.wait_state("Operational", REST_SECONDS)
        helpers.wait_ready(server, REST_SECONDS)
        self.wait_reachable()
        self.wait(lambda: not self.status()["stale"], REST_SECONDS, "fresh data")
        self._wait_equal()
        self._wait_picture()
        self._be_quiet()
        self._look_at_log()

    def own(self, key):
        """Return the board's value of a key, as it tells it on the network."""
        items = []
        while True:
            with self.face.at_board():
                reply = json.loads(self.face.source.reply(key, f"d99vnoa{len(items)}"))
            if not isinstance(reply["result"], list):
                return reply["result"]
            items += reply["result"]
            if not reply["next"]:
                return items

    def differences(self):
        """Return where the plugin's model and the board's own differ, live members apart."""
        found = []
        # counters, and the channel by which it is asked, move with each look
        for key in set(self.board.model) - {"seqs", "inputs"}:
            known = helpers.value(self.server, key)
            found += helpers.differences(known, self.own(key), key)
        return found

    def _wait_equal(self):
        last = []

        def is_equal():
            last[:] = self.differences()
            return not last

        try:
            self.wait(is_equal, REST_SECONDS, "the model to be the board's")
        except AssertionError as error:
            raise Harmed(f"{error}: {last[:10]}") from None

    def _wait_picture(self):
        self.wait(lambda: not self.picture.differences(), 20, "the subscriber to know everything")
        if not self.picture.is_open:
            raise Harmed("the subscriber that stays was thrown out")

    def _be_quiet(self):
        """Nobody does anything: how often is the board asked?"""
        # after a gap or a reset everything is fetched anew, one request right behind the other
        started = time.monotonic()

        def is_left_in_peace():
            has_come = time.monotonic() - started > PEACE_SECONDS
            return has_come and self._rate(PEACE_SECONDS) <= MOST_A_SECOND

        self.wait(is_left_in_peace, 30, "the board to be left in peace")
        since, began = len(self.face.asked), time.monotonic()
        helpers.wait_polls(self.server, QUIET_REPLIES)
        rate = (len(self.face.asked) - since) / (time.monotonic() - began)
        self.quiet_rates.append(rate)
        if rate > MOST_A_SECOND:
            raise Harmed(f"the board was asked {rate:.1f} times a second while nobody did anything")

    def _rate(self, seconds):
        """Return how often in a second the board has been asked lately."""
        after = time.monotonic() - seconds
        return sum(at > after for at in self.face.asked[-100:]) / seconds

    def _look_at_log(self):
        entries = ENTRY.split(self.server.log()[self._log_length :])
        bad = [entry[:1500] for entry in entries if BAD_IN_LOG.search(entry)]
        if bad:
            raise Harmed(f"in octoprint.log: {bad[:3]}")
