"""OctoPrint's files of one storage, told alike by 1.11 and 2.0; any thread that may wait calls it.

It asks OctoPrint's file manager, which fires its events and analyses what is new; what OctoPrint's
own API looks at before it (``server/api/files.py``) is looked at here too.
"""

import logging
from typing import Any, NamedTuple

from flask_babel import gettext
from octoprint.events import Events
from octoprint.filemanager import FileDestinations, get_file_type
from octoprint.filemanager.storage import StorageError
from octoprint.filemanager.util import DiskFileWrapper

from .answers import RequestRefused
from .version import IS_2

LOCAL = FileDestinations.LOCAL

_LOGGER = logging.getLogger("octoprint.plugins.rrfmodel.print_files")

BUSY = ("is_printing", "is_paused", "is_pausing", "is_resuming", "is_cancelling", "is_finishing")
"""What OctoPrint's printer may be doing with its file."""

STARTING = "STARTING"
"""The printer's state while a script runs before the first line of a file: what is asked of the
print then is forgotten, OctoPrint goes on to printing behind the script."""

STATUSES = {
    StorageError.ALREADY_EXISTS: 409,
    StorageError.NOT_EMPTY: 409,
    StorageError.DOES_NOT_EXIST: 404,
    StorageError.INVALID_SOURCE: 404,
    StorageError.INVALID_FILE: 415,
    StorageError.INVALID_DESTINATION: 400,
    StorageError.SOURCE_EQUALS_DESTINATION: 400,
}
"""Of refusals by OctoPrint, whose own texts tell where its folders are; any other is a 500."""


class StoredFile(NamedTuple):
    """A file or folder."""

    path: str
    """In the storage, without a slash in front."""
    size: int
    modified: float
    """Unix time in whole seconds, 0 for unknown."""
    is_folder: bool = False
    is_printable: bool = False
    analysis: Any = None
    """OctoPrint's, as plain values; ``None`` before there is one."""


class PrintFiles:
    """The files of storage ``name``; ``files()`` is OctoPrint's file manager.

    ``printer()`` is its printer, ``fire(event, payload)`` tells of an event.
    """

    def __init__(self, name, files, printer, *, fire):
        self.name = name
        self._files = files
        self._printer = printer
        self._fire = fire

    ##~~ what is there

    def entries(self, folder="", recursive=False):
        """Return what is in a folder; with ``recursive`` the files of those below it, too."""
        manager = self._files()
        places = {"locations": [self.name], "path": folder or None, "recursive": recursive}
        listed = manager.list_storage_entries if IS_2 else manager.list_files
        nodes = list(listed(**places).get(self.name, {}).values())
        found = []
        while nodes:
            node = _plain(nodes.pop(0))
            found.append(_stored(node))
            nodes.extend((node["children"] or {}).values() if recursive else ())
        return found

    def find(self, path):
        """Return a file or folder by its path, ``None`` for none."""
        if not self._is_name(path):
            return None
        manager = self._files()
        if not path or manager.folder_exists(self.name, path):
            date = manager.last_modified(self.name, path or None)
            return StoredFile(path, 0, _second(date), is_folder=True)
        if not manager.file_exists(self.name, path):
            return None
        kind = get_file_type(path)
        told = manager.get_metadata(self.name, path) or {}
        return StoredFile(
            path,
            max(0, manager.get_size(self.name, path) or 0),
            _second(manager.get_lastmodified(self.name, path)),
            is_printable=bool(kind) and kind[0] == "machinecode",
            analysis=told.get("analysis"),
        )

    def on_disk(self, path=""):
        """Return where a file or folder of OctoPrint's own is."""
        return self._files().path_on_disk(self.name, path)

    def read(self, path):
        """Return what to read a file from, which may have to be fetched first; 2.0 alone."""
        return self._asked("read_file", path)

    def _is_name(self, path):
        """Return whether a file of that name can be there."""
        try:
            return all(self._files().sanitize_name(self.name, p) == p for p in path.split("/") if p)
        except ValueError:
            return False

    ##~~ what is done to them

    def in_use(self, path):
        """Return whether a file is printed or worked on, or one in a folder."""
        manager, printer = self._files(), self._printer()
        in_hand = list(manager.get_busy_files())
        if any(getattr(printer, name)() for name in BUSY):
            in_hand.append(self._current())
        return any(
            storage == self.name and busy and manager.file_in_path(self.name, path, busy)
            for storage, busy in in_hand
        )

    def delete(self, found):
        """Delete a file, or a folder with all that is in it."""
        self._refuse_in_use(found.path)
        self._deselect(found.path)
        self._asked("remove_folder" if found.is_folder else "remove_file", found.path)

    def move(self, found, target):
        """Move a file or folder; return its new path."""
        self._refuse_in_use(found.path)
        target = self.name_for(target)
        if self.find(target) is not None:
            raise _refused(StorageError.ALREADY_EXISTS)
        self._deselect(found.path)
        self._asked("move_folder" if found.is_folder else "move_file", found.path, target)
        return target

    def make_folder(self, path):
        """Make a folder; return its path as it has become."""
        path = self.name_for(path)
        if self.find(path) is not None:
            raise _refused(StorageError.ALREADY_EXISTS)
        return self._asked("add_folder", path)

    def add(self, path, source, user):
        """Take the file at ``source`` on this disk, which is gone then; return its path."""
        path = self.name_for(path)
        self._refuse_in_use(path)
        was_selected = self._current() == (self.name, path)
        name = path.rpartition("/")[2]
        added = self._asked(
            "add_file", path, DiskFileWrapper(name, source), allow_overwrite=True, user=user
        )
        if was_selected:
            # it has another size now
            self.select(added, user, is_printed=False)
        return added

    def tell_of_upload(self, path, is_printed):
        """Fire OctoPrint's event of an upload."""
        told = {"select": False, "print": is_printed}
        effective = {f"effective_{name}": value for name, value in told.items()}
        name = path.rpartition("/")[2]
        payload = {"name": name, "path": path, "target": self.name, **told, **effective}
        self._fire(Events.UPLOAD, payload)

    def name_for(self, path):
        """Return the path that a new file gets: OctoPrint has some letters otherwise."""
        manager = self._files()
        try:
            named = "/".join(manager.sanitize_name(self.name, part) for part in path.split("/"))
        except ValueError:
            named = ""
        if not named or not all(named.split("/")):
            raise RequestRefused(400, gettext("A file can't have that name."))
        return named

    def analyse(self, path):
        """Have a file analysed anew, some time."""
        self._files().analyse(self.name, path)

    def select(self, path, user, is_printed):
        """Let OctoPrint have a file for its next print, and begin it."""
        printer, manager = self._printer(), self._files()
        if IS_2:
            job = manager.create_job(self.name, path, owner=user)
            printer.set_job(job, print_after_select=is_printed)
        else:
            printer.select_file(self.on_disk(path), False, is_printed, user=user)

    def _refuse_in_use(self, path):
        if self.in_use(path):
            raise RequestRefused(
                409, gettext("%(path)s is being printed or worked on.", path=path or self.name)
            )

    def _deselect(self, path):
        storage, current = self._current()
        is_it = storage == self.name and current
        if is_it and self._files().file_in_path(self.name, path, current):
            printer = self._printer()
            printer.set_job(None) if IS_2 else printer.unselect_file()

    def _current(self):
        """Return storage and path of the file that OctoPrint has for its next print."""
        file = (self._printer().get_current_job() or {}).get("file") or {}
        return file.get("origin"), file.get("path")

    def _asked(self, name, *arguments, **named):
        try:
            return getattr(self._files(), name)(self.name, *arguments, **named)
        except StorageError as error:
            if self.name != LOCAL and str(error).endswith("."):
                # a sentence of the plugin's own, about the card
                raise RequestRefused(409, str(error)) from None
            raise _refused(error.code) from None
        except (OSError, ValueError) as error:
            _LOGGER.warning("OctoPrint could not %s: %s", name, error)
            raise _refused(None) from None


NODE = ("path", "size", "date", "children", "analysis")


def _refused(code):
    texts = {
        StorageError.ALREADY_EXISTS: gettext("There is a file or folder of that name already."),
        StorageError.NOT_EMPTY: gettext("The folder is not empty."),
        StorageError.DOES_NOT_EXIST: gettext("There is no such file or folder."),
        StorageError.INVALID_SOURCE: gettext("There is no such file or folder."),
        StorageError.INVALID_FILE: gettext("OctoPrint takes no files of that kind."),
        StorageError.INVALID_DESTINATION: gettext("There is no such folder to put it into."),
        StorageError.SOURCE_EQUALS_DESTINATION: gettext("Both names are the same."),
    }
    otherwise = gettext("OctoPrint could not do that. Look at its log.")
    return RequestRefused(STATUSES.get(code, 500), texts.get(code, otherwise))


def _plain(node):
    """Return an entry of OctoPrint's list, a dictionary in 1.11 and an object in 2.0."""
    if isinstance(node, dict):
        return {**{name: node.get(name) for name in NODE}, "kind": node["typePath"]}
    found = {name: getattr(node, name, None) for name in NODE}
    metadata = getattr(node, "metadata", None)
    analysis = metadata.analysis if metadata else None
    found["analysis"] = analysis.model_dump() if analysis else None
    return {**found, "kind": node.type_path}


def _second(date):
    """Return a time as all of OctoPrint's ways to ask for it agree on it."""
    return float(max(0, int(date or 0)))


def _stored(node):
    date, kind = node["date"], node["kind"][0]
    return StoredFile(
        node["path"].strip("/"),
        node["size"] or 0,
        _second(date.timestamp() if hasattr(date, "timestamp") else date),
        is_folder=kind == "folder",
        is_printable=kind == "machinecode",
        analysis=node["analysis"],
    )
