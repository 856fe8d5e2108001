"""Everything at once on a line that fails: in the end all is known, and no line was harmed.

OctoPrint's counting, the hooks and every listener of the plugin against the simulated board, with
its faults; requests, prints, pauses, resets and reconnects in any order, and each thread's turns
in any order.
"""

import tempfile
from pathlib import Path

import pytest

pytest.importorskip("octoprint")

from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from octoprint_rrfmodel.link.poll_slot import TooManyQueries
from octoprint_rrfmodel.rrf.follow.freshness import LIVE

from .plugin_line import PluginLine

MACHINES = [
    ("cartesian", "3.5.3"),
    ("toolchanger", "3.6"),
    ("corexy", "2.05"),
    ("idex", "3.3"),
    ("cartesian", "3.7"),
]

FAULTS = [
    *("lost_ok:once", "lost_ok:4", "slow:2", "slow:6", "garbage:3", "glued_before:3"),
    *("glued_after:2", "truncated:2", "nul_bytes:2", "bad_utf8:2", "debug_text:2"),
    *("error_reply:2", "no_reply:2", "err_no_buffers:3", "err_no_buffers:>900", "stall:3"),
    *("stall:12", "unsolicited:1", "huge_line", "nesting_bomb", "nan", "exponent", "unread:2"),
]

COMMANDS = [
    *("M105", "M114", "M115", "G28", "G1 X5 F3000", "T0", "T-1", "G4 S3", "M117 ok", "M9999"),
    *("M104 S40", "M140 S30", "M106 S128", "M220 S90", "M400", "X20 Y5", 'M98 P"0:/none.g"'),
    *("M111", "M122", 'M291 P"x" S1 T1', 'M409 K"heat"', "M36", "M20", "M27", "ok"),
]

ON_THE_BOARD = [
    *("M104 S60", "M140 S45", "M220 S110", "M106 S200", "G91", "T0", "M207 S2", "M84"),
    *("global x = 1", "M566 X500", "G28", 'M117 "hi"', "M290 S0.1", "M572 D0 S0.05"),
]

LINES_OF_FILES = ["M106 S{0}", "G28", "M117 layer {0}", "T0", "M104 S4{0}", "G4 P50", "X{0} Y5"]
"""Between the moves, which are numbered."""

EXTRA = st.lists(st.sampled_from(LINES_OF_FILES), max_size=10)

TURNS = st.lists(
    st.tuples(
        st.sampled_from(["read", "send", "work", "everybody"]),
        st.sampled_from([0.0, 0.01, 0.3, 1.1, 4.1]),
    ),
    min_size=1,
    max_size=20,
)

CALM_SECONDS = 150

SETTLED_SECONDS = 16 + max(each.unseen for each in LIVE)
"""Time for what is rarely asked for, on a line that was found slow while nobody looks."""

SLOW_TURN = 0.2


class PluginOnABadLine(RuleBasedStateMachine):
    @initialize(machine=st.sampled_from(MACHINES))
    def start(self, machine):
        self.folder = tempfile.TemporaryDirectory()
        self.line = PluginLine(Path(self.folder.name), *machine)
        self.host, self.board = self.line.host, self.line.board
        self.moves = 0
        self.files = []
        self.questions = []
        self.line.connect()
        self.line.run(3)

    def is_up(self):
        return self.host.isOperational() and self.line.link.is_rrf

    ##~~ time

    @rule(turns=TURNS)
    def turns_in_any_order(self, turns):
        for who, seconds in turns:
            if who == "everybody":
                self.line.everybody(seconds)
                continue
            self.line.pass_time(seconds)
            {"read": self.host.read, "send": self.host.send, "work": self.line.work}[who]()

    @rule(seconds=st.sampled_from([1, 3, 12]))
    def time_passes(self, seconds):
        self.line.run(seconds, SLOW_TURN)

    ##~~ the line and the board

    @rule(fault=st.sampled_from(FAULTS))
    def line_fails(self, fault):
        self.board.inject(fault)

    @rule()
    def board_says_ok_too_often(self):
        self.line.is_forged = True
        self.board.inject("extra_ok:2")

    @rule()
    def line_is_well_again(self):
        for name in list(self.board.faults.names()):
            self.board.clear(name)

    @rule(gcode=st.sampled_from(ON_THE_BOARD))
    def somebody_else_works_at_the_board(self, gcode):
        self.board.execute(gcode, channel="http")

    @rule()
    def board_begins_anew(self):
        self.line.run(1)
        self.board.reset()
        # what was under way has no ok any more
        self.line.is_forged = True

    @rule(seconds=st.sampled_from([1, 5]))
    def cable_is_pulled(self, seconds):
        self.board.unplug(seconds)

    ##~~ OctoPrint

    @precondition(lambda self: self.host.state == "closed")
    @rule()
    def connect(self):
        self.line.pass_time(2)
        if self.board.is_plugged_in:
            self.line.connect()

    @rule()
    def connect_again_at_once(self):
        self.host.close()
        if self.board.is_plugged_in:
            self.line.connect()
            # of the connection before, whatever the board still has to say of it
            self.line.is_forged = True

    @precondition(lambda self: self.is_up())
    @rule(commands=st.lists(st.sampled_from(COMMANDS), min_size=1, max_size=4))
    def somebody_sends(self, commands):
        self.host.commands(commands, tags={"source:api", "trigger:printer.commands"})

    @precondition(lambda self: self.is_up() and not self.host.isBusy())
    @rule(extra=EXTRA, moves=st.integers(1, 30))
    def print_begins(self, extra, moves):
        lines = []
        for number in range(moves):
            self.moves += 1
            lines.append(f"G1 F6000 X{self.moves / 1000:.3f}")
            if number < len(extra):
                lines.append(extra[number].format(number))
        self.files.append(lines)
        self.line.written.clear()
        self.line.pass_time(0.01)
        self.host.print_lines(lines)

    @precondition(lambda self: self.is_up() and not self.host.isBusy())
    @rule(extra=EXTRA, fault=st.sampled_from(FAULTS), seconds=st.sampled_from([0.0, 0.3]))
    def print_begins_on_a_line_that_fails(self, extra, fault, seconds):
        self.print_begins(extra, 20)
        self.line.run(seconds)
        self.board.inject(fault)
        self.line.run(5)

    @precondition(lambda self: self.host.isBusy())
    @rule(what=st.sampled_from(["pause", "resume", "cancel"]))
    def print_is_handled(self, what):
        if what == "cancel":
            self.host.end_print("PrintCancelled")
        elif what == "pause" or self.line.parts._guard.refusal() is None:
            self.host.setPause(what == "pause")

    ##~~ the plugin

    @rule(key=st.sampled_from(["", "heat", "move.axes", "nothing"]))
    def somebody_asks(self, key):
        try:
            self.questions.append(self.line.parts.questions.ask(key, "d99vn"))
        except TooManyQueries:
            assert sum(not question.done() for question in self.questions) >= 4

    @rule(key=st.sampled_from([None, "", "move", "tools"]))
    def somebody_wants_it_fresh(self, key):
        self.poller_look(key)

    def poller_look(self, key):
        self.line.parts.worker.notify("look", *([] if key is None else [key]))

    ##~~ what holds

    @invariant()
    def nothing_is_harmed(self):
        if not hasattr(self, "line"):
            return
        line = self.line
        assert not line.errors.texts, line.errors.texts[0]
        assert line.overtaken == []
        assert line.polls_waiting() <= 1
        if self.files:
            # a print is its file from the beginning, each line once
            file = self.files[-1][: len(line.written)]
            assert line.written == file, (line.written, self.files[-1])

    def is_settled(self):
        host = self.host
        if host.state == "closed" and self.board.is_plugged_in:
            self.line.connect()
        if host.isPaused():
            if self.line.parts._guard.refusal() is None:
                host.setPause(False)
            else:
                host.end_print("PrintCancelled")
        return (
            self.is_up()
            and not host.isBusy()
            and not host._send_queue.qsize()
            and self.line.is_known()
            and not self.line.poller.is_stale()
            and all(question.done() for question in self.questions)
            and all(channel.is_idle for channel in self.board.channels.values())
        )

    def calm(self):
        line = self.line
        self.line_is_well_again()
        line.run(2, SLOW_TURN)
        if line.link.awaits_long and not line.has_open_acknowledgement():
            # its ok was lost: waiting for it takes as long as a setting says
            self.host.close()
        line.wait(self.is_settled, CALM_SECONDS, "all quiet")
        # as nothing changes any more, what is known has to be what is
        self.board.speed = 0
        line.run(3, SLOW_TURN)
        if line.differences():
            line.run(SETTLED_SECONDS, SLOW_TURN)
        differences = line.differences()
        assert not differences, "\n".join(differences)
        self.nothing_is_harmed()

    def teardown(self):
        if hasattr(self, "line"):
            try:
                self.calm()
            finally:
                self.line.errors.close()
                self.folder.cleanup()


TestPluginOnABadLine = PluginOnABadLine.TestCase
TestPluginOnABadLine.settings = settings(
    max_examples=12,
    stateful_step_count=20,
    deadline=None,
    # a run takes a second, and shrinking hundreds of them
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow],
)
