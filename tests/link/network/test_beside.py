"""The network of a board on a cable stops that board, once it is known to be the same one."""

import threading
import time
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.network import beside as module
from octoprint_rrfmodel.link.network.beside import Beside, NotThere
from octoprint_rrfmodel.link.network.memory import Memory
from octoprint_rrfmodel.rrf.wire.rr import path_of
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from tests.support.waiting import wait_for, within

HERE = "127.0.0.1"


class Face(HttpBoard):
    """A board on the network that counts its connections."""

    asked = 0

    def converse(self, client, address):
        self.asked += 1
        super().converse(client, address)


@pytest.fixture
def face():
    with Face(Board("cartesian", "3.5.3", speed=1)) as made:
        yield made


class Settings:
    def __init__(self, port):
        self.port = port
        self.kept = {}

    def get_int(self, path, min, max):
        assert path == ["network", "beside_port"]
        return self.port

    def get(self, path, merged=False):
        return self.kept.get(tuple(path))

    def set(self, path, value, force=False):
        self.kept[tuple(path)] = value

    def save(self):
        pass


class Rig:
    """What is known over the cable of the board that ``face`` serves, and who looks for it."""

    def __init__(self, face, port=None):
        self.settings = Settings(face.port if port is None else port)
        self.links = SimpleNamespace(kind="serial")
        self.notes = []
        self.model = {
            "boards": [{"uniqueId": face.board.model["boards"][0]["uniqueId"]}],
            "network": {"interfaces": [{"actualIP": "0.0.0.0"}, {"actualIP": HERE}]},
        }
        known = SimpleNamespace(model=lambda: self.model, is_ready=lambda: True)
        self.beside = Beside(
            lambda: self.settings,
            self.links,
            known,
            notify=lambda *note: self.notes.append(note),
            clock=time.monotonic,
        )

    def look(self):
        """A reply comes, and whoever looks is through."""
        self.beside.replied(None, 0.0)
        at_rest("rrfmodel.beside")
        return self.beside.is_found()

    def stop(self):
        self.beside.halted()
        at_rest("rrfmodel.stop")


def at_rest(name):
    def is_over():
        return name not in {each.name for each in threading.enumerate()}

    wait_for(is_over, 30, f"the end of {name}")


def test_stop_passes_a_heat_up(face):
    rig = Rig(face)
    assert rig.beside.is_found() is None
    assert rig.look() is True
    assert len(face.sessions) == 0, "no slot is kept"
    with face.board.lock:
        face.board.receive(b"T0\nM109 S200\n")
        face.board.advance()
    began = time.monotonic()
    rig.stop()
    assert face.board.is_halted
    assert time.monotonic() - began < within(5)
    assert rig.notes == [("refused_operation", "stopped_beside")]
    assert len(face.sessions) == 0


@pytest.mark.parametrize("why", ["off", "network", "no network", "no number", "not ready"])
def test_nobody_is_asked(face, why):
    rig = Rig(face, port=0 if why == "off" else None)
    if why == "network":
        rig.links.kind = "network"
    elif why == "no network":
        rig.model["network"] = {"interfaces": [{"actualIP": "224.0.0.1"}, None, {}]}
    elif why == "no number":
        rig.model["boards"] = [{"uniqueId": None}]
    elif why == "not ready":
        rig.model = {}
    assert rig.look() is None
    rig.stop()
    assert face.asked == 0
    assert not face.board.is_halted


def test_another_board_is_never_stopped(face):
    rig = Rig(face)
    rig.model["boards"] = [{"uniqueId": "another"}]
    assert rig.look() is False
    rig.stop()
    assert not face.board.is_halted
    before = face.asked
    rig.look()
    assert face.asked == before, "it isn't asked again at once"


def test_address_that_is_anothers_by_now(face):
    """It was the same board when it was looked for."""
    rig = Rig(face)
    assert rig.look()
    with face.board.lock:
        face.board.model["boards"][0]["uniqueId"] = "another"
    rig.stop()
    assert not face.board.is_halted
    assert rig.notes == []


def test_password_is_the_one_that_is_kept(face):
    face.board.network_access.password = "secret"
    rig = Rig(face)
    assert rig.look() is False
    again = Rig(face)
    memory = Memory(lambda: again.settings)
    memory.keep_password(module.Address("http", HERE, face.port), "secret")
    assert again.look() is True
    again.stop()
    assert face.board.is_halted


def test_stop_is_tried_again_while_answers_are_lost(face):
    rig = Rig(face)
    assert rig.look()
    face.board.inject("net_reset:3")
    rig.stop()
    assert face.board.is_halted
    assert rig.notes == [("refused_operation", "stopped_beside")]


def test_stop_comes_to_an_end(face, monkeypatch):
    monkeypatch.setattr(module, "STOP_SECONDS", 0.5)
    rig = Rig(face)
    assert rig.look()
    face.board.inject("net_refused")
    rig.stop()
    face.board.clear("net_refused")
    assert not face.board.is_halted
    assert rig.notes == []


def test_whoever_has_connected_again_is_not_stopped(face):
    rig = Rig(face)
    assert rig.look()
    face.board.inject("net_refused")
    rig.beside.halted()
    rig.beside.halted()
    assert [each.name for each in threading.enumerate()].count("rrfmodel.stop") == 1
    rig.beside.forgotten()
    assert rig.beside.is_found() is None
    rig.beside.identified()
    at_rest("rrfmodel.stop")
    face.board.clear("net_refused")
    assert not face.board.is_halted


def test_board_that_was_restarted_is_not_stopped(face, monkeypatch):
    """Its session is gone between the question who it is and the stop."""
    rig = Rig(face)
    assert rig.look()
    value = module._value

    def told(session, path):
        found = value(session, path)
        face.sessions.forget()
        return found

    monkeypatch.setattr(module, "_value", told)
    rig.stop()
    assert not face.board.is_halted


def test_session_for_what_only_reads(face):
    rig = Rig(face)
    with pytest.raises(NotThere), rig.beside.at_board():
        pass
    assert rig.look()
    with rig.beside.at_board() as session:
        assert b'"dir"' in session.ask(path_of("filelist", dir="0:/sys"))
    with face.board.lock:
        face.board.model["boards"][0]["uniqueId"] = "another"
    with pytest.raises(NotThere), rig.beside.at_board():
        pass
    assert len(face.sessions) == 0
