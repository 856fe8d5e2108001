"""A print from the card from its start to its end, and everything that may happen on the way."""

from __future__ import annotations

import pytest


def until(board, status):
    return board.until(lambda b: b.model["state"]["status"] == status)


@pytest.fixture
def printing(bench):
    """A board in the middle of a print."""
    board = bench()
    board.send('M32 "square.gcode"')
    board.until(lambda b: (b.model["job"]["layer"] or 0) >= 3)
    board.wait(5)
    return board


def test_the_life_of_a_print(bench):
    board = bench()
    assert board.send('M32 "Two layers.gcode"') == "File opened\nFile selected\nok\n"
    assert board.status == "processing"
    assert board.ask("job.file.fileName") == "0:/gcodes/Two layers.gcode"
    assert board.ask("job.lastFileName") is None
    board.wait(5)
    assert board.ask("job.duration") == 5
    assert board.ask("inputs[2].state") == "waiting"
    said = until(board, "idle")
    assert said == (
        "Done printing file\n"
        "Finished printing file 0:/gcodes/Two layers.gcode, print time was 0h 1m\n"
    )
    job = board.board.model["job"]
    assert job["file"]["fileName"] is None
    assert job["duration"] is None
    assert job["lastFileName"] == "0:/gcodes/Two layers.gcode"
    assert job["lastDuration"] > 60
    # homing isn't warming up
    assert 40 < job["lastWarmUpDuration"] < job["lastDuration"] - 10


def test_select_then_start(bench):
    board = bench()
    board.send('M23 "square.gcode"')
    assert board.status == "idle"
    assert board.done("M24") == "ok\n"
    assert board.status == "processing"


def test_progress(printing):
    job = printing.board.model["job"]
    assert 0 < job["filePosition"] < job["file"]["size"]
    assert job["layerTime"] is not None
    assert job["warmUpDuration"] > 40
    assert job["rawExtrusion"] > 0
    assert job["build"]["objects"] == [
        {"cancelled": False, "name": "square", "x": [80, 120], "y": [80, 120]}
    ]
    # the pace is measured every 30 s (3.5 PrintMonitor.cpp)
    assert (job["timesLeft"]["file"], job["timesLeft"]["filament"]) == (None, None)
    printing.wait(30)
    left = printing.ask("job.timesLeft")
    assert 0 < left["file"] < 1000
    assert left["slicer"] < 200
    assert left["filament"] > 0
    assert printing.send("M27").startswith("SD printing byte ")


def test_layers_count_up_to_the_end(printing):
    layers = []
    while printing.board.job.is_printing:
        layers.append(printing.board.model["job"]["layer"])
        printing.wait(0.5)
    assert layers[-1] == 40
    assert layers == sorted(layers)


def test_polls_are_answered_at_once_while_printing(printing):
    assert printing.ask("state.status") == "processing"
    assert printing.send("M105").startswith("ok T:205.0 /205.0")


def test_pause_and_resume(printing):
    assert printing.send("M25") == "Resume state saved\n"
    assert printing.status == "pausing"
    said = printing.until(lambda b: b.channels["USB"].is_idle)
    assert said.startswith("Printing paused at X")
    assert said.endswith("\nok\n")
    assert printing.status == "paused"
    before = printing.board.job.position
    printing.wait(30)
    assert printing.board.job.position == before
    assert printing.ask("job.pauseDuration") >= 30
    # without the pauses (3.5 PrintMonitor.cpp, GetPrintDuration)
    assert printing.ask("job.duration") == int(printing.board.job.duration)
    assert printing.send("M25") == "Error: M25: Printing is already paused!\nok\n"
    assert printing.send("M24") == ""
    assert printing.status == "resuming"
    assert printing.until(lambda b: b.channels["USB"].is_idle) == "Printing resumed\nok\n"
    assert printing.status == "processing"
    printing.wait(20)
    assert printing.board.job.position > before


CANCELLING = {"3.3": "busy", "3.4": "cancelling", "3.5.3": "cancelling"}


@pytest.mark.parametrize(("firmware", "status"), CANCELLING.items())
def test_cancel(bench, firmware, status):
    board = bench(firmware=firmware)
    board.send('M32 "square.gcode"')
    board.until(lambda b: (b.model["job"]["layer"] or 0) >= 2)
    expected = "Error: M0: Pause the print before attempting to cancel it\nok\n"
    assert board.send("M0") == expected
    board.done("M25")
    assert board.send("M0") == ""
    assert board.status == status
    said = board.until(lambda b: b.channels["USB"].is_idle)
    assert "Cancelled printing file 0:/gcodes/square.gcode, print time was 0h " in said
    assert said.endswith("m\nok\n")
    assert board.status == "idle"
    assert board.ask("heat.heaters[1].active") == 0


def test_pause_from_the_file_itself(bench):
    board = bench()
    board.board.card.write("0:/gcodes/stop.gcode", "G4 S1\nM226\nG4 S1\n")
    board.send('M32 "stop.gcode"')
    until(board, "paused")
    board.done("M24")
    assert until(board, "idle").startswith("Done printing file\n")


def test_a_second_file_is_refused(printing):
    assert "already being printed" in printing.send('M32 "Two layers.gcode"')


def test_m0_in_the_file_ends_it(bench):
    board = bench()
    board.board.card.write("0:/gcodes/stop.gcode", "G4 S1\nM0\nG4 S100\n")
    board.send('M32 "stop.gcode"')
    board.wait(3)
    assert board.status == "idle"
    assert board.ask("job.lastFileName") == "0:/gcodes/stop.gcode"


def test_simulation(bench):
    board = bench()
    assert board.send('M37 P"square.gcode"') == "ok\n"
    assert board.status == "simulating"
    board.wait(2)
    assert board.ask("job.filePosition") > 0
    assert board.board.model["heat"]["heaters"][1]["state"] == "off"
    expected = "File 0:/gcodes/square.gcode will print in 0h 3m plus heating time\n"
    assert until(board, "idle") == expected


def test_object_cancel_and_resume(printing):
    assert printing.send("M486 P0") == "ok\n"
    assert printing.ask("job.build.objects[0].cancelled") is True
    assert printing.ask("job.build.currentObject") == 0
    printing.send("M486 U0")
    assert printing.ask("job.build.objects[0].cancelled") is False
    expected = "Error: M486: Object number out of range\nok\n"
    assert printing.send("M486 P7") == expected


def test_objects_without_a_print(bench):
    assert bench().send("M486") == "No known objects on build plate\nok\n"
    assert bench().send("M486 P0") == "Error: M486: Object number out of range\nok\n"
    assert bench().send("M486 S0", "M486 C") == "ok\nObject 0 cancelled\nok\n"
    assert bench().send("M486 T3") == "ok\n"


def test_seek(bench):
    board = bench()
    board.send("M23 square.gcode")
    assert board.send("M26 S3000") == "ok\n"
    board.done("M24")
    assert board.board.job.position >= 3000


def test_a_print_from_the_card_is_not_blocked_by_usb(bench):
    board = bench()
    board.send('M32 "square.gcode"', "G4 S1000")
    position = board.board.job.position
    board.wait(400)
    assert board.board.job.position > position


def test_usb_streams_are_no_jobs(bench):
    board = bench().homed()
    for index in range(4):
        board.send(f"G1 X{index * 5} F600")
    assert board.status == "busy"
    assert board.ask("job.duration") is None


def test_reset_ends_a_print(printing):
    printing.board.reset()
    assert printing.status == "idle"
    assert printing.ask("job.file.fileName") is None


def test_volume_has_open_files_while_printing(printing):
    assert printing.ask("volumes[0].openFiles") is True
    assert printing.send("M22") == "Error: M22: SD card 0 has open file(s)\nok\n"


def test_filament_load_and_unload(bench):
    board = bench()
    assert board.send('M701 S"PLA"') == "Error: M701: No tool selected\nok\n"
    board.done("T0")
    assert board.done('M701 S"PLA"') == "ok\n"
    assert board.ask("move.extruders[0].filament") == "PLA"
    expected = "Error: M701: Unload the current filament before attempting to load another one\n"
    assert board.send('M701 S"PLA"').startswith(expected)
    assert board.done("M703") == "ok\n"
    assert board.done("M702") == "ok\n"
    assert board.ask("move.extruders[0].filament") == ""
    assert "not found" in board.send('M701 S"Wood"')
