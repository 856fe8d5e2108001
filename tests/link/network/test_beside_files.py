"""Files and height map of a board on a cable come over its network, once it is known to be it."""

import json
import tempfile
import time
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.link.network import transfers
from octoprint_rrfmodel.link.network.beside_files import BesideFiles, FilesInUse
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.simulator.board import Board

from .test_beside import Face, Rig, at_rest

CONFIG = "0:/sys/config.g"

MAP = "0:/sys/heightmap.csv"

MESH = {"move": {"compensation": {"type": "mesh", "file": MAP, "meshDeviation": {"mean": 0.1}}}}


@pytest.fixture
def face(monkeypatch):
    monkeypatch.setattr(transfers, "STALL_SECONDS", 0.0)
    with Face(Board("cartesian", "3.5.3")) as made:
        yield made


class Found:
    """What is known over the cable, with the board's network beside it."""

    def __init__(self, face, is_there=True):
        self.rig = Rig(face)
        self.files = BesideFiles(
            self.rig.beside, lambda: self.rig.model, tempfile.gettempdir, clock=time.monotonic
        )
        if is_there:
            assert self.rig.look() is True


def sentence(call, *arguments):
    with pytest.raises(RequestRefused) as refused:
        call(*arguments)
    assert str(refused.value).endswith(".")
    return refused.value.status, str(refused.value)


def test_listed_read_and_changed_with_a_copy(face):
    files = Found(face).files
    assert "config.g" in {each["name"] for each in files.entries("0:/sys")}
    before = files.read(CONFIG)
    assert before["text"] == face.board.card.read(CONFIG).decode()
    told = files.write(CONFIG, "; mine\n", before["stamp"])
    assert face.board.card.read(CONFIG) == b"; mine\n"
    assert face.board.card.read(told["backup"]).decode() == before["text"]
    assert len(face.sessions) == 0, "no slot is kept"


def test_nobody_is_asked_before_the_board_is_found(face):
    files = Found(face, is_there=False).files
    for call, arguments in (
        (files.entries, ("0:/sys",)),
        (files.read, (CONFIG,)),
        (files.write, (CONFIG, "G28\n")),
    ):
        status, text = sentence(call, *arguments)
        assert (status, "settings" in text) == (409, True)
    assert files.read_height_map() is None and files.height_map is None
    files.replied(None, 0.0)
    assert face.asked == 0


def test_another_board_is_neither_read_nor_changed(face):
    found = Found(face)
    kept = face.board.card.read(CONFIG)
    face.board.model["boards"][0]["uniqueId"] = "another"
    assert sentence(found.files.entries, "0:/sys")[0] == 504
    assert sentence(found.files.write, CONFIG, "G28\n", None)[0] == 504
    found.rig.model.update(MESH)
    reading = found.files.read_height_map()
    with pytest.raises(RequestRefused, match="another board") as refused:
        reading.result(20)
    assert refused.value.status == 504
    assert face.board.card.read(CONFIG) == kept
    assert len(face.sessions) == 0


def test_a_board_that_has_gone_off_the_network(monkeypatch):
    monkeypatch.setattr(transfers, "STALL_SECONDS", 0.0)
    with Face(Board("cartesian", "3.5.3")) as face:
        found = Found(face)
    assert sentence(found.files.read, CONFIG)[0] == 504
    found.rig.model.update(MESH)
    with pytest.raises(RequestRefused) as refused:
        found.files.read_height_map().result(30)
    assert refused.value.status == 504


def test_the_mesh_in_use_is_read_and_forgotten(face):
    found = Found(face)
    face.board.execute("G29 S1", channel="aux")
    told = face.board.execute('M409 K"move" F"d99vn"', channel="telnet")
    found.rig.model["move"] = json.loads(told.splitlines()[0])["result"]
    assert found.files.height_map is None
    found.files.replied(None, 0.0)
    file, mesh = found.files.read_height_map().result(30)
    at_rest("rrfmodel.beside_files")
    assert file == found.rig.model["move"]["compensation"]["file"]
    assert found.files.height_map == mesh
    found.files.forgotten()
    assert found.files.height_map is None


def test_a_link_over_a_cable_has_what_is_read_beside_it():
    link = SerialLink(None, None, time.monotonic)
    assert link.height_map is None and link.read_height_map() is None
    link.beside = SimpleNamespace(height_map="mesh", read_height_map=lambda: "future")
    assert (link.height_map, link.read_height_map()) == ("mesh", "future")


@pytest.mark.parametrize("kind, wanted", [("network", "over the network"), ("serial", "beside")])
def test_whose_files_are_in_use(kind, wanted):
    def files(name):
        return SimpleNamespace(
            entries=lambda path: name, read=lambda path: name, write=lambda path, text, stamp: name
        )

    networks = (SimpleNamespace(machine_files=files("over the network")),)
    in_use = FilesInUse(SimpleNamespace(kind=kind), networks, files("beside"))
    assert {in_use.entries(""), in_use.read(""), in_use.write("", "")} == {wanted}
