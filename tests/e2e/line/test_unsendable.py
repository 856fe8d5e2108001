"""Commands that would hang the line don't get there, whoever sends them."""

import time

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener
from tests.support.waiting import within

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line", once_for=("line",)),
    pytest.mark.slow,
]

BLOCKING_BOX = 'M291 P"Is it S1 there?" R"Look" S3'


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory()


@pytest.fixture
def connected(server, board_factory):
    def connect(**options):
        board = board_factory(**options)
        helpers.connect(server, board)
        return board

    yield connect
    helpers.disconnect(server)


def arrived(server, board, *lines):
    """Return what has arrived of the lines, and of an M118 behind them."""
    before = len(board.board.received())
    started = time.monotonic()
    server.commands(*lines, 'M118 P1 S"through"')
    server.wait_for(
        lambda: any(text.startswith("M118") for text in helpers.commands(board)[before:]),
        10,
        "the line behind",
    )
    assert time.monotonic() - started < within(10)
    # what comes from OctoPrint and the plugin at any time
    own = ("M409", "M105", "M118", "M27", "M20", "M114", "M115")
    return [text for text in helpers.commands(board)[before:] if not text.startswith(own)]


@pytest.mark.parametrize(
    "line",
    ["M111", 'M111 P3 S1 ; "what is it"', "M155 S2", "M113 S2", "M154 S1", "M410", "; nothing"],
)
def test_never_sent(server, connected, line):
    board = connected()
    assert arrived(server, board, line) == []


@pytest.mark.parametrize(
    "line", ['M291 P"hello" S1', 'M291 P"S2 in the text"', "M111 S1", "G4 P1", 'M98 P"none.g"']
)
def test_sent_as_it_is(server, connected, line):
    board = connected()
    assert arrived(server, board, line) == [line]


@pytest.mark.parametrize("firmware, is_sent", [("3.4", True), ("3.5.3", False), ("3.6", False)])
def test_blocking_box_by_firmware(server, connected, firmware, is_sent):
    board = connected(firmware=firmware)
    with PushListener(server, ADMIN) as push:
        assert arrived(server, board, BLOCKING_BOX) == ([BLOCKING_BOX] if is_sent else [])
        if not is_sent:
            notice = push.wait_for_plugin(lambda found: found.get("code") == "message_box")
            assert "Is it S1 there?" in notice["text"]


def test_switched_off(server, connected):
    board = connected()
    server.set_setting("plugins.rrfmodel.operations", {"probes": False})
    try:
        assert arrived(server, board, "M155 S2") == ["M155 S2"]
    finally:
        server.set_setting("plugins.rrfmodel.operations", {"probes": True})


def resume(server):
    response = server.post("/api/job", json={"command": "pause", "action": "resume"})
    assert response.status_code == 204, response.text


def dwells(board):
    """Return what has come of the lines that each place of a file is known by."""
    return [text for text in helpers.commands(board) if text.startswith("G4")]


def test_streamed(server, connected):
    """A print goes through with all of them in it, and pauses where a person is to act."""
    board = connected()
    board.board.inject("usb_box_stuck")
    stops = ["M0", BLOCKING_BOX, "M1"]
    lines = ["M111", "M155 S1", "; comment"]
    for number, stop in enumerate(stops):
        lines += [f"G4 P{number}", stop]
    server.upload("odd.gcode", "\n".join([*lines, f"G4 P{len(stops)}"]) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("odd.gcode")
        for number, stop in enumerate(stops):
            server.wait_state("Paused", 20)
            # nothing goes out behind the place
            assert dwells(board) == [f"G4 P{before}" for before in range(number + 1)]
            if stop == BLOCKING_BOX:
                told = server.wait_for(lambda: paused(server), 5, "the warning")[0]
                assert told["values"] == {"next": "answer", "message": "Is it S1 there?"}
            else:
                server.wait_for(lambda: not paused(server), 5, "the end of the warning")
            resume(server)
        server.wait_state("Operational", 20)
        # events come later than the state that they tell of
        push.wait_for_event("PrintDone")
        assert push.count("PrintPaused", len(stops)) == len(stops)
        (notice,) = [found for found in push.of_plugin() if found.get("code") == "print_paused"]
        assert '"Is it S1 there?"' in notice["text"]
        assert "resume the print" in notice["text"]
    assert dwells(board) == [f"G4 P{number}" for number in range(len(stops) + 1)]
    sent = {text.split()[0] for text in helpers.commands(board) if text}
    assert not {"M111", "M291", "M155", "M0", "M1", "@pause"} & sent


def test_box_that_can_be_answered_goes_out_in_a_print(server, connected):
    board = connected(firmware="3.4")
    server.upload("box.gcode", f"G4 P1\n{BLOCKING_BOX}\nG4 P2\n")
    server.select_and_print("box.gcode")
    server.wait_for(lambda: dwells(board) == ["G4 P1", "G4 P2"], 20, "the lines of the file")
    assert BLOCKING_BOX in helpers.commands(board)
    server.wait_state("Operational", 20)


def paused(server):
    """Return the warnings that say why the print is paused."""
    found = helpers.status(server)["warnings"]
    return [warning for warning in found if warning["code"] == "print_paused"]


def box_warning(server):
    codes = [found["code"] for found in helpers.status(server)["warnings"]]
    return "message_box_unanswerable" in codes


@pytest.mark.parametrize("firmware, is_told", [("3.5.3", True), ("3.4", False)])
def test_box_that_waits_on_the_line(server, connected, firmware, is_told):
    board = connected(firmware=firmware)
    usb = board.board.channels["USB"]
    usb.awaits_acknowledgement = True
    if is_told:
        server.wait_for(lambda: box_warning(server), 5, "the warning")
    else:
        helpers.wait_polls(server, 2)
        assert not box_warning(server)
    usb.awaits_acknowledgement = False
    server.wait_for(lambda: not box_warning(server), 5, "the end of the warning")


def test_box_of_a_macro_that_holds_the_line(server, connected):
    """No reply can tell of it: the text does."""
    board = connected()
    server.commands("G4 S12")
    server.wait_for(lambda: helpers.status(server)["blocked"], 5, "the command to begin")
    board.board.message("- Look -\nIs it there?\nSend M292 to continue\n")
    server.wait_for(lambda: box_warning(server), 3, "the warning")
    assert server.wait_for(lambda: not box_warning(server), 30, "the end of the warning")


ASKS = "- Look -\nIs it there?\nSend M292 to continue or M292 P1 to cancel\n"
MACRO = 'M98 P"0:/macros/ask.g"'


def hold(server, board, lines, seconds):
    """Let a macro that is started over USB hold the line with a box, as the firmware does."""
    board.board.card.write("0:/macros/ask.g", f"G4 S{seconds}\n")
    lines()
    server.wait_for(lambda: MACRO in helpers.commands(board), 20, "the macro to begin")
    board.board.channels["USB"].status_request = "M409"
    board.board.message(ASKS)


def test_row_2_box_that_holds_the_line_is_told_and_waited_for(server, connected):
    board = connected()
    with PushListener(server, ADMIN) as push:
        push.wait_for_plugin(bool)
        hold(server, board, lambda: server.commands(MACRO, "M117 behind"), 8)
        notice = push.wait_for_plugin(lambda found: found.get("code") == "box_waits", 3)
        assert "panel" in notice["text"]
        push.wait_for_event("plugin_rrfmodel_message_box_unanswerable", 3)
        told = server.wait_for(
            lambda: [w for w in helpers.status(server)["warnings"] if "unanswerable" in w["code"]],
            3,
            "the warning",
        )
        assert told[0]["fix"] == "recover"
        # answered elsewhere, everything goes on
        server.wait_for(lambda: "M117 behind" in helpers.commands(board), 30, "the line behind")
        server.wait_for(lambda: not box_warning(server), 10, "the end of the warning")


def test_box_that_holds_a_print_leaves_a_restart(server, connected):
    board = connected()
    server.upload("asks.gcode", f"G4 P1\n{MACRO}\nG4 P2\n")
    hold(server, board, lambda: server.select_and_print("asks.gcode"), 600)
    server.wait_for(lambda: box_warning(server), 5, "the warning")
    response = server.post("/api/plugin/rrfmodel", json={"command": "recover"})
    assert response.status_code == 204, response.text
    server.wait_for(lambda: "M999" in helpers.commands(board), 30, "the restart to be sent")
    board.board.power_cycle()
    server.wait_for(lambda: server.state() == "Operational", 60, "the board to be back")
    helpers.wait_ready(server, 30)
    assert not box_warning(server)


ASKING = 'M291 R"Tool" P"Is it clean?" S3\nM118 S"went on"\n'


def ask_in_a_macro(server, board, start, text=ASKING):
    """Have OctoPrint start a macro that opens a box, and return once that is in the model."""
    board.board.card.write("0:/macros/ask.g", text)
    start()
    helpers.wait_value(server, "state.messageBox.message", "Is it clean?", 20)


def answer(server, action="ok"):
    # as the page does
    seq = helpers.value(server, "state.messageBox.seq")
    request = {"command": "message_box", "action": action, "seq": seq}
    response = server.post("/api/plugin/rrfmodel", json=request)
    assert response.status_code == 204, response.text


def lines_behind(board, count):
    return [f"M117 {number}" for number in range(count)] == [
        text for text in helpers.commands(board) if text.startswith("M117 ")
    ]


@pytest.mark.parametrize("firmware", ["3.4", "3.6.1"])
def test_row_2_box_of_a_macro_is_answered_over_the_line(server, connected, firmware):
    """What waits behind it goes out in order, one line for each ok."""
    board = connected(firmware=firmware)
    behind = [f"M117 {number}" for number in range(20)]
    before = helpers.status(server)["counters"]["timeouts"]
    ask_in_a_macro(server, board, lambda: server.commands(MACRO, *behind))
    box = helpers.value(server, "state.messageBox")
    assert (box["title"], box["mode"]) == ("Tool", 3)
    # OctoPrint's patience is a matter of seconds elsewhere, and a person's isn't
    assert not box_warning(server)
    assert not lines_behind(board, 1)
    answer(server)
    server.wait_for(lambda: lines_behind(board, len(behind)), 20, "the lines behind")
    assert board.board.boxes.answers == [None]
    server.wait_for(lambda: "went on" in server.received(), 5, "the macro's end")
    helpers.wait_value(server, "state.messageBox", None, 10)
    helpers.wait_polls(server, 3)
    assert helpers.status(server)["counters"]["timeouts"] == before


def test_row_2_two_boxes_of_a_macro_in_a_print(server, connected):
    """The first is answered, the second cancelled: the file's lines go on, each once."""
    board = connected(firmware="3.4")
    lines = [f"M117 {number}" for number in range(100)]
    server.upload("asks.gcode", "\n".join([*lines[:50], MACRO, *lines[50:]]) + "\n")
    second = 'M291 R"Tool" P"And now?" S3\nM118 S"not reached"\n'
    ask_in_a_macro(server, board, lambda: server.select_and_print("asks.gcode"), ASKING + second)
    answer(server)
    helpers.wait_value(server, "state.messageBox.message", "And now?", 10)
    assert lines_behind(board, 50)
    answer(server, "cancel")
    server.wait_for(lambda: lines_behind(board, 100), 20, "the lines behind")
    server.wait_state("Operational", 20)
    assert board.board.boxes.answers == [None, False]
    assert "not reached" not in server.received()
