"""A print goes through to its end, line by line, while the model is kept fresh."""

import re

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each streams and pauses with its own code"),
    pytest.mark.slow,
]

LINES = 2500
PRINT_SECONDS = 150

# so that OctoPrint soon finds out that an ok was lost
SHORT_TIMEOUTS = {
    "timeout": {
        "communication": 2,
        "communicationBusy": 2,
        "temperature": 1,
        "temperatureTargetSet": 1,
    }
}

SILENCE = {"rrfmodel": {"silence_minutes": 0.2}}
"""An ok that is lost behind a macro isn't looked for before OctoPrint's patience is asked."""

PLUGIN_LINE = re.compile(r"M409|M105$")


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(serial=SHORT_TIMEOUTS, plugins_config=SILENCE)


def distinct_moves(count, first=0):
    """Return so many lines, each another one, of about ten milliseconds each."""
    return [
        f"G1 X{20 + number % 2:d}.{number % 100:02d} Y{20 + number // 100:d} F6000"
        for number in range(first, first + count)
    ]


def answers_in_order(server):
    """Return the plugin's requests and the replies to them since OctoPrint connected last."""
    found = []
    # what an earlier board was asked last may never have been answered
    connection = server.serial_log().rpartition('to "Connecting"')[2]
    for line in connection.splitlines():
        if match := re.search(r" - (?:Send: |>>> )(?:N\d+ )?(M409[^*]*)", line):
            found.append(("asked", match[1]))
        elif match := re.search(r' - (?:Recv: |<<< )(\{"key":"[^"]*","flags":"[^"]*")', line):
            found.append(("answered", match[1]))
    return found


def assert_one_request_at_a_time(server):
    """Every request of this connection was answered before the next one left."""
    order = answers_in_order(server)
    assert len(order) > 40
    for (kind, what), (following, next_what) in zip(order, order[1:]):
        assert kind != following, f"two in a row: {what}, {next_what}"


def print_through(server, board, lines, name):
    """Print the lines and return what the plugin's counters grew by."""
    server.upload(name, "\n".join(lines) + "\n")
    before = helpers.status(server)["counters"]
    with PushListener(server, ADMIN) as push:
        server.select_and_print(name)
        seen = set()

        def is_done():
            seen.add(helpers.status(server)["blocked"])
            seen.discard(None)
            return push.events("PrintDone") or push.events("PrintFailed")

        server.wait_for(is_done, PRINT_SECONDS, "the end of the print")
        assert push.events("PrintFailed") == []
        assert push.events("Error") == []
    server.wait_state("Operational")
    job = server.job()
    assert job["progress"]["completion"] == 100
    counters = helpers.status(server)["counters"]
    return {key: counters[key] - before[key] for key in counters}


@pytest.mark.parametrize(
    "fault",
    [
        pytest.param(None, id="clean"),
        pytest.param("extra_ok", id="extra_ok"),
        # one of so many replies: a stall of two seconds each
        pytest.param("lost_ok:601", id="lost_ok"),
    ],
)
def test_print(server, board_factory, fault):
    board = board_factory(speed=2)
    helpers.connect(server, board)
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 20)
    if fault:
        board.board.inject(fault)
    start = len(board.board.received())
    lines = distinct_moves(LINES)
    assert len(set(lines)) == LINES
    grown = print_through(server, board, lines, f"{fault or 'clean'}.gcode".replace(":", "-"))

    def moves():
        return [command for command in helpers.commands(board)[start:] if command[:3] == "G1 "]

    # with an ok too many OctoPrint is ahead of the board by what the line's buffers hold
    server.wait_for(lambda: len(moves()) >= LINES, 30, "the last line to arrive")
    assert moves() == lines
    sent = helpers.commands(board)[start:]
    assert helpers.polls_without_status(sent) == []
    # how many there are is a matter of how long the print takes; with an ok too many OctoPrint
    # fills the line's buffers, and answers come the later
    assert grown["polls"] >= 1
    assert grown["replies"] >= 1
    assert grown["malformed"] == 0
    if fault != "extra_ok":
        # an answer that waits behind all that the line's buffers hold may be given up
        assert_one_request_at_a_time(server)
        assert grown["timeouts"] == 0
    # nothing went out among the lines but what OctoPrint and the plugin ask
    during = sent[sent.index(lines[0]) :]
    other = {command for command in during if not PLUGIN_LINE.match(command)} - set(lines)
    # by the last two the plugin finds out whether an ok was lost
    asked = {"M114", "M115"} if fault and fault.startswith("lost_ok") else set()
    assert {command.split()[0] for command in other} <= {"M110", "M400"} | asked

    if fault:
        board.board.clear(fault.partition(":")[0])
    server.wait_for(lambda: not helpers.status(server)["stale"], 20, "fresh data")
    helpers.wait_equal(server, board, 10)


def test_lost_ok_of_a_macro_costs_the_minutes_of_the_setting(server, board_factory):
    board = board_factory(speed=10)
    helpers.connect(server, board)
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 30)
    lines = distinct_moves(60)
    lines.insert(30, "G32")
    start = len(board.board.received())
    server.upload("macro.gcode", "\n".join(lines) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("macro.gcode")
        server.wait_for(lambda: "G32" in helpers.commands(board)[start:], 30, "the macro")
        board.board.inject("lost_ok:once")
        server.wait_for(lambda: push.events("PrintDone"), PRINT_SECONDS, "the end of the print")
        assert push.events("Error") == push.events("Disconnected") == []
    assert [command for command in helpers.commands(board)[start:] if command in lines] == lines


SURVIVED = (
    "lost_ok:401",
    "truncated:2",
    "bad_utf8:2",
    "garbage:3",
    "huge_line:2",
    "debug_text:2",
    "err_no_buffers:2",
    "error_reply:50",
    "unread:2",
)
"""Faults of the line and of the board that a print goes through."""

BETWEEN = {
    # silent for as long as its macro takes
    500: "G28",
    700: "M117 *** not a checksum ***",
    900: "T0",
    1100: 'M98 P"0:/macros/Say hello"',
    1300: "M109 S45",
    1500: "X21.5 Y21.5",
    1700: "G32",
    1900: "M290 S0.01",
}
"""Number of a move -> what comes in front of it."""


@pytest.mark.parametrize("firmware", ["3.5.3", "3.7"])
def test_print_with_all_that_can_be_survived(server, board_factory, firmware):
    board = board_factory(firmware=firmware, speed=10)
    helpers.connect(server, board)
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 30)
    for fault in SURVIVED:
        board.board.inject(fault)
    moves = distinct_moves(2000)
    lines = []
    for number, move in enumerate(moves):
        lines += [BETWEEN[number], move] if number in BETWEEN else [move]
    start = len(board.board.received())
    print_through(server, board, lines, f"all-{firmware}.gcode")

    def arrived():
        sent = helpers.commands(board)[start:]
        return [command for command in sent if command in wanted]

    # a comment that would be dropped goes out quoted
    wanted = set(lines) - {BETWEEN[700]}
    expected = [line for line in lines if line in wanted]
    server.wait_for(lambda: len(arrived()) >= len(expected), 30, "the last line to arrive")
    assert arrived() == expected
    assert any("not a checksum" in command for command in helpers.commands(board)[start:])
    for fault in SURVIVED:
        board.board.clear(fault.partition(":")[0])
    server.wait_for(lambda: not helpers.status(server)["stale"], 20, "fresh data")
    helpers.wait_equal(server, board, 10)
