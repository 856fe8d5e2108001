"""The model that a simulated board tells, as a follower has it: each version's own members."""

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.views.machine import Machine
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.simulator.board import Board

MOST_REQUESTS = 200


class Simulated:
    """A board whose time only moves when a test says so, and what is known of it."""

    def __init__(self, machine="cartesian", firmware="3.5.3"):
        self._time = 0.0
        self.board = Board(machine, firmware, clock=lambda: self._time)

    def run(self, *lines, channel="http", seconds=0.0):
        """Run commands on the board and let time pass until they are through; return itself."""
        self.board.execute("\n".join(lines), channel=channel)
        self._time += seconds
        self.board.advance()
        return self

    def model(self):
        """Return the model as the plugin knows it."""
        follower = Follower()
        for _ in range(MOST_REQUESTS):
            self.board.receive((follower.next_request().line + "\n").encode())
            lines = self.board.transmit().decode().splitlines()
            replies = [found.reply for line in lines if (found := find_reply(line))]
            if replies:
                follower.take(replies[0])
            else:
                # a firmware without M409 says so
                follower.not_supported()
            if follower.ready and not follower.behind:
                return follower.store.model
        raise AssertionError(f"not ready after {MOST_REQUESTS} requests")

    def machine(self, is_current=True):
        """Return the questions about it."""
        return Machine(self.model(), is_current)
