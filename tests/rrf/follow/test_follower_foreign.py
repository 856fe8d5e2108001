"""Letters beyond ASCII: a name that somebody gave, or a broken byte that makes another name."""

import pytest

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply, decode, foreign_strings
from octoprint_rrfmodel.rrf.wire.request import KEY_FLAGS

from ..board import Board, following, serve


def keyed(board):
    return [request.key for request in board.asked if request.flags == KEY_FLAGS]


def test_a_name_with_such_letters_is_asked_for_twice_and_no_more():
    board = Board()
    board.model["network"] = {"name": "Größe", "interfaces": []}
    follower = following(board)
    serve(follower, board, 40)
    assert keyed(board).count("network") == 2
    assert follower.store.model["network"]["name"] == "Größe"


def test_live_values_beside_such_a_name_change_nothing_about_that():
    board = Board()
    board.model["state"]["displayMessage"] = "Grüß Gott"
    follower = following(board)
    for _ in range(30):
        board.model["state"]["upTime"] += 1
        serve(follower, board, 1)
    assert keyed(board).count("state") == 2


def test_a_broken_byte_in_a_text_is_put_right():
    board = Board()
    board.model["network"] = {"name": "Printer", "interfaces": []}
    follower = Follower()
    was_broken = False
    for _ in range(80):
        request = follower.next_request()
        text = board.reply(request)
        if getattr(request, "key", "") == "network" and not was_broken:
            was_broken = True
            text = text.replace("Printer", "Pr\xe9nter")
        follower.take(text)
    assert was_broken
    assert follower.store.model["network"]["name"] == "Printer"


@pytest.mark.parametrize(
    "text",
    [
        '{"key":"heat","flags":"f","result":{"h\xe9aters":[]}}',
        '{"key":"","flags":"d99fin","result":{"heat":{"a":1,"b\xff":2}}}',
    ],
)
def test_a_member_with_such_a_name_is_none(text):
    with pytest.raises(MalformedReply):
        decode(text)


@pytest.mark.parametrize(
    "text, strings",
    [
        ('{"a":"plain"}', ()),
        ('{"a":"gr\xfcn","b":"x","c":"\xb0"}', ('"gr\xfcn"', '"\xb0"')),
    ],
)
def test_foreign_strings(text, strings):
    assert foreign_strings(text) == strings
