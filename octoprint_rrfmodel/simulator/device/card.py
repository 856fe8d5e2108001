"""A virtual SD card: folders, names with blanks and other letters, files held in memory."""

from __future__ import annotations

import posixpath
from typing import Any, NamedTuple

from ..text.letters import utf8
from .sample import SAMPLE_FILES, SAMPLE_FOLDERS

ROOTS = ("0:", "0:/")
REFUSED = frozenset('\\:*?"<>|')
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

    @staticmethod
    def may_be(path: str) -> bool:
        """Return whether a file or folder can have that path: FAT refuses some letters."""
        return path.startswith("0:/") and not REFUSED & set(path[2:])

    def _stored(self, path: str) -> str | None:
        wanted = path.lower()
        return next((known for known in self._files if known.lower() == wanted), None)

    def has_folder(self, path: str) -> bool:
        wanted = path.lower()
        return path in ROOTS or any(known.lower() == wanted for known in self._folders)

    def make_folder(self, path: str) -> None:
        while "/" in path and path not in ROOTS and not self.has_folder(path):
            self._folders.append(path)
            path = posixpath.dirname(path)

    def write(self, path: str, content: str, date: str = "2024-11-05T08:10:00") -> None:
        """Make or replace a file, and the folders it is in."""
        self.store(path, utf8(content), date)

    def store(self, path: str, content: bytes, date: str) -> None:
        """Make or replace a file of bytes, and the folders it is in."""
        self.make_folder(posixpath.dirname(path))
        stored = self._stored(path) or path
        self._files[stored] = bytearray(content)
        self._dates[stored] = date

    def append(self, path: str, text: str) -> None:
        self._files[self._stored(path) or path] += utf8(text)

    def add(self, path: str, data: bytes) -> None:
        """Write further bytes into a file, nowhere if it has gone meanwhile."""
        stored = self._stored(path)
        if stored is not None:
            self._files[stored] += data

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

    def delete_tree(self, path: str) -> bool:
        """Remove a file, or a folder with all that is in it; return whether there was one."""
        inside = path.lower() + "/"
        for known in [name for name in self._files if name.lower().startswith(inside)]:
            del self._files[known], self._dates[known]
        self._folders = [name for name in self._folders if not name.lower().startswith(inside)]
        return self.delete(path)

    def rename(self, old: str, new: str) -> bool:
        """Give a file or a folder another path; return whether there was one."""
        is_folder = self._stored(old) is None
        if is_folder and not self.has_folder(old):
            return False
        self.make_folder(posixpath.dirname(new))
        for kept in (self._files, self._dates):
            self._rename_keys(kept, old, new)
        self._folders = [_moved(name, old, new) for name in self._folders]
        return True

    def _rename_keys(self, kept: dict[str, Any], old: str, new: str) -> None:
        for name in [name for name in kept if _moved(name, old, new) != name]:
            kept[_moved(name, old, new)] = kept.pop(name)

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


def _moved(name: str, old: str, new: str) -> str:
    """Return what a path is called after ``old``, which it may lie in, has become ``new``."""
    if name.lower() == old.lower() or name.lower().startswith(old.lower() + "/"):
        return new + name[len(old) :]
    return name
