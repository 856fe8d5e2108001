"""Files of a simulated board's card over HTTP: here whole or not at all, one at a time."""

import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.network import downloads as module
from octoprint_rrfmodel.link.network.address import address_of
from octoprint_rrfmodel.link.network.card import Card
from octoprint_rrfmodel.link.network.card_refused import CardRefused
from octoprint_rrfmodel.link.network.downloads import Reader
from octoprint_rrfmodel.link.network.file_read import whole_file
from octoprint_rrfmodel.link.network.session import Session
from octoprint_rrfmodel.link.network.transport import Transport
from octoprint_rrfmodel.rrf.card.listing import CardFile
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from tests.support.waiting import wait_for

from .standin import StandIn, answer, standalone

PATH = "0:/gcodes/a (1) ü.gcode"
CONTENT = b"; a file\n" + b"G1 X1 Y2 E0.1\n" * 30_000
FILE = CardFile(PATH, len(CONTENT), "2026-01-02T03:04:06")

SECONDS = 20


class Bench:
    def __init__(self, url, folder):
        self.session = Session(Transport(address_of(url)), lambda: "")
        self.dialect = standalone(self.session)
        self.exchange = SimpleNamespace(
            dialect=self.dialect, run=lambda errand: None, is_away=False
        )
        self.folder = folder
        self.card = Card(self, dict, lambda: str(folder))
        self.downloads = self.card.downloads
        self.held = []

    def want(self, file=FILE):
        self.held.append(self.downloads.want(file))
        return self.held[-1]

    def get(self, file=FILE):
        """Return all of a file, as OctoPrint reads it."""
        download = self.downloads.want(file)
        try:
            download.end.result(timeout=SECONDS)
        except CardRefused:
            download.release()
            raise
        reader, content = Reader(download), b""
        while piece := reader.read():
            content += piece
        reader.close()
        return content

    def close(self):
        self.downloads.forget()
        for download in self.held:
            download.release()
        self.downloads.forget()
        self.session.log_out()


@pytest.fixture
def face():
    with HttpBoard(Board("cartesian", "3.5.3")) as made:
        made.board.card.store(PATH, CONTENT, FILE.date)
        yield made


@pytest.fixture
def bench_of(tmp_path):
    made = []

    def bench(url):
        made.append(Bench(url, tmp_path))
        return made[-1]

    yield bench
    for each in made:
        each.close()


@pytest.fixture
def bench(bench_of, face):
    return bench_of(face.url)


def refused(call, *given):
    with pytest.raises(CardRefused) as caught:
        call(*given)
    return caught.value.code


def test_it_comes_byte_by_byte_as_it_is_on_the_card(bench, face):
    assert bench.get() == CONTENT
    everything = bytes(range(256)) * 1000
    face.board.card.store("0:/gcodes/b.gcode", everything, FILE.date)
    assert bench.get(CardFile("0:/gcodes/b.gcode", len(everything), FILE.date)) == everything


def test_empty_file_is_one(bench, face):
    face.board.card.store("0:/gcodes/empty.g", b"", FILE.date)
    assert bench.get(CardFile("0:/gcodes/empty.g", 0, FILE.date)) == b""


@pytest.mark.parametrize("fault", ["net_cut", "net_reset", "net_foreign", "net_redirect"])
def test_broken_transfer_is_no_file(bench, face, fault):
    bench.session.log_in()
    face.board.inject(fault + ":1")
    assert refused(bench.get) == "not_whole"
    assert bench.downloads.here(FILE) is None
    assert bench.get() == CONTENT


def test_no_buffers_is_told(bench, face):
    bench.session.log_in()
    face.board.inject("net_503:1")
    assert refused(bench.get) == "unreachable"


def test_session_that_was_lost_is_made_anew(bench, face):
    bench.session.log_in()
    face.board.inject("net_stale_key")
    assert bench.get() == CONTENT


def test_file_of_another_size_than_listed_is_not_served(bench, face):
    face.board.card.store(PATH, CONTENT[:-1], FILE.date)
    assert refused(bench.get) == "not_whole"


def test_file_that_is_gone_is_told(bench, face):
    face.board.card.delete(PATH)
    assert refused(bench.get) == "gone"


@pytest.mark.parametrize("length", [None, 5, 500])
def test_body_of_another_length_than_announced_is_no_file(bench_of, length):
    """Without a length nobody knows where it ends."""
    size = 100

    def reply(request):
        if b"rr_connect" in request:
            return answer('{"err":0,"sessionTimeout":8000,"boardType":"x","apiLevel":2}')
        told = b"" if length is None else b"Content-Length: %d\r\n" % length
        return b"HTTP/1.1 200 OK\r\n" + told + b"Connection: close\r\n\r\n" + b"x" * size

    with StandIn(reply) as standin:
        bench = bench_of(f"http://127.0.0.1:{standin.port}")
        for listed in {size, length or size}:
            file = CardFile("0:/gcodes/x.g", listed, FILE.date)
            if (listed, length) != (5, 5):
                assert refused(bench.get, file) == "not_whole"


def test_what_is_here_is_not_asked_for_again(bench, face):
    assert bench.get() == CONTENT
    face.board.inject("net_refused")
    assert bench.get() == CONTENT


def test_a_newer_one_of_that_name_is(bench, face):
    assert bench.get() == CONTENT
    face.board.card.store(PATH, CONTENT + b"M400\n", "2026-01-02T03:04:08")
    newer = CardFile(PATH, len(CONTENT) + 5, "2026-01-02T03:04:08")
    assert bench.get(newer) == CONTENT + b"M400\n"
    assert bench.downloads.here(FILE) is None


def test_who_wants_the_same_at_the_same_time_shares_it(bench, face):
    face.board.inject("net_slow:0.5")
    first, second = bench.want(), bench.want()
    assert first is second
    first.end.result(timeout=SECONDS)
    assert second.read(0, 10) == CONTENT[:10]


def test_one_is_transferred_at_a_time(bench, face, monkeypatch):
    """A small board serves three requests at once, all programs together."""
    others = [f"0:/gcodes/{number}.gcode" for number in range(4)]
    at_once, most = [], []
    opened = bench.session.open

    def counted(path, limit):
        at_once.append(path)
        most.append(len(at_once))
        response = opened(path, limit)
        closing = response.close
        response.close = lambda: (closing(), at_once.remove(path) if path in at_once else None)
        return response

    monkeypatch.setattr(bench.session, "open", counted)
    for path in others:
        face.board.card.store(path, CONTENT, FILE.date)
    wanted = [bench.want(CardFile(path, len(CONTENT), FILE.date)) for path in others]
    for each in wanted:
        each.end.result(timeout=SECONDS)
    assert len(most) == 4
    assert max(most) == 1


def test_upload_beside_a_download_is_refused_and_a_print_goes_first(bench, face, tmp_path):
    source = tmp_path / "b.gcode"
    source.write_bytes(b"G28\n")
    face.board.inject("net_slow:1")
    download = bench.want()
    wait_for(lambda: bench.card.transfers._turn.locked(), SECONDS, "the transfer to begin")
    assert refused(bench.card.upload, source, "0:/gcodes/b.gcode") == "busy"
    bench.card.upload(source, "0:/gcodes/b.gcode", goes_first=True)
    assert face.board.card.read("0:/gcodes/b.gcode") == b"G28\n"
    assert refused(download.end.result) == "stopped"


def test_what_nobody_wants_any_more_is_fetched_no_further(bench, face):
    face.board.inject("net_slow:1")
    download = bench.downloads.want(FILE)
    download.release()
    assert refused(download.end.result, SECONDS) == "stopped"
    assert not bench.card.transfers._turn.locked()
    face.board.clear("net_slow")
    assert bench.get() == CONTENT


def test_end_of_the_connection_ends_it(bench, face):
    face.board.inject("net_slow:1")
    download = bench.want()
    bench.downloads.forget()
    assert refused(download.end.result, SECONDS) == "stopped"
    bench.exchange = None
    assert refused(bench.get) == "unreachable"


def test_board_that_is_away_is_not_asked(bench, face):
    bench.exchange.is_away = True
    assert refused(bench.get) == "unreachable"


def test_the_oldest_go_first(bench, face, monkeypatch):
    monkeypatch.setattr(module, "MOST_KEPT", 2 * len(CONTENT) + 10)
    files = []
    for number in range(4):
        path = f"0:/gcodes/{number}.gcode"
        face.board.card.store(path, CONTENT, FILE.date)
        files.append(CardFile(path, len(CONTENT), FILE.date))
        assert bench.get(files[-1]) == CONTENT
    here = [bench.downloads.here(file) for file in files]
    bench.held += [each for each in here if each]
    assert [each is not None for each in here] == [False, False, True, True]


def test_one_too_large_to_keep_is_served_all_the_same(bench, face, monkeypatch):
    monkeypatch.setattr(module, "MOST_KEPT", 10)
    assert bench.get() == CONTENT
    assert bench.downloads.here(FILE) is None


def test_disk_that_is_full_is_told(bench, face, monkeypatch):
    class Full:
        closed = False

        def write(self, piece):
            raise OSError(28, "No space left on device")

        def close(self):
            self.closed = True

    monkeypatch.setattr(module.tempfile, "TemporaryFile", lambda dir: Full())
    assert refused(bench.get) == "no_room"


def test_transfer_that_comes_to_nothing_ends(bench, face, monkeypatch):
    monkeypatch.setattr(module, "BEGIN_SECONDS", -1000.0)
    assert refused(bench.get) == "not_whole"


def test_small_files_are_read_whole_or_refused(bench, face):
    assert whole_file(bench.dialect.files, PATH, most=len(CONTENT)) == CONTENT
    for size, most, code in ((None, 100, "large"), (3, 10**6, "not_whole")):
        with pytest.raises(CardRefused) as caught:
            whole_file(bench.dialect.files, PATH, size, most=most)
        assert caught.value.code == code


def test_no_thread_is_left(bench, face):
    def names():
        return [thread.name for thread in threading.enumerate()]

    assert bench.get() == CONTENT
    assert bench.want().end.result(timeout=SECONDS) is None
    wait_for(lambda: "rrfmodel.download" not in names(), SECONDS, "the threads to end")
    assert "rrfmodel.download" not in names()
