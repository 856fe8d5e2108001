"""What OctoPrint would run for a print, and which of it reaches a board that has its own job."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import FILE_TAG
from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.script_filter import ScriptFilter
from octoprint_rrfmodel.rrf.views.machine import Machine

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
        self.told = []
        self.off = set()
        link = SimpleNamespace(
            connection=self.comm,
            rewritten=0,
            targets={},
            profile=lambda: {"extruder": {"count": 1}},
            # what it makes of a line stands in its own tests
            carried=lambda lines, machine: [line.replace("M14", "M120 M14") for line in lines],
        )
        scripts = ScriptFilter(
            link,
            self.card,
            lambda: Machine(self.model),
            is_on=lambda row: row not in self.off,
            tell=lambda *told: self.told.append(told),
        )
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


def test_print_that_octoprint_cancels_keeps_its_script_however_long_that_takes(own):
    own.comm.state = "cancelling"
    assert own.goes_out("M108", ABORT) == ["M108"]
    assert own.goes_out("M25", CANCEL) != []
    # the board has none any more, and OctoPrint asks on until its own lines are through
    own.status("idle")
    own.comm._consecutive_not_sd_printing = 3
    assert own.runs("afterPrintCancelled") == ["afterPrintCancelled"]
    # the next one may be lost
    own.octoprint_begins()
    own.comm._consecutive_not_sd_printing = 3
    assert own.cancel() == ["M114"]


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


def heater(state, active=0.0, standby=0.0):
    return {"state": state, "active": active, "standby": standby, "current": 100.0}


HOT = {
    "state": {"status": "idle", "currentTool": 0},
    "boards": [{"firmwareVersion": "3.5.3"}],
    "heat": {
        "bedHeaters": [0, 5, -1],
        "chamberHeaters": [-1, 6],
        "heaters": [
            heater("active", 60.0),
            heater("active", 200.0),
            heater("standby", 200.0, 150.0),
            heater("off", 210.0),
            None,
            heater("active", 70.0),
            heater("active", 40.0),
        ],
    },
    "tools": [
        {"number": 0, "heaters": [1]},
        {"number": 1, "heaters": [2]},
        None,
        {"number": 3, "heaters": [3]},
        # with the heater of the first
        {"number": 7, "heaters": [1]},
        {"number": 8, "heaters": []},
    ],
}

SCRIPT = script("afterPrintCancelled")


@pytest.fixture
def hot(bench):
    """The bench with a streamed print that was cancelled on a hot machine of many heaters."""
    bench.streams("cancelling")
    bench.model = HOT
    return bench


def test_cancelled_print_leaves_no_heater_on_that_its_script_does_not_know(hot):
    assert hot.goes_out("M104 T0 S0", SCRIPT) == [
        "M104 T0 S0",
        "M568 P0 A0",
        "M568 P1 A0",
        "M568 P3 A0",
    ]
    # its next line for that kind is but one more
    assert hot.goes_out("M104 T1 S0", SCRIPT) == ["M104 T1 S0"]
    assert hot.goes_out("M140 S0", SCRIPT) == [
        "M140 S0",
        "M120 M140 P0 S{-273.15}",
        "M120 M140 P1 S{-273.15}",
    ]
    assert hot.goes_out("M141 S0", SCRIPT) == ["M141 S0", "M120 M141 P1 S{-273.15}"]
    # of what was on and isn't OctoPrint's to know
    assert hot.told == [("heaters_off", "T1"), ("heaters_off", "B1")]
    # the next print's script again
    hot.comm._currentFile = SimpleNamespace(getStartTime=lambda: 2.0)
    assert len(hot.goes_out("M104 T0 S0", SCRIPT)) == 4


def test_what_a_script_leaves_on_stays_on(hot):
    for line in ("M84", "M106 S0", "M140 S50", "M104 T0 S170", "G10", "M140", "M568 P1 A1"):
        assert hot.goes_out(line, SCRIPT) == [line]
    # nor do other scripts switch off what they don't name
    assert hot.goes_out("M104 T0 S0", script("afterPrintDone")) == ["M104 T0 S0"]
    assert hot.goes_out("M140 S0", {"trigger:printer.commands"}) == ["M140 S0"]


def test_heaters_by_a_setting(hot):
    hot.off.add("heaters_off")
    assert hot.goes_out("M104 T0 S0", SCRIPT) == ["M104 T0 S0"]


def test_heaters_of_a_machine_that_runs_a_job_of_its_own_stay_on(hot):
    hot.model = {**HOT, "state": {"status": "processing"}}
    assert hot.goes_out("M104 T0 S0", SCRIPT) == []
