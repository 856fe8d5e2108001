"""What charts show, over HTTP: kept over the end of a connection, with gaps where it must be."""

import pytest

from tests.support.basedir import READER

from .. import helpers

PATH = "/plugin/rrfmodel/history"
LAYERS = "".join(f";LAYER_CHANGE\nG4 S{seconds}\n" for seconds in (60, 80, 200))
"""A print of three layers: seconds on the board's clock, which is twenty times as fast."""


# what was connected before would be in the history
SERVER = {"own": True}
BOARD = {"machine": "cartesian", "speed": 20}


def history(server, **parameters):
    response = server.get(PATH, params=parameters)
    assert response.status_code == 200, response.text
    return response.json()


def values(told, name):
    return next((each["values"] for each in told["series"] if each["id"] == name), [])


@pytest.mark.both_hosts("the endpoint is there")
def test_samples_of_heaters(server, board):
    board.board.execute("M568 P0 S185 R90 A1", channel="http")
    server.wait_for(lambda: 90.0 in values(history(server), "heater1.target"), 20, "a sample")
    told = history(server)
    assert told["times"] == sorted(told["times"])
    assert told["times"][-1] <= told["now"] < told["times"][-1] + 30
    assert all(len(each["values"]) == len(told["times"]) for each in told["series"])
    gaps = [later - at for at, later in zip(told["times"], told["times"][1:])]
    assert all(gap >= told["interval"] for gap in gaps)
    board.board.execute("M568 P0 A0", channel="http")


def test_only_what_is_new(server):
    before = history(server)
    server.wait_for(lambda: history(server, since=before["now"])["times"], 20, "a new sample")
    told = history(server, since=before["now"])
    assert told["times"][0] > before["times"][-1]
    assert len(told["times"]) < len(history(server)["times"])


@pytest.mark.both_hosts("the endpoint is there", once_for=("since",))
@pytest.mark.parametrize("since", ["", "yesterday", "nan", "1,5"])
def test_malformed(server, since):
    response = server.get(PATH, params={"since": since})
    assert response.status_code == 400
    assert "number" in response.json()["error"]


def test_the_end_of_a_connection_leaves_a_gap_and_nothing_is_lost(server, board):
    before = history(server)
    helpers.connect(server, board)
    server.wait_for(
        lambda: len(values(history(server, since=before["now"]), "heater0.current")) > 2,
        20,
        "samples of the next connection",
    )
    after = history(server)
    at = len(before["times"])
    assert after["times"][:at] == before["times"]
    assert None in values(after, "heater0.current")[at:]
    assert values(after, "heater0.current")[-1] is not None


def test_a_stale_model_leaves_a_gap(server, board):
    before = history(server)
    board.board.inject("stall")
    server.wait_for(
        lambda: None in values(history(server, since=before["now"]), "heater0.current"),
        60,
        "a gap",
    )
    board.board.clear("stall")
    assert server.wait_for(lambda: not helpers.status(server)["stale"], 40, "fresh values")


def test_layers_of_a_job(server, board):
    server.wait_for(lambda: helpers.status(server)["ready"], 60, "the model")
    board.board.card.write("0:/gcodes/layers.gcode", LAYERS)
    board.board.execute('M32 "layers.gcode"', channel="http")
    server.wait_for(lambda: len(history(server)["layers"]) == 3, 60, "the layers")
    told = history(server)
    assert [layer["layer"] for layer in told["layers"]] == [1, 2, 3]
    first, second, last = (layer["seconds"] for layer in told["layers"])
    assert first == pytest.approx(60, abs=3)
    assert second == pytest.approx(80, abs=3)
    # as it was seen last
    assert 60 < last <= 202
    assert told["began"] < told["layers"][0]["at"] < told["layers"][-1]["at"] <= told["now"]
    assert history(server, since=told["now"])["layers"] == []
    with server.client(READER) as reader:
        assert reader.get(PATH).json()["layers"] == told["layers"]
