"""How a print ends, and what is kept of it: sequences of replies and lines."""

import threading

import pytest

from octoprint_rrfmodel.rrf.klipper import HostJob, Kept, World

from . import HOST, Machine, changed, get, host, host_job, whole
from .test_job import OVER, PATH, PRINTING

FINISHED = f"Finished printing file {PATH}, print time was 0h 5m"
CANCELLED = f"Cancelled printing file {PATH}, print time was 0h 5m"
SIMULATED = f"File {PATH} will print in 0h 5m plus heating time"
OTHER = "Cancelled printing file 0:/gcodes/other.gcode, print time was 0h 5m"
ERROR = "Error: Heater 1 fault: temperature excursion exceeded 15.0C"

TOLD = (FINISHED, CANCELLED, SIMULATED, OTHER, ERROR, "ok", "Resume state saved")


class Session:
    """A model that changes, lines that are heard, and what comes of it."""

    def __init__(self, host=HOST):
        self.kept = Kept()
        self.model = OVER
        self.host = host
        self.now = 0.0

    def step(self, what):
        """Take a status, a line, a model, a job of the host, or nothing of either."""
        if isinstance(what, (HostJob, type(None))):
            self.host = self.host._replace(job=what)
        elif what in TOLD:
            return self.kept.heard(what)
        elif isinstance(what, dict):
            self.model = what
        elif what == "forget":
            return self.kept.forget()
        else:
            is_job = what in ("processing", "simulating", "pausing", "paused", "resuming")
            is_job |= what == "cancelling"
            self.model = changed(PRINTING if is_job else OVER, **{"state.status": what})
        self.now += 2.0
        self.kept.observe(self.model, self.host, self.now)
        return None

    def take(self, *steps):
        for step in steps:
            self.step(step)
        return self

    def get(self, name, field):
        return get(World(self.model, self.host, self.kept.snapshot, self.now), name, field)


def at(**changes):
    """Return the model of a print with members changed."""
    return changed(PRINTING, **changes)


ALMOST = at(job__filePosition=995)
BEHIND = {
    status: at(state__status=status) for status in ("busy", "changingTool", "off", "processing")
}
RESET = changed(OVER, **{"state.upTime": 3, "job.lastFileName": None, "job.lastDuration": 0})
RESET_AND_PRINTING = at(state__upTime=3, job__duration=1)
FAR = changed(OVER, **{"state.upTime": 10_000})

SEQUENCES = [
    # the text says it
    pytest.param(["processing", FINISHED, "idle"], "complete", id="finished, then idle"),
    pytest.param(["processing", "idle", FINISHED], "complete", id="idle, then finished"),
    pytest.param(["processing", CANCELLED, "idle"], "standby", id="cancelled, then idle"),
    pytest.param(["processing", "idle", CANCELLED], "standby", id="idle, then cancelled"),
    pytest.param([ALMOST, CANCELLED, "idle"], "standby", id="cancelled at the end"),
    pytest.param(["paused", FINISHED, "busy", "idle"], "complete", id="text before the status"),
    pytest.param(["processing", SIMULATED, "idle"], "complete", id="simulated"),
    pytest.param(["processing", OTHER, "idle"], "error", id="text about another"),
    pytest.param([ALMOST, OTHER, "idle"], "complete", id="text about another, at the end"),
    # the status says it
    pytest.param(["processing", "cancelling", "idle"], "standby", id="cancelling"),
    pytest.param([ALMOST, "cancelling", "busy", "idle"], "standby", id="cancelling, busy"),
    pytest.param(["processing", "cancelling"], "printing", id="cancelling isn't over"),
    pytest.param(["paused", "busy"], "standby", id="paused, busy"),
    pytest.param(["paused", "busy", "idle"], "standby", id="paused, busy, idle"),
    pytest.param(["pausing", "paused", CANCELLED, "busy", "idle"], "standby", id="as 3.4.5 did"),
    pytest.param(["paused", "idle"], "standby", id="paused, idle"),
    pytest.param(["pausing", "idle"], "standby", id="pausing, idle"),
    pytest.param(["paused", BEHIND["busy"]], "standby", id="paused, busy before the rest"),
    pytest.param(["paused", "resuming", "processing", "idle"], "error", id="resumed, then gone"),
    pytest.param(["paused", "resuming", ALMOST, "idle"], "complete", id="resumed, then over"),
    # nothing says it
    pytest.param([ALMOST, "idle"], "complete", id="at the end"),
    pytest.param([ALMOST, "busy", "idle"], "complete", id="at the end, busy"),
    pytest.param(["processing", "idle"], "error", id="in the middle"),
    pytest.param(["processing", "busy"], "error", id="in the middle, busy"),
    # the firmware ends it
    pytest.param([ALMOST, "halted"], "error", id="halted"),
    pytest.param(["paused", "halted"], "error", id="halted while paused"),
    pytest.param(["processing", "starting"], "error", id="starts"),
    pytest.param([ALMOST, "forget", RESET], "error", id="reset"),
    pytest.param(["paused", "forget", RESET], "error", id="reset while paused"),
    pytest.param([ALMOST, "forget", RESET, RESET], "error", id="stays so after the reset"),
    pytest.param([ALMOST, FINISHED, "forget", RESET], "error", id="reset after the text"),
    pytest.param([ALMOST, "forget", RESET_AND_PRINTING], "printing", id="reset and printing"),
    pytest.param(["processing", "forget", FAR], "error", id="forgotten"),
    pytest.param([ALMOST, "idle", "forget", FAR], "standby", id="forgotten after the end"),
    pytest.param([ALMOST, "idle", "forget", RESET], "standby", id="reset after the end"),
    pytest.param(["processing", "forget", "processing"], "printing", id="found again"),
    # it goes on
    pytest.param(
        [at(state__upTime=9000), at(state__upTime=501)], "printing", id="an up-time was spoilt"
    ),
    pytest.param(["processing", BEHIND["busy"]], "printing", id="busy within"),
    pytest.param(["processing", BEHIND["changingTool"]], "printing", id="tool change within"),
    pytest.param(["processing", BEHIND["off"], "processing"], "printing", id="no power within"),
    pytest.param(["paused", at(state__status="off")], "paused", id="no power while paused"),
    pytest.param(["processing", {}], "printing", id="nothing known for a moment"),
    pytest.param(["paused", "resuming"], "printing", id="resuming"),
    pytest.param(["pausing"], "paused", id="pausing"),
    # one after the other
    pytest.param([ALMOST, "idle", "processing"], "printing", id="the next one"),
    pytest.param([ALMOST, FINISHED, "idle", "processing", "idle"], "error", id="word is not kept"),
    pytest.param(
        [ALMOST, FINISHED, at(job__duration=5), "idle"], "error", id="again, not idle between"
    ),
    pytest.param(["idle", FINISHED], "complete", id="began and ended between two replies"),
    pytest.param(["idle", OTHER], "standby", id="began and was cancelled between two replies"),
    pytest.param([ALMOST, "idle", OTHER], "standby", id="another between two replies"),
    pytest.param(["idle"], "standby", id="none"),
    pytest.param(["halted"], "standby", id="halted without one"),
    pytest.param(["busy"], "standby", id="busy without one"),
]


@pytest.mark.parametrize(("steps", "state"), SEQUENCES)
def test_state_of_a_print(steps, state):
    session = Session().take(*steps)
    assert session.get("print_stats", "state") == state
    # the same reply again says nothing new
    session.step(session.model)
    assert session.get("print_stats", "state") == state


@pytest.mark.parametrize("steps", [["paused", "busy", "idle"], ["processing", CANCELLED, "idle"]])
def test_cancelled_print_keeps_its_name(steps):
    session = Session().take(*steps)
    assert session.get("print_stats", "filename") == "sub/part.gcode"
    assert session.get("virtual_sdcard", "progress") == 0.25


MESSAGES = [
    pytest.param(["processing", ERROR, "idle"], ERROR, id="in the print"),
    pytest.param(["processing", ERROR, "ok", "idle"], ERROR, id="not the last line"),
    pytest.param([ERROR, "processing", "idle"], "", id="before the print"),
    pytest.param(["processing", "idle", ERROR], "", id="after the print"),
    pytest.param(["processing", ERROR], "", id="not over"),
    pytest.param([ALMOST, ERROR, "idle"], "", id="complete all the same"),
    pytest.param(["processing", ERROR, CANCELLED, "idle"], "", id="cancelled"),
    pytest.param(["processing", ERROR, "forget", FAR], ERROR, id="forgotten"),
    pytest.param([host_job(), ERROR, host_job(state="error")], ERROR, id="host's print"),
]


@pytest.mark.parametrize(("steps", "message"), MESSAGES)
def test_message_is_the_last_error_of_a_print_that_ended_with_one(steps, message):
    assert Session().take(*steps).get("print_stats", "message") == message


def test_reset_leaves_name_and_progress_of_the_print_that_it_ended():
    session = Session().take("processing", "forget", RESET)
    assert session.get("print_stats", "filename") == "sub/part.gcode"
    assert session.get("print_stats", "print_duration") == 60
    assert session.get("virtual_sdcard", "progress") == 0.25


HOST_SEQUENCES = [
    pytest.param([host_job()], "printing", id="printing"),
    pytest.param([host_job(), host_job(state="paused")], "paused", id="paused"),
    pytest.param([host_job(), host_job(state="complete")], "complete", id="complete"),
    pytest.param([host_job(), host_job(state="cancelled")], "standby", id="cancelled"),
    pytest.param([host_job(), host_job(state="error")], "error", id="error"),
    pytest.param([host_job(), host_job(state="complete"), None], "complete", id="kept"),
    pytest.param([host_job(position=999), None], "complete", id="gone at the end"),
    pytest.param([host_job(position=500), None], "error", id="gone in the middle"),
    pytest.param(
        [host_job(), host_job(state="error"), host_job(state="cancelled")],
        "standby",
        id="second word",
    ),
    pytest.param([host_job(), host_job(state="cancelled"), host_job()], "printing", id="again"),
    pytest.param([host_job(), "processing"], "printing", id="the card's goes before"),
    pytest.param(
        [host_job(state="complete"), ALMOST, CANCELLED, "idle"],
        "standby",
        id="the card's was later",
    ),
    pytest.param(
        [ALMOST, "idle", host_job(), host_job(state="cancelled")],
        "standby",
        id="the host's was later",
    ),
    pytest.param([host_job(), CANCELLED], "printing", id="a text about the card's"),
    pytest.param([host_job(), "halted"], "printing", id="the host knows when it is over"),
    pytest.param([host_job(), "forget", host_job()], "printing", id="goes on after a reset"),
]


@pytest.mark.parametrize(("steps", "state"), HOST_SEQUENCES)
def test_state_of_a_hosts_print(steps, state):
    session = Session().take(*steps)
    assert session.get("print_stats", "state") == state
    session.step(session.model)
    assert session.get("print_stats", "state") == state


def test_hosts_print_counts_its_pauses():
    session = Session().take(
        host_job(print_time=10.0),
        host_job(print_time=12.0),
        host_job(print_time=12.0, state="paused"),
        host_job(print_time=12.0, state="paused"),
        host_job(print_time=12.0),
        host_job(print_time=14.0),
    )
    # paused when it was seen so, until it was seen otherwise
    assert session.get("print_stats", "print_duration") == 14.0
    assert session.get("print_stats", "total_duration") == 18.0


def test_pause_of_a_host_goes_on_between_replies():
    session = Session().take(host_job(print_time=10.0), host_job(print_time=10.0, state="paused"))
    session.now += 3.5
    assert session.get("print_stats", "total_duration") == 13.5


def fed(*raw, **members):
    drives = [{"rawPosition": position, "position": position and position * 2} for position in raw]
    return changed(OVER, move={"extruders": drives}, **members)


# each: positions of the extruders at each reply; what was used
FILAMENT = [
    pytest.param([(5.0,), (5.0,), (15.0,), (25.0,)], 20.0, id="one"),
    pytest.param([(5.0,), (15.0,), (15.0,)], 10.0, id="began before it was seen"),
    pytest.param([(0.0,), (10.0,), (9.0,), (10.0,), (12.0,)], 12.0, id="retracted"),
    pytest.param([(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)], 15.0, id="two"),
    pytest.param([(0.0,), (10.0,), (10.0, 3.0), (10.0, 5.0)], 12.0, id="one more"),
    pytest.param([(), (), ()], 0.0, id="none known"),
    pytest.param([(None,), (None,), (4.0,), (6.0,)], 2.0, id="known later"),
]


@pytest.mark.parametrize(("positions", "used"), FILAMENT)
def test_filament_of_a_hosts_print_is_what_the_extruders_were_fed(positions, used):
    session = Session()
    first, *others = positions
    session.take(fed(*first), host_job())
    for position in others:
        session.take(fed(*position))
    assert session.get("print_stats", "filament_used") == used
    session.take(host_job(state="complete"), fed(1000.0))
    assert session.get("print_stats", "filament_used") == used


def test_filament_is_counted_anew_for_each_print():
    session = Session().take(fed(0.0), host_job(), fed(10.0), host_job(state="complete"))
    session.take(fed(50.0), host_job(), fed(52.0))
    assert session.get("print_stats", "filament_used") == 2.0


def test_filament_goes_on_after_a_reset_of_the_board():
    session = Session().take(fed(0.0), host_job(), fed(10.0))
    session.take("forget", fed(0.0), fed(4.0))
    assert session.get("print_stats", "filament_used") == 14.0


def test_filament_without_raw_positions():
    model = changed(OVER, move={"extruders": [{"position": 5.0}]})
    session = Session().take(model, host_job())
    session.take(changed(OVER, move={"extruders": [{"position": 8.0}]}))
    assert session.get("print_stats", "filament_used") == 3.0


def test_m408_tells_no_raw_positions_while_a_host_prints():
    session = Session()
    for position in (5.0, 5.0, 8.0):
        drives = [{"rawPosition": 1.0, "position": position}]
        session.take(changed(OVER, move={"extruders": drives}, m408={"volumes": 2}), host_job())
    assert session.get("print_stats", "filament_used") == 3.0


def test_complete_print_was_read_to_the_end():
    session = Session().take(host_job(position=900), host_job(position=0, state="complete"))
    assert session.get("virtual_sdcard", "progress") == 1.0
    session = Session().take(host_job(position=900), host_job(position=0, state="cancelled"))
    assert session.get("virtual_sdcard", "progress") == 0.9


def test_same_file_printed_again_by_the_host():
    session = Session().take(host_job(print_time=100.0, position=900), host_job(print_time=1.0))
    assert session.get("print_stats", "print_duration") == 1.0
    assert session.get("virtual_sdcard", "progress") == 0.0


FIRMWARE = ["3.3", "3.4", "3.5.1", "3.5.3", "3.6", "3.7"]


def states_of(machine, until):
    """Return the states that a print goes through until the condition holds."""
    machine.wait(2)
    states = [machine.get("print_stats", "state")]

    def look(machine):
        state = machine.get("print_stats", "state")
        if state != states[-1]:
            states.append(state)
        return until(machine)

    machine.until(look)
    return states


def is_idle(machine):
    return machine.status == "idle" and machine.get("print_stats", "state") != "printing"


@pytest.mark.parametrize("firmware", ["2.05", *FIRMWARE])
def test_simulated_print_from_its_start_to_its_end(firmware):
    machine = Machine("cartesian", firmware)
    machine.send('M32 "Two layers.gcode"')
    assert states_of(machine, is_idle) == ["printing", "complete"]
    assert machine.get("print_stats", "filename") == "Two layers.gcode"
    assert machine.get("print_stats", "print_duration") > 60
    assert machine.get("virtual_sdcard", "progress") > 0.5
    if firmware != "2.05":
        assert machine.get("print_stats", "filament_used") == pytest.approx(10.64, abs=2)


@pytest.mark.parametrize("firmware", ["2.05", *FIRMWARE])
def test_simulated_print_that_is_cancelled(firmware):
    machine = Machine("cartesian", firmware)
    machine.send('M32 "square.gcode"')
    machine.wait(150)
    assert machine.get("print_stats", "state") == "printing"
    machine.send("M25")
    machine.until(lambda machine: machine.get("print_stats", "state") == "paused")
    machine.until(lambda machine: machine.status == "paused")
    assert machine.get("virtual_sdcard", "is_active") is False
    assert machine.get("pause_resume", "is_paused") is True
    machine.send("M0")
    assert states_of(machine, is_idle)[-1] == "standby"
    assert machine.get("print_stats", "filename") == "square.gcode"


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_simulated_print_that_is_reset(firmware):
    machine = Machine("cartesian", firmware)
    machine.send('M32 "square.gcode"')
    machine.wait(150)
    machine.send("M999")
    machine.wait(20)
    machine.until(is_idle)
    assert machine.get("print_stats", "state") == "error"
    assert machine.get("print_stats", "filename") == "square.gcode"


def test_simulated_print_that_is_halted():
    machine = Machine("cartesian")
    machine.send('M32 "square.gcode"')
    machine.wait(150)
    machine.send("M112")
    machine.until(lambda machine: machine.status == "halted")
    assert machine.get("print_stats", "state") == "error"
    assert machine.get("webhooks", "state") == "shutdown"


def test_simulation_of_a_print():
    machine = Machine("cartesian")
    machine.send('M37 P"square.gcode"')
    assert states_of(machine, is_idle) == ["printing", "complete"]


def test_objects_of_a_simulated_print():
    machine = Machine("cartesian")
    machine.send('M32 "square.gcode"')
    machine.wait(150)
    assert machine.get("exclude_object", "current_object") == "square"
    machine.send("M486 P0")
    machine.wait(3)
    assert machine.get("exclude_object", "excluded_objects") == ["square"]
    assert machine.get("exclude_object", "objects")[0]["center"] == [100.0, 100.0]
    assert machine.get("print_stats", "info")["total_layer"] is not None


@pytest.mark.parametrize("firmware", ["2.05", "3.3", "3.6", "3.7"])
def test_simulated_print_that_a_host_streams(firmware):
    machine = Machine("cartesian", firmware)
    machine.send("T0", "M302 P1", "M83", "G28")
    machine.until(lambda machine: machine.status == "idle")
    machine.host = host({"name": "streamed.gcode"})
    machine.wait(1)
    machine.send("G1 X100 Y100 Z5 F6000", "G1 X110 E5 F3000", "G1 E-1 F1800", "G1 E1", "G1 Y110 E5")
    machine.wait(20)
    assert machine.get("print_stats", "filament_used") == pytest.approx(10.0, abs=0.1)
    assert whole(machine.world, "print_stats")["filename"] == "streamed.gcode"
    assert machine.get("toolhead", "homed_axes") == "xyz"


def test_kept_may_be_used_by_several_threads():
    kept = Kept()
    kept.observe(PRINTING, HOST, 0.0)
    done = threading.Event()
    seen = set()

    def read():
        while not done.is_set():
            seen.add(get(World(OVER, HOST, kept.snapshot, 1.0), "print_stats", "state"))

    def talk():
        for _ in range(300):
            kept.heard(CANCELLED)

    threads = [threading.Thread(target=read), threading.Thread(target=talk)]
    for thread in threads:
        thread.start()
    for number in range(300):
        kept.observe(PRINTING if number % 2 else OVER, HOST, float(number))
    threads[1].join()
    done.set()
    threads[0].join()
    assert seen <= {"printing", "standby", "error"}
    assert kept.snapshot.at == 299.0
