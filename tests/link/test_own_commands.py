"""The plugin's own commands in the queue, where other plugins see them, and on the line."""

import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import COMMAND_TAG, POLL_TAG, POLL_TYPE
from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.sent import SentCommands
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.rrf.wire.gcode_words import apart, extrude_line, jog_line
from octoprint_rrfmodel.rrf.wire.request import (
    FileRequest,
    ListRequest,
    ModelRequest,
    PieceRequest,
    StatusRequest,
)

LIVE = ModelRequest("", "d99fin")
FILE = frozenset(("source:file",))


class Rig:
    """The link with both hooks of what goes out, and what OctoPrint was given to queue."""

    def __init__(self):
        self.notes = []
        self.given = []
        self.told = []
        self.comm = SimpleNamespace(_clear_to_send=threading.Event(), _current_line=7)
        printer = SimpleNamespace(
            commands=lambda lines, tags, force=False: self.given.append((lines, tags))
        )
        self.link = SerialLink(lambda: printer, dict, lambda: 100.0)
        self.link.connection = self.comm
        self.queued = QueuedCommands(
            self.link, self.note, lambda cmd, gcode, tags: None, translators=()
        )
        self.sent = SentCommands(
            self.link,
            self.note,
            lambda: 100.0,
            show_target=self.note,
            sent=lambda cmd, tags: self.told.append(cmd),
        )

    def note(self, *note):
        self.notes.append(note)

    def queue(self, cmd, tags, gcode=None):
        return self.queued.on_queuing(
            self.comm, "queuing", cmd, None, gcode or cmd.split()[0], tags=tags
        )

    def send(self, cmd, cmd_type, tags, comm=None):
        return self.sent.on_sending(
            comm or self.comm, "sending", cmd, cmd_type, cmd.split()[0], tags=tags
        )


@pytest.fixture
def rig():
    return Rig()


@pytest.mark.parametrize(
    "request_, gcode",
    [
        (LIVE, "M409"),
        (StatusRequest(3), "M408"),
        (ListRequest("0:/gcodes", 0), "M20"),
        (FileRequest("0:/gcodes/a; b.gcode"), "M36"),
        (PieceRequest("0:/gcodes/a.gcode", 400), "M36"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_poll_is_a_status_request_until_it_leaves(rig, request_, gcode):
    rig.link.ask(request_)
    assert rig.given == [("M105", {POLL_TAG})]
    queued = rig.queue("M105", {POLL_TAG})
    assert queued == [("M105", POLL_TYPE), ("M105",)]
    assert rig.send("M105", POLL_TYPE, {POLL_TAG}) == request_.line
    # all that looks at what goes out knows it for what it is
    assert rig.link.awaited == gcode
    assert rig.link.awaited_command == request_.line
    assert rig.link.has_polled(request_.line)
    assert rig.link.asks_of_a_file is (gcode == "M36")
    assert rig.notes == [("poll_sent", 100.0, 7)]
    assert rig.send("M105", None, {POLL_TAG}) is None
    assert rig.link.awaited == "M105"
    assert rig.notes[1:] == [("poll_acknowledged",)]
    assert rig.told == []


def test_it_is_known_by_its_type_alone(rig):
    """Another plugin's hook may have made the command anew, without its tags."""
    rig.link.ask(LIVE)
    assert rig.send("M105", POLL_TYPE, None) == LIVE.line
    assert rig.link.has_polled(LIVE.line)


def test_one_that_was_given_up_goes_out_as_what_it_is(rig):
    """Two of its places in the queue, and only the newer question is asked, once."""
    newer = ModelRequest("heat", "d99vno")
    rig.link.ask(LIVE)
    rig.link.ask(newer)
    assert rig.send("M105", POLL_TYPE, {POLL_TAG}) == newer.line
    assert rig.send("M105", POLL_TYPE, {POLL_TAG}) is None
    assert [note[0] for note in rig.notes] == ["poll_sent"]
    assert not rig.link.has_polled("M105")


def test_nothing_reaches_another_printer(rig):
    rig.link.ask(LIVE)
    other = SimpleNamespace(_clear_to_send=threading.Event())
    assert rig.send("M105", POLL_TYPE, {POLL_TAG}, comm=other) is None
    assert rig.notes == []
    # nor the next connection, be it with RepRapFirmware
    rig.link.forget()
    rig.link.connection = rig.comm
    assert rig.send("M105", POLL_TYPE, {POLL_TAG}) is None


@pytest.mark.parametrize("line, disguised", [("M80", "M080"), ("M81", "M081")])
def test_what_others_answer_is_disguised_from_them(rig, line, disguised):
    rig.link.send([line, "M106 P0 S1"], {COMMAND_TAG})
    assert rig.given == [([disguised, "M106 P0 S1"], {COMMAND_TAG})]
    assert rig.queue(disguised, {COMMAND_TAG}) == [(line, None)]
    # a person's stays theirs
    assert rig.queue(line, {"source:api"}) is None


EXTRUSION = extrude_line([5], 300)


@pytest.mark.parametrize(
    "line, lines",
    [
        (EXTRUSION, ("M120 M83", "G91", "G1 E5 F300", "G90", "M121")),
        (extrude_line([1, 2.5], None), ("M120 M83", "G91", "G1 E1:2.5", "G90", "M121")),
        (
            jog_line(["X10", "'a2"], True, 600),
            ("M120 G21", "G91", "G1 X10 'a2 F600", "G90", "M121"),
        ),
        (jog_line(["Z5"], False, None), ("M120 G21", "G90", "G1 Z5", "M121")),
        ("M120 M140 P0 S60 M121", ("M120 M140 P0 S60 M121",)),
        ("M120", ("M120",)),
    ],
)
def test_a_move_is_what_others_know(rig, line, lines):
    assert apart(line) == lines
    assert rig.queue(line, {COMMAND_TAG}, "M120") == [(part, None) for part in lines]


@pytest.mark.parametrize("tags", [{"source:api"}, FILE, None], ids=["typed", "of a file", "none"])
def test_what_isnt_the_plugins_goes_out_as_it_is(rig, tags):
    assert rig.queue(EXTRUSION, tags, "M120") is None
