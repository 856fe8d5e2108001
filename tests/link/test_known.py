"""How old the model is, as a whole and key by key, whatever it comes by."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.known import Known
from octoprint_rrfmodel.link.reports import TEMPERATURES, TemperatureReports
from octoprint_rrfmodel.simulator.board import Board as SimulatedBoard

from ..rrf.board import Board
from ..rrf.slow_line import SlowLine

GUARD_SECONDS = 2.0


class Rig(SlowLine):
    """A follower on a slow line with what notes how fresh it is."""

    def __init__(self, machine="idex"):
        super().__init__(Board(SimulatedBoard(machine).data))
        link = SimpleNamespace(settled_at=0.0, target_command_at=0.0, is_changing=lambda: False)
        self.link = link
        self.known = Known(self.follower, link, lambda: self.now)

    def ask(self):
        asked_at = self.now
        request, text = super().ask()
        self.requests = request, asked_at
        return request, text

    def take(self, text):
        request = self.follower.next_request()
        taken = super().take(text)
        if taken is not None and not taken.is_doubted:
            self.known.note(request, self.now)
        return taken


@pytest.fixture
def rig():
    return Rig().ready()


def whole(rig):
    rig.take(rig.board.reply(rig.follower.next_request()))


def test_one_answer_makes_all_of_one_age(rig):
    whole(rig)
    rig.now += 7
    assert rig.known.age() == 7
    assert set(rig.known.ages()) == set(rig.follower.store.model)
    assert set(rig.known.ages().values()) == {7}


def test_key_that_has_changed_and_is_not_fetched_is_as_old_as_what_is_known(rig):
    whole(rig)
    rig.now += 5
    rig.board.set("network.name", "other")
    whole(rig)
    assert rig.known.ages()["network"] >= 5
    assert rig.known.ages()["volumes"] == 0
    rig.ready()
    whole(rig)
    assert rig.known.ages()["network"] == 0


def test_beside_a_print_the_age_is_that_of_what_the_guard_needs(rig):
    whole(rig)
    rig.spare().serve(60)
    for _ in range(100):
        rig.serve(0.3)
        assert rig.known.age() < GUARD_SECONDS
    ages = rig.known.ages()
    assert set(ages) == set(rig.follower.store.model)
    # what nobody looks at is old, and told to be so
    assert ages["inputs"] > 2 * GUARD_SECONDS
    assert ages["state"] < GUARD_SECONDS
    assert max(ages.values()) < 300


def test_commands_are_refused_by_what_is_newer_than_what_changed_the_machine(rig):
    whole(rig)
    rig.spare().serve(60)
    assert rig.known.is_current()
    rig.link.settled_at = rig.now
    assert not rig.known.is_current()
    rig.serve(4)
    assert rig.known.is_current()


def test_targets_are_known_when_their_parts_are_newer_than_the_command(rig):
    whole(rig)
    rig.spare().serve(60)
    rig.link.target_command_at = rig.now
    assert not rig.known.heat()[1]
    rig.interest.look("heat", seconds=600)
    rig.serve(40)
    assert rig.known.heat()[1]


def test_report_of_all_heaters_counts_as_an_answer(rig):
    whole(rig)
    rig.spare().serve(60)
    warmed = []
    reports = TemperatureReports(rig.follower, rig.known, warmed.append)
    rig.now += 3
    reports.take("ok T:50.5 /60.0 T0:50.5 /60.0 T1:51.5 /0.0 B:40.5 /45.0")
    heaters = rig.follower.store.model["heat"]["heaters"]
    assert [heater["current"] for heater in heaters if heater][0] == 40.5
    assert len(warmed) == 1
    told = len(warmed[0].heaters)
    assert (rig.known.age_of(TEMPERATURES) == 0) is (told == len(heaters))


def test_nothing_is_known_without_a_connection(rig):
    whole(rig)
    rig.follower.forget()
    rig.known.forget()
    assert rig.known.age() is None
    assert rig.known.ages() == {}
