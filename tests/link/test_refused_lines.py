"""Whose command a refusal is about."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import FILE_TAG, POLL_TAG
from octoprint_rrfmodel.link.serial.refused_lines import REPEAT_SECONDS, RefusedLines
from octoprint_rrfmodel.link.serial.serial_link import SerialLink

OF_FILE = {FILE_TAG, "filepos:77"}
TYPED = {"source:api"}
UNHOMED = "Error: G1: insufficient axes homed"
COLD = "Warning: Tool 0 was not driven because its heater temperatures were not high enough"


class Rig:
    """A line, and OctoPrint that prints a file."""

    def __init__(self):
        self.now = 0.0
        self.notes = []
        self.pauses = 0
        self.is_paused = False
        self.is_finishing = self.is_starting = False
        file = SimpleNamespace(getFilename=lambda: "/a.gcode", getStartTime=lambda: 5.0)
        self.comm = SimpleNamespace(
            _currentFile=file,
            _long_running_command=False,
            isPrinting=lambda: True,
            isPausing=lambda: False,
            isCancelling=lambda: False,
            isFinishing=lambda: self.is_finishing,
            isStarting=lambda: self.is_starting,
            isPaused=lambda: self.is_paused,
            isSdFileSelected=lambda: False,
            setPause=self.pause,
        )
        self.link = SerialLink(dict, dict, lambda: self.now)
        self.link.connection = self.comm
        self.refused = RefusedLines(
            self.link,
            lambda *note: self.notes.append(note),
            stops=lambda *refused: self.stops(*refused),
            clock=lambda: self.now,
        )
        self.stops = lambda *refused: True

    def pause(self, is_paused):
        self.pauses += 1
        self.is_paused = is_paused

    def send(self, cmd, tags):
        self.link.awaits(cmd, cmd.split()[0], tags)

    def hear(self, line):
        self.refused.look(self.comm, line)
        return [(note[0], note[1], note[2]) for note in self.notes]


@pytest.fixture
def rig():
    return Rig()


def test_line_of_the_file(rig):
    rig.send("G1 X1", OF_FILE)
    ((name, code, place),) = rig.hear(UNHOMED)
    assert (name, code) == ("print_stops", "refused_move")
    assert (place.command, place.path, place.position) == ("G1 X1", "/a.gcode", 77)
    assert rig.notes[0][3] == "G1: insufficient axes homed"
    # what else is under way is refused in vain
    rig.hear(UNHOMED)
    assert (rig.pauses, len(rig.notes)) == (1, 1)


def test_what_the_guard_lets_go(rig):
    rig.stops = lambda code, text, started_at: started_at != 5.0
    rig.send("G1 X1", OF_FILE)
    assert rig.hear(UNHOMED) == []
    assert rig.pauses == 0


def test_typed_line_is_told_and_not_over_and_over(rig):
    rig.send("G1 X1", TYPED)
    told = [("refused_operation", "refused", "G1 X1: G1: insufficient axes homed")]
    assert rig.hear(UNHOMED) == told
    assert rig.hear(UNHOMED) == told
    rig.now += REPEAT_SECONDS
    assert rig.hear(UNHOMED) == told * 2
    assert rig.pauses == 0


def test_any_refusal_of_what_a_person_wants_is_told(rig):
    rig.send('M98 P"nope"', TYPED)
    assert rig.hear("Error: M98: nope") != []


@pytest.mark.parametrize(
    "line", ["Error: Heater 1 fault: x", "Error: G1: Machine is halted", "ok", "Warning: x"]
)
def test_what_others_tell_of(rig, line):
    rig.send("G1 X1", TYPED)
    assert rig.hear(line) == []
    rig.send("G1 X1", OF_FILE)
    assert rig.hear(line) == []


def test_cold_extrusion_is_told_later(rig):
    rig.send("G1 X1 E1", OF_FILE)
    rig.send('M409 K"heat"', {POLL_TAG})
    ((name, code, place),) = rig.hear(COLD)
    assert (name, code, place.command) == ("print_stops", "refused_extrusion", "G1 X1 E1")


def test_cold_extrusion_of_a_person(rig):
    rig.send("G1 X1 E1", OF_FILE)
    rig.send("M120 M83 G1 E5 F300 M121", TYPED)
    rig.send("G1 X2", OF_FILE)
    ((name, code, detail),) = rig.hear(COLD)
    assert (name, code) == ("refused_operation", "refused")
    assert "E5" in detail
    # and one of the file behind it
    rig.send("G1 X2 E1", OF_FILE)
    rig.hear(COLD)
    assert rig.pauses == 1


def test_macro_of_the_file_extrudes(rig):
    rig.send("M120 M83 G1 E5 F300 M121", TYPED)
    rig.send("T1", OF_FILE)
    rig.link.awaits("T1", "T", OF_FILE)
    rig.hear(COLD)
    assert rig.pauses == 1


def test_fault_that_is_nobodys(rig):
    rig.send('M409 K"heat"', {POLL_TAG})
    ((name, code, place),) = rig.hear("Error: VSSA fault, check thermistor wiring")
    assert (name, code, place.command) == ("print_stops", "refused_heating", "")


def test_fault_that_is_nobodys_while_the_print_starts(rig):
    """OctoPrint goes on to printing behind its script: the firmware says it again."""
    rig.is_starting = True
    rig.send('M409 K"heat"', {POLL_TAG})
    assert rig.hear("Error: VSSA fault, check thermistor wiring") == []
    rig.is_starting = False
    assert len(rig.hear("Error: VSSA fault, check thermistor wiring")) == 1


def test_switching_off_what_is_not_there(rig):
    rig.send("M141 S0", OF_FILE)
    assert rig.hear("Error: M141: No chamber heater has been configured for slot 0") == []
    rig.send("M141 S50", OF_FILE)
    assert len(rig.hear("Error: M141: No chamber heater has been configured for slot 0")) == 1


def test_file_is_through(rig):
    rig.is_finishing = True
    rig.send("G1 X1 E1", OF_FILE)
    assert rig.hear(COLD) == []


def test_board_prints_by_itself(rig):
    rig.comm.isSdFileSelected = lambda: True
    rig.send("G1 X1", OF_FILE)
    assert rig.hear(UNHOMED) == []
