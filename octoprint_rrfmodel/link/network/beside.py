"""The network of a board that hangs on a cable: a second way for an emergency stop.

Off unless a setting says at which port the board's web server is. The board itself tells over the
cable where it is on the network; what answers there is it only if it has the same serial number,
which is asked once when the machine is known and again in front of each stop: an address may be
another printer's by now. Nothing else that moves or changes the machine goes this way, and no
session is kept: a board has eight, and keeps its replies for all of them.
"""

import contextlib
import json
import logging
import threading
from typing import NamedTuple

from ...host.own_thread import on_a_thread_of_its_own
from ...rrf.wire.rr import path_of
from .address import Address, is_place
from .login import STANDALONE, Busy, Refused
from .memory import PATH, Memory
from .session import Session, SessionLost
from .standalone import Standalone
from .transport import Transport, Unreachable

AGAIN_SECONDS = 300.0
"""From a try that has found nothing to the next one."""

STOP_SECONDS = 10.0
"""Time for which a stop is tried; a later one would hit a machine that somebody has restarted."""

PAUSE_SECONDS = 0.2

ANSWER_SECONDS = 2.0

WHO = path_of("model", key="boards[0].uniqueId", flags="v")
"""What is asked for the serial number."""

FAILURES = (Unreachable, SessionLost, Busy, Refused)


class NotThere(Exception):
    """The board on the cable can't be reached over its network; says why in a few words."""


class Board(NamedTuple):
    """Who is on the cable, and where that may be on the network."""

    unique_id: str
    places: tuple


class Beside:
    """Knows whether the board on the cable has been found on the network, and stops it there.

    ``links`` says which link is in use, ``known`` what is known of the machine, ``settings()`` are
    the plugin's. ``notify(name, *arguments)`` only takes note.
    """

    def __init__(self, settings, links, known, *, notify, clock):
        self._settings = settings
        self._links = links
        self._known = known
        self._notify = notify
        self._clock = clock
        self._memory = Memory(settings)
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.network")
        self._lock = threading.Lock()
        self._tried = None
        self._again_at = 0.0
        self._found = None
        self._stopping = None
        self._ends = threading.Event()
        """Set when the stop that is under way has come too late."""

    def is_found(self):
        """Return whether the board was found; ``None`` where nobody looks for it. Any thread."""
        return None if self._tried is None else self._found is not None

    @contextlib.contextmanager
    def at_board(self):
        """Yield a session (``session.Session``) with the board, for what only reads, or files.

        ``NotThere`` where it isn't the same board, or not to be had. Waits for the network: for a
        thread of one's own.
        """
        found = self._found
        if found is None:
            raise NotThere("it was not found there")
        session = self._session(found.places[0])
        try:
            if not _is_same(session, found):
                raise NotThere("another board answers there")
            yield session
        except FAILURES as error:
            raise NotThere(str(error)) from None
        finally:
            session.log_out()

    ##~~ a listener

    def identified(self):
        """Stop nothing any more: whoever has connected again has a machine that answers."""
        self._ends.set()

    reset = identified

    def forgotten(self):
        """Know of no board; a stop that is under way goes on."""
        self._forget(None)

    def _forget(self, board):
        with self._lock:
            self._tried, self._found = board, None

    def replied(self, taken, asked_at):
        """Look for the board once it is known who it is, and where."""
        board = self._wanted()
        if board is None:
            self.forgotten()
        elif board != self._tried or (self._found is None and self._clock() >= self._again_at):
            self._forget(board)
            self._again_at = self._clock() + AGAIN_SECONDS
            on_a_thread_of_its_own(self._look, board, name="rrfmodel.beside")

    def halted(self, doing=None):
        """Stop the board over its network, too: over the cable that may have to wait."""
        found, under_way = self._found, self._stopping
        if found is None or (under_way is not None and under_way.is_alive()):
            return
        self._ends = ends = threading.Event()
        self._stopping = on_a_thread_of_its_own(self._stop, found, ends, name="rrfmodel.stop")

    def _wanted(self):
        """Return who is to be looked for, ``None`` where nobody is."""
        if self._links.kind != "serial" or not self._known.is_ready():
            return None
        port = self._settings().get_int([PATH, "beside_port"], min=0, max=65535)
        if not port:
            return None
        model = self._known.model()
        boards = model.get("boards") or [None]
        unique_id = (boards[0] or {}).get("uniqueId")
        interfaces = (model.get("network") or {}).get("interfaces") or ()
        told = [each.get("actualIP") for each in interfaces if each]
        places = tuple(Address("http", place, port) for place in told if is_place(place))
        if not places or not isinstance(unique_id, str) or not unique_id:
            return None
        return Board(unique_id, places)

    ##~~ on threads of their own

    def _session(self, place):
        return Session(Transport(place), lambda: self._memory.password(place), clock=self._clock)

    def _look(self, board):
        for place in board.places:
            session = self._session(place)
            try:
                is_same = _is_same(session, board)
                why = "" if is_same else "another board answers there"
            except FAILURES as error:
                is_same, why = False, str(error)
            finally:
                session.log_out()
            if is_same:
                with self._lock:
                    if board == self._tried:
                        self._found = Board(board.unique_id, (place,))
                self._logger.info("The board on the cable is on the network, too")
                return
            self._logger.info("The board on the cable is not used over the network: %s", why)

    def _stop(self, board, ends):
        """Stop it again and again, until it says that it stands, or the time is over."""
        session, until = self._session(board.places[0]), self._clock() + STOP_SECONDS
        try:
            while not ends.is_set() and self._clock() < until:
                try:
                    has_ended = self._stops(session, board)
                except SessionLost:
                    # it was reset: what is there now is not what was to be stopped
                    has_ended = True
                except Refused as refused:
                    has_ended = refused.code != "no_slot"
                except (Unreachable, Busy):
                    has_ended = False
                if has_ended:
                    return
                ends.wait(PAUSE_SECONDS)
        finally:
            session.log_out()

    def _stops(self, session, board):
        """Return whether there is nothing more to be done."""
        answers = _value(session, WHO)
        if answers is None:
            return False
        if answers != board.unique_id:
            self._logger.warning("Another board answers where this one was: it is not stopped")
            return True
        dialect = Standalone(session, self._clock, wake=lambda: None)
        dialect.take_at_once("M112")
        if not dialect.is_halted():
            return False
        self._logger.info("The board has stopped, over its network")
        self._notify("refused_operation", "stopped_beside")
        return True


def _is_same(session, board):
    # a computer in front of a board has commands of its own way
    return _value(session, WHO) == board.unique_id and session.greeting.protocol == STANDALONE


def _value(session, path):
    """Return the value that a question to the model brings, ``None`` for nonsense."""
    try:
        told = json.loads(session.ask(path, seconds=ANSWER_SECONDS))
    except ValueError:
        return None
    return told.get("result") if isinstance(told, dict) else None
