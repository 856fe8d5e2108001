"""A follower at the end of a line that takes its time; the clock is the test's."""

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.follow.interest import Interest
from octoprint_rrfmodel.rrf.follow.rows import Rows
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply

BAUD = 115200
BYTES_A_SECOND = BAUD / 10
SHARE = 0.03
AIM = 0.028

NUMBERED = len("N123456 *99\n")
"""What a host puts around a command."""

ACKNOWLEDGED = len("\n\nok\n")

MOST_REQUESTS = 200


class SlowLine:
    """Serves a follower from a board, and takes the time for it that such a line takes."""

    def __init__(self, board):
        self.now = 1000.0
        self.board = board
        self.interest = Interest(lambda: self.now)
        self.rows = Rows(lambda: self.now, self.interest)
        self.follower = Follower(self.rows)
        self.asked = []
        """Of each request: when it left, its path, its bytes both ways, those of the answer."""

    def ready(self):
        for _ in range(MOST_REQUESTS):
            self.take(self.board.reply(self.follower.next_request()))
            if self.follower.ready and not self.follower.behind:
                return self
        raise AssertionError("not ready")

    def take(self, text):
        try:
            return self.follower.take(text)
        except MalformedReply:
            return None

    def spare(self, share=AIM):
        self.follower.spare(BYTES_A_SECOND, share)
        return self

    def ask(self):
        """Let the time go by until the next request, and that which its answer takes."""
        self.now += self.rows.wait()
        request = self.follower.next_request()
        text = self.board.reply(request)
        around = len(request.line) + NUMBERED + ACKNOWLEDGED
        self.asked.append((self.now, request.key, len(text) + around, len(text)))
        self.now += (len(text) + around) / BYTES_A_SECOND
        found = find_reply(text)
        return request, found.reply if found else text

    def serve(self, seconds):
        """Ask and answer for so long; return what was asked meanwhile."""
        until, since = self.now + seconds, len(self.asked)
        while self.now < until:
            self.take(self.ask()[1])
        return self.asked[since:]

    def oldest(self, path, asked):
        """Return the greatest age that a part has had, from question to the next answer."""
        times = [(at, at + taken / BYTES_A_SECOND) for at, key, taken, _ in asked if key == path]
        return max(
            (later_end - sooner for (sooner, _), (_, later_end) in zip(times, times[1:])),
            default=float("inf"),
        )
