"""Filament monitors: M591, and what they report."""

from __future__ import annotations

import pytest

SWITCH = 'M591 D0 P1 C"io4.in" S'
TOLD = "Simple filament sensor on pin io4.in, {}, output low when no filament, filament present: {}"


@pytest.mark.parametrize(
    ("mode", "words"),
    [
        (0, "disabled"),
        (1, "enabled when printing from SD card"),
        (2, "enabled always"),
    ],
)
def test_a_switch_is_configured_and_told(bench, mode, words):
    board = bench()
    assert board.send(f"{SWITCH}{mode}") == "ok\n"
    assert board.send("M591 D0") == TOLD.format(words, "yes") + "\nok\n"
    monitor = board.ask("sensors.filamentMonitors[0]", "v")
    assert (monitor["type"], monitor["enableMode"]) == ("simple", mode)


def test_other_firmware_has_no_modes(bench):
    board = bench(firmware="3.4")
    board.send(f"{SWITCH}2")
    assert board.send("M591 D0").startswith(TOLD.format("enabled", "yes"))


def test_a_monitor_is_taken_away(bench):
    board = bench()
    board.send(f"{SWITCH}2", "M591 D0 P0")
    assert board.ask("sensors.filamentMonitors") == []
    assert board.send("M591 D0") == "Extruder 0 has no filament sensor\nok\n"


def test_another_level_and_another_extruder(bench):
    board = bench()
    board.send("M591 D0 P0", 'M591 D1 P2 C"io5.in" S1')
    assert [one is None for one in board.ask("sensors.filamentMonitors")] == [True, False]
    assert "pin io5.in, enabled when printing from SD card, output high" in board.send("M591 D1")
    board.send("M591 D1 S0")
    assert "disabled" in board.send("M591 D1")


@pytest.mark.parametrize("line", ["M591", "M591 D0 P3", "M591 D0"])
def test_other_monitors_are_left_alone(bench, line):
    board = bench("corexy")
    before = board.ask("sensors.filamentMonitors")
    assert board.send(line) == "ok\n"
    assert board.ask("sensors.filamentMonitors") == before


def test_a_switch_that_always_looks_tells_of_a_stream_too(bench):
    board = bench()
    board.send(f"{SWITCH}2")
    board.board.inject("filament_error:0")
    expected = "- Event notification -\nFilament error on extruder 0: noFilament\n"
    assert board.wait(0.1) == expected
    assert board.send("M591 D0") == TOLD.format("enabled always", "no") + "\nok\n"


def test_a_switch_for_prints_of_the_board_is_in_the_model_alone(bench):
    board = bench()
    board.send(f"{SWITCH}1")
    board.board.inject("filament_error:0")
    assert board.wait(1) == ""
    assert board.ask("sensors.filamentMonitors[0].status") == "noFilament"


def test_a_restart_forgets_the_pin(bench):
    board = bench()
    board.send('M591 D0 P2 C"io5.in" S2')
    board.board.inject("reset")
    board.wait(5)
    assert "pin io5.in" not in board.send("M591 D0")
