"""The link itself: what is queued, what is under way, which replies are fetched."""

import pytest

from octoprint_rrfmodel.link.network.network_link import NetworkLink
from octoprint_rrfmodel.link.network.nobody import Nobody
from octoprint_rrfmodel.link.network.standalone import Standalone
from octoprint_rrfmodel.rrf.wire.request import ModelRequest


class FakeExchange:
    def __init__(self):
        self.calls = []
        self.lines = []
        self.is_away = False
        self.dialect = Standalone(None, None, None)

    def __getattr__(self, name):
        return lambda *given: self.calls.append((name, *given))

    def send(self, line, first=False):
        self.lines.insert(0 if first else len(self.lines), line)

    def waiting(self):
        return list(self.lines)

    def count(self, name):
        return sum(call[0] == name for call in self.calls)


class Bench:
    def __init__(self):
        self.now = 100.0
        self.model = {}
        self.notes = []
        self.store = []
        self.link = NetworkLink(
            lambda *note: self.notes.append(note),
            lambda: self.now,
            model=lambda: self.model,
            patience=lambda: 60.0,
            nobody=Nobody(),
            sent=lambda line, tags: self.store.append(line),
        )
        self.exchange = self.link.exchange = self.link.connection = FakeExchange()

    def tell(self, name, *arguments):
        self.link._of(self.link.printer, name)(*arguments)

    def replied(self, asked_at=None, **model):
        self.model = {**self.model, **model}
        self.link.replied(None, self.now if asked_at is None else asked_at)


@pytest.fixture
def bench():
    return Bench()


def test_nothing_is_left_to_be_done():
    assert NetworkLink.__abstractmethods__ == frozenset()


def test_what_a_board_says_is_told_line_by_line(bench):
    bench.tell("said", "Heater 1 fault: too hot\nok\n\n")
    assert ("heard", "fault") in bench.notes
    assert [note for note in bench.notes if note[0] == "line"] == [
        ("line", "Heater 1 fault: too hot"),
        ("line", "ok"),
    ]


def test_lines_go_one_by_one_and_answers_to_boxes_first(bench):
    bench.link.send(["G28\nG29", " ", "; no command", "@pause"], ())
    bench.link.send(["M292 P0", "M117 x"], (), force=True)
    assert bench.exchange.lines == ["M292 P0", "M117 x", "G28", "G29"]


def test_bare_m122_gets_something_behind_it(bench):
    bench.link.send(["M122", "M122 B0"], ())
    assert bench.exchange.lines == ["M122 ", "M122 B0"]


def test_line_that_leaves_no_room_for_a_stop_is_not_sent(bench):
    bench.link.send([f'M117 "{"ü" * 120}"'], ())
    assert bench.exchange.lines == []
    assert bench.notes[-1][:2] == ("refused_operation", "unsent_too_long")


def test_command_is_under_way_until_the_channel_is_through(bench):
    bench.tell("sent", "G28")
    assert bench.link.doing() == ("G28", "homing", 100.0)
    assert bench.link.is_changing()
    busy, idle = ([{"name": "HTTP", "state": word}] for word in ("executing", "idle"))
    bench.now = 101.0
    bench.replied(inputs=busy)
    assert bench.link.is_changing()
    # asked too early to say anything of it
    bench.replied(100.1, inputs=idle)
    assert bench.link.is_changing()
    bench.now = 105.0
    bench.replied(inputs=idle)
    assert not bench.link.is_changing()
    assert bench.link.doing() is None
    assert bench.link.settled_at == 100.0


def test_command_that_is_told_to_be_through_is_what_nobody_waits_for(bench):
    """As behind a single-board computer, whose model shows it a little later."""
    for line in ("M117 x", "G28"):
        bench.tell("sent", line)
    bench.now = 109.0
    bench.tell("done", "G28")
    assert bench.notes[-1] == ("look",)
    assert bench.link.doing() is None and bench.link.is_changing()
    idle = [{"name": "HTTP", "state": "idle"}]
    bench.replied(109.1, inputs=idle)
    assert bench.link.is_changing()
    bench.replied(110.0, inputs=idle)
    assert not bench.link.is_changing()
    assert bench.link.settled_at == 109.0
    bench.tell("sent", "M117 y")
    bench.tell("done", "M117 y")
    assert bench.link.doing() is None


def test_command_that_changes_counts_while_it_waits(bench):
    bench.link.send(["G28"], ())
    assert bench.link.is_changing()


def test_secrets_of_commands_stay_out_of_sight(bench):
    logged = []
    bench.link.printer = Nobody()
    bench.link.printer.log = logged.append
    bench.tell("sent", 'M587 S"shed" P"swordfish"')
    assert "swordfish" not in logged[0]
    assert "swordfish" not in str(bench.link.doing())


def test_news_of_another_printer_is_nobodys(bench):
    told = bench.link._of(Nobody(), "said")
    told("late\n")
    assert bench.notes == []


def test_board_that_is_away_is_told(bench):
    assert bench.link.blocked() is None
    bench.exchange.is_away = True
    assert bench.link.blocked() == "unreachable"
    bench.exchange.is_away = False
    bench.tell("back", None, bench.now)
    assert bench.notes == [("look", "")], "another board may be there by now"


def test_reset_is_known_by_a_clock_that_is_late(bench):
    """As with a board that was reset right after it had been switched on."""
    bench.replied(100.0, state={"upTime": 7})
    bench.tell("back", 17, 110.0)
    assert ("was_reset",) not in bench.notes
    bench.tell("back", 9, 112.0)
    assert ("was_reset",) in bench.notes


def test_questions_and_answers(bench):
    request = ModelRequest("state", "")
    bench.link.ask(request)
    assert bench.exchange.calls == [("ask", request)]
    bench.tell("polled", request, 99.0, '{"key":"state"}')
    assert bench.notes == [
        ("poll_sent", 99.0),
        ("reply", '{"key":"state"}'),
        ("poll_acknowledged",),
    ]


def test_without_a_board_nothing_happens():
    link = Bench().link
    link.close()
    link.ask(ModelRequest("state", ""))
    link.give_up()
    link.send(["G28"], ())
    link.stop_now(())
    assert (link.is_operational, link.blocked(), link.doing()) == (False, None, None)
    assert not link.is_changing()
