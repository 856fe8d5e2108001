"""Which of ``inputs`` is the host's own line, whatever its number and name are."""

import pytest

from octoprint_rrfmodel.rrf.views.channels import channel_called, own_channel

from ..simulated import Simulated


def channel(name, line=0):
    return {"name": name, "lineNumber": line}


USB, USB2, AUX = channel("USB", 5), channel("USB2", 70), channel("Aux", 4073)
NET, FILE = channel("HTTP"), channel("File", 900)

# inputs, thisInput, whose element it is
OWN = {
    "told": ([NET, USB, USB2], 2, "USB2"),
    "told, moved": ([USB2, NET, USB], 2, "USB"),
    "told, a serial port": ([NET, USB, AUX], 2, "Aux"),
    "told, by a name that nobody knew": ([NET, USB, channel("CDC1")], 2, "CDC1"),
    "told, and it is none": ([NET, USB, FILE], 2, "USB"),
    "told, and it is the network's": ([NET, USB], 0, "USB"),
    "told, and there is none": ([NET, USB, None], 2, "USB"),
    "told, beyond the last": ([NET, USB], 7, "USB"),
    "told, and its name is odd": ([USB, {"name": []}], 1, "USB"),
    "told, and no number": ([NET, USB], True, "USB"),
    "not told": ([NET, None, AUX, USB], None, "USB"),
    "not told: the one that shows our lines": ([NET, USB, AUX, USB2], None, "USB2"),
    "not told, and the board has no USB": ([NET, AUX, channel("Aux2")], None, "Aux"),
    "no line at all": ([NET, FILE, None], None, None),
    "nothing": ([], 0, None),
    "odd": ([5, {"name": 3}, {"name": "USB", "lineNumber": "x"}, "USB"], None, "USB"),
}


@pytest.mark.parametrize("case", OWN)
def test_row_27_own_channel_is_found(case):
    inputs, number, name = OWN[case]
    found = own_channel({"inputs": inputs, "state": {"thisInput": number}})
    assert found.get("name") == name


@pytest.mark.parametrize("model", [{}, {"inputs": None}, {"inputs": {}, "state": 5}])
def test_without_channels_there_is_none(model):
    assert own_channel(model) == channel_called(model, "File") == {}


@pytest.mark.parametrize(
    ("firmware", "port"),
    [("3.3", "USB"), ("3.4", "USB"), ("3.6.4", "USB"), ("3.7", "USB"), ("3.7", "USB2")],
)
def test_row_27_own_channel_of_a_board(firmware, port):
    simulated = Simulated("cartesian", firmware)
    simulated.board.plug_into(port)
    assert own_channel(simulated.model())["name"] == port
