"""Whatever the board or the line does: the connection stays, and the model is right afterwards."""

import os
from dataclasses import dataclass, field
from typing import Any, Callable, Optional

import pytest

from octoprint_rrfmodel.simulator.faults import FAULTS
from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line"),
]


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(serial=helpers.PATIENT)


class Seen:
    """What a test's conditions look at; ``grown`` holds what counters grew by."""

    def __init__(self, server, board):
        self.server, self.board = server, board
        self._before = helpers.status(server)["counters"]

    @property
    def status(self):
        return helpers.status(self.server)

    @property
    def grown(self):
        counters = self.status["counters"]
        return {name: counters[name] - self._before[name] for name in counters}

    def value(self, key):
        return helpers.value(self.server, key)

    def codes(self):
        # OctoPrint's settings are those of a new OctoPrint, which has its own warnings
        found = self.status["warnings"]
        return [
            warning["code"] for warning in found if not warning.get("fix", "").startswith("fix_")
        ]


def replies(count):
    return lambda seen: seen.grown["replies"] >= count


def counted(name, count=1):
    return lambda seen: seen.grown[name] >= count


def warned(code):
    return lambda seen: code in seen.codes()


def has_value(key, wanted):
    return lambda seen: seen.value(key) == wanted


def old(seconds):
    return lambda seen: (seen.status["age"] or 0) > seconds


@dataclass
class Expected:
    """What a fault does to the plugin: ``sign`` is when it has struck, ``counts`` what grows."""

    sign: Callable[[Seen], Any]
    counts: tuple = ()
    argument: str = ""
    firmware: str = "3.5.3"
    before: Optional[Callable[[Any, Any], None]] = None
    seconds: float = 30
    recovery: float = helpers.RECOVERY_SECONDS
    afterwards: dict = field(default_factory=dict)
    """Keys and values once it is over."""


def heat_the_bed(server, board):
    server.commands("M140 S60")
    helpers.wait_value(server, "heat.heaters[0].active", 60, 5)


EXPECTED = {
    "lost_ok": Expected(replies(3), argument=":5"),
    "extra_ok": Expected(replies(5)),
    "glued_before": Expected(replies(5)),
    "glued_after": Expected(replies(5)),
    "err_no_buffers": Expected(counted("out_of_buffers", 2), ("out_of_buffers",)),
    "few_buffers": Expected(old(4)),
    "truncated": Expected(counted("malformed", 2), ("malformed",)),
    "nul_bytes": Expected(counted("malformed", 2), ("malformed",)),
    "bad_utf8": Expected(counted("malformed", 2), ("malformed",), recovery=12),
    "garbage": Expected(replies(4), argument=":20"),
    "huge_line": Expected(replies(3), argument=":6"),
    "nesting_bomb": Expected(counted("malformed"), ("malformed",)),
    "nan": Expected(has_value("boards[0].mcuTemp.current", None)),
    "exponent": Expected(replies(4)),
    "no_reply": Expected(counted("timeouts"), ("timeouts",), argument=":1"),
    # the card's list may take its turns between
    "slow": Expected(replies(2), seconds=60),
    "stall": Expected(old(5)),
    "reset": Expected(lambda seen: seen.status["resets"] > 0),
    "disconnect": Expected(lambda seen: not seen.status["connected"]),
    "heater_fault": Expected(warned("heater_fault_1")),
    "filament_error": Expected(
        has_value("sensors.filamentMonitors[0].status", "tooLittleMovement"),
        afterwards={"sensors.filamentMonitors[0].status": "ok"},
    ),
    "driver_error": Expected(
        has_value("boards[0].drivers[0].status", 2), afterwards={"boards[0].drivers[0].status": 0}
    ),
    "vin_off": Expected(warned("off")),
    "halted": Expected(warned("halted")),
    "message_box": Expected(
        has_value("state.messageBox.mode", 2), afterwards={"state.messageBox": None}
    ),
    "debug_text": Expected(counted("malformed"), ("malformed",)),
    "unsolicited": Expected(replies(4), before=heat_the_bed),
    "error_reply": Expected(replies(6), argument=":2"),
    "sbc": Expected(has_value("network.name", "Changed")),
    "baud": Expected(replies(3)),
    # OctoPrint reads all the time
    "unread": Expected(replies(3)),
    # nothing but a reset helps a board against it; see below
    "usb_box_stuck": None,
}
"""Fault → what is to be seen of it."""


def test_every_fault_has_an_expectation():
    # those of the network are for a board without a line
    assert set(EXPECTED) == {name for name in FAULTS if not name.startswith("net_")}


@pytest.mark.parametrize(
    "name",
    [name for name, expected in sorted(EXPECTED.items()) if expected],
)
def test_fault(server, board_factory, name):
    expected = EXPECTED[name]
    board = board_factory(firmware=expected.firmware)
    helpers.connect(server, board)
    if name == "reset":
        # a reset shows in the up-time, which has to be above its beginning
        server.wait_for(lambda: helpers.value(server, "state.upTime") > 3, 15, "some up-time")
    if expected.before:
        expected.before(server, board)
    with PushListener(server, ADMIN) as push:
        seen = Seen(server, board)
        resets = seen.status["resets"]
        board.board.inject(name + expected.argument)
        if name not in ("halted", "reset"):
            helpers.change(board)
        if name == "reset":
            seen.server.wait_for(
                lambda: seen.status["resets"] > resets, expected.seconds, "the reset"
            )
        else:
            seen.server.wait_for(lambda: expected.sign(seen), expected.seconds, f"{name} to show")
        if name == "disconnect":
            server.wait_disconnected()
            server.wait_for(lambda: os.path.lexists(board.link), 10, "the port to come back")
            helpers.connect(server, board)
        else:
            assert server.state().startswith("Operational")
            board.board.clear(name)
        if name in ("halted", "reset"):
            helpers.change(board)
        helpers.wait_ready(server)
        helpers.wait_equal(server, board, expected.recovery)
        assert seen.value("tools[0].name") == "Changed"
        for key, wanted in expected.afterwards.items():
            helpers.wait_value(server, key, wanted, 5)
        server.wait_for(lambda: not seen.codes(), 10, "the end of all warnings")
        server.wait_for(lambda: seen.status["blocked"] is None, 10, "an unblocked line")
        grown = seen.grown
        wrong = {count for count in helpers.WRONG if grown[count]}
        if name == "disconnect":
            # the end of a connection may cut off a poll
            wrong.discard("timeouts")
        assert wrong == set(expected.counts)
        if name != "disconnect":
            assert server.state().startswith("Operational")
            assert push.events("Disconnected") == push.events("Error") == []
    sent = helpers.commands(board)
    assert [command for command in sent if command.startswith("M112")] == []
    assert helpers.polls_without_status(sent) == []
    assert "Could not handle" not in server.log()
    assert board.error is None
