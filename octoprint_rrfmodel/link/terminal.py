"""Keeps the plugin's own traffic out of the terminal that a page is shown.

OctoPrint logs a line before any plugin sees it, so it can't be kept out of serial.log; but the
list of lines that goes to one client belongs to that client.
"""

import re
import weakref

SENT = re.compile(r"(?:Send: |>>> )(?:N\d+ )?(?P<command>.*?)(?:\*\d+)?$")
"""A line that went to the printer, as 1.11 and 2.0 log it; group ``command`` is the G-code."""

RECEIVED = re.compile(r"(?:Recv: |<<< ?)(?P<text>.*)$")
"""A line that came from the printer; group ``text`` is the line."""

OWN_REPLY = re.compile(r'\{"(?:key|err|status|axisMins|dir|thumbnail|line)":')
"""How an answer to a poll begins; ``line`` is the number of the command, from 3.6.2 on."""

MOST_POLLS = 1000

PATIENCE = 20
"""Lines after which a poll whose reply was not seen is forgotten."""


class RecentPolls:
    """The polls that were sent, each text once; the oldest go, since anything may be asked."""

    def __init__(self):
        self._sent = {}

    def __contains__(self, command):
        """Return whether the command was sent."""
        return command in self._sent

    def __len__(self):
        """Return how many different ones there are."""
        return len(self._sent)

    def add(self, command):
        """Note a poll; one thread does."""
        self._sent.pop(command, None)
        self._sent[command] = None
        if len(self._sent) > MOST_POLLS:
            del self._sent[next(iter(self._sent))]


class PollTrace:
    """How far one client has come through a poll: its reply, its ok, the M105 and its reply."""

    def __init__(self, is_poll):
        self._is_poll = is_poll
        self.expects = "poll"
        self.seen = 0

    @property
    def is_open(self):
        """Whether something that belongs to a poll is still to come."""
        return self.expects != "poll"

    def hides(self, line):
        """Return whether a line belongs to a poll."""
        sent = SENT.match(line)
        if sent:
            return self._hides_sent(sent["command"].strip())
        received = RECEIVED.match(line)
        if received is None or self.expects == "poll":
            return False
        return self._hides_received(received["text"].strip())

    def _hides_sent(self, command):
        if self._is_poll(command):
            self._expect("reply")
            return True
        if self.expects == "M105" and command == "M105":
            self._expect("temperatures")
            return True
        return False

    def _hides_received(self, text):
        self.seen += 1
        if self.seen > PATIENCE:
            self._expect("poll")
            return False
        if self.expects == "temperatures" and text.startswith("ok"):
            self._expect("poll")
            return True
        if self.expects == "reply" and text == "ok":
            self._expect("M105")
            return True
        return self.expects in ("reply", "M105") and (not text or bool(OWN_REPLY.match(text)))

    def _expect(self, what):
        self.expects = what
        self.seen = 0


class TerminalFilter:
    """Takes polls out of the lines that go to each client.

    ``is_set("hide_polls")`` says whether to, ``link`` what the plugin has sent.
    """

    def __init__(self, is_set, link):
        self._is_set = is_set
        self._link = link
        self._clients = weakref.WeakKeyDictionary()

    def on_emit(self, socket, user, message, payload, *args, **kwargs):
        """Take the lines out of ``payload``; always let the message go (OctoPrint's hook)."""
        if message in ("current", "history") and self._hides():
            logs = payload.get("logs") if payload else None
            if logs:
                if message == "history" or socket not in self._clients:
                    self._clients[socket] = PollTrace(self._link.has_polled)
                hides = self._clients[socket].hides
                payload["logs"] = [line for line in logs if not hides(line)]
        return True

    def _hides(self):
        return self._link.has_polled_at_all() and self._is_set("hide_polls")
