"""PSUControl switches the machine's supply through the plugin and is told its state."""

import re
import time
from pathlib import Path

import pytest

from tests.support import plugins
from tests.support.basedir import READER

from .. import helpers
from ..web.test_websocket import Socket

PSUCONTROL = Path(plugins.__file__).with_name("psucontrol.py")
ENDPOINT = "/api/plugin/psucontrol"

IDLE_SECONDS = 4
"""Longer than two polls are apart."""


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(
        plugin_files=(PSUCONTROL,), plugins_config={"psucontrol": {"plugin": "rrfmodel"}}
    )


@pytest.fixture(scope="module")
def board(server, module_board_factory):
    board = module_board_factory(machine="cartesian")
    helpers.connect(server, board)
    return board


def is_on(server):
    response = server.get(ENDPOINT)
    assert response.status_code == 200, response.text
    return response.json()["isPSUOn"]


def switch(server, word):
    assert server.post(ENDPOINT, json={"command": f"turnPSU{word}"}).status_code == 204


def test_switches_and_knows_the_state(server, board):
    assert is_on(server) is True
    for word, command, state in (("Off", "M81", False), ("On", "M80", True)):
        before = len(board.board.received())
        switch(server, word)
        server.wait_for(lambda state=state: is_on(server) is state, 10, f"the supply to be {word}")
        assert board.board.model["state"]["atxPower"] is state
        sent = [line for line in helpers.commands(board)[before:] if line.startswith("M8")]
        assert sent == [command]


def test_clients_of_moonrakers_switch_both(server, board):
    """What PSUControl senses is known to it only later."""
    devices = {"machine": "M80 and M81", "PSUControl": "the same, by way of PSUControl"}
    with Socket(server) as socket:
        listed = socket.result("machine.device_power.devices")["devices"]
        assert {each["device"] for each in listed} == set(devices)
        for device in devices:
            for word in ("off", "on"):
                socket.notifications.clear()
                asked = {"device": device, "action": word}
                assert socket.result("machine.device_power.post_device", **asked)
                (told,) = socket.wait_for("notify_power_changed")
                assert (told["device"], told["status"]) == ("machine", word)
                state = socket.result("machine.device_power.get_device", device="machine")
                assert state == {"machine": word}
                assert board.board.model["state"]["atxPower"] is (word == "on")
    server.wait_for(lambda: is_on(server), 10, "PSUControl to sense it")
    with Socket(server, READER) as socket:
        asked = {"device": "machine", "action": "off"}
        assert socket.error("machine.device_power.post_device", **asked) == -32000


@pytest.mark.both_hosts("each streams and pauses with its own code")
def test_refusal_is_logged_and_nothing_is_sent(server, board):
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", lambda homed: all(homed), 60)
    server.upload("long.gcode", "".join(f"G1 X{20 + n % 100} F600\n" for n in range(2000)))
    server.select_and_print("long.gcode")
    server.wait_state("Printing")
    before = len(board.board.received())
    try:
        switch(server, "Off")
        for device in ("machine", "PSUControl"):
            asked = {"device": device, "action": "off"}
            path = "/plugin/rrfmodel/machine/device_power/device"
            assert server.post(path, json=asked).status_code == 409
        helpers.wait_polls(server, 2)
        assert "M81" not in helpers.commands(board)[before:]
        assert "ValueError" in server.log()
        assert is_on(server)
    finally:
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 40)


@pytest.fixture
def psucontrol(server):
    """Function that gives PSUControl's settings other values; in the end they are as before."""

    def change(**values):
        for name, value in values.items():
            server.set_setting(f"plugins.psucontrol.{name}", value)

    yield change
    change(pseudo=False, idle=0.0)


def switched(server):
    """Return how often PSUControl has switched until now, and to what."""
    return server.get(ENDPOINT).json()["calls"]


def of_power(board, since):
    return [line for line in helpers.commands(board)[since:] if re.match(r"M0?8[01]\b", line)]


@pytest.mark.both_hosts("each queues with its own code")
def test_row_29_off_when_idle(server, board, psucontrol):
    """Polls are nobody at work, and what somebody does is."""
    psucontrol(idle=IDLE_SECONDS)
    polls = helpers.status(server)["counters"]["replies"]
    calls = len(switched(server))
    began = time.monotonic()
    server.commands("M115")
    server.wait_for(lambda: switched(server)[calls:], IDLE_SECONDS + 10, "the supply to be off")
    assert time.monotonic() - began > IDLE_SECONDS - 1
    # it was polled meanwhile; how often is a matter of how busy this machine is
    assert helpers.status(server)["counters"]["replies"] > polls
    server.wait_for(lambda: not is_on(server), 10, "the plugin to see it")
    assert switched(server)[calls:] == [False]
    assert board.board.model["state"]["atxPower"] is False
    psucontrol(idle=0.0)
    switch(server, "On")
    server.wait_for(lambda: is_on(server), 10, "the supply to be on")


@pytest.mark.both_hosts("each queues with its own code")
@pytest.mark.parametrize("who", ["typed", "the plugin's command", "PSUControl"])
def test_row_30_pseudo_commands_switch_once(server, board, psucontrol, who):
    """PSUControl takes M80 and M81 for its own, asks the plugin, and lets that one's through."""
    psucontrol(pseudo=True)
    ask = {
        "typed": lambda on: server.commands("M80" if on else "M81"),
        "the plugin's command": lambda on: power(server, on),
        "PSUControl": lambda on: switch(server, "On" if on else "Off"),
    }[who]
    calls = len(switched(server))
    for on in (False, True):
        before = len(board.board.received())
        ask(on)
        server.wait_for(lambda on=on: is_on(server) is on, 10, f"the supply to be {on}")
        helpers.wait_polls(server, 2)
        assert of_power(board, before) == ["M80" if on else "M81"]
    # the plugin's own is no wish to PSUControl
    asked = [] if who == "the plugin's command" else [False, True]
    assert switched(server)[calls:] == asked
    assert "RecursionError" not in server.log()
    assert server.state() == "Operational"


def power(server, on):
    response = server.post("/api/plugin/rrfmodel", json={"command": "power", "on": on})
    assert response.status_code == 204, response.text


def test_without_a_machine_it_is_off(server, board):
    helpers.disconnect(server)
    assert is_on(server) is False
