"""The board's card: what to ask about it, what is on it, and short names for hosts.

A host of the Marlin kind knows files by short names in one folder, as the old FAT had them. Each
file on the card therefore has an alias (``square.gco``), which stands for its path.
"""

from __future__ import annotations

import os
import re
import threading
import unicodedata
import zlib
from collections.abc import Iterable, Mapping
from datetime import datetime
from typing import Any, NamedTuple

from ..wire.reply import FolderPage
from ..wire.request import ListRequest

ROOT = "0:/gcodes"
"""Where the firmware has its G-code files; relative names mean this folder."""

PRINTABLE = (".gcode", ".gco", ".g", ".gc", ".nc", ".ngc", ".tap")
"""Endings of files that can be printed."""

DEEPEST = 8
MOST_FOLDERS = 200
MOST_FILES = 5000
"""How much of a card is looked at: folders below each other, folders, files."""

PATIENCE = 3
"""Failures in a row after which a list is given up until the card changes."""

EARLIEST = 1_000_000_000
"""Unix time; a file's date before it comes from a board whose clock wasn't set."""

_PLAIN = re.compile(r"[a-z0-9][a-z0-9_]{0,7}")
"""A name's stem that is its own alias."""

_DIGITS = "0123456789abcdefghijklmnopqrstuvwxyz"


class CardFile(NamedTuple):
    """A file that can be printed."""

    path: str
    """``0:/gcodes/folder/name.gcode``."""
    size: int
    date: str = ""
    """As the board tells it; see ``FolderEntry``."""

    @property
    def name(self) -> str:
        """Return the path below the folder for G-code."""
        return self.path[len(ROOT) + 1 :]

    @property
    def modified(self) -> int | None:
        """Return the Unix time of the last change, ``None`` where the board had no clock.

        The board's clock shows local time, and the host's place is the board's.
        """
        try:
            found = int(datetime.fromisoformat(self.date).timestamp())
        except (ValueError, OverflowError, OSError):
            return None
        return found if found >= EARLIEST else None


class CardIndex:
    """The files of a card by alias and by path; never changed once made."""

    def __init__(self, files: Mapping[str, CardFile]) -> None:
        self.files = files
        """By alias."""
        self._aliases = {file.path.lower(): alias for alias, file in files.items()}

    def alias_of(self, path: str) -> str | None:
        """Return the alias of a file; names compare without case, as on the card."""
        return self._aliases.get(path.lower())

    def file_of(self, alias: str) -> CardFile | None:
        """Return the file that an alias stands for; a host may put a slash in front."""
        return self.files.get(alias.lstrip("/").lower())


EMPTY = CardIndex({})


class Aliases:
    """Gives each path an alias of its own, always the same one; any thread may ask."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._aliases: dict[str, str] = {}
        self._taken: set[str] = set()

    def index(self, files: Iterable[CardFile]) -> CardIndex:
        """Return the files with their aliases."""
        with self._lock:
            # a name that is one already keeps it
            ordered = sorted(files, key=lambda file: (not file.path.lower().endswith(".gco"), file))
            named = {self._alias_of(file.path): file for file in ordered}
        return CardIndex(dict(sorted(named.items(), key=lambda item: item[1].name.lower())))

    def _alias_of(self, path: str) -> str:
        key = path.lower()
        alias = self._aliases.get(key)
        if alias is None:
            alias = next(name for name in _candidates(key) if name not in self._taken)
            self._aliases[key] = alias
            self._taken.add(alias)
        return alias


def _candidates(path: str) -> Iterable[str]:
    """Yield possible aliases of a path in lower case, the nicest first.

    At most eight characters, an ending of one to three, nothing but letters, digits and ``_``:
    whatever a host does to make a DOS name of it leaves it as it is.
    """
    folder, _, name = path.rpartition("/")
    stem, ending = os.path.splitext(name)
    ending = ".g" if ending == ".g" else ".gco"
    if folder == ROOT and _PLAIN.fullmatch(stem):
        yield stem + ending
    letters = unicodedata.normalize("NFKD", stem).encode("ascii", "ignore").decode()
    begin = re.sub("[^a-z0-9]", "", letters)[:3] or "f"
    # of the path and nothing else, so that it is the same after the next connection
    for attempt in range(MOST_FILES + 1):
        number = zlib.crc32(f"{path}/{attempt}".encode("utf-8", "surrogatepass"))
        digits = "".join(_DIGITS[number // 36**place % 36] for place in range(4))
        yield f"{begin}_{digits}{ending}"


def path_of(name: str) -> str:
    """Return the full path of a name as a command gives it (3.5 MassStorage.cpp CombineName)."""
    name = name.replace("\\", "/")
    if name[1:2] == ":":
        return name
    return f"0:{name}" if name.startswith("/") else f"{ROOT}/{name}"


class _Walk:
    """One look at the card, folder by folder, page by page."""

    def __init__(self) -> None:
        self.request = ListRequest(ROOT)
        self.files: list[CardFile] = []
        self.folders: list[str] = []
        self._folders: list[tuple[str, int]] = []
        self._seen = 1
        self._depth = 0

    def take(self, page: FolderPage) -> bool:
        """Take a page; return whether it was the last one."""
        folder = self.request.folder
        for entry in page.entries:
            path = f"{folder}/{entry.name}"
            if not path.isprintable():
                continue
            if not entry.is_folder:
                if path.lower().endswith(PRINTABLE):
                    self.files.append(CardFile(path, entry.size, entry.date))
            # a comment begins at a semicolon wherever a host looks at the line first
            elif self._depth < DEEPEST and self._seen < MOST_FOLDERS and ";" not in path:
                self._seen += 1
                self.folders.append(path)
                self._folders.append((path, self._depth + 1))
        if len(self.files) >= MOST_FILES:
            del self.files[MOST_FILES:]
            return True
        # a board that says it has more and sends nothing must not be asked forever
        if page.entries and page.next > self.request.first:
            self.request = ListRequest(folder, page.next)
            return False
        if not self._folders:
            return True
        path, self._depth = self._folders.pop(0)
        self.request = ListRequest(path)
        return False


class CardPlan:
    """What to ask about the card, and what is known of it. Sends nothing and knows no clock."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Begin anew: another connection, perhaps another board."""
        self.index: CardIndex | None = None
        """What is on the card; ``None`` before the first list, and where none can be had."""
        self.folders: tuple[str, ...] = ()
        """The folders of that list, each with its whole path."""
        self.aliases = Aliases()
        self._walk: _Walk | None = None
        self._counter: Any = (None, None)
        self._failures = 0
        self._wanted = True

    @property
    def behind(self) -> bool:
        """Whether there is something to ask."""
        return self._wanted or self._walk is not None

    @property
    def notices_changes(self) -> bool:
        """Whether the board counts changes of the card (``M409`` only)."""
        return self._counter[0] is not None

    def observe(self, model: Mapping[str, Any]) -> None:
        """Look whether the card has changed or was put in or out."""
        counter = _first(model.get("seqs"), "volChanges"), _mounted(model)
        if counter != self._counter:
            self._counter = counter
            self._wanted = True

    def refetch(self) -> None:
        """Want the list again."""
        self._wanted = True

    def next_request(self) -> ListRequest | None:
        """Return what to ask now; the same again until it was answered or given up."""
        if self._walk is None:
            if not self._wanted:
                return None
            self._wanted = False
            self._walk = _Walk()
        return self._walk.request

    def take(self, page: FolderPage) -> bool:
        """Take the answer to ``next_request``; return whether it is one."""
        walk = self._walk
        if walk is None:
            return False
        asked = walk.request
        if page.folder.rstrip("/") != asked.folder or page.first != asked.first:
            return False
        self._failures = 0
        if walk.take(page):
            self._walk = None
            self.folders = tuple(walk.folders)
            self.index = self.aliases.index(walk.files)
        return True

    def failed(self) -> None:
        """Note that ``next_request`` brought nothing; it is asked again, but not for ever."""
        self._failures += 1
        if self._failures >= PATIENCE:
            self._failures = 0
            self._walk = None


def _first(parent: Any, member: str) -> Any:
    values = parent.get(member) if isinstance(parent, Mapping) else None
    return values[0] if isinstance(values, list) and values else None


def _mounted(model: Mapping[str, Any]) -> Any:
    volume = _first(model, "volumes")
    return volume.get("mounted") if isinstance(volume, Mapping) else None
