"""What becomes of a file's pauses, and of commands whose quote isn't closed."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import FILE_TAG
from octoprint_rrfmodel.link.serial.file_lines import FileLines
from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.unsendable_commands import UnsendableCommands
from octoprint_rrfmodel.rrf.views.machine import Machine

TYPED = {"source:api"}

PAUSED = [("@pause", None)]


class Rig:
    """OctoPrint's queue, and a file that it reads a line of."""

    def __init__(self, path):
        self.path = path
        self.notes = []
        self.off = ()
        self.version = "3.5.3"
        self.comm = SimpleNamespace(
            _currentFile=SimpleNamespace(getFilename=lambda: str(path), getStartTime=lambda: 0.0)
        )
        link = SimpleNamespace(connection=self.comm, rewritten=0, targets={})
        unsendable = UnsendableCommands(
            lambda: Machine({"boards": [{"firmwareVersion": self.version}]}),
            lambda row: row not in self.off,
            self.note,
            stop=lambda *command: None,
            files=FileLines(link),
        )
        self.queued = QueuedCommands(link, self.note, unsendable.instead, translators=())

    def note(self, *note):
        self.notes.append(note)

    def queue(self, cmd, tags):
        gcode = cmd.split()[0] if cmd[0] in "GMT" else None
        return self.queued.on_queuing(self.comm, "queuing", cmd, None, gcode, tags=tags)

    def stream(self, line):
        """Return what is queued for a line of the file, which OctoPrint cuts."""
        self.path.write_text(f"G1 X1\n{line}\nG1 X2\n", encoding="utf-8")
        position = len(f"G1 X1\n{line}\n".encode())
        return self.queue(line.partition(";")[0].strip(), {FILE_TAG, f"filepos:{position}"})


@pytest.fixture
def rig(tmp_path):
    return Rig(tmp_path / "a.gcode")


@pytest.mark.parametrize("command", ["M25", "M226", "M600", "M601"])
def test_pauses_of_a_file_alone(rig, command):
    assert rig.stream(command) == PAUSED
    ((name, code, place),) = rig.notes
    assert (name, place.command) == ("print_stops", command)
    assert code == ("file_filament" if command == "M600" else "file_pause")
    rig.notes.clear()
    assert rig.queue(command, TYPED) != PAUSED
    rig.off = ("file_pause",)
    assert rig.stream(command) != PAUSED
    assert rig.notes == []


@pytest.mark.parametrize("line", ['M118 P1 S"a;b" ; c', 'echo "a;b"', 'M118 S"ä;ö"'])
def test_line_of_a_file_goes_out_whole(rig, line):
    assert rig.stream(line) == [(line.partition(" ; ")[0], None)]
    assert rig.notes == []


def test_what_is_whole_is_looked_at_like_any_other(rig):
    assert rig.stream('M291 P"Wait; then go" S3') == PAUSED
    assert rig.notes == [("print_waits", "Wait; then go")]
    rig.version = "3.4.6"
    assert rig.stream('M291 P"Wait; then go" S3') == [('M291 P"Wait; then go" S3', None)]
    # a command that blocks has a status request in front
    assert rig.stream('M98 P"a;b.g"')[-1] == ('M98 P"a;b.g"', None)


def test_box_that_can_not_be_made_whole_pauses(rig):
    assert rig.stream('M291 P"Wait') == PAUSED
    assert rig.notes == [("print_waits", 'M291 P"Wait')]


@pytest.mark.parametrize(
    "command, sent",
    [
        ('M118 S"a', 'M118 S"a"'),
        ('echo "a', 'echo "a"'),
        # and no checksum in it any more
        ('M117 5" * 3', 'M117 "5"" * 3"'),
        ('M98 P"a', None),
        ('M30 "a', None),
        ('M291 P"a', None),
    ],
)
def test_typed(rig, command, sent):
    queued = rig.queue(command, TYPED)
    assert queued == ((None,) if sent is None else [(sent, None)])
    told = [] if sent else [("refused_operation", "quotes", command)]
    assert rig.notes == told


def test_quotes_switched_off(rig):
    rig.off = ("quotes",)
    assert rig.queue('M118 S"a', TYPED) is None
