"""What is set up and tuned at the board: what the model shows then, and what is said."""

from __future__ import annotations

import pytest


@pytest.fixture
def board(bench):
    return bench()


def move(board):
    return board.board.model["move"]


def heater(board, index):
    return board.board.model["heat"]["heaters"][index]


def test_what_moves(board):
    assert board.send("M572 D0 S0.07") == "ok\n"
    assert move(board)["extruders"][0]["pressureAdvance"] == 0.07
    board.send('M593 P"EI2" F51.5 S0.05')
    shaping = move(board)["shaping"]
    assert (shaping["type"], shaping["frequency"], shaping["damping"]) == ("ei2", 51.5, 0.05)
    assert "Error" in board.send('M593 P"round"')
    board.done("M906 X1300 E900")
    assert move(board)["axes"][0]["current"] == 1300
    assert move(board)["axes"][1]["current"] == 1200
    assert move(board)["extruders"][0]["current"] == 900


def test_a_heater_is_tuned(board):
    before = dict(heater(board, 1)["model"])
    assert "Auto tuning heater 1 using target temperature 200.0" in board.send("M303 T0 S200")
    assert heater(board, 1)["state"] == "tuning"
    assert "is being tuned" in board.send("M303")
    assert "Error" in board.send("M303 H0 S60")
    board.wait(100)
    assert heater(board, 1)["current"] > 150
    board.wait(100)
    assert heater(board, 1)["state"] == "off"
    assert heater(board, 1)["model"]["heatingRate"] > before["heatingRate"]
    assert "No heater" in board.send("M303")


def test_tuning_ends_where_the_heater_is_switched_off(board):
    before = dict(heater(board, 0)["model"])
    board.send("M303 H0 S60")
    board.send("M140 S-273.15")
    board.wait(300)
    assert heater(board, 0)["state"] == "off"
    assert heater(board, 0)["model"] == before


def test_monitors_of_a_heater(board):
    board.send("M143 H1 P1 S280 A2 C0")
    monitor = heater(board, 1)["monitors"][1]
    assert (monitor["condition"], monitor["limit"], monitor["action"]) == ("tooHigh", 280, 2)
    board.send("M143 H1 P1 C-1")
    assert (monitor["condition"], monitor["limit"]) == ("disabled", None)
    assert "Error" in board.send("M143 H1 P3 S1")


def test_the_height_of_a_probe(board):
    board.send("G31 K0 Z2.2")
    assert board.board.model["sensors"]["probes"][0]["triggerHeight"] == 2.2
    assert "trigger height 2.200" in board.send("G31")


def test_a_place_is_kept(board):
    board.done("G28")
    board.done("G1 X30 Y40 Z5 F6000", "M400")
    board.done("G60 S3")
    assert board.board.model["state"]["restorePoints"][3]["coords"] == [30, 40, 5]
    board.done("G1 X100 F6000", "M400")
    board.done("G1 R3 X0 Y2 F6000", "M400")
    assert [axis["machinePosition"] for axis in move(board)["axes"]] == [30, 42, 5]


def test_what_is_saved(board):
    card = board.board.card
    assert "No M501" in board.send("M500")
    card.write("0:/sys/config.g", "M501\n")
    assert board.send("M500") == "ok\n"
    assert any("M307 H1" in line for line in card.lines("0:/sys/config-override.g"))


def test_after_the_power_was_gone(board):
    assert "No resume file" in board.send("M916")
    board.board.card.write("0:/sys/resurrect.g", "M117 on again\n")
    board.done("M916")
    assert board.board.model["state"]["displayMessage"] == "on again"


def test_firmware_of_the_card(board):
    assert "not found" in board.send("M997 S0")
    assert "does not exist" in board.send("M997 B9")
    name = board.board.model["boards"][0]["firmwareFileName"]
    board.board.card.write(f"0:/firmware/{name}", "binary")
    board.wait(100)
    assert board.send("M997 S0") == ""
    board.wait(10)
    assert board.board.clock.up_time < 10
