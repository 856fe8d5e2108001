"""Requests to a single-board computer, and its answers in a board's form."""

import json
from urllib.parse import unquote, unquote_plus

import pytest

from octoprint_rrfmodel.rrf.card.thumbnail import decode_piece
from octoprint_rrfmodel.rrf.wire import machine
from octoprint_rrfmodel.rrf.wire.reply import FolderEntry, decode_page, members_of

ZONED = "2026-11-29T09:00:16.1234567+01:00"


@pytest.mark.parametrize("name", ["a.g", "a+b c.g", "50%.g", "Größe/#1?.g", "a%2Bb.g"])
def test_paths_survive_being_decoded_twice(name):
    sent = machine.machine_path("file", f"0:/gcodes/{name}", timeModified=ZONED)
    path, _, query = sent.partition("?")
    prefix, _, rest = path[1:].partition("/file/")
    assert (prefix, unquote_plus(unquote(rest))) == ("machine", f"0:/gcodes/{name}")
    assert query == "timeModified=2026-11-29T09%3A00%3A16.1234567%2B01%3A00"
    assert machine.machine_path("noop") == "/machine/noop"


@pytest.mark.parametrize(
    ("line", "is_at_once"),
    [("M112", True), ("m292 P0", True), ("M122 ", True), ("M999", True), ("M108", True)]
    + [("M1120", False), ("G28", False), ("M117 M112", False), ("M29", False)],
)
def test_what_passes_the_queue(line, is_at_once):
    assert machine.is_at_once(line) is is_at_once


def test_a_folder():
    told = [
        {"type": "d", "name": "parts", "date": ZONED},
        {"type": "f", "name": "a.g", "size": 10, "date": ZONED},
        {"type": "f", "name": "b.g", "size": 1, "date": None},
        "nonsense",
    ]
    page = decode_page(machine.page_form("0:/gcodes", json.dumps(told)))
    assert page.folder == "0:/gcodes" and page.next == 0 and page.error == 0
    assert page.entries == (
        FolderEntry("parts", True, 0, "2026-11-29T09:00:16"),
        FolderEntry("a.g", False, 10, "2026-11-29T09:00:16"),
        FolderEntry("b.g", False, 1, ""),
    )
    assert decode_page(machine.no_folder("0:/x")).error == 2


def test_a_file_and_its_picture():
    told = {
        "fileName": "/opt/dsf/sd/gcodes/a.g",
        "size": 10,
        "lastModified": ZONED,
        "printTime": None,
        "height": 0.6,
        "thumbnails": [{"width": 48, "height": 48, "offset": 105, "size": 4, "data": "abcd"}],
    }
    text = json.dumps(told)
    assert members_of(machine.info_form("0:/gcodes/a.g", text)) == {
        "err": 0,
        "fileName": "0:/gcodes/a.g",
        "size": 10,
        "lastModified": "2026-11-29T09:00:16",
        "height": 0.6,
        "thumbnails": [{"width": 48, "height": 48, "offset": 105, "size": 4}],
    }
    piece = decode_piece(machine.piece_form("0:/gcodes/a.g", 105, text))
    assert (piece.data, piece.next, piece.error) == ("abcd", 0, 0)
    assert decode_piece(machine.piece_form("0:/gcodes/a.g", 7, text)).error == 1
    assert members_of(machine.no_file("0:/gcodes/a.g"))["err"] == 1


@pytest.mark.parametrize("text", ["", "<html>", "[" * 100000, "5"])
def test_nonsense_stays_nonsense(text):
    assert machine.page_form("0:/gcodes", text) == text
    assert machine.info_form("0:/gcodes/a.g", text) == text
    assert decode_piece(machine.piece_form("0:/gcodes/a.g", 5, text)).error == 1
