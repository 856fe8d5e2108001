"""The card of a board on the network: what is kept of it, what is refused."""

import json
import os
import time
import zlib
from types import SimpleNamespace
from urllib.parse import parse_qs, urlsplit

import pytest

from octoprint_rrfmodel.link.network import transfers as module
from octoprint_rrfmodel.link.network.card import Card
from octoprint_rrfmodel.link.network.card_names import check_name
from octoprint_rrfmodel.link.network.card_refused import CardRefused
from octoprint_rrfmodel.link.network.standalone import Standalone
from octoprint_rrfmodel.link.network.transport import Unreachable


class FakeSession:
    """A board's card, in memory."""

    def __init__(self):
        self.uploads = []
        self.fails = 0
        self.answers = {}
        self.spoils = 0

    def upload(self, path, body, length, told):
        if self.fails:
            self.fails -= 1
            raise Unreachable("no answer in time")
        told(length // 2)
        told(length)
        query = {name: value[0] for name, value in parse_qs(urlsplit(path).query).items()}
        content = body.read()
        self.uploads.append((query, content))
        self.answers["fileinfo"] = {
            "err": 0,
            "fileName": query["name"],
            "size": len(content) - self.spoils,
            "lastModified": query["time"],
        }
        return b'{"err":0}'

    def ask(self, path, **_):
        name = urlsplit(path).path[len("/rr_") :]
        return json.dumps(self.answers.get(name, {"err": 0})).encode()


@pytest.fixture
def session(monkeypatch):
    monkeypatch.setattr(module, "STALL_SECONDS", 0.0)
    return FakeSession()


@pytest.fixture
def card(session):
    dialect = Standalone(session, time.monotonic, None)
    exchange = SimpleNamespace(dialect=dialect, run=lambda errand: None)
    return Card(SimpleNamespace(exchange=exchange), dict)


@pytest.fixture
def source(tmp_path):
    path = tmp_path / "source.gcode"
    path.write_bytes(b"G28\n" * 100)
    os.utime(path, (1_750_000_000, 1_750_000_000))
    return path


PATH = "0:/gcodes/new/a.gcode"


def test_upload_has_checksum_and_date(card, session, source):
    percent = []
    card.upload(source, PATH, percent.append)
    query, content = session.uploads[0]
    assert content == source.read_bytes()
    assert query["name"] == PATH
    assert query["crc32"] == f"{zlib.crc32(content):08x}"
    assert len(query["time"]) == len("2026-11-29T12:00:00")
    assert percent[-1] == 100
    assert card.files[PATH].size == 400
    assert card.folders == {"0:/gcodes/new"}


def test_upload_is_tried_again_after_a_stall(card, session, source):
    session.fails = 1
    card.upload(source, PATH)
    assert len(session.uploads) == 1


def test_upload_that_stays_without_an_answer_is_refused(card, session, source):
    session.fails = 9
    with pytest.raises(CardRefused) as caught:
        card.upload(source, PATH)
    assert caught.value.code == "unreachable"
    assert card.files == {}


def test_zero_is_no_proof(card, session, source):
    """A board says 0 also where the file isn't there: a failed rename, a second sender."""
    session.spoils = 1
    with pytest.raises(CardRefused) as caught:
        card.upload(source, PATH)
    assert caught.value.code == "not_whole"


def test_upload_can_be_called_off(card, session, source):
    with pytest.raises(CardRefused) as caught:
        card.upload(source, PATH, lambda percent: card.stop_uploads())
    assert (caught.value.code, session.uploads) == ("stopped", [])


@pytest.mark.parametrize(
    "name",
    ["a:b.g", "a?.g", 'a".g', "a*.g", "a|b.g", "../a.g", "a//b.g", "x" * 120, "a\nb.g", "a;b"],
)
def test_names_that_the_card_refuses(name):
    with pytest.raises(CardRefused):
        check_name(f"0:/gcodes/{name}")


@pytest.mark.parametrize("name", ["a.g", "Größe 1 (2).gcode", "a/b/c.gcode", "a'b.g"])
def test_names_that_it_takes(name):
    check_name(f"0:/gcodes/{name}")


def test_changes_show_at_once(card, session, source):
    card.upload(source, PATH)
    card.make_folder("0:/gcodes/box")
    card.move(PATH, "0:/gcodes/box/b.gcode")
    assert set(card.files) == {"0:/gcodes/box/b.gcode"}
    card.move("0:/gcodes/box", "0:/gcodes/chest")
    assert set(card.files) == {"0:/gcodes/chest/b.gcode"}
    assert "0:/gcodes/box" not in card.folders
    card.delete_folder("0:/gcodes/chest")
    assert card.files == {}


def test_refusal_of_the_board_changes_nothing(card, session, source):
    card.upload(source, PATH)
    session.answers["delete"] = {"err": 1}
    with pytest.raises(CardRefused):
        card.delete(PATH)
    assert PATH in card.files
