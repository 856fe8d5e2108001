"""The machine's own files over HTTP on a simulated board: nothing is lost, nothing else reached."""

import contextlib
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.link.network import transfers
from octoprint_rrfmodel.link.network.address import address_of
from octoprint_rrfmodel.link.network.card import Card
from octoprint_rrfmodel.link.network.machine_files import MOST_WRITTEN, MachineFiles
from octoprint_rrfmodel.link.network.session import Session
from octoprint_rrfmodel.link.network.transport import Transport
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard

from .standin import standalone

CONFIG = "0:/sys/config.g"
MACRO = "0:/macros/Say hello"


class Bench:
    def __init__(self, face):
        self.board = face.board
        self.session = session = Session(Transport(address_of(face.url)), lambda: "")
        session.log_in()
        self.exchange = SimpleNamespace(
            dialect=standalone(session), run=lambda errand: None, is_away=False
        )
        self.model = {}
        self.card = Card(self, dict)
        self.files = MachineFiles(self, self.card, lambda: self.model)

    def on_card(self, path):
        content = self.board.card.read(path)
        return None if content is None else content.decode()


@pytest.fixture
def bench(monkeypatch):
    monkeypatch.setattr(transfers, "STALL_SECONDS", 0.0)
    with HttpBoard(Board("cartesian", "3.5.3")) as face:
        yield Bench(face)


def refused(call, *given):
    with pytest.raises(RequestRefused) as caught:
        call(*given)
    assert str(caught.value).endswith(".")
    return caught.value.status


def test_folders_are_listed(bench):
    found = {each["name"]: each for each in bench.files.entries("0:/filaments/PLA")}
    assert set(found) == {"load.g", "unload.g", "config.g"}
    assert found["load.g"]["size"] == len("G4 S2\n")
    (folder,) = bench.files.entries("0:/filaments/")
    assert (folder["name"], folder["folder"]) == ("PLA", True)
    assert "config.g" in {each["name"] for each in bench.files.entries("0:/sys")}


def test_file_is_read_with_what_tells_a_change(bench):
    told = bench.files.read(MACRO)
    assert told["text"] == bench.on_card(MACRO)
    assert told["size"] == len(told["text"])
    bench.board.card.write(MACRO, told["text"], "2026-01-02T03:04:06")
    assert bench.files.read(MACRO)["stamp"] != told["stamp"]


def test_what_is_written_over_is_kept(bench):
    before = bench.on_card(MACRO)
    told = bench.files.write(MACRO, "M117 Grüße\n", bench.files.read(MACRO)["stamp"])
    assert bench.on_card(MACRO) == "M117 Grüße\n"
    assert told["backup"] == "0:/sys/backup/macros/Say hello"
    assert bench.on_card(told["backup"]) == before
    assert told["restart"] is False
    assert told["stamp"] == bench.files.read(MACRO)["stamp"]


def test_new_file_needs_no_copy(bench):
    told = bench.files.write("0:/macros/new/one.g", "G28\n", "")
    assert bench.on_card("0:/macros/new/one.g") == "G28\n"
    assert told["backup"] is None


@pytest.mark.parametrize("path", [CONFIG, "0:/SYS/Config.g"])
def test_configuration_wants_a_restart(bench, path):
    assert bench.files.write(path, "; new\n")["restart"] is True
    assert bench.on_card(CONFIG) == "; new\n"
    assert bench.files.write("0:/sys/bed.g", "G28\n")["restart"] is False


def test_system_folder_may_be_another(bench):
    bench.model = {"directories": {"system": "0:/my/", "macros": None}}
    assert refused(bench.files.read, CONFIG) == 400
    bench.board.card.write("0:/my/config.g", "; mine\n")
    assert bench.files.write("0:/my/config.g", "; new\n")["restart"] is True
    assert bench.on_card("0:/my/backup/my/config.g") == "; mine\n"
    assert bench.files.read(MACRO)["text"]


def test_file_that_was_changed_meanwhile_stays_as_it_is(bench):
    stamp = bench.files.read(MACRO)["stamp"]
    bench.board.card.write(MACRO, "; somebody else's\n", "2026-01-02T03:04:06")
    assert refused(bench.files.write, MACRO, "; mine\n", stamp) == 409
    assert refused(bench.files.write, MACRO, "; mine\n", "") == 409
    assert bench.on_card(MACRO) == "; somebody else's\n"
    assert bench.on_card("0:/sys/backup/macros/Say hello") is None


@pytest.mark.parametrize(
    "path",
    ["", "0:/", "0:/gcodes/square.gcode", "0:/www/index.html", "0:/sys/../gcodes/square.gcode"]
    + ["0:/sysx/a.g", "1:/sys/a.g", "/sys/a.g", "sys/a.g", "0:/sys/a;b", '0:/sys/a"b']
    + ["0:/sys/a\nb", "0:/sys//a", "0:/sys/" + "x" * 120],
)
def test_nothing_else_is_reached(bench, path):
    for call in (bench.files.read, bench.files.entries):
        assert refused(call, path) == 400
    assert refused(bench.files.write, path, "x") == 400


@pytest.mark.parametrize("path", ["0:/sys", "0:/macros/", "0:/macros/sub/"])
def test_folder_is_no_file(bench, path):
    assert refused(bench.files.read, path) == 400
    assert refused(bench.files.write, path, "x") == 400


@pytest.mark.parametrize(
    "text", [None, 5, ["x"], "a\0b", "a\x1bb", "a\x7f", "\ud800", "x" * (MOST_WRITTEN + 1)]
)
def test_what_is_no_text_is_not_written(bench, text):
    before = bench.on_card(CONFIG)
    assert refused(bench.files.write, CONFIG, text) == 400
    assert bench.on_card(CONFIG) == before


def test_file_that_holds_no_text_is_not_shown(bench):
    bench.board.card.store("0:/sys/a.bin", b"\xff\xfe\0", "2026-01-02T03:04:06")
    assert refused(bench.files.read, "0:/sys/a.bin") == 409


def test_what_is_not_there_is_told(bench):
    assert refused(bench.files.read, "0:/sys/none.g") == 404
    assert refused(bench.files.entries, "0:/macros/none") == 404


@pytest.mark.parametrize("status", ["processing", "pausing", "resuming", "simulating"])
def test_nothing_is_written_beside_a_print(bench, status):
    bench.model = {"state": {"status": status}}
    assert refused(bench.files.write, CONFIG, "; new\n") == 409
    assert bench.files.read(CONFIG)["text"] == bench.on_card(CONFIG)


class Lying:
    """A session whose board denies a file that it has."""

    def __init__(self, session):
        self._session = session
        self.open = session.open
        self.upload = session.upload

    def ask(self, path, **named):
        told = self._session.ask(path, **named)
        return b'{"err":1}' if "rr_fileinfo" in path else told


def test_file_that_is_there_after_all_is_not_written_over(bench):
    before = bench.on_card(CONFIG)
    bench.exchange.dialect = standalone(Lying(bench.session))
    assert refused(bench.files.write, CONFIG, "; new\n") == 504
    assert bench.on_card(CONFIG) == before


@pytest.mark.parametrize("fault", ["net_corrupt:4", "net_foreign:2", "net_503:4"])
def test_what_does_not_come_through_leaves_the_file(bench, fault):
    before = bench.on_card(CONFIG)
    bench.board.inject(fault)
    assert refused(bench.files.write, CONFIG, "; new\n") == 504
    assert bench.on_card(CONFIG) == before


@pytest.mark.parametrize("count", range(1, 6))
def test_garbled_answers_lose_nothing(bench, count):
    before = bench.on_card(CONFIG)
    bench.board.inject(f"net_garbled:{count}")
    with contextlib.suppress(RequestRefused):
        bench.files.write(CONFIG, "; new\n")
    assert before in (bench.on_card(CONFIG), bench.on_card("0:/sys/backup/sys/config.g"))


def test_without_a_copy_nothing_is_written(bench):
    """The first transfer is that of the copy."""
    before = bench.on_card(CONFIG)
    bench.board.inject("net_corrupt:2")
    assert refused(bench.files.write, CONFIG, "; new\n") == 504
    assert bench.on_card(CONFIG) == before


def test_nothing_is_transferred_beside_another_file(bench):
    before = bench.on_card(CONFIG)
    with bench.card.transfers._turn:
        assert refused(bench.files.write, CONFIG, "; new\n") == 409
        assert refused(bench.files.read, CONFIG) == 409
    assert bench.on_card(CONFIG) == before


def test_board_that_is_away_is_not_asked(bench):
    bench.exchange.is_away = True
    assert refused(bench.files.read, CONFIG) == 504
    bench.exchange = None
    assert refused(bench.files.entries, "0:/sys") == 409
