"""A print that OctoPrint streams is paused by what would ruin it, and stays so until it is over."""

import re
import time

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener
from tests.support.waiting import within

from .. import helpers, prints

pytestmark = [
    pytest.mark.both_hosts(
        "each streams and pauses with its own code", once_for=("fault", "code", "firmware")
    ),
    pytest.mark.slow,
]

PAUSE_SECONDS = 6
"""Polls are at least two seconds apart while OctoPrint prints."""

# fault of the board, where its cause is over, the warning's code
FAULTS = [
    pytest.param("heater_fault:1", "heater_fault_1", id="heater"),
    pytest.param("filament_error:0", "filament_error_0", id="filament"),
    pytest.param("driver_error:2", "driver_error_0_2", id="driver"),
    pytest.param("vin_off", "off", id="off"),
]


# so that OctoPrint soon finds out that an ok was lost
SHORT_TIMEOUTS = {"timeout": {"communication": 3, "communicationBusy": 3}}


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(serial=SHORT_TIMEOUTS)


@pytest.fixture
def printing(server, board_factory):
    """Function that returns a board on which OctoPrint streams a long print."""

    def start(**options):
        board = board_factory(**{"machine": "cartesian", "firmware": "3.5.3", **options})
        helpers.connect(server, board)
        prints.print_long(server)
        return board

    yield start
    cancel(server)
    helpers.disconnect(server)


def cancel(server):
    if server.state().startswith(("Printing", "Paus", "Resum")):
        server.post("/api/job", json={"command": "cancel"})
    if not server.state().startswith(("Offline", "Error", "Closed")):
        server.wait_state("Operational", 40)


def codes(server):
    return [warning["code"] for warning in helpers.status(server)["warnings"]]


def pause(server):
    """Return the warning that says why the print is paused, ``None`` where there is none."""
    found = helpers.status(server)["warnings"]
    return next((warning for warning in found if warning["code"] == "print_paused"), None)


def resume(server, **request):
    return server.post("/api/job", json={"command": "pause", "action": "resume", **request})


def paused(push):
    return [found for found in push.of_plugin() if found.get("code") == "print_paused"]


@pytest.mark.parametrize("firmware", ["3.3", "3.4"])
def test_row_9_driver_error_in_words_alone_pauses(server, printing, firmware):
    """The model of older firmware shows no drivers: nobody can tell when it is over."""
    board = printing(firmware=firmware)
    board.board.inject("driver_error:2")
    server.wait_state("Paused", PAUSE_SECONDS)
    told = server.wait_for(lambda: pause(server), PAUSE_SECONDS, "the reason")
    assert told["values"]["next"] == "resume"
    assert [cause["code"] for cause in told["causes"]] == ["driver_error_0_2"]
    assert resume(server).status_code == 204
    server.wait_state("Printing")


def test_driver_error_while_the_print_starts_pauses_it_all_the_same(server, board_factory):
    """A pause that comes while OctoPrint's own script runs is undone behind that."""
    board = board_factory(machine="cartesian", firmware="3.4", speed=1)
    helpers.connect(server, board)
    server.set_setting("scripts", {"gcode": {"beforePrintStarted": "G4 S6"}})
    try:
        server.upload("long.gcode", prints.LONG_PRINT)
        server.select_and_print("long.gcode")
        server.wait_state("Starting", 10)
        board.board.message("Driver 2 error: over temperature shutdown\n")
        server.wait_state("Paused", PAUSE_SECONDS + 30)
        told = server.wait_for(lambda: pause(server), PAUSE_SECONDS, "the reason")
        assert [cause["code"] for cause in told["causes"]] == ["driver_error_0_2"]
        sent = [line for line in helpers.commands(board) if line.startswith("G1 ")]
        assert len(sent) < 1000
    finally:
        server.set_setting("scripts", {"gcode": {"beforePrintStarted": ""}})
        board.board.speed = 20
        cancel(server)
        helpers.disconnect(server)


def test_row_10_one_spoilt_reply_pauses_nothing(server, printing):
    """One flipped bit in an up-time, and a heater's state that is read wrong once."""
    board = printing()
    resets = helpers.status(server)["resets"]
    transmit, spoilt = board.board.transmit, []

    def with_a_spoilt_reply(*args, **kwargs):
        data = transmit(*args, **kwargs)
        for old, new in (
            (rb'("upTime":)(\d)', rb"\g<1>9\2"),
            (rb'"state":"off"', b'"state":"fault"'),
        ):
            if new not in spoilt and b'"flags":"d99fin"' in data:
                changed = re.sub(old, new, data, count=1)
                if changed != data:
                    spoilt.append(new)
                    return changed
        return data

    board.board.transmit = with_a_spoilt_reply
    helpers.wait_polls(server, 6)
    assert len(spoilt) == 2
    assert server.state().startswith("Printing")
    assert helpers.status(server)["resets"] == resets
    assert pause(server) is None


@pytest.mark.parametrize("fault, code", FAULTS)
def test_pauses_until_it_is_over(server, printing, fault, code):
    board = printing()
    with PushListener(server, ADMIN) as push:
        board.board.inject(fault)
        server.wait_state("Paused", PAUSE_SECONDS + 15)
        # a line that is refused because of it may have been quicker
        server.wait_for(lambda: code in codes(server), PAUSE_SECONDS, "the warning")
        # notice and event come later than the state that they tell of
        server.wait_for(lambda: paused(push), 5, "the notice")
        push.wait_for_event("PrintPaused")
        server.wait_for(
            lambda: code in [cause["code"] for cause in pause(server)["causes"]], 5, "the cause"
        )
        told_of = paused(push)
        assert len(told_of) == 1 or code == "off"
        told = pause(server)
        assert told["values"]["next"] == "wait"
        assert code in [cause["code"] for cause in told["causes"]]
        assert push.count("PrintPaused", 1) == 1

        # however it is said
        for request in ({}, {"action": "toggle"}, {"command": "restart"}):
            response = resume(server, **request)
            assert response.status_code == 409, response.text
            assert response.json()["error"].endswith(".")
        assert server.post("/api/job", json={"command": "pause"}).status_code == 409
        assert server.state() == "Paused"

        board.board.clear(fault.partition(":")[0])
        server.wait_for(lambda: code not in codes(server), 10, "the end of the fault")
        if code == "off":
            # a board without supply forgets where its axes are
            server.wait_for(lambda: "position_lost" in codes(server), 10, "the lost position")
            told = pause(server)
            assert told["values"]["next"] == "wait"
            response = resume(server)
            assert response.status_code == 409
            assert "G92" in response.json()["error"]
            server.commands("G92 X20 Y20 Z0")
            server.wait_for(lambda: "position_lost" not in codes(server), 10, "the new position")
        # why it was paused is told as long as it is
        told = pause(server)
        assert told["values"]["next"] == "resume"
        assert code in [cause["code"] for cause in told["causes"]]
        assert resume(server).status_code == 204
        server.wait_state("Printing")
        # OctoPrint tells of it later than its state shows it
        server.wait_for(lambda: pause(server) is None, 5, "the end of the pause")
        # time enough to be paused once more
        helpers.wait_polls(server, 2)
        assert server.state() == "Printing"
        assert push.count("PrintPaused", 1) == 1
        assert paused(push) == told_of


@pytest.mark.parametrize("firmware", ["3.3", "3.6", "3.7"])
def test_heater_fault_by_firmware(server, printing, firmware):
    board = printing(firmware=firmware)
    started = time.monotonic()
    board.board.inject("heater_fault:1")
    server.wait_state("Paus", PAUSE_SECONDS)
    # the text on the line is quicker than the next poll
    assert time.monotonic() - started < within(PAUSE_SECONDS)
    server.wait_state("Paused", 15)
    server.wait_for(lambda: "heater_fault_1" in codes(server), PAUSE_SECONDS, "the warning")
    assert not any(command == "M112" for command in helpers.commands(board))


def test_reset_can_only_be_cancelled(server, printing):
    board = printing()
    # a board that has only just begun can't be seen to begin again
    helpers.wait_value(server, "state.upTime", lambda seconds: seconds > 15, 30)
    with PushListener(server, ADMIN) as push:
        board.board.inject("reset")
        # perhaps an ok is lost with the reset, and OctoPrint finds out after its time limit
        server.wait_state("Paus", 12)
        server.wait_for(lambda: "reset" in codes(server), 5, "the warning")
        # a line that is refused because of it may have been quicker
        about = server.wait_for(
            lambda: [told for told in paused(push) if "reset" in told["text"]], 5, "the notice"
        )
        assert len(about) == 1
    server.wait_state("Paused", 60)
    response = resume(server)
    assert response.status_code == 409
    assert "cancel" in response.json()["error"]
    assert pause(server)["values"]["next"] == "cancel"
    cancel(server)
    server.wait_for(lambda: "reset" not in codes(server), 10, "the end of the warning")
    assert pause(server) is None
    # a reset board has lost its position, and refuses the moves of the file
    helpers.wait_ready(server, 30)
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 30)
    server.select_and_print("long.gcode")
    server.wait_state("Printing")


def test_resumed_otherwise_pauses_again(server, printing):
    board = printing()
    board.board.inject("heater_fault:1")
    server.wait_state("Paused", PAUSE_SECONDS + 15)
    with PushListener(server, ADMIN) as push:
        # as a printer's own panel resumes OctoPrint's print
        board.board.message("// action:resume\n")
        push.wait_for_event("PrintResumed")
        push.wait_for_event("PrintPaused", 20)
    server.wait_state("Paused", 20)
    # OctoPrint tells of the pause before the plugin's own thread has seen it
    told = server.wait_for(lambda: pause(server), PAUSE_SECONDS, "the reason")
    assert told["values"]["next"] == "wait"


def test_each_can_be_switched_off(server, printing):
    server.set_setting("plugins.rrfmodel.guard", {"heater_fault": False})
    try:
        board = printing()
        board.board.inject("heater_fault:1")
        server.wait_for(lambda: "heater_fault_1" in codes(server), PAUSE_SECONDS, "the warning")
        helpers.wait_polls(server, 2)
        assert server.state() == "Printing"
    finally:
        server.set_setting("plugins.rrfmodel.guard", {"heater_fault": True})


def test_filament_means_nothing_while_idle(server, board_factory):
    board = board_factory(machine="cartesian")
    helpers.connect(server, board)
    board.board.inject("filament_error:0")
    helpers.wait_value(
        server, "sensors.filamentMonitors[0].status", "tooLittleMovement", helpers.LIVE_SECONDS
    )
    assert "filament_error_0" not in codes(server)
