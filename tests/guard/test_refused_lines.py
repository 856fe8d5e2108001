"""A refused line pauses a print once, and again only when it is news."""

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.guard.print_guard import LET_GO_SECONDS
from octoprint_rrfmodel.rrf.gcode.file_place import Place

from .guarded import GuardedPrint

UNHOMED = "refused_move", "G1: insufficient axes homed"


class Rig(GuardedPrint):
    """A print that is paused, as it is behind each line that was refused."""

    def __init__(self, off=()):
        super().__init__(off, is_paused=True)


def test_once():
    rig = Rig()
    assert rig.guard.stops(*UNHOMED, 1.0)
    assert not rig.guard.stops(*UNHOMED, 1.0)
    # of another kind, in another print
    assert rig.guard.stops("refused_heating", "M104: no", 1.0)
    assert rig.guard.stops(*UNHOMED, 2.0)


def test_numbers_in_the_text_make_no_other_kind():
    rig = Rig()
    assert rig.guard.stops("refused_move", "in file macro line 3: G1: no", 1.0)
    assert not rig.guard.stops("refused_move", "in file macro line 14: G1: no", 1.0)


def test_switched_off():
    assert not Rig(off=["refused_move"]).guard.stops(*UNHOMED, 1.0)


@pytest.mark.parametrize("event_is_late", [False, True])
def test_who_resumes_lets_it_go_until_there_is_none_for_a_while(event_is_late):
    rig = Rig()
    assert rig.guard.stops(*UNHOMED, 1.0)
    # a night, paused
    rig.now = 30_000.0
    if event_is_late:
        assert not rig.guard.stops(*UNHOMED, 1.0)
    rig.guard.resumed()
    for _ in range(100):
        rig.now += LET_GO_SECONDS - 1
        assert not rig.guard.stops(*UNHOMED, 1.0)
    rig.now += LET_GO_SECONDS
    assert rig.guard.stops(*UNHOMED, 1.0)


def test_why_is_told_until_it_is_resumed():
    rig = Rig()
    rig.guard.stopped("refused_move", Place("G1 X1"), "insufficient axes homed")
    # OctoPrint's event of the beginning may be later than what its first line has met
    rig.guard.started()
    rig.guard.paused()
    pause = rig.guard.pause()
    assert pause.what_next == "mend"
    assert [cause.code for cause in pause.causes] == ["refused_move"]
    ((code, sentence),) = rig.told
    assert code == "print_paused"
    assert "G1 X1: insufficient axes homed" in sentence
    assert rig.guard.refusal() is None
    rig.guard.resumed()
    assert rig.guard.pause() is None


def test_next_line_that_stops_it_survives_a_late_event():
    rig = Rig()
    rig.guard.stopped("file_pause", Place("M226"))
    rig.guard.paused()
    rig.guard.stopped("file_filament", Place("M600"))
    rig.guard.resumed()
    rig.guard.paused()
    assert [cause.code for cause in rig.guard.pause().causes] == ["file_filament"]


def test_nothing_is_left_of_a_print_that_is_over():
    rig = Rig()
    rig.guard.stopped("file_pause", Place("M226"))
    rig.guard.paused()
    # begun again without an end
    rig.guard.started()
    assert rig.guard.pause() is None
    rig.guard.stopped("file_pause", Place("M226"))
    rig.guard.forgotten()
    assert rig.guard.pause() is None


def test_fault_that_a_refusal_came_of_takes_its_place():
    rig = Rig()
    for is_paused_yet in (False, True):
        rig.guard.stopped("refused_move", Place("G1 X1"), "insufficient axes homed")
        if is_paused_yet:
            rig.guard.paused()
        rig.model["state"] = {"status": "off"}
        rig.guard.look()
        rig.guard.paused()
        assert [code for code, _ in rig.told] == ["print_paused"] * 2
        assert [cause.code for cause in rig.guard.pause().causes] == ["off"]
        assert rig.guard.refusal()
        rig.model.clear()
        # as ever: nobody says that the machine has lost its position
        assert rig.guard.pause().what_next == "resume"
        rig.guard.forgotten()
        rig.told.clear()


def test_passwords_are_not_told():
    rig = Rig()
    rig.guard.stopped("refused_move", Place('M587 S"net" P"secret"'), "no")
    assert "secret" not in rig.told[0][1]
