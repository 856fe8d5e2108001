"""Samples for charts: what is kept of which model, for how long, and where there is a gap."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.views.history import LONGEST_SECONDS, MOST_ROWS, MOST_SERIES, History
from octoprint_rrfmodel.simulator.firmware import VERSIONS

from ..simulated import Simulated
from ..strategies import ANY_JSON


def heater(current=20.0, state="active", active=60.0, standby=30.0, **members):
    told = {"current": current, "state": state, "active": active, "standby": standby}
    return {**told, **members}


def model(*heaters, sensors=()):
    return {"heat": {"heaters": list(heaters)}, "sensors": {"analog": list(sensors)}}


def told(history, since=float("-inf")):
    """Return the times, and the values by the series' names."""
    samples = history.since(since)
    return samples.times, {series.id: series.values for series in samples.series}


def kept(*models, step=2.0):
    history = History()
    for number, each in enumerate(models):
        history.sample(each, 1000.0 + number * step)
    return history


def test_a_heater_has_its_temperature_target_and_power():
    history = kept(model(heater(59.5, avgPwm=0.25)))
    assert told(history) == (
        [1000.0],
        {"heater0.current": [59.5], "heater0.target": [60.0], "heater0.pwm": [0.25]},
    )
    assert [(s.kind, s.number, s.name, s.what, s.unit) for s in history.since().series] == [
        ("heater", 0, "", "current", "°C"),
        ("heater", 0, "", "target", "°C"),
        ("heater", 0, "", "pwm", ""),
    ]


@pytest.mark.parametrize(
    "state, target",
    [("active", 60.0), ("tuning", 60.0), ("standby", 30.0), ("off", None), ("fault", None)],
)
def test_the_target_is_the_one_that_counts_now(state, target):
    _, values = told(kept(model(heater(state=state))))
    assert values.get("heater0.target", [None]) == [target]


@pytest.mark.parametrize("reading", [2000.0, -273.15, None, "hot", True, float("nan")])
def test_a_broken_sensor_has_no_temperature(reading):
    times, values = told(kept(model(heater(20.0)), model(heater(reading))))
    assert (times, values["heater0.current"]) == ([1000.0, 1002.0], [20.0, None])


def test_sensors_that_no_heater_uses():
    sensors = [
        {"lastReading": 60.0, "name": "", "type": "thermistor"},
        None,
        {"lastReading": 41.5, "name": "MCU", "type": "mcutemp"},
        {"lastReading": 38.0, "name": "Box", "type": "dhthumidity"},
    ]
    series = kept(model(heater(sensor=0), sensors=sensors)).since().series
    assert [(s.id, s.name, s.unit, s.values) for s in series if s.kind == "sensor"] == [
        ("sensor2.current", "MCU", "°C", [41.5]),
        ("sensor3.current", "Box", "%", [38.0]),
    ]


def test_at_most_one_row_in_two_seconds():
    history = kept(*[model(heater(float(number))) for number in range(9)], step=0.5)
    assert told(history)[1]["heater0.current"] == [0.0, 4.0, 8.0]


def test_what_comes_later_is_padded():
    times, values = told(kept(model(heater()), model(heater(), heater(25.0, state="off"))))
    assert len(times) == 2
    assert values["heater1.current"] == [None, 25.0]
    assert "heater1.target" not in values


def test_a_model_that_is_not_known_leaves_one_gap_and_nothing_is_lost():
    history = kept(model(heater(20.0)))
    for now in (1003.0, 1004.0, 1005.0):
        history.gap(now)
    history.sample({}, 1007.0)
    history.sample(model(heater(21.0)), 1007.5)
    assert told(history)[0] == [1000.0, 1003.0, 1007.5]
    assert told(history)[1]["heater0.current"] == [20.0, None, 21.0]


def test_what_only_another_machine_had_goes_with_it():
    sensors = [{"lastReading": 41.5, "name": "mcu", "type": "mcutemp"}]
    history = kept(model(heater(20.0), heater(21.0), heater(22.0), sensors=sensors))
    history.gap(1001.0)
    history.connected()
    # nothing is known of the next one yet
    history.sample({}, 1003.0)
    assert "heater2.current" in told(history)[1]
    other = [{"lastReading": 38.0, "name": "Box", "type": "thermistor"}]
    history.sample(model(heater(30.0, sensor=0), sensors=other), 1005.0)
    assert {series.id.partition(".")[0] for series in history.since().series} == {"heater0"}


def test_only_what_is_new():
    history = kept(*[model(heater(float(number))) for number in range(4)])
    assert told(history, 1002.0)[0] == [1004.0, 1006.0]
    assert told(history, 1002.0)[1]["heater0.current"] == [2.0, 3.0]
    assert told(history, 1006.0) == ([], {"heater0.current": [], "heater0.target": []})


def test_an_hour_is_kept():
    history = History()
    for number in range(2500):
        history.sample(model(heater(number / 10)), number * 2.0)
    times, values = told(history)
    assert len(times) == MOST_ROWS
    assert times[-1] - times[0] <= LONGEST_SECONDS
    assert (values["heater0.current"][-1], len(values["heater0.current"])) == (249.9, MOST_ROWS)


def test_a_series_goes_when_it_had_no_value_for_an_hour():
    history = kept(model(heater(), heater()))
    for number in range(1, 1803):
        history.sample(model(heater()), 1000.0 + number * 2)
        if number == 1700:
            assert "heater1.current" in told(history)[1]
    assert "heater1.current" not in told(history)[1]
    assert len(told(history)[1]["heater0.current"]) == len(told(history)[0])


def test_a_clock_that_is_set_back():
    history = kept(*[model(heater(float(number))) for number in range(4)])
    history.sample(model(heater(9.0)), 1003.5)
    history.gap(1003.5)
    assert told(history)[0] == [1000.0, 1002.0, 1003.5]
    assert told(history)[1]["heater0.current"] == [0.0, 1.0, None]


def test_no_more_series_than_there_is_room_for():
    history = kept(model(*[heater(avgPwm=0.5)] * 200))
    assert len(history.since().series) == MOST_SERIES


@given(st.lists(ANY_JSON, max_size=4))
def test_any_model(values):
    history = History()
    for number, value in enumerate(values):
        found = {"heat": value, "sensors": value}
        history.sample(found, number * 2.0)
        history.sample({"heat": {"heaters": value}, "sensors": {"analog": value}}, number * 2.0)
    samples = history.since()
    assert all(len(series.values) == len(samples.times) for series in samples.series)


@pytest.mark.parametrize("firmware", VERSIONS)
def test_a_whole_machine(firmware):
    board = Simulated("cartesian", firmware).run("T0", "M104 S200", seconds=10)
    _, values = told(kept(board.model()))
    assert values["heater1.target"] == [200.0]
    assert values["heater1.current"][0] > 20


def test_a_report_tells_temperatures_of_its_heaters_and_nothing_else():
    model = {
        "heat": {
            "heaters": [
                {"current": 20.0, "state": "active", "active": 60, "avgPwm": 0.5},
                {"current": 21.0, "state": "off"},
            ]
        }
    }
    history = History()
    history.sample(model, 100.0)
    history.sample(model, 103.0, frozenset((0,)))
    told = {series.id: series.values for series in history.since().series}
    assert told == {
        "heater0.current": [20.0, 20.0],
        "heater1.current": [21.0, None],
        "heater0.target": [60.0, 60.0],
        "heater0.pwm": [0.5, None],
    }
