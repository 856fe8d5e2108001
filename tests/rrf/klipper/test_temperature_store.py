"""The kept hour as Moonraker tells it: which object has which lists, and a value each second."""

import pytest

from octoprint_rrfmodel.rrf.klipper import STORE_SECONDS, names, temperature_store
from octoprint_rrfmodel.rrf.views.history import History, Samples

from . import MODELS, model_of, world


def stored(model, *rows, now):
    """Return the store after rows of (time, model), the last of them ``model``'s world."""
    history = History()
    for at, seen in rows:
        history.gap(at) if seen is None else history.sample(seen, at)
    return temperature_store(world(model), history.since(), now)


@pytest.mark.parametrize(("machine", "firmware"), MODELS)
def test_all_that_is_stored_is_an_object_with_its_temperatures(machine, firmware):
    model = model_of(machine, firmware)
    found = stored(model, (100.0, model), now=103.0)
    assert found.keys() <= set(names(world(model)))
    heaters = [name for name in found if not name.startswith("temperature_sensor")]
    assert all("targets" in found[name] for name in heaters)
    assert {len(values) for each in found.values() for values in each.values()} <= {4}


def heater(current, **members):
    return {"current": current, "state": "active", "active": 60.0, "avgPwm": 0.25, **members}


def machine(*heaters, sensors=()):
    return {
        "heat": {"heaters": list(heaters), "bedHeaters": [0]},
        "tools": [{"number": 0, "heaters": [1]}, {"number": 1, "heaters": [1]}],
        "sensors": {"analog": list(sensors)},
        "seqs": {},
    }


def test_one_value_for_each_second():
    first = machine(heater(20.0), heater(30.0, state="off", avgPwm=None))
    then = machine(heater(21.0), heater(31.0, state="off", avgPwm=None))
    found = stored(then, (100.0, first), (102.5, then), now=104.0)
    assert found["heater_bed"] == {
        "temperatures": [20.0, 20.0, 20.0, 21.0, 21.0],
        "targets": [60.0] * 5,
        "powers": [0.25] * 5,
    }
    # one heater of two tools, without a power that is told
    extruder = {"temperatures": [30.0, 30.0, 30.0, 31.0, 31.0], "targets": [0.0] * 5}
    assert found["extruder"] == found["extruder1"] == extruder


def test_what_is_not_known_is_zero():
    model = machine(heater(20.0), heater(30.0))
    found = stored(model, (100.0, model), (102.0, None), (104.0, model), now=104.0)
    assert found["heater_bed"]["temperatures"] == [20.0, 20.0, 0.0, 0.0, 20.0]


def test_sensors_that_no_heater_uses():
    sensors = ({"name": "", "lastReading": 20.0}, {"name": "Case", "lastReading": 25.0})
    model = machine(heater(20.0, sensor=0), heater(30.0), sensors=sensors)
    found = stored(model, (100.0, model), now=100.0)
    assert found["temperature_sensor Case"] == {"temperatures": [25.0]}
    assert "temperature_sensor sensor0" not in found


def test_no_longer_than_an_hour():
    model = machine(heater(20.0), heater(30.0))
    rows = [(float(at), model) for at in range(0, 4000, 2)]
    found = stored(model, *rows, now=4000.0)
    assert len(found["extruder"]["temperatures"]) == STORE_SECONDS


@pytest.mark.parametrize(
    "now, count", [(99.0, 0), (100.0, 1), (100.9, 1)], ids=["clock set back", "now", "just"]
)
def test_at_the_beginning(now, count):
    model = machine(heater(20.0), heater(30.0))
    found = stored(model, (100.0, model), now=now)
    assert found["heater_bed"]["temperatures"] == [20.0] * count


def test_nothing_is_kept():
    assert temperature_store(world(), Samples([], []), 5.0) == {}
    assert temperature_store(world(model_of()), Samples([], []), 5.0) == {}
