"""The mesh in use, over HTTP from a simulated board: read once, again when it is another one."""

import collections
import json

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.link.network import height_maps as module
from octoprint_rrfmodel.link.network.address import address_of
from octoprint_rrfmodel.link.network.card_refused import FAILURES
from octoprint_rrfmodel.link.network.height_maps import MOST_TRIES, HeightMaps, mesh_of
from octoprint_rrfmodel.link.network.session import Session
from octoprint_rrfmodel.link.network.transport import Transport
from octoprint_rrfmodel.rrf.card.height_map import MOST_BYTES, height_map
from octoprint_rrfmodel.rrf.wire.rr import path_of
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard

from .standin import standalone

FILE = "0:/sys/heightmap.csv"


class Counting(Session):
    """A session that counts what is asked of the board."""

    def __init__(self, *given):
        super().__init__(*given)
        self.asked = collections.Counter()

    def ask(self, path, **named):
        self.asked[path.partition("?")[0]] += 1
        return super().ask(path, **named)

    def open(self, path, most):
        self.asked[path.partition("?")[0]] += 1
        return super().open(path, most)

    @property
    def downloads(self):
        return self.asked["/rr_download"]


class Bench:
    """A board, and height maps whose errands run when the test says so."""

    def __init__(self, face):
        self.face = face
        self.board = face.board
        self.session = Counting(Transport(address_of(face.url)), lambda: "")
        self.dialect = standalone(self.session)
        self.errands = []
        self.exchange = self
        self.told = {}
        self.maps = HeightMaps(self, lambda: self.told)
        self.follow()

    def run(self, errand):
        self.errands.append(errand)

    def follow(self):
        """Take the model from the board, as polls do."""
        self.told = {
            key: json.loads(self.session.ask(path_of("model", key=key, flags="d99vn")))["result"]
            for key in ("move", "seqs", "directories")
        }

    def does(self, *lines):
        for line in lines:
            self.board.execute(line, channel="aux")
        self.follow()
        self.look()

    def look(self):
        self.maps.look()
        self.work()

    def work(self):
        while self.errands:
            try:
                self.errands.pop(0)(self.dialect)
            except FAILURES:
                continue

    def read(self):
        """Return what somebody gets who asks for the mesh."""
        future = self.maps.read()
        self.work()
        return future.result(timeout=5)

    def write(self, text, date="2026-01-02T03:04:06"):
        self.board.card.write(FILE, text, date)
        self.board.bump("move")
        self.follow()


@pytest.fixture
def bench(monkeypatch):
    monkeypatch.setattr(module, "CHECK_SECONDS", 0.0)
    with HttpBoard(Board("cartesian", "3.5.3", speed=60)) as face:
        yield Bench(face)


def refusal(bench):
    with pytest.raises(RequestRefused) as caught:
        bench.read()
    return caught.value.status, str(caught.value)


def test_there_is_none_without_a_mesh_in_use(bench):
    bench.look()
    assert bench.maps.known is None
    assert refusal(bench)[0] == 404
    assert bench.session.downloads == 0


def test_it_is_read_as_soon_as_the_model_tells_of_it(bench):
    bench.does("G29 S1")
    file = bench.board.card.read(FILE).decode()
    assert bench.maps.known == height_map(file)
    assert bench.read() == (FILE, bench.maps.known)
    assert bench.session.downloads == 1


def test_who_asks_first_has_it_read(bench):
    bench.board.execute("G29 S1", channel="aux")
    bench.follow()
    assert bench.read()[1].size == (11, 10)


def test_it_is_read_once_while_it_is_the_same(bench):
    bench.does("G29 S1")
    for _ in range(5):
        bench.does("M290 S0.02")
        bench.board.bump("move")
        bench.follow()
        bench.look()
    assert bench.session.downloads == 1
    # whether it is the same is told by its date, once for each change of the model
    assert bench.session.asked["/rr_fileinfo"] <= 12
    assert bench.maps.known is not None


def test_a_counter_that_moves_all_the_time_costs_little(bench, monkeypatch):
    monkeypatch.setattr(module, "CHECK_SECONDS", 60.0)
    bench.does("G29 S1")
    before = bench.session.asked["/rr_fileinfo"]
    changed = bench.board.card.read(FILE).decode().replace("  0.053", "  0.153", 1)
    for _ in range(5):
        bench.write(changed)
        bench.look()
    assert bench.session.asked["/rr_fileinfo"] == before
    # who asks is told how it is now, and another mesh is read at once
    assert bench.read()[1].points[0][0] == 0.153
    bench.does('G29 S3 P"other.csv"', 'G29 S1 P"other.csv"')
    assert bench.maps.known is not None


def test_another_file_of_the_same_name_is_read(bench):
    bench.does("G29 S1")
    changed = bench.board.card.read(FILE).decode().replace("  0.053", "  0.153", 1)
    bench.write(changed)
    assert bench.maps.known.points[0][0] == 0.053
    bench.look()
    assert bench.maps.known.points[0][0] == 0.153


def test_another_name_is_never_shown_as_the_old_one(bench):
    bench.does("G29 S1")
    bench.board.execute('G29 S3 P"other.csv"', channel="aux")
    bench.board.execute('G29 S1 P"other.csv"', channel="aux")
    bench.follow()
    assert bench.maps.known is None
    bench.look()
    assert bench.read()[0] == "0:/sys/other.csv"
    bench.does("G29 S2")
    assert bench.maps.known is None
    assert refusal(bench)[0] == 404


@pytest.mark.parametrize(
    ("content", "status"),
    [
        ("", 404),
        ("<script>alert(1)</script>", 404),
        ("RepRapFirmware height map file v2\n", 404),
        ("x" * (MOST_BYTES + 1), 404),
    ],
)
def test_broken_file_is_told_and_not_read_again(bench, content, status):
    bench.does("G29 S1")
    bench.write(content)
    bench.look()
    assert bench.maps.known is None
    before = bench.session.downloads
    told = refusal(bench)
    assert told[0] == status
    assert "heightmap.csv" in told[1]
    assert "script" not in told[1]
    bench.look()
    assert bench.session.downloads == before


def test_file_that_is_gone_is_told(bench):
    bench.does("G29 S1")
    bench.board.card.delete(FILE)
    bench.board.bump("move")
    bench.follow()
    assert refusal(bench) == (
        404,
        "The card has no file heightmap.csv any more. Probe the bed again (G29).",
    )


@pytest.mark.parametrize("fault", ["net_cut:2", "net_reset:2", "net_garbled:1", "net_foreign:2"])
def test_broken_transfer_is_no_map_and_is_tried_again(bench, fault):
    bench.board.execute("G29 S1", channel="aux")
    bench.follow()
    bench.board.inject(fault)
    assert refusal(bench)[0] == 504
    assert bench.maps.known is None
    bench.board.clear(fault.partition(":")[0])
    bench.look()
    assert bench.maps.known.size == (11, 10)


def test_a_board_that_never_gives_it_is_left_alone(bench):
    bench.board.execute("G29 S1", channel="aux")
    bench.follow()
    bench.board.inject("net_foreign")
    for _ in range(MOST_TRIES + 5):
        bench.look()
    assert bench.session.asked["/rr_fileinfo"] == MOST_TRIES


def test_another_connection_knows_nothing_and_hears_nothing_of_the_old_one(bench):
    bench.board.execute("G29 S1", channel="aux")
    bench.follow()
    future = bench.maps.read()
    bench.maps.forget()
    with pytest.raises(RequestRefused):
        future.result(timeout=5)
    bench.work()
    assert bench.maps.known is None
    bench.look()
    assert bench.maps.known is not None


@pytest.mark.parametrize(
    ("model", "file"),
    [
        ({}, None),
        ({"move": None}, None),
        ({"move": {"compensation": None}}, None),
        ({"move": {"compensation": {"type": "mesh", "file": None}}}, None),
        ({"move": {"compensation": {"type": "none", "file": FILE}}}, None),
        ({"move": {"compensation": {"type": "mesh", "file": 5}}}, None),
        ({"move": {"compensation": {"type": "mesh", "file": "a.csv"}}}, "0:/sys/a.csv"),
        (
            {
                "move": {"compensation": {"type": "mesh", "file": "a.csv"}},
                "directories": {"system": "0:/my/"},
            },
            "0:/my/a.csv",
        ),
    ],
)
def test_mesh_that_a_model_tells_of(model, file):
    found = mesh_of(model)
    assert (found and found.file) == file
