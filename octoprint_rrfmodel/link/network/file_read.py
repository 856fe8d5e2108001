"""A file of the board's card, read to its end or refused: no part of one is given for the whole."""

import http.client

from ...rrf.wire.reply import MalformedReply, members_of
from ...rrf.wire.request import FileRequest
from .card_refused import FAILURES, CardRefused
from .session import SessionLost
from .transport import PIECE, Unreachable

BROKEN = (Unreachable, OSError, http.client.HTTPException, ValueError)
"""What reading of a response may raise."""


def facts_of(dialect, path):
    """Return what the card says of a file: ``err`` is 0 for one that is there, which has ``size``.

    Raises ``CardRefused`` for an answer that says neither.
    """
    try:
        told = members_of(dialect.read(FileRequest(path)))
    except MalformedReply:
        told = {}
    # what was garbled on its way may be JSON still
    if type(told.get("err")) is not int or not told["err"] and type(told.get("size")) is not int:
        raise CardRefused("not_whole", path.rpartition("/")[2])
    return told


def pieces_of(files, path, size=None, *, most):
    """Give the bytes of a file as they come; raise ``CardRefused`` unless all of them do.

    ``files`` are the board's (``dialect.Files``), ``size`` is what it is known to have. One that
    is larger than ``most`` bytes isn't begun.
    """
    name = path.rpartition("/")[2]
    with _opened(files, path, most) as response:
        if response.status == 404:
            raise CardRefused("gone", name)
        length = response.length
        # whatever else answers in the board's place has another length, or none
        if response.status != 200 or length is None or size not in (None, length):
            raise CardRefused("not_whole", name)
        if length > most:
            raise CardRefused("large", name)
        while length:
            piece = _read(response, min(PIECE, length), name)
            length -= len(piece)
            yield piece


def whole_file(files, path, size=None, *, most):
    """Return the bytes of a small file; as ``pieces_of``."""
    return b"".join(pieces_of(files, path, size, most=most))


def _opened(files, path, most):
    try:
        try:
            return files.open(path, most)
        except SessionLost:
            # nothing was read yet, and the next request logs in
            return files.open(path, most)
    except FAILURES as error:
        raise CardRefused("unreachable", str(error) or "no answer") from None


def _read(response, count, name):
    try:
        piece = response.read(count)
    except BROKEN:
        piece = b""
    if not piece:
        raise CardRefused("not_whole", name)
    return piece
