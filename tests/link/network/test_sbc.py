"""A computer in front of a board, simulated, over its HTTP and its websocket."""

import contextlib
import os
import queue
import time
import zlib
from types import SimpleNamespace

import pytest

from octoprint_rrfmodel.link.network import exchange as exchange_module
from octoprint_rrfmodel.link.network import model_feed
from octoprint_rrfmodel.link.network.address import address_of
from octoprint_rrfmodel.link.network.card import Card, CardRefused
from octoprint_rrfmodel.link.network.exchange import Exchange
from octoprint_rrfmodel.link.network.news import TOLD, News
from octoprint_rrfmodel.link.network.ration import Ration
from octoprint_rrfmodel.link.network.session import Session
from octoprint_rrfmodel.link.network.stop import stop
from octoprint_rrfmodel.link.network.transport import Transport, Unreachable
from octoprint_rrfmodel.rrf.card.thumbnail import decode_piece
from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.wire.reply import decode_page, members_of
from octoprint_rrfmodel.rrf.wire.request import (
    FileRequest,
    ListRequest,
    ModelRequest,
    PieceRequest,
    StatusRequest,
)
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from octoprint_rrfmodel.simulator.network.sbc.machine_files import MachineFiles
from octoprint_rrfmodel.simulator.network.sbc_board import SbcBoard
from tests.support.waiting import wait_for, within

pytest.importorskip("websocket")

LIVE = ModelRequest("", "d99fin")
STATUS = ModelRequest("state.status", "")


class Bench:
    """A board behind a computer, and the talk with it."""

    def __init__(self, face, password=""):
        self.face = face
        self.board = face.board
        self.told = queue.Queue()
        self.heard = []
        self.asked = []
        transport = Transport(address_of(face.url))
        self._get, transport.get = transport.get, self._counted
        self.session = Session(transport, lambda: password)
        news = News(
            **{name: lambda *given, name=name: self.told.put((name, *given)) for name in TOLD}
        )
        self.exchange = Exchange(
            self.session,
            news,
            time.monotonic,
            patience=lambda: 60.0,
            ration=Ration(time.monotonic, at_once=1000),
        )
        self.exchange.start()

    def _counted(self, path, *given, **named):
        self.asked.append(path.partition("?")[0])
        return self._get(path, *given, **named)

    def next(self, *names, seconds=20):
        """Return the next of these news, or of all; what else comes is kept as heard."""
        while True:
            news = self.told.get(timeout=seconds)
            self.heard.append(news)
            if not names or news[0] in names:
                return news

    def ask(self, request):
        self.exchange.ask(request)
        return self.next("polled")[3]

    def status(self):
        return members_of(self.ask(STATUS))["result"]

    def send(self, *lines):
        for line in lines:
            self.exchange.send(line)

    @property
    def dialect(self):
        return self.exchange.dialect


@contextlib.contextmanager
def benches(password="", own_password=None, **options):
    options = {"machine": "cartesian", "firmware": "3.5.3", "speed": 10, **options}
    with SbcBoard(Board(**options)) as face:
        face.board.network_access.password = password
        made = Bench(face, password if own_password is None else own_password)
        try:
            yield made
        finally:
            made.exchange.close()


@pytest.fixture(autouse=True)
def short_pauses(monkeypatch):
    for name in ("FIRST_PAUSE", "ERRAND_SECONDS"):
        monkeypatch.setattr(exchange_module, name, 0.05)
    monkeypatch.setattr(model_feed, "QUIET_SECONDS", 0.5)
    monkeypatch.setattr(model_feed, "ANSWER_SECONDS", 1.0)


@pytest.fixture
def bench():
    with benches() as made:
        assert made.next()[0] == "greeted"
        yield made


##~~ who answers


@pytest.mark.parametrize("firmware", ["3.4", "3.5.3", "3.6"])
def test_a_computer_is_told_by_what_answers(firmware):
    with benches("secret", firmware=firmware) as bench:
        name, greeting = bench.next()
        assert (name, greeting.protocol) == ("greeted", "dsf")
        assert bench.dialect.protocol == "dsf"
        # another question at the beginning, and none after it
        assert bench.asked == ["/rr_connect", "/machine/connect"]
        assert bench.status() in ("idle", "off")
        bench.exchange.close()
        wait_for(lambda: "/machine/disconnect" in bench.asked, 10, "the goodbye")
        wait_for(lambda: not bench.face.sessions._by_key, 10, "the end of the session")


REFUSALS = {
    "wrong password": ({"own_password": "other"}, None, "wrong_password"),
    "wrong password, before 3.5": (
        {"own_password": "other", "firmware": "3.4"},
        None,
        "wrong_password",
    ),
    "too old": ({"firmware": "3.3"}, None, "sbc_too_old"),
    "control server down": ({}, "net_sbc_down", "sbc_down"),
    "versions that don't fit": ({}, "net_sbc_version", "sbc_down"),
    "a hotel's page": ({}, "net_foreign", "not_rrf"),
}


@pytest.mark.parametrize(("options", "fault", "code"), REFUSALS.values(), ids=REFUSALS)
def test_refusals_have_reasons(options, fault, code):
    options = {"machine": "cartesian", "firmware": "3.5.3", **options}
    own = options.pop("own_password", "secret")
    with SbcBoard(Board(**options)) as face:
        face.board.network_access.password = "secret"
        if fault:
            face.board.inject(fault)
        made = Bench(face, own)
        assert made.next() == ("ended", code, "")


##~~ the model


def test_the_model_is_the_boards_and_its_questions_cost_nothing(bench):
    follower = Follower()

    def follow():
        request = follower.next_request()
        text = bench.ask(request)
        follower.take(text)
        return follower.ready and not follower.behind

    wait_for(follow, 20, "the whole model")
    for key, value in follower.store.model.items():
        if key not in ("seqs", "inputs"):
            assert value.keys() == bench.board.model[key].keys() if type(value) is dict else True
    assert follower.store.model["network"]["name"] == bench.board.model["network"]["name"]
    assert not {"sbc", "plugins", "messages"}.intersection(follower.store.model)
    board = bench.board
    board.execute("M104 S77", channel="aux")
    board.execute('M117 "hello"', channel="aux")
    wait_for(
        lambda: (
            follow() is not None
            and follower.store.model["heat"]["heaters"][1]["active"] == 77
            and follower.store.model["state"].get("displayMessage") == "hello"
        ),
        10,
        "what has changed",
    )
    assert bench.asked == ["/rr_connect", "/machine/connect"]


def test_what_is_no_question_says_so(bench):
    bench.exchange.ask(StatusRequest(2))
    assert bench.next("polled")[3] is None


def test_a_session_lives_as_long_as_its_websocket(bench):
    bench.session._used_at -= 60
    assert bench.dialect.read(FileRequest("0:/gcodes/square.gcode"))
    assert bench.asked.count("/machine/connect") == 1


def test_messages_come_before_what_has_come_of_them(bench):
    bench.board.message("Error: the filament is gone\n")
    assert bench.next("said") == ("said", "Error: the filament is gone")


def test_a_patch_that_does_not_fit_costs_nobody_anything(bench):
    """The whole is fetched again, and nobody is told of a gap."""
    bench.board.inject("net_garbled")
    bench.board.execute("M104 S61", channel="aux")
    wait_for(lambda: '"result":61' in active_of(bench), 10, "the target")
    wait_for(lambda: not bench.board.faults.is_on("net_garbled"), 10, "the fault to strike")
    bench.board.execute("M104 S62", channel="aux")
    wait_for(lambda: '"result":62' in active_of(bench), 10, "the target")
    assert not bench.exchange.is_away
    assert {news[0] for news in bench.heard} <= {"greeted", "polled", "said"}


def active_of(bench):
    return bench.ask(ModelRequest("heat.heaters[1].active", ""))


def test_patches_that_never_fit_are_a_gap(bench):
    bench.board.inject("net_garbled:20")
    wait_away(bench)
    bench.board.clear("net_garbled")
    assert bench.next("back")[0] == "back"
    assert bench.status() in ("idle", "off")


def wait_away(bench):
    def is_away():
        bench.exchange.ask(STATUS)
        return bench.exchange.is_away

    wait_for(is_away, 20, "the gap to be seen")


GAPS = ["net_loss", "net_refused", "net_sbc_down", "net_sbc_version"]


@pytest.mark.parametrize("fault", GAPS)
def test_a_gap_ends_by_itself(bench, fault):
    bench.board.inject(fault)
    if fault == "net_refused":
        bench.dialect._feed.close()
    wait_away(bench)
    bench.send("G28")
    assert bench.next("unsent") == ("unsent", "G28", "away")
    bench.board.execute('M118 P3 S"while away"', channel="aux")
    bench.board.clear(fault)
    name, up_time, _ = bench.next("back")
    assert type(up_time) is int
    assert bench.status() in ("idle", "off")
    assert bench.dialect._feed.is_open


def test_a_web_server_that_was_restarted_knows_nobody(bench):
    bench.face.sessions.forget()
    bench.dialect._feed.close()
    bench.exchange.ask(STATUS)
    assert bench.next("back")[0] == "back"
    assert bench.asked.count("/machine/connect") == 2
    assert bench.status() in ("idle", "off")


def test_silence_is_asked_about_and_lasts():
    """A computer that has nothing to tell still answers; here time stands at the board."""
    with benches(clock=lambda: 0.0) as bench:
        assert bench.next()[0] == "greeted"
        feed = bench.dialect._feed
        before, model = feed.heard_at, feed.model
        wait_for(lambda: feed.heard_at > before + 1, 10, "an answer")
        assert feed.is_open and feed.model is model


def test_more_than_makes_sense_is_no_answer(monkeypatch):
    monkeypatch.setattr(model_feed, "MOST_BYTES", 5000)
    with benches() as bench:
        assert bench.next()[:2] == ("ended", "unreachable")


def test_who_leaves_meanwhile_gets_no_other_websocket(bench):
    feed = bench.dialect._feed
    feed.close()
    feed._begin(feed._connected(), object())
    assert not feed.is_open


def test_password_and_key_stay_out_of_logs_and_reasons(caplog):
    caplog.set_level("DEBUG")
    with benches("swordfish") as bench:
        assert bench.next()[0] == "greeted"
        key = bench.session._key
        for fault in ("net_garbled:20", "net_sbc_down", "net_foreign"):
            bench.board.inject(fault)
            bench.dialect._feed.close()
            wait_away(bench)
            bench.board.clear(fault.partition(":")[0])
            bench.next("back")
        bench.face.sessions.forget()
        bench.send("G28")
        bench.next("unsent")
        text = caplog.text + repr(bench.heard)
        assert "rrfmodel.network" in text
        for secret in ("swordfish", key, bench.session._key):
            assert secret not in text


##~~ commands


def test_a_command_is_answered_when_it_is_through(bench):
    bench.send("M115")
    assert bench.next("sent") == ("sent", "M115")
    assert bench.next("said")[1].startswith("FIRMWARE_NAME: RepRapFirmware")
    assert bench.next("done") == ("done", "M115")
    bench.send("M9999")
    assert bench.next("said")[1].startswith("Warning") or "M9999" in bench.heard[-1][1]


def test_commands_go_one_by_one_and_hold_up_nobody(bench):
    bench.send("G4 S20", "M117 x", "M115")
    assert bench.next("sent") == ("sent", "G4 S20")
    assert bench.status()
    assert bench.exchange.waiting() == ["M117 x", "M115"]
    assert bench.dialect.is_executing
    # what a framework takes past its queue
    bench.send("M122")
    assert bench.next("sent") == ("sent", "M122")
    assert bench.next("done") == ("done", "M122")
    assert [bench.next("done")[1] for _ in range(3)] == ["G4 S20", "M117 x", "M115"]
    assert not bench.dialect.is_executing


def test_a_box_is_answered_beside_the_command_that_opened_it(bench):
    bench.send('M291 P"Go on?" S3', "M117 x")
    bench.next("sent")
    box = ModelRequest("state.messageBox.mode", "")
    wait_for(lambda: members_of(bench.ask(box))["result"] == 3, 10, "the box")
    assert bench.exchange.waiting() == ["M117 x"]
    bench.exchange.send("M292 P0", True)
    assert {bench.next("done")[1] for _ in range(3)} == {
        'M291 P"Go on?" S3',
        "M292 P0",
        "M117 x",
    }


def test_no_command_goes_out_twice_when_its_answer_is_lost(bench):
    bench.send("global count = 0")
    bench.next("done")
    bench.board.inject("net_lost_command")
    bench.send("set global.count = global.count + 1")
    assert bench.next("unsent")[2] == "doubtful"
    bench.next("done")
    bench.send("set global.count = global.count + 1")
    bench.next("done")
    assert bench.board.model["global"]["count"] == 2


def test_a_command_of_a_session_that_is_unknown_is_not_sent_again(bench):
    bench.face.sessions.forget()
    bench.send("G28")
    assert bench.next("unsent") == ("unsent", "G28", "reset")
    bench.send("M115")
    assert bench.next("said")[1].startswith("FIRMWARE_NAME")


def test_a_stop_passes_a_heat_up_within_a_second(bench, caplog):
    bench.send("T0", "M109 S200", "M117 x")
    while bench.next("sent")[1] != "M109 S200":
        pass
    wait_for(lambda: bench.board.model["heat"]["heaters"][1]["active"] == 200, 10, "the heat-up")
    began = time.monotonic()
    bench.exchange.drop("stopped")
    stop(bench.dialect, exchange_logger())
    wait_for(lambda: bench.board.model["state"]["status"] == "halted", 1, "the stop")
    assert time.monotonic() - began < within(1)
    assert bench.next("unsent") == ("unsent", "M117 x", "stopped")
    assert bench.dialect.is_halted()


def exchange_logger():
    import logging

    return logging.getLogger("test")


def test_a_restart_is_sent_once(bench):
    before = bench.dialect.up_time()
    bench.board.execute("G4 S3", channel="aux")
    stop(bench.dialect, exchange_logger(), "M999")
    wait_for(lambda: bench.dialect.up_time() < max(before, 3), 20, "the restart")
    # the computer stays, and so does what hangs on it
    assert not bench.exchange.is_away
    assert bench.status()


##~~ files


def test_the_card_is_read_in_a_boards_words(bench):
    page = decode_page(bench.dialect.read(ListRequest("0:/gcodes")))
    listed = {entry.name: entry for entry in page.entries}
    assert (page.folder, page.next, page.error) == ("0:/gcodes", 0, 0)
    assert listed["square.gcode"].size == len(bench.board.card.read("0:/gcodes/square.gcode"))
    assert "." not in listed["square.gcode"].date
    assert decode_page(bench.dialect.read(ListRequest("0:/nowhere"))).error == 2
    told = members_of(bench.dialect.read(FileRequest("0:/gcodes/square.gcode")))
    assert (told["err"], told["fileName"]) == (0, "0:/gcodes/square.gcode")
    (thumbnail,) = told["thumbnails"]
    piece = decode_piece(
        bench.dialect.read(PieceRequest("0:/gcodes/square.gcode", thumbnail["offset"]))
    )
    assert len(piece.data) == thumbnail["size"] and not piece.next and not piece.error
    assert members_of(bench.dialect.read(FileRequest("0:/gcodes/none.g")))["err"] == 1


@pytest.mark.parametrize("keeps_dates", [True, False], ids=["3.4.4", "before"])
def test_the_card_takes_files_whatever_becomes_of_their_dates(keeps_dates, tmp_path, monkeypatch):
    if not keeps_dates:
        write = MachineFiles.write
        monkeypatch.setattr(MachineFiles, "write", lambda *given: write(*given[:-1], None))
    source = tmp_path / "source.gcode"
    source.write_bytes(b"G28\n")
    os.utime(source, (1_750_000_000, 1_750_000_000))
    with benches() as bench:
        assert bench.next()[0] == "greeted"
        card = Card(SimpleNamespace(exchange=bench.exchange), dict)
        card.upload(source, "0:/gcodes/new/a.gcode")
        assert bench.board.card.read("0:/gcodes/new/a.gcode") == b"G28\n"
        bench.board.inject("net_corrupt:9")
        with pytest.raises(CardRefused) as caught:
            card.upload(source, "0:/gcodes/b.gcode")
        assert caught.value.code == "not_whole"


def upload(bench, tmp_path, content, path):
    source = tmp_path / "source.gcode"
    source.write_bytes(content)
    told = []
    with open(source, "rb") as body:
        is_whole = bench.dialect.files.upload(
            body,
            path,
            size=len(content),
            crc=zlib.crc32(content),
            modified="2026-11-29T12:00:00",
            told=told.append,
        )
    return is_whole, told


@pytest.mark.parametrize("name", ["a.gcode", "Größe 50%+1.gcode", "new folder/a b.gcode"])
def test_files_are_brought_whole(bench, tmp_path, name):
    content = b"G1 X10\n" * 50000
    is_whole, told = upload(bench, tmp_path, content, f"0:/gcodes/{name}")
    assert is_whole and told[-1] == len(content)
    assert bench.board.card.read(f"0:/gcodes/{name}") == content
    told = members_of(bench.dialect.read(FileRequest(f"0:/gcodes/{name}")))
    assert (told["size"], told["lastModified"]) == (len(content), "2026-11-29T12:00:00")


def test_a_byte_that_was_spoilt_on_its_way_shows(bench, tmp_path):
    bench.board.inject("net_corrupt")
    assert not upload(bench, tmp_path, b"G28\n" * 10, "0:/gcodes/a.gcode")[0]
    assert upload(bench, tmp_path, b"G28\n" * 10, "0:/gcodes/a.gcode")[0]


FACES = {"by itself": HttpBoard, "behind a computer": SbcBoard}


@pytest.mark.parametrize("face", FACES.values(), ids=FACES)
def test_files_are_read(face):
    with face(Board("cartesian", "3.5.3")) as face:
        bench = Bench(face)
        assert bench.next()[0] == "greeted"
        content = face.board.card.read("0:/gcodes/square.gcode")
        with bench.dialect.files.open("0:/gcodes/square.gcode", 10**6) as response:
            assert (response.status, response.length) == (200, len(content))
            assert response.read(7) + response.read() == content
        with bench.dialect.files.open("0:/gcodes/none.gcode", 10**6) as response:
            assert response.status == 404
        face.board.card.write("0:/gcodes/large.gcode", "x" * 100000)
        large = bench.dialect.files.open("0:/gcodes/large.gcode", 100)
        with large, pytest.raises(Unreachable):
            large.read()
        bench.exchange.close()


def test_files_and_folders_are_changed(bench):
    files, card = bench.dialect.files, bench.board.card
    assert files.make_folder("0:/gcodes/box")
    assert files.move("0:/gcodes/square.gcode", "0:/gcodes/box/50% + ü.gcode")
    assert card.read("0:/gcodes/square.gcode") is None
    assert not files.delete("0:/gcodes/box")
    assert files.delete("0:/gcodes/box/50% + ü.gcode")
    assert files.delete("0:/gcodes/box")
    assert not files.delete("0:/gcodes/box")
