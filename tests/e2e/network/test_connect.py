"""Connecting to a board on the network, and its model."""

from .. import helpers

BOARD = {"machine": "cartesian", "speed": 10}


def test_model_is_the_boards(server, face):
    state = helpers.status(server)
    assert (state["link"], state["protocol"], state["blocked"]) == ("network", "rr", None)
    assert state["firmware"]["name"].startswith("RepRapFirmware")
    assert helpers.value(server, "network.name") == face.board.model["network"]["name"]
    assert [warning["code"] for warning in state["warnings"]] == []
