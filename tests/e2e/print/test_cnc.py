"""Files of CNC programs: lines that the board acknowledges and OctoPrint takes for no command."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

pytestmark = [
    pytest.mark.both_hosts("each waits for acknowledgements with its own code"),
    pytest.mark.slow,
    pytest.mark.timeout(240),
]

MOVES = 200

FRAME = ["(a program)", "N1 (made by hand)", "Q0", "n2 g21", "g90"]
"""What the board never acknowledges, and small letters."""


def program():
    """Return the lines of a file, and those of them that are to reach the board."""
    moves = [
        f"N{10 + number} G1 X{20 + 40 * (number % 2)}.{number} F6000" for number in range(MOVES)
    ]
    modal = [line for move in moves for line in (move, "Y20 Z5")]
    return FRAME + modal, ["n2 g21", "g90", *modal]


@pytest.mark.parametrize("waits", [False, True], ids=["default", "waits for unknown"])
def test_row_14_waits_for_each_line(server_factory, board_factory, waits):
    server = server_factory(serial={"unknownCommandsNeedAck": waits})
    board = board_factory(speed=4)
    helpers.connect(server, board)
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 20)
    before = len(board.board.received())
    lines, reaching = program()
    server.upload("program.gcode", "\n".join(lines) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("program.gcode")
        prints.wait_done(server, push, 120)
        arrived = [text.partition("*")[0] for text in board.board.received()[before:]]
    assert [text for text in arrived if text in set(reaching)] == reaching


def test_row_15_an_asterisk_in_a_text_costs_nothing(server_factory, board_factory):
    server = server_factory()
    board = board_factory(speed=20)
    helpers.connect(server, board)
    server.upload("stars.gcode", "M117 *** one ***\nG1 X1*2 Y5\nG90\nM117 two\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("stars.gcode")
        prints.wait_done(server, push, 15)
        sent = [text.partition(" ")[2] for text in board.board.received()]
        assert any(text.startswith('M117 "*** one ***"*') for text in sent)
        assert not any("X1*2" in text for text in sent)
        server.wait_for(
            lambda: [found for found in push.of_plugin() if found.get("code") == "asterisk"],
            5,
            "the notice",
        )


@pytest.mark.parametrize("stop", ["M00", "N70 m0 (turn the part)"])
def test_a_stop_in_the_middle_pauses_however_it_is_written(server_factory, board_factory, stop):
    server = server_factory()
    board = board_factory(speed=20)
    helpers.connect(server, board)
    server.upload("stop.gcode", f'G21\n{stop}\nM118 S"behind"\n')
    with PushListener(server, ADMIN) as push:
        server.select_and_print("stop.gcode")
        push.wait_for_event("PrintPaused", 15)
        # told while it is still pausing, when OctoPrint ignores that a print is resumed
        server.wait_state("Paused")
        assert "behind" not in "".join(board.board.received())
        assert server.post("/api/job", json={"command": "pause", "action": "resume"}).ok
        prints.wait_done(server, push, 15)
    assert "behind" in "".join(board.board.received())
