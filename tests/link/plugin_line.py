"""The whole plugin on a line without threads: OctoPrint's counting, the simulated board, a clock.

``Assembly`` is the real one, with every listener; only time and threads are the test's.
"""

import logging
import re
from types import SimpleNamespace
from unittest import mock

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
from octoprint.events import Events

from octoprint_rrfmodel import assembly
from octoprint_rrfmodel.host.tags import POLL_TAG, POLL_TYPE, STATUS_TAG
from octoprint_rrfmodel.link.worker import LONGEST_WAIT
from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.simulator.board import Board
from tests.rrf.board import STEP
from tests.rrf.independent import differing
from tests.support.hosts import host_of

from .counting_host import CountingHost

PROFILE = {
    "id": "_default",
    "name": "Default",
    "heatedBed": True,
    "heatedChamber": False,
    "extruder": {"count": 1, "offsets": [(0, 0)], "sharedNozzle": False},
    "volume": {"width": 200, "depth": 200, "height": 200, "formFactor": "rectangular"},
    "axes": {},
}

TURN_SECONDS = 0.05

MOST_REQUESTS = 200

NOTHING = "nothing"

OWN = re.compile(r"seqs\.reply|inputs\[|state\.thisInput|m408\.")
"""What isn't the same for two who ask on different channels."""


class Errors(logging.Handler):
    """What the plugin logs as an error, as text; it is to log none."""

    def __init__(self):
        super().__init__(logging.ERROR)
        self.texts = []
        logging.getLogger("octoprint.plugins.rrfmodel").addHandler(self)

    def emit(self, record):
        self.texts.append(logging.Formatter().format(record))

    def close(self):
        logging.getLogger("octoprint.plugins.rrfmodel").removeHandler(self)
        super().close()


class PluginLine:
    """A board, OctoPrint's line to it and the plugin; nothing moves but by the methods here."""

    def __init__(self, folder, machine="cartesian", firmware="3.5.3"):
        self.now = 1000.0
        clock = self.clock = lambda: self.now
        self.board = Board(machine, firmware, clock=clock, speed=4)
        self.written = []
        """Lines of the print, in the order in which they left."""
        self.is_forged = False
        """Whether an ``ok`` may have come that the board never meant."""
        self.overtaken = []
        """Lines that left while the board still had something to acknowledge."""
        settings = SimpleNamespace(
            get_boolean=lambda path: True,
            get_float=lambda path, **options: 60.0,
            get_int=lambda path, **options: 0,
            get=lambda path, **options: None,
            global_get=lambda path: None,
            global_get_boolean=lambda path: False,
        )
        profiles = SimpleNamespace(
            get_current_or_default=lambda: PROFILE, get=lambda name: PROFILE, save=lambda *a, **m: 0
        )
        plugins = SimpleNamespace(
            get_hooks=lambda hook: {},
            get_helpers=lambda *names: None,
            enabled_plugins={},
            registered_clients=[],
        )
        # the parts take the clock where they are made
        with mock.patch.object(assembly, "time", SimpleNamespace(monotonic=clock)):
            self.parts = assembly.Assembly(
                host_of(
                    folder,
                    None,
                    settings,
                    printer=lambda: self.host,
                    profiles=lambda: profiles,
                    plugins=lambda: plugins,
                )
            )
        self.host = CountingHost(clock, self.parts, self._on_event, self._leaves)
        self._handlers = self.parts.notes()
        self._ticks = self.parts._listeners.ticks()
        self._due_at = 0.0
        self.poller = self.parts._poller
        self.link = self.parts.link
        self.errors = Errors()

    def _on_event(self, name):
        self.parts.on_event(getattr(Events, name_of_event(name)), {"origin": "local"})

    ##~~ what may not happen

    def _leaves(self, command, tags):
        """Look at the line before one leaves that was queued; called by the host."""
        if self.has_open_acknowledgement() and not (self.is_forged or self.host.tickled):
            self.overtaken.append(command)
        if self.host.print_tag in (tags or ()) and STATUS_TAG not in tags:
            self.written.append(command)

    def has_open_acknowledgement(self):
        """Return whether the board, or the line, still has an ``ok`` of what was sent."""
        board, host = self.board, self.host
        if not board.channels[board._port].is_idle:
            return True
        waiting = [data for _, data in board.output._late]
        waiting += [bytes(board.output._ready), *host._lines]
        return any(line.startswith(b"ok") for data in waiting for line in data.split(b"\n"))

    ##~~ whose turn it is

    def pass_time(self, seconds):
        """Let time go by, for the board too, whoever is connected with it."""
        self.now += seconds
        self.board.advance()

    def work(self):
        """Let the plugin's worker do what is there, and what is due, and then who sends for it."""
        notes, handed_over = self.parts.worker._notes, self.parts._sender._worker._notes
        if notes.empty() and handed_over.empty() and self.now < self._due_at:
            return
        while not notes.empty():
            name, arguments = notes.get()
            self._handlers[name](*arguments)
        self._due_at = self.now + min(LONGEST_WAIT, *(tick() for tick in self._ticks))
        while not handed_over.empty():
            _, (function, *arguments) = handed_over.get()
            function(*arguments)

    def everybody(self, seconds=TURN_SECONDS):
        """Let time pass, and everybody do all that there is."""
        self.pass_time(seconds)
        self.host.poll_status()
        # who sends is quick, and would be too early wherever it may be
        while self.host.send() or self.host.read():
            pass
        self.work()
        if self.is_forged or self.host.tickled:
            self._is_right_again()

    def _is_right_again(self):
        """Note that OctoPrint's count is right, whatever it was: nothing is under way."""
        host, board = self.host, self.board
        is_quiet = host.isOperational() and not host.isBusy() and not host._send_queue.qsize()
        may_come = board.faults.is_on("extra_ok") or self.link.extra_ok.awaits is not None
        if is_quiet and not may_come and not self.has_open_acknowledgement():
            self.is_forged = host.tickled = host._clear_to_send.blocked()

    def run(self, seconds, step=TURN_SECONDS):
        until = self.now + seconds
        while self.now < until:
            self.everybody(step)

    def wait(self, fits, seconds, what):
        until = self.now + seconds
        while not fits():
            assert self.now < until, f"{what}: not within {seconds} s; {self.told()}"
            self.everybody(0.1)

    ##~~ the machine

    def told(self):
        """Return what there is to know of a line that doesn't do what it should."""
        return (
            f"{self.host.state}, awaits {self.link.awaited_command!r}, blocked "
            f"{self.poller.blocked()}, {self.poller.follower.counters}, the board heard "
            f"{self.board.received()[-8:]}, faults {self.board.faults.names()}"
        )

    def connect(self):
        self.host.connect(self.board)

    def is_known(self):
        follower = self.poller.follower
        return follower.ready and not follower.behind

    def polls_waiting(self):
        """Return how many polls lie in OctoPrint's queues."""
        waiting = [entry[0] for entry in self.host._send_queue._send_queue.queue]
        waiting += [entry[0] for entry in self.host._command_queue.queue]
        # a marker is no tuple, and an entry's last is its tags
        return sum(POLL_TAG in (each[-1] or ()) and POLL_TYPE in each for each in waiting)

    def afresh(self):
        """Return the model as somebody gets it who asks the board for the first time."""
        follower = Follower()
        for _ in range(MOST_REQUESTS):
            said = self.board.execute(follower.next_request().line, channel="http")
            replies = [found.reply for line in said.splitlines() if (found := find_reply(line))]
            if replies:
                follower.take(replies[-1])
            else:
                follower.not_supported()
            if follower.ready and not follower.behind:
                return follower.store.model
        raise AssertionError("the board does not tell its model")

    def differences(self):
        """Return where the plugin's model isn't the board's; time has to stand still for that."""
        # in M408 what is told depends on which of its forms was asked for last
        is_m408 = self.poller.follower.protocol == "M408"
        known, own = self.poller.follower.store.model, self.afresh()
        return [
            f"{path}: {at(known, path)!r}, the board has {at(own, path)!r}"
            for path in differing(known, own)
            if not OWN.match(path) and not (is_m408 and at(known, path) == NOTHING)
        ]


def at(model, path):
    """Return what a model has at a path, a sentence where it has nothing."""
    for name, index in STEP.findall(path):
        try:
            model = model[name or int(index)]
        except (KeyError, IndexError, TypeError):
            return NOTHING
    return model


def name_of_event(name):
    """Return the name of OctoPrint's constant: ``PrintDone`` is ``PRINT_DONE``."""
    return "".join("_" + letter if letter.isupper() else letter for letter in name)[1:].upper()
