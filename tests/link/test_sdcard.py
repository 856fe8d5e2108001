"""The glue about the card, on a connection that only remembers."""

import queue
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import SWALLOWED
from octoprint_rrfmodel.link.serial.sdcard import LONG_NAMES, SdCard
from octoprint_rrfmodel.link.serial.sdjob import CANCEL_SECONDS, PREFIX, SdJob
from octoprint_rrfmodel.link.serial.sdupload import UploadRefusal
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.rrf.card.listing import CardPlan
from octoprint_rrfmodel.rrf.wire.reply import FolderEntry, FolderPage

CANCEL = {"trigger:comm.cancel", "trigger:cancel"}
FILE = {"fileName": "0:/gcodes/a b.gcode", "size": 500}


class Connection:
    """OctoPrint's connection, as far as the card is concerned."""

    def __init__(self):
        self._sdEnabled = True
        self._sdFiles = {}
        self._sdFileToSelect = None
        self._serial_encoding = "ascii"
        self._ignore_select = False
        self._currentFile = None
        self._job_queue = queue.Queue()
        self._consecutive_not_sd_printing = 0
        self._consecutive_not_sd_printing_maximum = 2
        self.state = "operational"
        self.is_ready = True
        self.called = []

    def isSdReady(self):
        return self.is_ready

    def isSdFileSelected(self):
        return isinstance(self._currentFile, SelectedFile)

    def isSdPrinting(self):
        return self.isPrinting() and self.isSdFileSelected()

    def isPrinting(self):
        return self.state in ("starting", "printing", "cancelling", "finishing")

    def isPaused(self):
        return self.state == "paused"

    def isBusy(self):
        return self.isPrinting() or self.isPaused()

    def isStarting(self):
        return self.state == "starting"

    def isCancelling(self):
        return self.state == "cancelling"

    def isFinishing(self):
        return self.state == "finishing"

    def isOperational(self):
        return True

    def isPausing(self):
        return False

    isResuming = isPausing

    def refreshSdFiles(self, tags):
        self.called.append("refresh")

    def initSdCard(self, tags):
        self.called.append("init")


class SelectedFile:
    """A file of the card that OctoPrint would print; one that it prints has begun at a time."""

    def __init__(self, name, start=None):
        self.getFilename = lambda: name
        self.getStartTime = lambda: start


class Bench:
    """A card with its job, a connection, and a model and a clock that a test sets."""

    def __init__(self):
        self.comm = Connection()
        self.model = {}
        self.sent = []
        self.now = 0.0
        self.prints = 0
        self.is_current = True
        job = SdJob(lambda: self.model, lambda: self.is_current, self._send, clock=lambda: self.now)
        self.plan = CardPlan()
        self.switched_off = set()
        self.card = SdCard(
            self.plan,
            job,
            SimpleNamespace(connection=self.comm, later=lambda function: function()),
            model=lambda: self.model,
            is_reworded=lambda row: row not in self.switched_off,
        )
        self.card.identified()

    def _send(self, lines, tags):
        self.sent += lines

    def list(self, *names):
        self.plan.refetch()
        request = self.plan.next_request()
        entries = tuple(FolderEntry(name, False, 500, "2024-11-04T20:21:00") for name in names)
        self.plan.take(FolderPage(request.folder, 0, entries, 0, 0))

    def status(self, status):
        self.model = {
            "state": {"status": status},
            "seqs": {"volChanges": [1]},
            "job": {"file": FILE, "filePosition": 123},
        }
        self.card.replied(None, 0.0)

    def job_of_the_machine(self):
        """Return the alias of a listed file that the board begins to print by itself."""
        self.card.fill()
        self.list("a b.gcode")
        self.hear("Begin file list", "End file list")
        (alias,) = self.plan.index.files
        self.status("processing")
        return alias

    def shows(self, name, state):
        """Let OctoPrint show another print of a file of the card."""
        self.prints += 1
        self.comm._currentFile = SelectedFile(PREFIX + name, float(self.prints))
        self.comm.state = state

    def begins(self, name):
        """Let OctoPrint begin one by itself."""
        self.shows(name, "starting")
        self.card.translate("M24", "M24", {"trigger:comm.start_print"})
        self.comm.state = "printing"

    def hear(self, *lines):
        return [self.card.reword(line + "\n") for line in lines]


@pytest.fixture
def bench():
    return Bench()


def test_first_swallowed_line_ends_the_wait_for_capabilities(bench):
    assert bench.card.fill() == LONG_NAMES
    assert bench.card.fill() == SWALLOWED


def test_names_go_out_as_utf8_unless_somebody_wants_another_encoding(bench):
    assert bench.comm._serial_encoding == "utf-8"
    bench.comm._serial_encoding = "latin-1"
    bench.card.identified()
    assert bench.comm._serial_encoding == "latin-1"


def test_plain_list_serves_where_there_is_no_other(bench):
    bench.card.fill()
    lines = ("Begin file list", "Two layers.gcode", "Spare parts", "Ü.g", "End file list")
    heard = bench.hear(*lines)
    assert heard[0].strip() == lines[0]
    assert heard[1:4] == [SWALLOWED] * 3
    assert heard[4].strip() == lines[4]
    assert {file.longname for file in bench.comm._sdFiles.values()} == {"Two layers.gcode", "Ü.g"}
    assert all(name.startswith(PREFIX) and name.isascii() for name in bench.comm._sdFiles)
    assert all(file.size == 0 for file in bench.comm._sdFiles.values())


def test_known_list_stands_for_the_plain_one(bench):
    bench.card.fill()
    bench.list("a b.gcode")
    bench.hear("Begin file list", "other.gcode", "End file list")
    ((name, file),) = bench.comm._sdFiles.items()
    assert (file.name, file.size, file.longname) == (name, 500, "a b.gcode")


def test_row_that_is_switched_off_leaves_the_reply(bench):
    line = "SD card 0 may now be removed"
    assert bench.hear(line) == ["SD card released"]
    bench.switched_off.add("released")
    assert bench.hear(line) == [line + "\n"]


def test_other_lines_come_through_a_list(bench):
    bench.card.fill()
    heard = bench.hear("Begin file list", "T:20.0 /0.0", "NONE", "End file list")
    assert heard[1] == "T:20.0 /0.0\n"
    assert bench.comm._sdFiles == {}
    assert bench.hear("a.gcode") == ["a.gcode\n"]


def test_list_that_has_changed_is_asked_for_once_the_print_is_over(bench):
    bench.comm.state = "printing"
    bench.list("a.gcode")
    bench.card.replied(None, 0.0)
    assert bench.comm.called == []
    bench.comm.state = "operational"
    bench.card.replied(None, 0.0)
    bench.card.replied(None, 0.0)
    assert bench.comm.called == ["refresh"]


def test_card_that_was_not_heard_of_is_asked_for_once(bench):
    bench.comm.is_ready = False
    bench.card.replied(None, 0.0)
    bench.card.replied(None, 0.0)
    assert bench.comm.called == ["init"]


def test_octoprints_refresh_looks_again_where_changes_are_not_counted(bench):
    bench.list("a.gcode")
    assert not bench.plan.behind
    bench.card.translate("M20", "M20", {"trigger:comm.refresh_sd_files"})
    assert bench.plan.behind
    bench.list("a.gcode")
    tags = {"trigger:comm.refresh_sd_files", "trigger:rrfmodel.card"}
    bench.card.translate("M20", "M20", tags)
    assert not bench.plan.behind


@pytest.mark.parametrize(
    ("command", "tag"),
    [
        ("M23 {}", "trigger:comm.select_file"),
        ("M23 /{}", "trigger:comm.start_print"),
        ("M30 /{}", "trigger:comm.delete_sd_file"),
    ],
)
def test_name_becomes_a_path(bench, command, tag):
    bench.list("Bob's b.gcode")
    (alias,) = bench.plan.index.files
    gcode = command[:3]
    lines = bench.card.translate(command.format(alias), gcode, {tag}).lines
    assert lines == (f"{gcode} \"0:/gcodes/Bob''s b.gcode\"",)
    typed = bench.card.translate(command.format(alias), gcode, {"trigger:printer.commands"})
    assert typed is None


def test_other_commands_are_for_others(bench):
    assert bench.card.translate("M105", "M105", {"trigger:comm.poll_temperature"}) is None


def test_cancelling_pauses_and_ends(bench):
    bench.status("processing")
    assert bench.card.translate("M25", "M25", CANCEL).lines == ("M25", "M400 M0")
    assert bench.card.translate("M26 S0", "M26", CANCEL).lines == ()
    assert bench.card.translate("M27", "M27", CANCEL) is None


def test_cancelling_a_paused_job_only_ends_it(bench):
    bench.status("paused")
    assert bench.card.translate("M25", "M25", CANCEL).lines == ("M400 M0",)


def test_end_comes_again_when_a_pause_was_put_off(bench):
    bench.card.fill()
    bench.list("a b.gcode")
    bench.card.translate("M25", "M25", CANCEL)
    bench.status("pausing")
    assert bench.hear("SD printing byte 300/500") == ["Not SD printing."]
    assert bench.sent == []
    bench.status("paused")
    bench.status("paused")
    assert bench.sent == ["M400 M0"]
    bench.status("idle")
    bench.comm.state = "printing"
    assert bench.hear("SD printing byte 300/500") == ["SD printing byte 300/500\n"]


def test_pause_that_never_comes_is_not_waited_for(bench):
    bench.card.translate("M25", "M25", CANCEL)
    bench.now = CANCEL_SECONDS + 1
    bench.status("processing")
    bench.status("paused")
    assert bench.sent == []


def test_old_news_decide_nothing(bench):
    bench.is_current = False
    bench.card.translate("M25", "M25", CANCEL)
    bench.status("paused")
    assert bench.sent == []


@pytest.mark.parametrize(
    ("shown", "status", "said"),
    [
        ("printing", "paused", ["// action:paused"]),
        ("paused", "processing", ["// action:resumed"]),
        ("printing", "processing", []),
        ("paused", "paused", []),
        ("paused", "idle", ["// action:cancel"]),
        ("paused", "busy", ["// action:cancel"]),
        # the supply may come back, and the job with it
        ("paused", "off", []),
        ("printing", "idle", []),
        ("operational", "idle", []),
    ],
)
def test_octoprint_follows_the_machine(bench, shown, status, said):
    bench.card.fill()
    if shown != "operational":
        bench.shows("square.gco", shown)
    bench.status(status)
    heard = [bench.card.fill()]
    assert heard == (said or [SWALLOWED])


def test_paused_print_that_was_ended_at_the_machine_is_ended_once_and_sends_nothing(bench):
    bench.card.fill()
    bench.shows("square.gco", "paused")
    bench.status("idle")
    bench.status("idle")
    assert [bench.card.fill(), bench.card.fill()] == ["// action:cancel", SWALLOWED]
    # M0 without a job would run stop.g
    assert bench.card.translate("M25", "M25", CANCEL).lines == ()
    assert bench.card.translate("M26 S0", "M26", CANCEL).lines == ()
    # and would end one that begins before OctoPrint is through
    bench.status("processing")
    assert bench.card.translate("M25", "M25", CANCEL).lines == ()
    # the next one is ended as ever
    bench.shows("square.gco", "printing")
    assert bench.card.translate("M25", "M25", CANCEL).lines == ("M25", "M400 M0")


@pytest.mark.parametrize(
    ("state", "is_ended", "done"),
    [
        ("printing", False, True),
        ("cancelling", False, True),
        # the board's job is the next one, and OctoPrint would do nothing to it
        ("cancelling", True, False),
        ("finishing", False, False),
    ],
)
@pytest.mark.parametrize(
    ("action", "method"), [("pause", "pause_print"), ("cancel", "cancel_print")]
)
def test_what_octoprint_still_says_of_a_print_that_is_over_takes_nothing_from_the_next(
    bench, state, is_ended, done, action, method
):
    asked = []
    printer = SimpleNamespace(**{method: lambda: asked.append(method)})
    link = SerialLink(lambda: printer, dict, lambda: bench.now)
    link.attach(bench.card)
    link.connection = bench.comm
    bench.card.fill()
    bench.shows("square.gco", "paused" if is_ended else state)
    if is_ended:
        bench.status("idle")
        bench.status("idle")
        assert bench.card.fill() == "// action:cancel"
        bench.comm.state = state
    assert link.control_card_job(action) is done
    assert asked == ([method] if done else [])


DONE = "Done printing file"
FINISHED = "Finished printing file 0:/gcodes/a b.gcode, print time was 0h 2m"
CANCELLED = "Cancelled printing file 0:/gcodes/a b.gcode, print time was 0h 0m"


@pytest.mark.parametrize(
    ("state", "how", "told"),
    [
        ("printing", FINISHED, [DONE]),
        ("printing", CANCELLED, ["// action:cancel"]),
        # OctoPrint has told everybody that it is cancelled
        ("cancelling", FINISHED, []),
        ("cancelling", CANCELLED, []),
        # resumed at the machine, and at its end before OctoPrint has heard of it
        ("paused", FINISHED, ["// action:resumed", DONE]),
        ("paused", CANCELLED, ["// action:cancel"]),
        ("operational", FINISHED, []),
    ],
)
def test_a_print_has_one_end_and_the_right_one(bench, state, how, told):
    bench.card.fill()
    bench.begins("square.gco")
    bench.comm.state = state
    heard = [*bench.hear(DONE, how), bench.card.fill(), bench.card.fill()]
    # to a host that shows no print as going on it is none
    takes = [line for line in heard if line in ("// action:cancel", "// action:resumed", DONE)]
    assert takes == told
    # and the next one none of it
    bench.begins("square.gco")
    bench.now += 60
    bench.status("idle")
    assert bench.card.fill() == SWALLOWED


def test_job_right_behind_a_cancelled_one_is_another(bench):
    """The same file, begun at the machine before any news were without a job."""
    alias = bench.job_of_the_machine()
    bench.begins(alias)
    while bench.card.fill() != SWALLOWED:
        pass
    bench.card.translate("M25", "M25", CANCEL)
    bench.comm.state = "cancelling"
    bench.hear(DONE, CANCELLED)
    bench.comm.state = "operational"
    bench.status("processing")
    assert bench.hear("SD printing byte 300/500") == ["SD printing byte 300/500\n"]
    # and paused there it is nobody's to end
    bench.status("paused")
    assert bench.sent == []


def test_end_that_nobody_says_more_of_is_an_end(bench):
    bench.card.fill()
    bench.begins("square.gco")
    assert bench.hear(DONE) != [DONE]
    bench.status("processing")
    assert bench.card.fill() == SWALLOWED
    bench.now += 3
    bench.status("processing")
    assert bench.card.fill() == DONE


def test_print_of_another_file_is_not_taken_for_octoprints(bench):
    bench.job_of_the_machine()
    bench.begins("square.gco")
    assert [bench.card.fill(), bench.card.fill()][1] == "File selected"
    bench.status("processing")
    # the model may have the name of the file before
    bench.now += 3
    bench.status("processing")
    assert bench.card.fill() == SWALLOWED
    bench.now += 3
    bench.status("processing")
    assert bench.card.fill() == "// action:cancel"
    assert bench.card.translate("M25", "M25", CANCEL).lines == ()


def test_job_of_the_machine_is_selected_once(bench):
    alias = bench.job_of_the_machine()
    bench.status("processing")
    assert bench.card.fill() == f"File opened: {PREFIX}{alias} Size: 500"
    # the second one in place of the blank line behind the board's JSON
    assert bench.hear("") == ["File selected"]
    bench.status("processing")
    assert bench.card.fill() == SWALLOWED


def test_job_of_the_machine_is_not_shown_before_octoprint_has_heard_its_name(bench):
    alias = bench.job_of_the_machine()
    assert bench.card.fill().startswith("File opened")
    # OctoPrint has the file but not yet told anybody so: a position that grows would begin a
    # print under the name of what was selected before
    bench.comm._currentFile = SelectedFile(PREFIX + alias)
    assert bench.hear("SD printing byte 123/500") == ["Not SD printing."]
    assert bench.card.fill() == "File selected"
    assert bench.hear("SD printing byte 123/500") == ["SD printing byte 123/500\n"]


def test_upload_of_another_plugin_fails_at_once():
    failed = []
    refusal = UploadRefusal(SimpleNamespace(is_rrf=True))
    name = refusal.on_upload(
        None, "a.gcode", "/tmp/a.gcode", None, None, lambda *names: failed.append(names)
    )
    assert name == "a.gcode"
    assert failed == [("a.gcode", "a.gcode", 0)]
    assert (
        UploadRefusal(SimpleNamespace(is_rrf=False)).on_upload(None, "a", "a", None, None, None)
        is None
    )


def test_no_file_is_told_before_octoprint_has_it_in_its_list(bench):
    bench.card.fill()
    bench.list("a b.gcode")
    bench.status("processing")
    # 2.0 looks for the file in its list and gives the connection up where it isn't
    assert bench.card.fill() == SWALLOWED
    bench.hear("Begin file list", "a b.gcode", "End file list")
    bench.status("processing")
    (name,) = bench.comm._sdFiles
    assert bench.card.fill() == f"File opened: {name} Size: 500"
    assert bench.card.fill() == "File selected"


def test_file_that_octoprint_does_not_list_is_opened_for_itself(bench):
    bench.card.fill()
    bench.list("a b.gcode")
    bench.card.translate('M23 "0:/gcodes/a b.gcode"', "M23", set())
    assert bench.hear("File opened") == ["// a file that is not in the list was opened"]
