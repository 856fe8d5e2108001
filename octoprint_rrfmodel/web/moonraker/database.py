"""What clients keep for themselves: a JSON object for each of them, called a namespace.

Moonraker's rules: a key leads through objects, by a list of names or by one text with dots; what
lies on its way is made (Moonraker 0.9, ``docs/external_api/database.md``).
"""

import json
import string
import threading
from pathlib import Path
from urllib.parse import unquote

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...host.kept_json import KeptJson

FOLDER = "database"

LARGEST_ITEM = 256 * 1024
LARGEST = 5 * 1024 * 1024
"""Bytes of JSON of one value, and of all that is kept."""

MOST_NAMESPACES = 50
LONGEST_NAMESPACE = 64
LONGEST_FILE_NAME = 200
DEEPEST_KEY = 20
LONGEST_KEY = 200

DEEPEST_VALUE = 100
"""Levels of a value; what is much deeper can be read and not be written."""

PLAIN = frozenset(string.ascii_lowercase + string.digits + "_-")
"""What stands for itself in a file's name; capital letters don't, for some disks know none."""


class Database:
    """Keeps the namespaces in files, one each; any thread may call it.

    ``folder()`` is where the plugin may keep files. What can't be done raises ``RequestRefused``
    with a sentence, and then nothing has changed.
    """

    def __init__(self, folder):
        self._folder = folder
        self._lock = threading.Lock()
        self._spaces = None
        self._sizes = {}

    def names(self):
        """Return the names of all namespaces."""
        with self._lock:
            return sorted(self._read())

    def get(self, namespace, key=None):
        """Return what a key leads to, all of the namespace without one."""
        names = names_of(key) if key is not None else ()
        with self._lock:
            return _found(self._space(namespace), names)

    def put(self, namespace, key, value):
        """Keep a value at a key instead of what is there."""
        names = names_of(key)
        if not _is_shallow(value, DEEPEST_VALUE):
            raise RequestRefused(400, gettext("The value is nested too deep."))
        if _size(value) > LARGEST_ITEM:
            raise RequestRefused(400, gettext("The value is larger than 256 kB."))
        _check_namespace(namespace)
        with self._lock:
            spaces = self._read()
            if namespace not in spaces and len(spaces) >= MOST_NAMESPACES:
                raise RequestRefused(400, gettext("There are 50 namespaces, no more are kept."))
            self._keep(namespace, _with(spaces.get(namespace, {}), names, value))

    def delete(self, namespace, key):
        """Return what was at a key, and is no longer."""
        names = names_of(key)
        with self._lock:
            space = self._space(namespace)
            value = _found(space, names)
            self._keep(namespace, _without(space, names))
            return value

    def _space(self, namespace):
        spaces = self._read()
        if namespace not in spaces:
            raise RequestRefused(404, gettext("There is no such namespace."))
        return spaces[namespace]

    def _keep(self, namespace, space):
        """Write a namespace, or remove an empty one; then it is so in memory too."""
        others = {name: each for name, each in self._spaces.items() if name != namespace}
        size = _size(space)
        if size + sum(self._sizes[name] for name in others) > LARGEST:
            raise RequestRefused(400, gettext("The database is full, 5 MB are kept."))
        file = KeptJson(self._place, file_name(namespace))
        is_kept = file.write(space) if space else file.remove()
        if not is_kept:
            raise RequestRefused(500, gettext("The plugin could not keep that, see its log."))
        self._spaces = {**others, namespace: space} if space else others
        self._sizes[namespace] = size

    def _read(self):
        if self._spaces is None:
            found = {}
            for path in sorted(self._place().glob("*.json")):
                space = KeptJson(self._place, path.name).read()
                if isinstance(space, dict):
                    found[unquote(path.stem)] = space
            self._spaces = found
            self._sizes = {name: _size(space) for name, space in found.items()}
        return self._spaces

    def _place(self):
        place = Path(self._folder()) / FOLDER
        place.mkdir(exist_ok=True)
        return place


def names_of(key):
    """Return the names that a key goes through; ``RequestRefused`` for what is none."""
    names = key.split(".") if isinstance(key, str) else key
    is_key = (
        isinstance(names, list)
        and 0 < len(names) <= DEEPEST_KEY
        and all(isinstance(name, str) and 0 < len(name) <= LONGEST_KEY for name in names)
    )
    if not is_key:
        raise RequestRefused(400, gettext("A key is a text with dots, or a list of texts."))
    return tuple(names)


def file_name(namespace):
    """Return the name of a namespace's file, which no other one has on any disk."""
    letters = map(chr, namespace.encode("utf-8"))
    return "".join(each if each in PLAIN else f"%{ord(each):02x}" for each in letters) + ".json"


def _check_namespace(namespace):
    # what is printable can be encoded
    is_name = 0 < len(namespace) <= LONGEST_NAMESPACE and namespace.isprintable()
    if not is_name or len(file_name(namespace)) > LONGEST_FILE_NAME:
        raise RequestRefused(400, gettext("A namespace has a name of at most 64 letters."))


def _size(value):
    try:
        return len(json.dumps(value, allow_nan=False))
    except ValueError:
        raise RequestRefused(400, gettext("The value is nothing that JSON can hold.")) from None


def _is_shallow(value, levels):
    if not isinstance(value, (dict, list)):
        return True
    members = value.values() if isinstance(value, dict) else value
    return levels > 0 and all(_is_shallow(member, levels - 1) for member in members)


def _found(value, names):
    for name in names:
        if not isinstance(value, dict) or name not in value:
            raise RequestRefused(404, gettext("There is nothing at this key."))
        value = value[name]
    return value


def _with(space, names, value):
    """Return the object with a value in it; what was there stays as it was."""
    if not names:
        return value
    if not isinstance(space, dict):
        raise RequestRefused(400, gettext("The key leads through something that is no object."))
    return {**space, names[0]: _with(space.get(names[0], {}), names[1:], value)}


def _without(space, names):
    """Return the object without what a key leads to, which is there."""
    others = {name: each for name, each in space.items() if name != names[0]}
    return {**others, names[0]: _without(space[names[0]], names[1:])} if names[1:] else others
