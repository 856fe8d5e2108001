"""How far a print is, as the model tells it; whatever is missing or odd is simply not known."""

import pytest

from octoprint_rrfmodel.rrf.views.printing import Printing, printing

FILE = {
    "fileName": "0:/gcodes/Spare parts/clip (L).gcode",
    "size": 2000,
    "height": 15.2,
    "numLayers": 76,
}
MODEL = {
    "state": {"status": "processing", "currentTool": 1},
    "job": {
        "file": FILE,
        "filePosition": 500,
        "layer": 12,
        "timesLeft": {"file": 900, "filament": 800, "slicer": 700},
    },
    "move": {
        "axes": [
            {"letter": "X", "userPosition": 10.0},
            {"letter": "Z", "userPosition": 2.4},
        ]
    },
    "inputs": [
        {"name": "HTTP", "feedRate": 50.0},
        None,
        {"name": "File", "feedRate": 45.0},
        {"name": "USB", "feedRate": 20.0},
    ],
    "tools": [None, {"number": 1, "fans": [2]}],
    "fans": [{"requestedValue": 0.2}, None, {"requestedValue": 0.69}],
}


def test_print_from_the_card():
    assert printing(MODEL) == Printing(
        is_card_job=True,
        is_paused=False,
        name="Spare parts/clip (L).gcode",
        layer=12,
        layers=76,
        height=2.4,
        total_height=15.2,
        fraction=0.25,
        seconds_left=700.0,
        feed_rate=2700.0,
        fan=0.69,
    )


def test_without_one_only_what_holds_for_any_print():
    known = printing({**MODEL, "state": {"status": "busy", "currentTool": -1}})
    assert known == Printing(
        False, False, "", None, None, 2.4, None, None, None, feed_rate=1200.0, fan=0.2
    )


@pytest.mark.parametrize(
    "status, is_card_job, is_paused",
    [
        ("processing", True, False),
        ("resuming", True, False),
        ("pausing", True, True),
        ("paused", True, True),
        ("cancelling", True, False),
        ("simulating", False, False),
        ("idle", False, False),
        (None, False, False),
    ],
)
def test_state(status, is_card_job, is_paused):
    known = printing({**MODEL, "state": {"status": status}})
    assert (known.is_card_job, known.is_paused) == (is_card_job, is_paused)


def job(**members):
    return {**MODEL, "job": {**MODEL["job"], **members}}


@pytest.mark.parametrize(
    "model, member, value",
    [
        (job(layer=None), "layer", None),
        (job(layer=0), "layer", 0),
        (job(file={**FILE, "numLayers": 0}), "layers", None),
        (job(file={**FILE, "height": 0.0}), "total_height", None),
        (job(file={**FILE, "size": 0}), "fraction", None),
        (job(filePosition=3000), "fraction", 1.0),
        ({**job(file=None), "m408": {"fractionPrinted": 40.0}}, "fraction", 0.4),
        (job(file={**FILE, "fileName": "1:/a.gcode"}), "name", "1:/a.gcode"),
        (job(file=None), "name", ""),
        (job(timesLeft={"file": 900, "filament": None, "slicer": None}), "seconds_left", 900.0),
        (job(timesLeft={"file": 900, "filament": 0, "slicer": None}), "seconds_left", 0.0),
        (job(timesLeft=None), "seconds_left", None),
        ({**MODEL, "move": {"axes": []}}, "height", None),
        ({**MODEL, "inputs": []}, "feed_rate", None),
        ({**MODEL, "fans": []}, "fan", None),
        ({**MODEL, "fans": [None, None, None]}, "fan", None),
        ({**MODEL, "tools": [None, {"number": 1, "fans": [9]}]}, "fan", None),
        ({**MODEL, "tools": [None, {"number": 1, "fans": []}]}, "fan", 0.2),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_is_missing_or_odd(model, member, value):
    assert getattr(printing(model), member) == value


@pytest.mark.parametrize("key", sorted(MODEL))
@pytest.mark.parametrize("value", [None, 7, "x", [], {}, [7], {"axes": 7, "file": 7, "size": "7"}])
def test_nonsense_is_nothing_known(key, value):
    assert isinstance(printing({**MODEL, key: value}), Printing)


def test_empty_model():
    assert printing({}) == Printing(False, False, "", *[None] * 8)
