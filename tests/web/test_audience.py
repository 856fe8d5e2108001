"""Who looks at which part of the model, and for how long."""

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.rrf.follow.interest import LOOKS_SECONDS, Interest
from octoprint_rrfmodel.web.audience import SCRAPE_SECONDS, VIEWS, Audience


class Hall:
    """An audience with a clock to turn."""

    def __init__(self):
        self.now = 100.0
        self.sockets = 0
        self.keys = ()
        self.interest = Interest(lambda: self.now)
        self.audience = Audience(self.interest, lambda: self.sockets, lambda: self.keys)

    def sees(self, path):
        return self.interest.looks_at(path)


@pytest.fixture
def hall():
    return Hall()


def test_nobody_looks_at_first(hall):
    hall.audience.tick()
    assert not hall.sees("state")
    assert not hall.interest.looks_at_all


@pytest.mark.parametrize("view", [*VIEWS, "unknown"])
def test_page_looks_for_a_while(hall, view):
    hall.audience.sees(view)
    assert hall.sees("heat.heaters[].current")
    assert hall.sees("fans") is (view in ("machine", "job", "model"))
    hall.now += LOOKS_SECONDS
    assert not hall.sees("heat.heaters[].current")


def test_model_view_looks_at_all(hall):
    hall.audience.sees("machine")
    assert not hall.interest.looks_at_all
    hall.audience.sees("model")
    assert hall.interest.looks_at_all


@pytest.mark.parametrize(
    "key, part",
    [
        ("heat.heaters[1].current", "heat.heaters[].current"),
        ("heat.heaters[1].current", "heat"),
        ("#tools", "tools[].active"),
        ("move.axes[].userPosition", "move.axes"),
        ("", "boards[].vIn"),
    ],
)
def test_key_that_is_read_is_looked_at(hall, key, part):
    hall.audience.reads(key)
    assert hall.sees(part)


def test_other_parts_are_not(hall):
    hall.audience.reads("heat.heaters[1].current")
    assert not hall.sees("heat.heaters[].active")
    assert not hall.sees("heat.heaters[].currently")


def test_scrape_lasts_until_the_next(hall):
    hall.audience.scrapes()
    hall.now += SCRAPE_SECONDS - 1
    assert hall.sees("boards[].vIn")


def test_history_is_looked_at(hall):
    hall.audience.charts()
    assert hall.sees("heat.heaters[].avgPwm")


def test_subscribers_look_as_long_as_they_are_there(hall):
    hall.keys = ("sensors.analog[2].lastReading",)
    for _ in range(10):
        hall.now += hall.audience.tick()
        assert hall.sees("sensors.analog")
    hall.keys = ()
    hall.audience.tick()
    hall.now += LOOKS_SECONDS
    assert not hall.sees("sensors.analog")


def test_websockets_and_mqtt_look(hall):
    hall.sockets = 1
    hall.audience.tick()
    assert hall.sees("fans")
    other = Hall()
    other.audience.publishes = lambda: True
    other.audience.tick()
    assert other.sees("job")
