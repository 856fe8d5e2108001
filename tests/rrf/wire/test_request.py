"""Requests as G-code."""

import pytest

from octoprint_rrfmodel.rrf.wire.request import (
    FLAGS_LENGTH,
    KEY_FLAGS,
    KEY_LENGTH,
    LIVE_FLAGS,
    ModelRequest,
    StatusRequest,
)


@pytest.mark.parametrize(
    ("key", "flags", "line"),
    [
        ("", "d99fin", 'M409 K"" F"d99fin"'),
        ("heat.heaters[0]", "", 'M409 K"heat.heaters[0]" F""'),
        ("#tools", "f", 'M409 K"#tools" F"f"'),
        ('a"b', '"', 'M409 K"a""b" F""""'),
        ("it's", "'", "M409 K\"it''s\" F\"''\""),
    ],
)
def test_model_request_is_quoted_as_the_firmware_reads_it(key, flags, line):
    assert ModelRequest(key, flags).line == line


@pytest.mark.parametrize("form", range(6))
def test_status_request_names_its_form(form):
    assert StatusRequest(form).line == f"M408 S{form}"


def test_own_flags_are_short_enough_and_ask_for_nulls():
    assert (KEY_LENGTH, FLAGS_LENGTH) == (100, 20)
    for flags in (LIVE_FLAGS, KEY_FLAGS):
        assert len(flags + "a99999") <= FLAGS_LENGTH
        assert "n" in flags
    assert "i" in LIVE_FLAGS, "the message box is not live"
    assert {"v", "o"} <= set(KEY_FLAGS)
