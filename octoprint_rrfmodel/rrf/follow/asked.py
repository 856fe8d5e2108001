"""Answers to what somebody asks the board, besides what its model is followed with."""

from __future__ import annotations

from typing import Any, Callable

from ..card.thumbnail import Piece, PrintFile, decode_file, decode_piece
from ..wire.line import NO_BUFFERS
from ..wire.reply import FolderPage, MalformedReply, ModelReply, decode, decode_page
from ..wire.request import FileRequest, ListRequest, ModelRequest, PieceRequest
from .follower import answers

NO_ROOM = "the printer had no room for this answer"


class NoFile:
    """Answers for a file that the board hasn't got."""


def _model(request: ModelRequest, text: str) -> ModelReply | None:
    reply = decode(text)
    if not isinstance(reply, ModelReply):
        raise MalformedReply(NO_ROOM)
    return reply if answers(reply, request) else None


def _page(request: ListRequest, text: str) -> FolderPage | None:
    page = decode_page(text)
    is_it = page.folder.rstrip("/") == request.folder and page.first == request.first
    return page if is_it else None


def _file(request: FileRequest, text: str) -> PrintFile | type[NoFile] | None:
    name, file = decode_file(text)
    # of a file that isn't there some firmware doesn't repeat the name
    if name.lower() not in ("", request.path.lower()):
        return None
    return file or NoFile


def _piece(request: PieceRequest, text: str) -> Piece | None:
    piece = decode_piece(text)
    is_it = piece.path.lower() == request.path.lower() and piece.offset == request.offset
    return piece if is_it else None


READERS: dict[type, Callable[[Any, str], Any]] = {
    ModelRequest: _model,
    ListRequest: _page,
    FileRequest: _file,
    PieceRequest: _piece,
}
"""What reads the answer to each kind of request."""


def answer_to(request: Any, text: str) -> Any:
    """Return what a reply answers to the request, ``None`` where it answers another.

    Raises ``MalformedReply`` for one that can't be read, and where the board had no room for it.
    """
    if text == NO_BUFFERS:
        raise MalformedReply(NO_ROOM)
    return READERS[type(request)](request, text)
