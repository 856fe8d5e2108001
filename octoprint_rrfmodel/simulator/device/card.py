"""A virtual SD card: folders, names with blanks and other letters, files held in memory."""

from __future__ import annotations

import posixpath
from typing import NamedTuple

from ..text.letters import utf8
from .sample import SAMPLE_FILES, SAMPLE_FOLDERS

GCODES = "0:/gcodes"
SYSTEM = "0:/sys"
MACROS = "0:/macros"


class Entry(NamedTuple):
    """A file or a folder in a listing."""

    name: str
    is_folder: bool
    size: int
    date: str


class Card:
    """Files by their full path (``0:/gcodes/a.gcode``); names compare without case, as FAT does."""

    def __init__(self) -> None:
        self._files: dict[str, bytearray] = {}
        self._dates: dict[str, str] = {}
        self._folders: list[str] = []
        self.is_mounted = True
        for folder in SAMPLE_FOLDERS:
            self.make_folder(folder)
        for path, (date, content) in SAMPLE_FILES.items():
            self.write(path, content, date)

    @staticmethod
    def path_of(name: str, folder: str = GCODES) -> str:
        """Return the full path of a name as a command gives it, relative ones in ``folder``."""
        name = name.replace("\\", "/")
        if name[1:2] == ":":
            full = name
        elif name.startswith("/"):
            full = "0:" + name
        else:
            full = f"{folder}/{name}"
        return full[:2] + posixpath.normpath(full[2:] or "/").rstrip("/")

    def _stored(self, path: str) -> str | None:
        wanted = path.lower()
        return next((known for known in self._files if known.lower() == wanted), None)

    def has_folder(self, path: str) -> bool:
        wanted = path.lower()
        return path in ("0:", "0:/") or any(known.lower() == wanted for known in self._folders)

    def make_folder(self, path: str) -> None:
        while path not in ("0:", "0:/") and not self.has_folder(path):
            self._folders.append(path)
            path = posixpath.dirname(path)

    def write(self, path: str, content: str, date: str = "2024-11-05T08:10:00") -> None:
        """Make or replace a file, and the folders it is in."""
        self.make_folder(posixpath.dirname(path))
        stored = self._stored(path) or path
        self._files[stored] = bytearray(utf8(content))
        self._dates[stored] = date

    def append(self, path: str, text: str) -> None:
        self._files[self._stored(path) or path] += utf8(text)

    def read(self, path: str) -> bytes | None:
        """Return the content; ``None`` where there is no such file."""
        stored = self._stored(path) if self.is_mounted else None
        return None if stored is None else bytes(self._files[stored])

    def lines(self, path: str) -> list[str] | None:
        content = self.read(path)
        return None if content is None else content.decode("utf-8", "replace").splitlines()

    def name_of(self, path: str) -> str | None:
        """Return the path as the card spells it."""
        return self._stored(path)

    def date(self, path: str) -> str | None:
        stored = self._stored(path)
        return self._dates.get(stored) if stored else None

    def delete(self, path: str) -> bool:
        """Remove a file, or an empty folder; return whether there was one."""
        stored = self._stored(path)
        if stored is not None:
            del self._files[stored], self._dates[stored]
            return True
        if self.has_folder(path) and not self.entries(path):
            self._folders = [known for known in self._folders if known.lower() != path.lower()]
            return True
        return False

    def entries(self, folder: str) -> list[Entry]:
        """Return what is in a folder, folders among the files as the card has them."""
        inside = folder.rstrip("/").lower() + "/"
        found = [
            Entry(known[len(inside) :], True, 0, "2024-10-01T12:00:00")
            for known in self._folders
            if known.lower().startswith(inside) and "/" not in known[len(inside) :]
        ]
        for known, content in self._files.items():
            name = known[len(inside) :]
            if known.lower().startswith(inside) and "/" not in name:
                found.append(Entry(name, False, len(content), self._dates[known]))
        return found
