"""The connector without a server: what OctoPrint is told, and when it isn't told any more."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

connection = pytest.importorskip("octoprint.printer.connection", reason="OctoPrint 2.0 has it")
from octoprint_rrfmodel.link.network import connector as module  # noqa: E402
from octoprint_rrfmodel.link.network import printer_side  # noqa: E402
from octoprint_rrfmodel.link.network.login import Greeting  # noqa: E402
from octoprint_rrfmodel.rrf.views.machine import Machine  # noqa: E402


class Listener:
    """Keeps what it was called with."""

    def __init__(self):
        self.calls = []

    def __getattr__(self, name):
        if not name.startswith("on_printer_"):
            raise AttributeError(name)
        return lambda *given, **named: self.calls.append((name[len("on_printer_") :], given, named))

    def names(self):
        return [name for name, _, _ in self.calls]

    def states(self):
        return [given[0].name for name, given, _ in self.calls if name == "state_changed"]


class FakeLink:
    exchange = None

    def __init__(self):
        self.sent = []

    def send(self, lines, tags, force=False):
        self.sent += lines

    def stop_now(self, tags):
        self.sent.append("stop")

    def end_job(self):
        return "M25", "M0"


class FakeNetwork:
    """What the connector stands on; its thread is the caller's."""

    def __init__(self):
        self.link = FakeLink()
        self.known = {}
        self.notes = []
        self.opened = []
        self.memory = SimpleNamespace(hosts=lambda: ["duet.local"])
        self.found = SimpleNamespace(boards=dict)
        details = SimpleNamespace(known={})
        self.card = SimpleNamespace(files={}, folders=frozenset(), changed=None, details=details)

    def model(self):
        return self.known

    def machine(self):
        return Machine(self.known)

    def clock(self):
        return 0.0

    def notify(self, *note):
        self.notes.append(note)

    def later(self, function, *arguments):
        function(*arguments)

    def open(self, printer, address):
        self.opened.append(address.text)

    def close(self, printer):
        self.opened.append(None)


class Events:
    def __init__(self):
        self.fired = []

    def fire(self, name, payload=None):
        self.fired.append(name)


@pytest.fixture
def events(monkeypatch):
    made = Events()
    for place in (printer_side, connection):
        monkeypatch.setattr(place, "eventManager", lambda: made)
    return made


PROFILE = {"id": "_default", "axes": {"x": {"speed": 6000}, "z": {"speed": 200}}}


@pytest.fixture
def printer(events, monkeypatch):
    monkeypatch.setattr(module.NetworkPrinter, "network", FakeNetwork())
    owner = SimpleNamespace(trigger_printjob_event=lambda event, **named: events.fire(event))
    made = module.NetworkPrinter(
        owner, Listener(), PROFILE, port=None, baudrate=None, host="duet.local"
    )
    made.heard = made._listener
    return made


def told(status, name="0:/gcodes/a.g", **more):
    job = {"file": {"fileName": name, "size": 100}, "filePosition": 40, "duration": 5}
    return {
        "state": {"status": status, "upTime": 9, "currentTool": 0},
        "job": job if name else {},
        "heat": {"heaters": []},
        **more,
    }


IDLE = told("idle", "")


def show(printer, *models):
    for model in models:
        printer.network.known = model
        printer.side.look()


@pytest.fixture
def connected(printer):
    printer.connect()
    printer.side.greeted(Greeting("duet3mini", 2))
    show(printer, IDLE)
    return printer


def test_it_is_operational_when_the_board_has_told_its_state(printer, events):
    printer.connect()
    assert printer.network.opened == ["duet.local"]
    assert printer.heard.states() == ["CONNECTING"]
    printer.side.greeted(Greeting("duet3mini", 2))
    show(printer, {})
    assert printer.heard.states() == ["CONNECTING"]
    show(printer, IDLE)
    assert printer.heard.states() == ["CONNECTING", "OPERATIONAL"]
    assert "Connected" in events.fired
    assert "files_available" in printer.heard.names()


def test_parameters_are_the_address_and_no_more(printer):
    assert printer.connection_parameters == {
        "connector": "rrfmodel",
        "profile": PROFILE,
        "host": "duet.local",
    }


def test_nothing_is_told_once_it_is_disconnected(connected):
    """A late call would close the connection that came after this one."""
    connected.disconnect()
    assert connected.heard.states()[-1] == "CLOSED"
    before = len(connected.heard.calls)
    show(connected, told("processing"))
    connected.side.log("late")
    connected.side.ended("gone", "")
    assert len(connected.heard.calls) == before


def test_end_tells_why_before_the_state(connected, events):
    connected.network.later = lambda function, *given: function(*given)
    with connected_app():
        connected.side.ended("wrong_password", "")
    assert connected.heard.states()[-1] == "CLOSED_WITH_ERROR"
    names = connected.heard.names()
    assert names.index("error") < len(names) - 1 - names[::-1].index("state_changed")
    assert connected.network.opened[-1] is None


def connected_app():
    """Return what sentences are translated in."""
    import flask
    import flask_babel

    app = flask.Flask("test")
    flask_babel.Babel(app)
    return app.app_context()


def test_job_of_the_machine_gets_no_scripts(connected):
    show(connected, told("processing"), told("paused"), told("idle", ""))
    connected.side.heard("Cancelled printing file 0:/gcodes/a.g, print time was 0h 1m")
    about = {name: named for name, _, named in connected.heard.calls if name.startswith("job_")}
    for name in ("job_started", "job_paused", "job_cancelled"):
        assert about[name]["suppress_script"] is True, name
    assert connected.current_job.path == "a.g"
    assert connected.heard.states()[-1] == "OPERATIONAL"


def test_job_of_octoprints_gets_them(connected):
    connected.set_job(job_of(storage="printer", path="b.g"))
    connected.start_print(user="me")
    assert connected.network.link.sent == ['M32 "0:/gcodes/b.g"']
    assert connected.heard.states()[-1] == "STARTING"
    show(connected, told("processing", "0:/gcodes/b.g"), told("paused", "0:/gcodes/b.g"))
    paused = next(named for name, _, named in connected.heard.calls if name == "job_paused")
    assert paused["suppress_script"] is False
    assert connected.heard.names().count("job_started") == 1


def job_of(**members):
    from octoprint.printer.job import PrintJob

    return PrintJob(display=members["path"], size=10, **members)


def test_second_start_does_nothing(connected):
    connected.set_job(job_of(storage="printer", path="b.g"))
    connected.start_print()
    connected.start_print()
    assert len(connected.network.link.sent) == 1
    assert not connected.is_ready()


def test_cancel_is_shown_and_sent_once(connected, events):
    show(connected, told("processing"))
    connected.cancel_print(user="me")
    show(connected, told("processing"), told("pausing"), IDLE)
    assert connected.network.link.sent == ["M25", "M0"]
    assert connected.heard.states()[-2:] == ["CANCELLING", "OPERATIONAL"]
    assert "PrintCancelling" in events.fired


def test_states_are_told_when_they_change(connected):
    show(connected, *[told("processing")] * 5)
    assert connected.heard.states().count("PRINTING") == 1


def test_temperatures_are_pairs(connected):
    heat = {"heaters": [{"current": 20.5, "active": 60, "state": "active"}], "bedHeaters": [0]}
    show(connected, told("idle", "", heat=heat))
    last = [given for name, given, _ in connected.heard.calls if name == "temperature_update"][-1]
    assert last[0]["bed"] == (20.5, 60)
    assert None not in last[0]


OPERATIONS = (
    ("jog", ({"x": 10, "z": -1},), {"speed": None}, ["M120 G21 G91 G1 X10 Z-1 F200 M121"]),
    ("jog", ({"x": 10},), {"relative": False, "speed": False}, ["M120 G21 G90 G1 X10 M121"]),
    ("home", (["x", "y"],), {}, ["G28 X Y"]),
    ("home", ("z",), {}, ["G28 Z"]),
    ("feed_rate", (110,), {}, ["M220 S110"]),
    ("change_tool", ("tool0",), {}, ["T0"]),
    ("emergency_stop", (), {"tags": set()}, ["stop"]),
    ("commands", ("M117 hi", "G28"), {"tags": set()}, ["M117 hi", "G28"]),
)


@pytest.mark.parametrize(("name", "given", "named", "lines"), OPERATIONS)
def test_operations(connected, name, given, named, lines):
    getattr(connected, name)(*given, **named)
    assert connected.network.link.sent == lines


def test_nothing_moves_beside_a_print(connected):
    show(connected, told("processing"))
    connected.jog({"x": 10})
    connected.home(["x"])
    connected.change_tool("tool1")
    assert connected.network.link.sent == []
    assert [note[:2] for note in connected.network.notes] == [("refused_operation", "prints")] * 3


def test_preconditions_are_that_there_is_an_address():
    met = module.NetworkPrinter.connection_preconditions_met
    assert met({"host": "duet.local"}) is True
    assert met({"host": "duet/x"}) is False
    assert met({}) is False


def test_options_are_the_known_boards_and_those_that_were_found(printer):
    found = {"10.0.0.7": "b (Duet 1)", "10.0.0.5": "a (Duet 1)", "duet.local": "known already"}
    printer.network.found = SimpleNamespace(boards=lambda: found)
    assert printer.connection_options() == {
        "host": ["duet.local"],
        "found": [
            {"host": "10.0.0.5", "name": "a (Duet 1)"},
            {"host": "10.0.0.7", "name": "b (Duet 1)"},
        ],
    }


def test_without_the_plugins_parts_there_are_no_options(monkeypatch):
    monkeypatch.setattr(module.NetworkPrinter, "network", None)
    assert module.NetworkPrinter.connection_options() == {"host": [], "found": []}
