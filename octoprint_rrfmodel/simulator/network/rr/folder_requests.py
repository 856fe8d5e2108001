"""Folders and files of the card: lists, downloads, and what changes them."""

from __future__ import annotations

from ...device.card import Card
from ...device.job import Job
from ...device.network_access import NetworkAccess
from ...device.printing.file_text import MANY, SLOT, FolderText, Page
from ...line.output import Output
from ...model.tree import ObjectModel
from .answers import OUT_OF_BUFFERS, error_answer, file_answer, rejection, text_answer
from .output_buffers import OutputBuffers
from .request_parser import Request
from .requests import RequestRow, RequestRows, needed

LONGEST_ENTRY = 160
"""Bytes that stay free behind the last entry of a page (twice a name, and 50)."""
GCODES = "0:/gcodes/"


class FolderRequests:
    """Lists folders, and hands out files."""

    def __init__(
        self, card: Card, folders: FolderText, *, buffers: OutputBuffers, access: NetworkAccess
    ):
        self._card = card
        self._folders = folders
        self._buffers = buffers
        self._access = access

    def requests(self) -> RequestRows:
        return {
            "filelist": RequestRow(self._details),
            "files": RequestRow(self._names),
            "download": RequestRow(self._download),
        }

    def _page(self, request: Request, asked: str) -> Page:
        """Paths without a drive are those of the first one, whatever they begin with."""
        most = self._buffers.room - LONGEST_ENTRY
        count = request.number("max") or MANY
        return Page(asked, self._card.path_of(asked, SLOT), request.number("first"), most, count)

    def _text(self, text: str) -> bytes:
        if self._buffers.free == 0:
            return OUT_OF_BUFFERS
        return text_answer(text + "\n", self._access.cors_site)

    def _details(self, request: Request) -> bytes:
        page = self._page(request, needed(request, "dir"))
        return self._text(self._folders.details(page))

    def _names(self, request: Request) -> bytes:
        page = self._page(request, request.parameter("dir") or GCODES)
        return self._text(self._folders.names(page, request.number("flagdirs") == 1))

    def _download(self, request: Request) -> bytes:
        path = self._card.path_of(needed(request, "name"), SLOT)
        content = self._card.read(path)
        if content is None:
            return rejection(404, "file not found", self._access.cors_site)
        return file_answer(path, content, self._access.cors_site)


class ChangeRequests:
    """Makes, renames and deletes."""

    def __init__(
        self,
        *,
        card: Card,
        job: Job,
        model: ObjectModel,
        output: Output,
        access: NetworkAccess,
        says_why: bool,
    ):
        self._card = card
        self._job = job
        self._model = model
        self._output = output
        self._access = access
        self._says_why = says_why

    def requests(self) -> RequestRows:
        return {
            "mkdir": RequestRow(self._make),
            "move": RequestRow(self._move),
            "delete": RequestRow(self._delete),
        }

    def _answer(self, is_done: bool) -> bytes:
        if is_done:
            self._model.volumes_changed(True)
        return error_answer(0 if is_done else 1, self._access.cors_site)

    def _make(self, request: Request) -> bytes:
        """One that is there already is an error."""
        path = self._card.path_of(request.parameter("dir") or "", SLOT)
        is_possible = self._card.is_mounted and self._card.may_be(path)
        is_new = is_possible and not self._card.has_folder(path)
        if is_new:
            self._card.make_folder(path)
        return self._answer(is_new)

    def _move(self, request: Request) -> bytes:
        """The drive of the new path is cut off: it stays on the old one."""
        old, new = request.parameter("old") or "", request.parameter("new") or ""
        if not old or not new or not self._card.is_mounted:
            return self._answer(False)
        source = self._card.path_of(old, SLOT)
        target = self._card.path_of(new.partition(":")[2] or new, SLOT)
        if not self._card.may_be(target):
            return self._answer(False)
        if self._card.name_of(target) is not None and source.lower() != target.lower():
            if request.parameter("deleteexisting") != "yes" or not self._exists(source):
                return self._answer(False)
            self._card.delete(target)
        elif self._card.has_folder(target):
            return self._answer(False)
        return self._answer(self._card.rename(source, target))

    def _exists(self, path: str) -> bool:
        return self._card.name_of(path) is not None or self._card.has_folder(path)

    def _delete(self, request: Request) -> bytes:
        path = self._card.path_of(needed(request, "name"), SLOT)
        if path.lower() == (self._job.printed_path or "").lower():
            self._output.text(f"Error: Cannot delete file {path} because it is open\n")
            return self._answer(False)
        wants_all = request.parameter("recursive") == "yes" and path != SLOT and self._says_why
        is_done = self._card.delete_tree(path) if wants_all else self._card.delete(path)
        if not is_done and self._says_why:
            why = " because it is a folder and not empty" if self._card.has_folder(path) else ""
            self._output.text(f"Error: Failed to delete {path}{why}\n")
        return self._answer(is_done)
