"""What is kept of what was said on the line, in the words of both OctoPrints' logs."""

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
import pytest

from octoprint_rrfmodel.host.tags import COMMAND_TAG, SCRIPT_TAG, STATUS_TAG
from octoprint_rrfmodel.web.moonraker.gcode_store import MOST_LINES, GcodeStore

POLL = 'M409 K"" F"d99fin"'

FORMS = {"1.11": ("Send: ", "Recv: "), "2.0": (">>> ", "<<< ")}


class Store:
    """A store with its line: ``>`` goes to the printer, ``<`` comes from it."""

    def __init__(self, form):
        self.responded = []
        self.is_rrf = True
        self.store = GcodeStore(self, self.responded.append)
        self.out, self.into = FORMS[form]

    def has_polled(self, command):
        return command == POLL

    def log(self, *lines):
        for line in lines:
            prefix = self.out if line[0] == ">" else self.into
            self.store.on_printer_add_log(prefix + line[1:])

    def kept(self):
        return [(entry["type"], entry["message"]) for entry in self.store.latest(MOST_LINES)]


@pytest.fixture(params=FORMS)
def line(request):
    return Store(request.param)


def test_commands_and_responses(line):
    line.store.sent("M115", {"trigger:printer.commands"})
    line.log(">M115", "<FIRMWARE_NAME: RepRapFirmware", "<ok")
    assert line.kept() == [("command", "M115"), ("response", "FIRMWARE_NAME: RepRapFirmware")]
    assert line.responded == ["FIRMWARE_NAME: RepRapFirmware"]
    assert all(entry["time"] > 0 for entry in line.store.latest(2))


@pytest.mark.parametrize("said", ["<ok", "<", "<wait", "<ok T:20.1 /0.0 B:20.2 /0.0", "<T0:20.1"])
def test_what_nobody_asked_for_is_left_out(line, said):
    line.log(said)
    assert line.kept() == line.responded == []


@pytest.mark.parametrize("number", ["", "N17 "])
def test_polls_are_left_out(line, number):
    checksum = "*71" if number else ""
    line.log(f">{number}{POLL}{checksum}", '<{"key":"","flags":"d99fin","result":{}}', "<", "<ok")
    line.log(f">{number}M105{checksum}", "<ok T:20.1 /0.0 B:20.2 /0.0")
    assert line.kept() == line.responded == []


def test_reply_to_somebody_else_s_m409_is_kept(line):
    line.log('>M409 K"heat"', '<{"key":"heat","flags":"","result":{}}', "<ok")
    assert line.responded == ['{"key":"heat","flags":"","result":{}}']


@pytest.mark.parametrize(
    "tag", ["trigger:comm.poll_temperature", "trigger:comm.poll_sd_status", STATUS_TAG]
)
def test_automatic_commands_are_left_out(line, tag):
    line.store.sent("M105", {tag})
    line.log(">M105", "<ok T:20.1 /0.0")
    assert line.kept() == []


def test_temperatures_that_somebody_asked_for_come_once(line):
    report = "ok T:20.1 /0.0"
    line.store.sent("M105", {"trigger:printer.commands"})
    line.log(">M105", "<" + report, "<" + report)
    assert line.kept() == [("command", "M105"), ("response", report)]


def test_asking_by_itself_ends_the_wait_for_temperatures(line):
    line.store.sent("M105", {"trigger:printer.commands"})
    line.store.sent("M105", {"trigger:comm.poll_temperature"})
    line.log("<ok T:20.1 /0.0")
    assert line.responded == []


def test_lines_of_a_print_are_no_commands(line):
    line.log(">N5 G1 X1 Y2*33", "<ok", ">N6 M106 S1*3", "<ok")
    assert line.kept() == []


@pytest.mark.parametrize("count, kept", [(0, 0), (1, 1), (5, 5), (10, 5)])
def test_latest(line, count, kept):
    for number in range(5):
        line.log(f"<line {number}")
    found = [entry["message"] for entry in line.store.latest(count)]
    assert found == [f"line {number}" for number in range(5)][5 - kept :]


def test_nothing_is_kept_of_another_firmware(line):
    line.is_rrf = False
    line.log("<FIRMWARE_NAME:Marlin")
    assert line.kept() == line.responded == []


def test_the_oldest_go(line):
    for number in range(MOST_LINES + 3):
        line.log(f"<line {number}")
    assert len(line.kept()) == MOST_LINES
    assert line.kept()[0] == ("response", "line 3")


def test_row_35_passwords_are_kept_nowhere(line):
    line.store.sent('M587 S"shed" P"swordfish"', {"source:api"})
    line.log("<Own SSID: shed password: swordfish", "<Error: Bad command: M551 Pswordfish")
    assert line.kept() == [
        ("command", "M587 ***"),
        ("response", "Own SSID: shed password: ***"),
        ("response", "Error: Bad command: M551 ***"),
    ]
    assert line.responded == ["Own SSID: shed password: ***", "Error: Bad command: M551 ***"]


def test_what_a_person_asked_for_is_told_apart_until_its_ok(line):
    line.store.sent("M98", {SCRIPT_TAG})
    line.log(">M98", "<Warning: nothing", "<ok", "<Later")
    line.store.sent("M115", {"source:api"})
    line.log("<FIRMWARE_NAME: x", "<ok")
    line.store.sent("M106", {COMMAND_TAG})
    line.log("<Error: no fan")
    asked = [(entry["message"], entry["asked"]) for entry in line.store.since(0)]
    assert asked == [
        ("M98", True),
        ("Warning: nothing", True),
        ("Later", False),
        ("M115", False),
        ("FIRMWARE_NAME: x", False),
        ("M106", True),
        ("Error: no fan", True),
    ]


def test_lines_have_numbers_by_which_the_newer_ones_are_asked(line):
    for number in range(3):
        line.store.sent(f"M{number}", set())
    first, *later = line.store.since(0)
    assert line.store.since(first["number"]) == later
    assert set(line.store.latest(1)[0]) == {"message", "time", "type"}


def test_what_octoprint_asks_about_the_card_is_no_news(line):
    line.store.sent("M27", {"trigger:comm.poll_sd_status"})
    line.log("<Not SD printing.", "<ok")
    assert line.kept() == []
    line.store.sent("M27", {"source:api"})
    line.log("<Not SD printing.", "<ok")
    assert line.kept() == [("command", "M27"), ("response", "Not SD printing.")]
