"""The virtual card over the serial line."""

from __future__ import annotations

import base64
import json
import struct
import zlib

import pytest

from octoprint_rrfmodel.simulator.device.card import Card


def listing(board, line):
    text = board.send(line)
    assert text.endswith("\n\nok\n")
    return json.loads(text[: -len("\n\nok\n")])


def test_plain_list(bench):
    assert bench().send("M20") == (
        "Begin file list\nEmpty\nSpare parts\nsquare.gcode\nTwo layers.gcode\n"
        "Prüfkörper ø20.gcode\nEnd file list\nok\n"
    )


def test_empty_folder(bench):
    board = bench()
    expected = "Begin file list\nNONE\nEnd file list\nok\n"
    assert board.send('M20 P"0:/gcodes/Empty"') == expected


def test_list_of_names(bench):
    assert bench().send('M20 S2 P"0:/gcodes/Spare parts"') == (
        '{"dir":"0:/gcodes/Spare parts","first":0,"files":["*ver 2","clip (L).gcode"],'
        '"next":0,"err":0}\n\nok\n'
    )


def test_list_with_sizes(bench):
    found = listing(bench(), 'M20 S3 P"0:/gcodes/Spare parts/"')
    assert found["dir"] == "0:/gcodes/Spare parts/"
    assert "err" not in found
    folder, file = found["files"]
    assert folder == {"type": "d", "name": "ver 2", "size": 0, "date": "2024-10-01T12:00:00"}
    assert (file["type"], file["name"]) == ("f", "clip (L).gcode")
    assert file["size"] > 500


@pytest.mark.parametrize("kind", [2, 3])
def test_errors_of_a_list(bench, kind):
    board = bench()
    assert listing(board, f'M20 S{kind} P"0:/nowhere"')["err"] == 2
    board.send("M22")
    found = listing(board, f"M20 S{kind}")
    assert (found["err"], found["files"]) == (1, [])


@pytest.mark.parametrize("kind", [2, 3])
def test_long_lists_come_in_pages(bench, kind):
    board = bench()
    for index in range(150):
        board.board.card.write(f"0:/gcodes/many/part number {index:03d}.gcode", "")
    names, start, pages = [], 0, 0
    while True:
        found = listing(board, f'M20 S{kind} P"0:/gcodes/many" R{start}')
        assert found["first"] == start
        names += [entry["name"] if kind == 3 else entry for entry in found["files"]]
        start, pages = found["next"], pages + 1
        if not start:
            break
    assert names == [f"part number {index:03d}.gcode" for index in range(150)]
    assert pages > 1


def test_no_buffers_for_a_list(bench):
    board = bench(faults=["err_no_buffers:1"])
    assert board.send("M20 S3") == '{"err":-1}\n\nok\n'


@pytest.mark.parametrize("room, answered", [(20, False), (20_000, True)])
def test_no_buffers_for_a_list_of_that_size(bench, room, answered):
    board = bench(faults=[f"err_no_buffers:>{room}"])
    assert ('"files"' in board.send("M20 S3")) is answered


def test_upload_gets_no_ok_until_its_end(bench):
    board = bench()
    assert board.send("M28 part.gcode") == "ok\nWriting to file: part.gcode\n"
    assert board.send("G28", "N5 M105", "; comment", "M115") == ""
    assert board.send("M29") == "Done saving file.\nok\n"
    content = board.board.card.read("0:/gcodes/part.gcode")
    assert content == b"G28\nM105\n; comment\nM115\n"
    assert board.send("M105").startswith("ok T0")


def test_upload_to_a_folder(bench):
    board = bench()
    board.send('M28 "0:/gcodes/new/a b.gcode"', "G1 X1", "M29")
    assert board.board.card.has_folder("0:/gcodes/new")
    assert "a b.gcode" in board.send('M20 P"0:/gcodes/new"')


def test_delete(bench):
    board = bench()
    assert board.send("M30 square.gcode") == "ok\n"
    assert "square.gcode" not in board.send("M20")
    assert board.send('M30 "0:/gcodes/Empty"') == "ok\n"


def test_select(bench):
    assert bench().send("M23 square.gcode") == "File opened\nFile selected\nok\n"


@pytest.mark.parametrize("line", ["M23 nothing.gcode", 'M32 "nothing.gcode"'])
def test_select_nothing(bench, line):
    name = line.split()[0]
    expected = f'Error: {name}: GCode file "nothing.gcode" not found\n\nok\n'
    assert bench().send(line) == expected


def test_names_compare_without_case(bench):
    board = bench()
    assert board.send("M23 SQUARE.GCODE") == "File opened\nFile selected\nok\n"
    assert board.ask("job.lastFileName") == "0:/gcodes/square.gcode"
    assert board.ask("job.file.fileName") is None


def test_information(bench):
    found = listing(bench(), 'M36 "square.gcode"')
    size = found.pop("size")
    assert size > 5000
    assert found.pop("thumbnails")[0]["format"] == "png"
    assert found == {
        "err": 0,
        "fileName": "square.gcode",
        "lastModified": "2024-11-04T20:21:00",
        "height": 8.0,
        "layerHeight": 0.2,
        "numLayers": 40,
        "printTime": 200,
        "filament": [212.8],
        "generatedBy": "PrusaSlicer 2.8.1 on 2024-11-04 at 19:20:11 UTC",
    }


def test_information_of_nothing(bench):
    assert bench().send('M36 "no.gcode"') == '{"err":1,"fileName":"no.gcode"}\nok\n'


def test_information_about_the_print(bench):
    board = bench()
    board.send('M32 "square.gcode"')
    board.wait(10)
    found = listing(board, "M36")
    assert found["fileName"] == "0:/gcodes/square.gcode"
    assert found["printDuration"] == 10


def test_information_before_there_was_a_model(bench):
    board = bench(firmware="2.05")
    assert board.send('M36 "no.gcode"') == '{"err":1}\nok\n'
    assert "fileName" not in listing(board, 'M36 "square.gcode"')
    board.send('M32 "square.gcode"')
    board.wait(10)
    text = board.send("M36")
    assert text.startswith('{"err":0,"size":')
    assert text.endswith(',"printDuration":10,"fileName":"0:/gcodes/square.gcode"}\n\nok\n')


def picture_of(png):
    """Return width, height and pixels of a grey PNG, whose sums are right."""
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    place, parts = 8, {}
    while place < len(png):
        (length,) = struct.unpack_from(">I", png, place)
        name, data = png[place + 4 : place + 8], png[place + 8 : place + 8 + length]
        assert zlib.crc32(name + data) == struct.unpack_from(">I", png, place + 8 + length)[0]
        parts[name] = data
        place += 12 + length
    return (*struct.unpack_from(">II", parts[b"IHDR"]), zlib.decompress(parts[b"IDAT"]))


def test_thumbnail(bench):
    board = bench()
    offset = listing(board, 'M36 "square.gcode"')["thumbnails"][0]["offset"]
    found = listing(board, f'M36.1 P"square.gcode" S{offset}')["thumbnail"]
    # a true one, which a browser shows
    assert picture_of(base64.b64decode(found.pop("data")))[:2] == (32, 32)
    assert found == {
        "fileName": "square.gcode",
        "offset": offset,
        "next": 0,
        "err": 0,
    }


def test_thumbnail_of_nothing(bench):
    found = listing(bench(), 'M36.1 P"no.gcode" S5')["thumbnail"]
    assert found == {"fileName": "no.gcode", "offset": 5, "err": 1}


def test_card_information(bench):
    assert bench().send("M39").startswith("SD card in slot 0: capacity 15.93GB")
    said = bench().send("M39 S2")
    assert json.loads(said.removesuffix("\nok\n"))["SDinfo"]["present"] == 1


def test_mounting_is_in_the_model(bench):
    board = bench()
    board.send("M22")
    assert board.ask("volumes[0].mounted") is False
    assert board.ask("seqs.volChanges") == [1, 0]
    board.send("M21")
    assert board.ask("volumes[0].mounted") is True
    assert board.send("M21 P1").startswith("Error: M21: No SD card present")


PATHS = {
    "a.gcode": "0:/gcodes/a.gcode",
    "sub/a.gcode": "0:/gcodes/sub/a.gcode",
    "/sys/config.g": "0:/sys/config.g",
    "0:/macros/x": "0:/macros/x",
    "1:/x": "1:/x",
    "0:/gcodes/../sys/a": "0:/sys/a",
    "0:/gcodes/": "0:/gcodes",
}


@pytest.mark.parametrize(("name", "path"), PATHS.items())
def test_paths(name, path):
    assert Card.path_of(name) == path


def test_a_folder_with_something_in_it_stays():
    card = Card()
    assert not card.delete("0:/gcodes/Spare parts")
    assert card.has_folder("0:/gcodes/Spare parts")
