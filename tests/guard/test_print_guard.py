"""Every fault of the guard's table on every firmware, by whatever way that firmware tells it."""

import threading

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.guard import print_guard
from octoprint_rrfmodel.rrf.follow.follower import Taken
from octoprint_rrfmodel.rrf.views.warnings import GUARDS
from octoprint_rrfmodel.rrf.wire.m408 import M408Model

from ..rrf.simulated import Simulated
from .guarded import GuardedPrint

M408 = "2.05.1"
VERSIONS = ("3.3", "3.4", "3.5.3", "3.6.0", "3.7", M408)


class Printing(GuardedPrint):
    """A print on a machine that tells something."""

    def __init__(self, off=()):
        super().__init__(off)
        self.model = {"state": {"status": "idle"}}

    def take(self, model):
        self.model = model
        self.guard.replied(Taken({}, False), 0.0)
        return self

    def say(self, *lines):
        for line in lines:
            self.guard.line(line)
        return self

    @property
    def causes(self):
        pause = self.guard.pause()
        return [] if pause is None else [cause.name for cause in pause.causes]


def board(firmware):
    made = Simulated("cartesian", firmware)
    made.run("M140 S60", "M104 T0 S200", seconds=1)
    return made


def struck(firmware, fault):
    """Return the print after a fault of the board, with all that the board then tells."""
    simulated = board(firmware)
    printing = Printing().take(simulated.model())
    assert printing.pauses == 0
    simulated.board.transmit()
    simulated.board.inject(fault)
    simulated.run()
    lines = simulated.board.transmit().decode("utf-8", "replace").splitlines()
    return printing.say(*lines).take(simulated.model())


FAULTS = {
    "heater_fault": ("heater_fault:1", "heater_fault_1"),
    "driver_error": ("driver_error:2", "driver_error_0_2"),
    "off": ("vin_off", "off"),
    "halted": ("halted", "halted"),
}


@pytest.mark.parametrize("firmware", [version for version in VERSIONS if version != M408])
@pytest.mark.parametrize("fault", FAULTS)
def test_row_9_fault_pauses_whatever_tells_it(firmware, fault):
    name, cause = FAULTS[fault]
    printing = struck(firmware, name)
    assert printing.pauses == 1
    assert cause in printing.causes


TOLD = {
    "3.3": "Error: Driver 2 error: phase A short-to-ground",
    "3.3, several": "Error: over temperature shutdown on drivers 2",
    "3.4": "Driver 2 error: over temperature shutdown",
    "3.5, an expansion board": "Driver 0.2 error: over temperature shutdown",
}


@pytest.mark.parametrize("text", TOLD.values(), ids=TOLD)
def test_driver_error_in_words_alone_pauses(text):
    printing = Printing().say("- Event notification -", text)
    assert printing.causes == ["driver_error_0_2"]
    # nobody can tell when it is over: a person has to look
    assert printing.guard.pause().what_next == "resume"
    assert printing.guard.refusal() is None
    assert len(printing.told) == 1


def test_driver_error_in_words_while_the_print_starts_pauses_once_it_has_begun():
    """OctoPrint goes on to printing behind its script, whatever was paused before."""
    printing = Printing()
    printing.state = "STARTING"
    printing.say("- Event notification -", TOLD["3.4"])
    assert (printing.pauses, printing.told) == (0, [])
    # OctoPrint's event of the beginning may come later
    printing.guard.started()
    printing.take({"state": {"status": "idle"}})
    assert printing.pauses == 0
    printing.state = "PRINTING"
    printing.take({"state": {"status": "idle"}})
    assert printing.causes == ["driver_error_0_2"]
    assert (printing.pauses, len(printing.told)) == (1, 1)
    printing.guard.resumed()
    printing.is_paused = False
    printing.take({"state": {"status": "idle"}})
    assert printing.pauses == 1


def test_one_thing_after_another_while_the_print_starts_is_known_when_it_has_begun():
    printing = Printing()
    printing.state = "STARTING"
    printing.say(TOLD["3.4"])
    printing.say(TOLD["3.4"].replace("Driver 2", "Driver 3"))
    printing.state = "PRINTING"
    printing.take({"state": {"status": "idle"}})
    assert sorted(printing.causes) == ["driver_error_0_2", "driver_error_0_3"]
    assert printing.pauses == 1


def test_what_was_found_while_a_print_started_ends_with_it():
    printing = Printing()
    printing.state = "STARTING"
    printing.say("- Event notification -", TOLD["3.4"])
    printing.guard.forgotten()
    printing.state = "PRINTING"
    printing.take({"state": {"status": "idle"}})
    assert printing.pauses == 0


@pytest.mark.parametrize("text", TOLD.values(), ids=TOLD)
def test_driver_error_in_a_box_alone_pauses(text):
    box = {"mode": 1, "seq": 3, "title": "Event notification", "message": text}
    printing = Printing().take({"state": {"status": "busy", "messageBox": box}})
    assert printing.causes == ["driver_error_0_2"]


@pytest.mark.parametrize("firmware", VERSIONS)
def test_filament_error_in_words_alone_pauses(firmware):
    text = "Filament error on extruder 0: noFilament"
    assert Printing().say("- Event notification -", text).causes == ["filament_error_0"]
    other = {"state": {"currentTool": 0}, "tools": [{"number": 0, "extruders": [1]}]}
    assert Printing().take(other).say(text).pauses == 0


M408_FAULTS = {
    "heater_fault": ({"temps": {"current": [20, 20], "state": [2, 3]}}, "heater_fault_1"),
    "off": ({"status": "O"}, "off"),
    "halted": ({"status": "H"}, "halted"),
}


@pytest.mark.parametrize("fault", M408_FAULTS)
def test_fault_by_m408_pauses(fault):
    members, cause = M408_FAULTS[fault]
    model = M408Model()
    fine = {"status": "I", "temps": {"current": [20, 20], "state": [2, 2]}}
    printing = Printing().take(model.take(fine))
    assert printing.pauses == 0
    assert printing.take(model.take({**fine, **members})).causes == [cause]


def test_fault_before_3_in_words_pauses():
    text = "Error: Heating fault on heater 1, temperature excursion exceeded 10.0C"
    assert Printing().say(text).causes == ["heater_fault_1"]


@pytest.mark.parametrize("code", ["heater_fault", "driver_error", "filament_error"])
def test_what_is_not_watched_for_pauses_nothing(code):
    printing = Printing(off=(code,))
    printing.say("Heater 1 fault: x") if code == "heater_fault" else None
    printing.say("Driver 1 error: x") if code == "driver_error" else None
    printing.say("Filament error on extruder 0: x") if code == "filament_error" else None
    assert printing.pauses == 0


@pytest.mark.parametrize(
    "text",
    [
        "Error: M569: Driver 10 does not exist",
        "echo: Driver 1 error",
        "Heater 1 is at 20.0",
        "Warning: Driver 0 stall",
        "ok T:20.0 /0.0",
    ],
)
def test_other_words_pause_nothing(text):
    assert Printing().say(text).pauses == 0


def test_reset_pauses():
    printing = Printing()
    printing.guard.reset()
    assert printing.causes == ["reset"]


def test_each_fault_of_the_table_is_here():
    assert {*FAULTS, "filament_error", "reset"} == set(GUARDS)


def test_a_pause_that_hangs_stops_nothing_and_is_asked_for_once(monkeypatch):
    """Hooks of other plugins run in it."""
    monkeypatch.setattr(print_guard, "PAUSING_SECONDS", 0.01)
    may_go_on, pauses = threading.Event(), []

    class Hanging(Printing):
        def pause(self):
            pauses.append(threading.current_thread())
            assert may_go_on.wait(20)
            super().pause()

    printing = Hanging()
    for _ in range(3):
        printing.take({"state": {"status": "off"}})
    (thread,) = pauses
    assert thread is not threading.current_thread()
    # what it is for is told, and nothing else has happened yet
    assert len(printing.told) == 1 and printing.causes == ["off"]
    assert printing.pauses == 0
    may_go_on.set()
    thread.join(20)
    printing.take({"state": {"status": "off"}})
    assert printing.pauses == len(pauses) == 1
