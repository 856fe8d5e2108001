"""The mesh in use on a board of the network, read from its card and kept until it is another one.

It is read beside the polls, as what can wait, whenever the model tells of another mesh. Where the
model has only moved (an axis was homed, say) size and date of the file tell whether it is the same.
"""

import threading
import time
from concurrent.futures import Future
from functools import partial
from typing import NamedTuple

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...rrf.card.height_map import MOST_BYTES, BrokenHeightMap, height_map
from .card_refused import FAILURES, CardRefused
from .file_read import facts_of, whole_file
from .reasons import card_sentence, height_map_sentence

SYSTEM = "0:/sys/"

MOST_TRIES = 3
"""Times that a mesh is read of the plugin's own accord: one may take nine seconds to fail."""

CHECK_SECONDS = 10.0
"""Between two looks whether a file is still the same, while nobody asks for it: a print with many
changes of tools moves the model's counter all the time."""


class Mesh(NamedTuple):
    """What the model says of the mesh in use."""

    file: str
    deviation: str
    counter: object
    """How often it has told of another motion system; the mesh may be another one then."""


class Found(NamedTuple):
    """A file that was read."""

    mesh: Mesh
    stamp: tuple
    """Its size and date."""
    map: object
    """The map, or the ``RequestRefused`` that says what is wrong with it."""


class HeightMaps:
    """Reads the mesh in use from the board of ``link``; ``model()`` is the snapshot.

    Any thread may ask.
    """

    def __init__(self, link, model):
        self._link = link
        self._model = model
        self._lock = threading.Lock()
        self._connections = 0
        self._is_reading = False
        self._tries = 0
        self._tried = None
        self._found = None
        self._looked_at = None
        self._waiting = []

    def forget(self):
        """Know nothing: another board, perhaps."""
        with self._lock:
            self._connections += 1
            self._is_reading = False
            self._found = self._tried = None
        self._settle(RequestRefused(504, _unreadable("")))

    @property
    def known(self):
        """The mesh in use, ``None`` where it was not read or there is none."""
        found, mesh = self._found, mesh_of(self._model())
        is_it = found is not None and mesh is not None and found.mesh[:2] == mesh[:2]
        return None if not is_it or isinstance(found.map, RequestRefused) else found.map

    def look(self):
        """Read the mesh where the model tells of another one."""
        mesh, exchange = mesh_of(self._model()), self._link.exchange
        if mesh is None or exchange is None:
            return
        with self._lock:
            if self._tried != mesh:
                self._tried, self._tries = mesh, 0
            if self._is_known(mesh) or self._is_reading or self._tries >= MOST_TRIES:
                return
            self._tries += 1
            self._is_reading = True
            self._looked_at = time.monotonic()
        exchange.run(partial(self._read, self._connections, mesh))

    def _is_known(self, mesh):
        """Return whether a mesh need not be read for now."""
        found = self._found
        if found is None or found.mesh[:2] != mesh[:2]:
            return False
        waits = self._looked_at is not None and time.monotonic() < self._looked_at + CHECK_SECONDS
        return found.mesh == mesh or waits

    def read(self):
        """Return a future of the mesh in use and its file, as soon as it is known."""
        future = Future()
        future.set_running_or_notify_cancel()
        mesh = mesh_of(self._model())
        if mesh is None:
            future.set_exception(RequestRefused(404, _none()))
            return future
        with self._lock:
            found = self._found
            if found is None or found.mesh != mesh:
                self._waiting.append(future)
                self._tries, self._looked_at = 0, None
                found = None
        if found is None:
            self.look()
        else:
            _answer(future, found)
        return future

    def _read(self, connection, mesh, dialect):
        """Read it (an errand of the exchange)."""
        if connection != self._connections:
            return
        try:
            found = self._read_file(mesh, dialect)
        except CardRefused as refused:
            self._end(connection, None, RequestRefused(504, card_sentence(refused)))
        except FAILURES as error:
            self._end(connection, None, RequestRefused(504, _unreadable(str(error))))
            raise
        except BaseException:
            self._end(connection, None, RequestRefused(504, _unreadable("")))
            raise
        else:
            self._end(connection, found, found)

    def _read_file(self, mesh, dialect):
        name = mesh.file.rpartition("/")[2]
        told = facts_of(dialect, mesh.file)
        stamp = told.get("size"), told.get("lastModified")
        if told.get("err") != 0:
            return Found(mesh, (), RequestRefused(404, _gone(name)))
        kept = self._found
        if kept is not None and kept.mesh[:2] == mesh[:2] and kept.stamp == stamp and stamp[1]:
            return kept._replace(mesh=mesh)
        try:
            text = whole_file(dialect.files, mesh.file, stamp[0], most=MOST_BYTES)
            found = height_map(text.decode("utf-8", "replace"))
        except BrokenHeightMap as broken:
            found = RequestRefused(404, height_map_sentence(broken, name))
        except CardRefused as refused:
            if refused.code not in ("gone", "large"):
                raise
            found = RequestRefused(404, card_sentence(refused))
        return Found(mesh, stamp, found)

    def _end(self, connection, found, told):
        with self._lock:
            if connection != self._connections:
                return
            self._is_reading = False
            self._found = found or self._found
        self._settle(told)

    def _settle(self, told):
        with self._lock:
            waiting, self._waiting = self._waiting, []
        for future in waiting:
            _answer(future, told)


def mesh_of(model):
    """Return what a model says of the mesh in use (``Mesh``), ``None`` where it uses none."""
    compensation = (model.get("move") or {}).get("compensation") or {}
    file = compensation.get("file")
    if str(compensation.get("type")).lower() != "mesh" or not isinstance(file, str) or not file:
        return None
    if "/" not in file:
        folder = (model.get("directories") or {}).get("system")
        file = (folder if isinstance(folder, str) else SYSTEM) + file
    counter = (model.get("seqs") or {}).get("move")
    return Mesh(file, str(compensation.get("meshDeviation")), counter)


def _answer(future, told):
    if isinstance(told, Found):
        file, told = told.mesh.file, told.map
    if isinstance(told, RequestRefused):
        future.set_exception(told)
    else:
        future.set_result((file, told))


def _none():
    return gettext("No height map is in use. Load one (G29 S1) or probe the bed (G29).")


def _gone(name):
    return gettext("The card has no file %(name)s any more. Probe the bed again (G29).", name=name)


def _unreadable(why):
    text = gettext("The height map could not be read from the board.")
    return f"{text} ({why})" if why else text
