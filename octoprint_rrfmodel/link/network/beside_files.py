"""Files and height map of a board that hangs on a cable, fetched over its network.

As for the stop (``beside``) no session is kept: each errand logs in, makes sure of the board's
serial number, and logs out.
"""

import contextlib
import threading
from types import SimpleNamespace

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...host.own_thread import on_a_thread_of_its_own
from .beside import NotThere
from .card_refused import CardRefused
from .height_maps import HeightMaps
from .machine_files import MachineFiles
from .reasons import card_sentence
from .standalone import Standalone
from .transfers import Transfers
from .transport import Unreachable


class Visits:
    """Has what files need of a link and its exchange: a dialect, and only during a visit.

    ``beside`` (``beside.Beside``) knows whether the board was found, and finds it again.
    """

    is_away = False

    def __init__(self, beside, clock):
        self._beside = beside
        self._clock = clock
        self._own = threading.local()

    @property
    def exchange(self):
        """What carries errands out, ``None`` where the board wasn't found."""
        return self if self._beside.is_found() else None

    @property
    def dialect(self):
        """The dialect of the visit that this thread makes; raises ``Unreachable`` without one."""
        dialect = getattr(self._own, "dialect", None)
        if dialect is None:
            raise Unreachable("no connection")
        return dialect

    @contextlib.contextmanager
    def visit(self):
        """Yield while the board is there for this thread; raise ``beside.NotThere``."""
        with self._beside.at_board() as session:
            self._own.dialect = Standalone(session, self._clock, wake=lambda: None)
            try:
                yield
            finally:
                self._own.dialect = None

    def run(self, errand):
        """Have ``errand(dialect)`` done soon, on a thread of its own."""
        on_a_thread_of_its_own(self._carry_out, errand, name="rrfmodel.beside_files")

    def _carry_out(self, errand):
        try:
            with self.visit():
                errand(self.dialect)
        except NotThere as why:
            # one that has not begun hears of it as of any other board that doesn't answer
            with contextlib.suppress(Unreachable):
                errand(_Absent(str(why)))


class _Absent:
    """A dialect of a board that can't be reached: whatever it is asked for says so."""

    def __init__(self, why):
        self._why = why

    def __getattr__(self, name):
        raise Unreachable(self._why)


class BesideFiles:
    """The height map and the files of the board on the cable; a listener.

    The files have the methods of ``MachineFiles``. ``model()`` is the snapshot, ``folder()`` is
    where files lie that are fetched.
    """

    def __init__(self, beside, model, folder, *, clock):
        self._visits = Visits(beside, clock)
        card = SimpleNamespace(transfers=Transfers(self._visits, folder))
        self._files = MachineFiles(self._visits, card, model)
        self._heights = HeightMaps(self._visits, model)

    def entries(self, path):
        """Return what is in a folder."""
        return self._visited(self._files.entries, path)

    def read(self, path):
        """Return a file's text and stamp."""
        return self._visited(self._files.read, path)

    def write(self, path, text, stamp=None):
        """Write a file, as ``MachineFiles.write``."""
        return self._visited(self._files.write, path, text, stamp)

    @property
    def height_map(self):
        """The mesh in use, ``None`` where it was not read or there is none."""
        return self._heights.known

    def read_height_map(self):
        """Return a future as ``Link.read_height_map``; ``None`` where the board wasn't found."""
        return None if self._visits.exchange is None else self._heights.read()

    def _visited(self, function, *arguments):
        if self._visits.exchange is None:
            raise RequestRefused(409, not_found_sentence())
        try:
            with self._visits.visit():
                return function(*arguments)
        except NotThere as why:
            refused = CardRefused("unreachable", str(why))
            raise RequestRefused(504, card_sentence(refused)) from None

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Read the mesh where the model tells of another one."""
        if self._visits.exchange is not None:
            self._heights.look()

    def reset(self):
        """Know no mesh any more: another may be loaded."""
        self._heights.forget()

    def forgotten(self):
        """Know no mesh any more: another machine's, perhaps."""
        self._heights.forget()


class FilesInUse:
    """The machine's files of whichever link is in use; ``links`` says which.

    ``networks`` has one ``Network``, or none in OctoPrint 1.11; ``beside`` are ``BesideFiles``.
    """

    def __init__(self, links, networks, beside):
        self._links = links
        self._networks = networks
        self._beside = beside

    def entries(self, path):
        """Return what is in a folder."""
        return self._current().entries(path)

    def read(self, path):
        """Return a file's text and stamp."""
        return self._current().read(path)

    def write(self, path, text, stamp=None):
        """Write a file, as ``MachineFiles.write``."""
        return self._current().write(path, text, stamp)

    def _current(self):
        if self._links.kind == "network":
            return self._networks[0].machine_files
        return self._beside


def not_found_sentence():
    """Return why the files of a machine on a cable can't be had."""
    return gettext(
        "The machine's files are read over its network. Connect it there, or set the port of its"
        " web server in the settings."
    )
