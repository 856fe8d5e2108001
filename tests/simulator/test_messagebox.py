"""Message boxes: in the model, on USB, answered or not."""

from __future__ import annotations

import pytest


def box(board):
    return board.board.model["state"]["messageBox"]


def test_members(bench):
    board = bench()
    board.board.execute('M291 P"Text" R"Title" S3 X1 Z1')
    assert box(board) == {
        "axisControls": 5,
        "cancelButton": True,
        "choices": None,
        "default": None,
        "max": None,
        "message": "Text",
        "min": None,
        "mode": 3,
        "seq": 1,
        "timeout": 0,
        "title": "Title",
    }
    assert board.ask("seqs.state") == 1


def test_members_before_35(bench):
    board = bench(firmware="3.4")
    board.board.execute('M291 P"Text" R"Title" S2')
    assert set(box(board)) == {"axisControls", "message", "mode", "seq", "timeout", "title"}


LIVE = {
    ("3.3", "fi"): False,
    ("3.4", "f"): False,
    ("3.4", "fi"): True,
    ("3.5.3", "f"): False,
    ("3.5.3", "fi"): True,
}


@pytest.mark.parametrize(("firmware", "flags", "shown"), [(*k, v) for k, v in LIVE.items()])
def test_box_is_important_not_live(bench, firmware, flags, shown):
    board = bench(firmware=firmware)
    board.board.execute('M291 P"Text" S2')
    assert ("messageBox" in board.ask("state", flags)) is shown
    board.board.execute("M292")
    assert (board.ask("state", flags).get("messageBox", 0) is None) is shown


@pytest.mark.parametrize(("mode", "seconds"), [(0, 10), (1, 10)])
def test_a_box_without_buttons_goes_by_itself(bench, mode, seconds):
    board = bench()
    board.board.execute(f'M291 P"Text" S{mode}')
    assert board.board.channels["HTTP"].is_idle
    assert box(board)["timeout"] == seconds * 1000
    board.wait(seconds - 0.5)
    assert box(board) is not None
    board.wait(1)
    assert box(board) is None


def test_a_given_time(bench):
    board = bench()
    board.board.execute('M291 P"Text" S1 T0')
    board.wait(1000)
    assert box(board) is not None


def test_a_blocking_box_makes_its_channel_wait_and_the_board_busy(bench):
    board = bench()
    board.board.execute('M291 P"Text" S2\nM117 Done')
    assert board.status == "busy"
    assert board.ask("inputs[0].state") == "awaitingAcknowledgement"
    board.wait(100)
    assert board.board.model["state"]["displayMessage"] == ""
    board.send("M292")
    board.wait(0.1)
    assert board.status == "idle"
    assert board.board.model["state"]["displayMessage"] == "Done"


def test_cancel_ends_the_macro(bench):
    board = bench()
    board.board.card.write("0:/macros/Ask", 'M291 P"?" S3\nM117 Yes\n')
    board.board.execute('M98 P"0:/macros/Ask"')
    board.send("M292 P1")
    board.wait(0.1)
    assert board.board.model["state"]["displayMessage"] == ""
    assert board.board.channels["HTTP"].is_idle
    assert board.status == "idle"


def test_ok_lets_the_macro_go_on(bench):
    board = bench()
    board.board.card.write("0:/macros/Ask", 'M291 P"?" S3\nM117 Yes\n')
    board.board.execute('M98 P"0:/macros/Ask"')
    board.send("M292 P0")
    board.wait(0.1)
    assert board.board.model["state"]["displayMessage"] == "Yes"


ANSWERS = {
    "choice": ('S4 K{"a","b"}', "M292 R{1} S1", True, 1),
    "choice out of range": ('S4 K{"a","b"}', "M292 R{2} S1", False, None),
    "integer": ("S5 L1 H10 F3", "M292 R{7} S1", True, 7),
    "integer too large": ("S5 L1 H10", "M292 R11 S1", False, None),
    "float": ("S6 L0.5 H2.5", "M292 R{1.25} S1", True, 1.25),
    "text": ("S7 L1 H5", 'M292 R{"abc"} S1', True, "abc"),
    "text in braces": ("S7 H30", 'M292 P0 R{"it\'\'s ""}"" M5"} S1', True, 'it\'s "}" M5'),
    "text too long": ("S7 L1 H5", 'M292 R{"abcdef"} S1', False, None),
    "number for a text": ("S7", "M292 R{5} S1", False, None),
    "no value": ("S5", "M292 S1", False, None),
    "another box": ("S2", "M292 S9", False, None),
    "cancel": ("S5 J1", "M292 P1 S1", True, False),
}


@pytest.mark.parametrize(("arguments", "answer", "closes", "value"), ANSWERS.values(), ids=ANSWERS)
def test_answers(bench, arguments, answer, closes, value):
    board = bench()
    board.board.execute(f'M291 P"?" {arguments}')
    assert box(board) is not None
    board.send(answer)
    assert (box(board) is None) is closes
    if closes:
        assert board.board.boxes.answers == [value]


def test_choices_and_limits_are_in_the_model(bench):
    board = bench()
    board.board.execute('M291 P"?" S4 K{"a","b"} F1')
    assert (box(board)["choices"], box(board)["default"]) == (["a", "b"], 1)
    board.send("M292 R{0} S1")
    board.board.execute('M291 P"?" S5 L1 H10 F3')
    assert [box(board)[name] for name in ("min", "max", "default")] == [1, 10, 3]


def test_modes_above_3_came_with_35(bench):
    old = bench(firmware="3.4")
    assert "Invalid message box mode" in old.board.execute('M291 P"?" S5')


def test_seq_is_ignored_before_35(bench):
    board = bench(firmware="3.4")
    board.board.execute('M291 P"?" S2')
    board.send("M292 S9")
    assert box(board) is None


def test_boxes_queue_up(bench):
    board = bench()
    for name in ("http", "telnet", "aux"):
        board.board.execute(f'M291 P"{name}" S2', name)
    assert box(board)["message"] == "http"
    board.send("M292 S1")
    assert box(board)["message"] == "telnet"
    board.send("M292", "M292")
    assert box(board) is None


ON_USB = {
    2: "- Title -\nText\nSend M292 to continue\nok\n",
    3: "- Title -\nText\nSend M292 to continue or M292 P1 to cancel\nok\n",
    1: "- Title -\nText\nok\n",
}


@pytest.mark.parametrize(("mode", "text"), ON_USB.items())
@pytest.mark.parametrize("firmware", ["3.3", "3.4", "3.5.3", "3.6"])
def test_from_usb_it_is_acknowledged_at_once_and_shown_as_text(bench, firmware, mode, text):
    assert bench(firmware=firmware).send(f'M291 P"Text" R"Title" S{mode}') == text


@pytest.mark.parametrize(
    ("firmware", "opens"), [("3.3", True), ("3.4", True), ("3.5.1", False), ("3.6", False)]
)
def test_only_older_firmware_can_close_what_usb_opened(bench, firmware, opens):
    board = bench(firmware=firmware)
    board.send('M291 P"Text" R"Title" S2')
    assert (box(board) is not None) is opens
    assert board.ask("inputs[3].state") == "awaitingAcknowledgement"
    board.send("M292")
    board.wait(0.1)
    expected = "executing" if opens else "awaitingAcknowledgement"
    assert board.ask("inputs[3].state") == expected
    assert box(board) is None


def test_the_other_reading_usb_is_stuck(bench):
    board = bench(faults=["usb_box_stuck"])
    assert board.send('M291 P"Text" R"Title" S2').endswith("ok\n")
    assert board.send("M292", "M105") == ""
    board.board.power_cycle()
    board.wait(2)
    assert board.send("M105") != ""


def test_no_box_to_answer(bench):
    assert bench().send("M292") == "ok\n"


def test_too_many_boxes(bench):
    board = bench()
    for _ in range(8):
        board.board.execute('M291 P"?" S1 T0')
    assert "Too many message boxes" in board.board.execute('M291 P"?" S1')
