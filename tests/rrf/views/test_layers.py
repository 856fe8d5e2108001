"""Layers of the board's own job: how long each took, over pauses, gaps and the next job."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.views.layers import MOST_LAYERS, Layers
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.simulator.board import Board

from ..strategies import ANY_JSON

FINISHED = "Finished printing file 0:/gcodes/a.gcode, print time was 0h 5m"
CANCELLED = "Cancelled printing file 0:/gcodes/a.gcode, print time was 0h 5m"
IDLE = {"state": {"status": "idle"}, "job": {"layer": None, "duration": None}}


def job(layer, time, duration, z=None, fed=None, status="processing", position=10, **file):
    known = {"fileName": "0:/gcodes/a.gcode", "size": 100, **file}
    return {
        "state": {"status": status},
        "job": {
            "file": known,
            "layer": layer,
            "layerTime": time,
            "duration": duration,
            "rawExtrusion": fed,
            "filePosition": position,
        },
        "move": {
            "axes": [{"letter": "X", "userPosition": 9.0}, {"letter": "Z", "userPosition": z}]
        },
    }


def seen(*models):
    """Return the layers after models a second apart; texts are lines, numbers are seconds."""
    layers, now = Layers(), 1000.0
    for model in models:
        if isinstance(model, str):
            layers.heard(model)
        elif isinstance(model, float):
            now += model
        else:
            layers.look(model, now)
            now += 1.0
    return layers


def times(layers):
    return [(layer.layer, round(layer.seconds, 1)) for layer in layers.since()]


def test_a_layer_is_there_when_the_next_has_begun():
    layers = seen(
        job(0, None, 60, fed=0.0),
        job(1, 0.4, 61, z=0.2, fed=1.0),
        29.0,
        job(1, 30.4, 91, z=0.2, fed=100.0),
        job(2, 0.1, 92, z=0.4, fed=104.0),
    )
    (layer,) = layers.since()
    assert (layer.layer, round(layer.seconds, 1), layer.height) == (1, 31.3, 0.2)
    assert layer.filament == pytest.approx(103.0)
    assert (layer.at, layers.began_at) == (1032.0, 1000.0)


def test_pauses_do_not_count():
    layers = seen(
        job(1, 5.0, 50),
        job(1, 6.0, 51, status="paused"),
        500.0,
        job(1, 6.0, 51, status="paused"),
        job(2, 0.5, 58),
    )
    # the longest that the job's own clock, in whole seconds, allows
    assert times(layers) == [(1, 11.5)]


def test_a_layer_whose_beginning_nobody_saw_is_as_long_as_the_firmware_says():
    layers = seen(job(7, 100.0, 900), job(8, 0.0, 901))
    assert times(layers) == [(7, 101.0)]
    assert layers.since()[0].filament is None


def test_without_the_firmwares_own_layer_time():
    layers = seen(job(1, None, 10), 8.0, job(2, None, 20), 29.0, job(2, None, 40), job(3, None, 50))
    assert times(layers) == [(2, 30.0)]


def test_layers_that_end_between_two_polls_share_their_time():
    layers = seen(job(1, 2.0, 10, fed=5.0), 7.0, job(4, 1.0, 18, fed=35.0))
    assert times(layers) == [(1, 3.0), (2, 3.0), (3, 3.0)]


def test_a_number_that_cannot_be():
    layers = seen(job(12, 2.0, 10), job(92, 3.0, 11), job(12, 4.0, 12), job(13, 0.0, 13))
    assert times(layers) == [(12, 5.0)]


@pytest.mark.parametrize(
    "ending, is_there",
    [
        ([job(2, 9.0, 60, position=100)], True),
        ([job(2, 9.0, 60, position=50)], False),
        ([job(2, 9.0, 60, position=50), FINISHED], True),
        ([job(2, 9.0, 60, position=100), CANCELLED], False),
        ([job(2, 9.0, 60, position=100, status="cancelling")], False),
    ],
    ids=["read to the end", "broken off", "told finished", "told cancelled", "cancelling"],
)
def test_the_last_layer(ending, is_there):
    layers = seen(job(1, 5.0, 50), job(2, 0.0, 51), 7.0, *ending, IDLE)
    assert [layer for layer, _ in times(layers)] == ([1, 2] if is_there else [1])
    if is_there:
        assert times(layers)[-1] == (2, 9.0)


def test_they_stay_until_the_next_job_begins():
    first = [job(1, 5.0, 50), job(2, 0.0, 51), IDLE, IDLE]
    assert times(seen(*first)) == [(1, 6.0)]
    again = seen(*first, job(None, None, 0))
    assert (times(again), again.began_at) == ([], 1004.0)


def test_the_next_job_without_a_pause_between():
    first = [job(1, 5.0, 50), job(2, 0.0, 51)]
    assert times(seen(*first, job(1, 2.0, 5), job(2, 0.0, 6))) == [(1, 3.0)]
    assert times(seen(*first, FINISHED, job(1, 2.0, 5), job(2, 0.0, 6))) == [(1, 3.0)]


def test_another_connection_in_the_same_job():
    layers = seen(job(1, 5.0, 50), job(2, 0.0, 51), {}, 8.0, job(2, 10.0, 61), job(3, 0.0, 62))
    assert times(layers) == [(1, 6.0), (2, 11.0)]


def test_a_reset_ends_the_job_and_keeps_its_layers():
    first, second = job(1, 5.0, 50), job(2, 0.0, 51)
    first["state"]["upTime"] = second["state"]["upTime"] = 100
    reset = {"state": {"status": "idle", "upTime": 1}}
    assert times(seen(first, second, {}, reset)) == [(1, 6.0)]


def test_only_what_is_new():
    layers = seen(job(1, 5.0, 50), job(2, 0.0, 51), job(3, 0.0, 52))
    assert [layer.layer for layer in layers.since(1001.0)] == [2]
    assert layers.since(1002.0) == []


def test_what_is_kept_is_bounded():
    layers = seen(*[job(number, 0.0, number) for number in range(1, MOST_LAYERS + 20)])
    assert len(layers.since()) == MOST_LAYERS
    assert layers.since()[-1].layer == MOST_LAYERS + 18


@given(st.lists(st.tuples(ANY_JSON, ANY_JSON, ANY_JSON), max_size=4))
def test_any_model(values):
    layers = Layers()
    for number, (layer, time, duration) in enumerate(values):
        layers.look(job(layer, time, duration, z=time, fed=duration), float(number))
        layers.look({"job": layer, "move": time, "state": duration}, float(number))
    assert all(layer.seconds >= 0 for layer in layers.since())


@pytest.mark.parametrize("firmware", ["3.3", "3.5.3"])
def test_a_whole_job(firmware):
    now = [0.0]
    board = Board("cartesian", firmware, clock=lambda: now[0])
    follower, layers = Follower(), Layers()

    def poll():
        board.receive((follower.next_request().line + "\n").encode())
        now[0] += 0.5
        board.advance()
        for line in board.transmit().decode().splitlines():
            if found := find_reply(line):
                follower.take(found.reply)
            layers.heard(line)
        layers.look(follower.store.model, now[0])

    while not follower.ready:
        poll()
    board.execute('M32 "Two layers.gcode"', channel="http")
    began = {}
    while not (began and not board.job.is_printing):
        if number := board.model["job"]["layer"]:
            began.setdefault(number, board.job.duration)
        last = board.job.duration
        poll()
    poll()
    assert [layer.layer for layer in layers.since()] == sorted(began)
    for layer in layers.since():
        true = began.get(layer.layer + 1, last) - began[layer.layer]
        # a second of the job's own clock, and half of one between two looks
        assert layer.seconds == pytest.approx(true, abs=1.6)
