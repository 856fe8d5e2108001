"""Pictures in files: which to fetch, what the board's answers say, and QOI made PNG."""

import base64
import struct
import zlib

import pytest

from octoprint_rrfmodel.rrf.card import qoi
from octoprint_rrfmodel.rrf.card.thumbnail import Picture, Thumbnail, best, picture, print_file
from octoprint_rrfmodel.rrf.follow.asked import NoFile, answer_to
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply
from octoprint_rrfmodel.rrf.wire.request import FileRequest, PieceRequest

PATH = "0:/gcodes/a.gcode"


def qoi_of(width, height, *body):
    return struct.pack(">4sIIBB", b"qoif", width, height, 4, 0) + bytes(body) + b"\0" * 7 + b"\1"


def pixels_of(png):
    """Return width, height and the pixels of a PNG, its checksums proved."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data, width, height = 8, b"", 0, 0
    while at < len(png):
        length, kind = struct.unpack_from(">I4s", png, at)
        body = png[at + 8 : at + 8 + length]
        assert struct.unpack_from(">I", png, at + 8 + length)[0] == zlib.crc32(kind + body)
        if kind == b"IHDR":
            width, height, *rest = struct.unpack(">IIBBBBB", body)
            assert rest == [8, 6, 0, 0, 0]
        if kind == b"IDAT":
            data += body
        at += 12 + length
    rows = zlib.decompress(data)
    size = width * 4 + 1
    assert len(rows) == size * height
    assert all(rows[start] == 0 for start in range(0, len(rows), size))
    flat = b"".join(rows[start + 1 : start + size] for start in range(0, len(rows), size))
    return width, height, [tuple(flat[at : at + 4]) for at in range(0, len(flat), 4)]


def test_qoi_every_kind_of_tag():
    body = (
        (0xFE, 10, 20, 30),  # colours
        (0xFF, 10, 20, 30, 128),  # with opacity
        (0b01_11_00_10,),  # red +1, green -2, blue +0
        (0b10_101000, 0b1001_0110),  # green +8, red +9, blue +6
        (0xC1,),  # twice more
        ((10 * 3 + 20 * 5 + 30 * 7 + 255 * 11) % 64,),  # the first again
    )
    png = qoi.png_of(qoi_of(7, 1, *(byte for tag in body for byte in tag)))
    first, last = (10, 20, 30, 255), (20, 26, 36, 128)
    assert pixels_of(png) == (
        7,
        1,
        [first, (10, 20, 30, 128), (11, 18, 30, 128), last, last, last, first],
    )


def test_qoi_wraps_around_and_spans_rows():
    # black and opaque at the beginning; two less than nothing is 254
    png = qoi.png_of(qoi_of(2, 2, 0b01_00_10_10, 0xC2))
    assert pixels_of(png) == (2, 2, [(254, 0, 0, 255)] * 4)


@pytest.mark.parametrize(
    "data",
    [
        b"qoif",
        qoi_of(0, 5),
        qoi_of(60_000, 60_000),
        qoi_of(2, 2, 0xFE, 1, 2)[:-8],
        b"nope" + qoi_of(1, 1, 0xC0)[4:],
    ],
)
def test_broken_qoi_is_none(data):
    with pytest.raises(qoi.NotQoi):
        qoi.png_of(data)
    assert picture(base64.b64encode(data).decode()) is None


def read(data):
    return picture(base64.b64encode(data).decode())


PNG = qoi.png_of(qoi_of(2, 2, 0xFE, 1, 2, 3, 0xC2))
JPEG = b"\xff\xd8\xff\xe0 what is between \xff\xd9"


@pytest.mark.parametrize(("data", "kind"), [(PNG, "image/png"), (JPEG, "image/jpeg")])
def test_a_picture_is_what_its_bytes_say(data, kind):
    assert read(data) == Picture(kind, data)
    # slicers fill up
    assert read(data + b"\0\0") == Picture(kind, data + b"\0\0")
    for end in range(len(data)):
        assert read(data[:end]) is None


def test_a_png_that_is_wrong_in_one_byte_is_none():
    for at in range(len(PNG)):
        assert read(PNG[:at] + bytes((PNG[at] ^ 4,)) + PNG[at + 1 :]) is None


@pytest.mark.parametrize("letters", ["", "QUJD", "no base64!", "PHN2Zz4=", "é"])
def test_other_bytes_are_no_picture(letters):
    assert picture(letters) is None


def thumbnail(width, size=100):
    return Thumbnail("png", width, width, 1, size)


def test_the_biggest_that_is_not_too_big_is_best():
    found = [thumbnail(32), thumbnail(300), thumbnail(640), thumbnail(160)]
    assert best(found) == thumbnail(300)
    assert best([thumbnail(300, 1_000_000), thumbnail(32)]) == thumbnail(32)
    assert best([thumbnail(640)]) is None


def test_what_is_no_thumbnail_is_left_out():
    whole = {"format": "qoi", "width": 8, "height": 9, "offset": 7, "size": 12}
    members = {
        "fileName": PATH,
        "thumbnails": [None, {**whole, "format": "svg"}, {**whole, "size": "x"}, whole],
    }
    assert print_file(members).thumbnails == (Thumbnail("qoi", 8, 9, 7, 12),)
    assert print_file({"fileName": None}) is None


def test_a_file_and_its_absence():
    request = FileRequest(PATH)
    text = f'{{"err":0,"fileName":"{PATH}","size":12,"lastModified":"2024-11-04T20:21:00"}}'
    assert answer_to(request, text)[:2] == (12, "2024-11-04T20:21:00")
    assert answer_to(request, text.replace("a.g", "b.g")) is None
    assert answer_to(request, '{"err":1}') is NoFile
    assert answer_to(request, f'{{"err":1,"fileName":"{PATH}"}}') is NoFile
    assert request.line == f'M36 "{PATH}"'


def test_a_piece():
    request = PieceRequest(PATH, 50)
    text = f'{{"thumbnail":{{"fileName":"{PATH}","offset":50,"data":"QUJD","next":90,"err":0}}}}'
    assert answer_to(request, text) == (PATH, 50, "QUJD", 90, 0)
    assert answer_to(PieceRequest(PATH, 51), text) is None
    assert request.line == f'M36.1 P"{PATH}" S50'


@pytest.mark.parametrize(
    ("asked", "text"),
    [
        (PieceRequest(PATH, 1), '{"thumbnail":7}'),
        (PieceRequest(PATH, 1), '{"thumbnail":{"fileName":"x","offset":1,"data":8}}'),
        (PieceRequest(PATH, 1), '{"thumbnail":{"fileName":"x"'),
        (FileRequest(PATH), '{"err":-1}'),
    ],
)
def test_what_is_no_answer_is_malformed(asked, text):
    with pytest.raises(MalformedReply):
        answer_to(asked, text)
