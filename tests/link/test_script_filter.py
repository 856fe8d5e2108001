"""What OctoPrint would run for a print, and which of it reaches a board that has its own job."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import FILE_TAG
from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.script_filter import ScriptFilter

from .test_sdcard import Bench

JOB = {"source:job"}
START = {"trigger:comm.start_print"}
CANCEL = {"trigger:comm.cancel", "trigger:cancel"}
ABORT = CANCEL | {"trigger:abort_heatup"}
POSITION = CANCEL | {"trigger:record_position"}


def script(name):
    return JOB | {"trigger:comm.send_gcode_script", "source:script", f"script:{name}"}


class Queue(Bench):
    """The card's bench with the hook that everything is queued through."""

    def __init__(self):
        super().__init__()
        link = SimpleNamespace(connection=self.comm, rewritten=0, targets={})
        scripts = ScriptFilter(link, self.card)
        self.hook = QueuedCommands(
            link,
            notify=None,
            instead=lambda cmd, gcode, tags: None,
            translators=(scripts.translate, self.card.translate),
        )

    def goes_out(self, cmd, tags, gcode=""):
        """Return the lines that are queued for a command, without the plugin's M105."""
        gcode = cmd.split()[0] if gcode == "" else gcode
        queued = self.hook.on_queuing(self.comm, "queuing", cmd, None, gcode, tags=tags)
        if queued is None:
            return [cmd]
        lines = [entry[0] if isinstance(entry, tuple) else entry for entry in queued]
        return [line for line in lines if line and line != "M105"]

    def runs(self, *names):
        """Return which of the scripts reach the board."""
        return [name for name in names if self.goes_out("M84", script(name))]

    def octoprint_begins(self, name="a.gco"):
        """Let OctoPrint begin a print; return what reaches the board of the script before."""
        self.shows(name, "starting")
        for command in (f"M23 {name}", "M24"):
            self.comm._job_queue.put((command, None, None, JOB | START))
        lines = self.goes_out("G28", script("beforePrintStarted"))
        while not self.comm._job_queue.empty():
            command, *_, tags = self.comm._job_queue.get()
            self.goes_out(command, tags)
        self.comm.state = "printing"
        return lines

    def streams(self, state="printing"):
        """Let OctoPrint print a file of its own."""
        self.comm._currentFile = SimpleNamespace(getStartTime=lambda: 1.0)
        self.comm.state = state

    def cancel(self):
        """Return what reaches the board when OctoPrint's print is cancelled."""
        self.comm.state = "cancelling"
        return [
            *self.goes_out("M108", ABORT),
            *self.goes_out("M400", POSITION),
            *self.goes_out("M114", POSITION),
            *self.goes_out("M84", script("afterPrintCancelled")),
        ]


WHOLE_CANCEL = ["M108", "M400", "M114", "M84"]


@pytest.fixture
def bench():
    made = Queue()
    made.card.fill()
    made.list("a b.gcode", "other.gcode")
    return made


def alias_of(bench, name):
    return bench.plan.index.alias_of(f"0:/gcodes/{name}")


@pytest.fixture
def own(bench):
    """The bench with a print from the card that OctoPrint has begun."""
    assert bench.octoprint_begins(alias_of(bench, "a b.gcode")) == ["G28"]
    bench.status("processing")
    return bench


def test_octoprints_own_print_has_its_scripts(own):
    names = ["afterPrintPaused", "beforePrintResumed", "afterPrintDone"]
    assert own.runs(*names) == names
    assert own.cancel() == WHOLE_CANCEL


def test_job_begun_at_the_machine_has_none_of_them(bench):
    bench.status("processing")
    bench.shows(alias_of(bench, "a b.gcode"), "printing")
    assert (
        bench.runs(
            "beforePrintStarted",
            "afterPrintPaused",
            "beforePrintResumed",
            "afterPrintDone",
            "afterPrintCancelled",
        )
        == []
    )
    # the board learns that it is cancelled, and no more
    assert bench.cancel() == ["M114"]
    assert bench.goes_out("M25", CANCEL) == ["M25", "M400 M0"]
    # also when it is over, and whatever OctoPrint takes a line for
    bench.status("idle")
    assert bench.goes_out("set global.done = true", script("afterPrintDone"), gcode=None) == []
    assert bench.goes_out("T-1", script("afterPrintDone"), gcode=None) == []
    assert bench.goes_out('M291 P"done"', script("afterPrintDone")) == []


def test_a_script_before_a_print_does_not_go_into_a_job_of_the_machine(bench):
    bench.status("processing")
    assert bench.octoprint_begins() == []
    # news from before its end forbid nothing
    bench.is_current = False
    assert bench.octoprint_begins() == ["G28"]


def test_print_that_ended_at_the_machine_without_a_word(own):
    own.comm._consecutive_not_sd_printing = 3
    assert own.cancel() == ["M114"]
    # the next job's position resets OctoPrint's count
    own.comm._consecutive_not_sd_printing = 0
    own.status("processing")
    assert own.runs("afterPrintCancelled") == []
    # and a new one of OctoPrint's is one
    own.status("idle")
    assert own.octoprint_begins() == ["G28"]
    assert own.cancel() == WHOLE_CANCEL


def test_print_that_ended_at_the_machine_as_the_firmware_says(own):
    own.hear("Cancelled printing file 0:/gcodes/a b.gcode, print time was 0h 0m")
    assert own.cancel() == ["M114"]


def test_another_job_has_begun_meanwhile(own):
    own.model["job"]["file"] = {"fileName": "0:/gcodes/other.gcode", "size": 5}
    assert own.runs("afterPrintDone", "afterPrintCancelled") == []


@pytest.mark.parametrize("status", ["processing", "paused", "cancelling"])
def test_old_news_of_its_own_job_hold_nothing_back(own, status):
    own.status(status)
    own.comm.state = "finishing"
    assert own.runs("afterPrintDone") == ["afterPrintDone"]
    # the same file once more
    own.status("idle")
    assert own.runs("afterPrintDone") == ["afterPrintDone"]
    own.status("processing")
    assert own.runs("afterPrintDone") == []


@pytest.mark.parametrize("status", ["processing", "paused", "pausing", "resuming", "simulating"])
def test_streamed_print_beside_a_job_of_the_machine(bench, status):
    bench.streams()
    bench.status("busy")
    assert bench.cancel() == WHOLE_CANCEL
    bench.streams()
    bench.status(status)
    assert bench.cancel() == ["M114"]
    # what the file holds isn't OctoPrint's to leave out
    assert bench.goes_out("M84", {FILE_TAG}) == ["M84"]


@pytest.mark.parametrize(
    "prepare, is_sent",
    [
        (lambda bench: bench.status("idle"), True),
        (lambda bench: bench.status("processing"), False),
        (lambda bench: (bench.streams("operational"), bench.status("processing")), False),
    ],
)
def test_script_before_a_disconnection(bench, prepare, is_sent):
    prepare(bench)
    assert bench.runs("beforePrinterDisconnected") == ["beforePrinterDisconnected"] * is_sent


def test_script_before_a_disconnection_from_its_own_print(own):
    assert own.runs("beforePrinterDisconnected") == ["beforePrinterDisconnected"]


def test_scripts_that_are_for_no_print_are_left_alone(bench):
    bench.status("processing")
    names = ["beforeToolChange", "afterToolChange", "afterPrinterConnected", "mine"]
    assert bench.runs(*names) == names
