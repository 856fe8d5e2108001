"""The print of the demo: what the page shows of it is true, and it runs on each machine."""

import base64
import re
import struct
import zlib

import pytest

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.device import demo_print
from octoprint_rrfmodel.simulator.device.printing.fileinfo import file_info
from octoprint_rrfmodel.simulator.machines import MACHINES

PATH = f"0:/gcodes/{demo_print.NAME}"


@pytest.fixture(scope="module")
def content():
    return demo_print.content([1, 3, 7])


def test_what_a_board_reads_of_it(content):
    info = file_info(PATH, content.encode(), None)
    assert (info["layerHeight"], info["firstLayerHeight"]) == (0.2, 0.2)
    assert info["numLayers"] == demo_print.LAYERS
    assert info["height"] == pytest.approx(demo_print.LAYERS * 0.2)
    assert info["filament"][0] > 1000
    assert 300_000 < info["size"] < 2_000_000
    assert re.findall(r'M486 S\d+ A"(.*)"', content) == [each.name for each in demo_print.PIECES]
    # the first two of the tools take turns
    assert set(re.findall(r"^T(\d+)$", content, re.MULTILINE)) == {"1", "3"}


def test_its_pictures_are_pictures(content):
    info = file_info(PATH, content.encode(), None)
    assert [each["width"] for each in info["thumbnails"]] == [48, 200]
    for told in info["thumbnails"]:
        lines = content.encode()[told["offset"] :].split(b"; thumbnail end")[0].splitlines()
        text = b"".join(line.removeprefix(b"; ") for line in lines)
        assert len(text) == told["size"]
        picture = base64.b64decode(text, validate=True)
        assert picture.startswith(b"\x89PNG\r\n\x1a\n")
        assert struct.unpack(">II", picture[16:24]) == (told["width"], told["height"])
        (length,) = struct.unpack(">I", picture[33:37])
        pixels = zlib.decompress(picture[41 : 41 + length])
        assert len(pixels) == told["height"] * (4 * told["width"] + 1)
        # the pieces in their colours, nothing in the corners
        assert len(set(pixels)) > 50
        assert pixels[4] == 0


@pytest.mark.parametrize("machine", ["toolchanger", "delta"])
def test_layers_take_real_time_and_objects_have_their_places(machine):
    now = [0.0]
    board = Board(machine, clock=lambda: now[0])
    demo_print.put_on(board.card, [tool["number"] for tool in board.tools()])
    board.execute(f'M32 "{PATH}"', channel="http")
    began = {}
    while len(began) < 4 and now[0] < 900:
        now[0] += 1
        board.advance()
        began.setdefault(board.model["job"]["layer"], now[0])
    times = [began[layer + 1] - began[layer] for layer in (1, 2)]
    assert all(10 < seconds < 60 for seconds in times), times
    objects = board.model["job"]["build"]["objects"]
    assert [each["name"] for each in objects] == [piece.name for piece in demo_print.PIECES]
    for found, piece in zip(objects, demo_print.PIECES):
        for axis, centre in zip("xy", piece.centre):
            low, high = found[axis]
            # a tool of a changer has an offset
            assert abs((low + high) / 2 - centre) < 1.5
            assert 10 < high - low < 30


def test_a_machine_without_tools_has_none():
    board = Board("cnc")
    demo_print.put_on(board.card, [tool["number"] for tool in board.tools()])
    assert "cnc" in MACHINES
    assert board.card.read(PATH) is None
