"""Requests as paths of a board's network, answers in the form that a line has."""

import json

import pytest

from octoprint_rrfmodel.rrf.follow.asked import answer_to
from octoprint_rrfmodel.rrf.wire.request import (
    FileRequest,
    JobFileRequest,
    ListRequest,
    ModelRequest,
    PieceRequest,
    StatusRequest,
)
from octoprint_rrfmodel.rrf.wire.rr import line_form, path_of, request_path

PATHS = (
    (ModelRequest("", "d99fin"), "/rr_model?key=&flags=d99fin"),
    (ModelRequest("heat.heaters[]", "d99vno"), "/rr_model?key=heat.heaters%5B%5D&flags=d99vno"),
    (ModelRequest("#tools", ""), "/rr_model?key=%23tools&flags="),
    (ModelRequest("global.my_value", "d99vno"), "/rr_model?key=global.my_value&flags=d99vno"),
    (ListRequest("0:/gcodes", 60), "/rr_filelist?dir=0%3A%2Fgcodes&first=60"),
    (FileRequest("0:/gcodes/a b&c.g"), "/rr_fileinfo?name=0%3A%2Fgcodes%2Fa%20b%26c.g"),
    (PieceRequest("0:/gcodes/ü.g", 105), "/rr_thumbnail?name=0%3A%2Fgcodes%2F%C3%BC.g&offset=105"),
)


@pytest.mark.parametrize(("request_", "path"), PATHS)
def test_request_is_a_path(request_, path):
    assert request_path(request_) == path


@pytest.mark.parametrize(
    "request_",
    [
        StatusRequest(3),
        JobFileRequest(),
        # up to 3.5 what can't be evaluated may reset a board
        ModelRequest("move.axes[", ""),
        ModelRequest("a b", ""),
        ModelRequest("heat[-1]", ""),
        ModelRequest("state.status\nM112", ""),
        ModelRequest("state", "d99 f"),
    ],
)
def test_what_is_not_asked_this_way_has_no_path(request_):
    assert request_path(request_) is None


def test_escapes_have_capitals_and_no_plus():
    """Boards refuse lower-case digits, and take a plus for a blank."""
    assert path_of("gcode", gcode="\nM112") == "/rr_gcode?gcode=%0AM112"
    assert path_of("gcode", gcode='M117 "~+%"') == "/rr_gcode?gcode=M117%20%22~%2B%25%22"
    assert path_of("disconnect") == "/rr_disconnect"


def test_thumbnail_is_read_as_over_a_line():
    piece = {"fileName": "a.g", "offset": 105, "data": "QUJD", "next": 0, "err": 0}
    request = PieceRequest("a.g", 105)
    text = line_form(request, json.dumps(piece, separators=(",", ":")) + "\n")
    assert text.startswith(request.begins)
    assert answer_to(request, text).data == "QUJD"


def test_other_answers_stay_as_they_are():
    assert line_form(ModelRequest("", ""), '{"key":""}\n') == '{"key":""}'
