"""How often a board is asked what can wait."""

from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.link.network.ration import A_SECOND, AT_ONCE, Ration

WINDOW = 10.0
MOST = 3.0
"""Requests a second of any ten seconds, as the network is asked to bear."""


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def test_some_go_out_at_once_and_the_rest_in_turn():
    clock = Clock()
    ration = Ration(clock)
    for _ in range(AT_ONCE):
        assert ration.wait() == 0
        ration.take()
    assert round(ration.wait(), 6) == round(1 / A_SECOND, 6)
    clock.now += ration.wait()
    assert ration.wait() < 1e-9


def test_what_waits_for_nothing_is_counted_and_leaves_one():
    clock = Clock()
    ration = Ration(clock)
    for _ in range(AT_ONCE - 2):
        ration.take_spare()
    assert ration.wait(spare=1) == 0
    ration.take_spare()
    assert ration.wait() == 0
    assert ration.wait(spare=1) > 0
    for _ in range(20):
        ration.take_spare()
    assert ration.wait() == 0
    ration.take()
    assert ration.wait() > 0
    ration.take_spare()
    assert ration.wait() <= 1 / A_SECOND


@given(st.lists(st.floats(0, 5), max_size=120))
def test_never_more_than_it_is_asked_to_bear(pauses):
    clock = Clock()
    ration = Ration(clock)
    asked = []
    for pause in pauses:
        clock.now += pause
        clock.now += ration.wait()
        ration.take()
        asked.append(clock.now)
    for begin in asked:
        count = sum(begin <= at <= begin + WINDOW for at in asked)
        assert count <= MOST * WINDOW
