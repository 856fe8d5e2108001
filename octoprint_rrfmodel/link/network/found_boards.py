"""Boards that say of themselves where they are: web servers by DNS-SD that RepRapFirmware runs.

Somebody looks while somebody asks, on a thread of its own. What is found is offered as text, and
nothing is sent there before a person has chosen it. Zeroconf comes with OctoPrint's plugin for
discovery; without it, or without that plugin, nothing is found.
"""

import contextlib
import logging
import queue
import threading

from ...rrf.wire.announcement import announced
from .address import address_of, is_place

SERVICE = "_http._tcp.local."

MOST_BOARDS = 20

MOST_WAITING = 100
"""Names that were told and not asked about yet; others are not heard."""

ANSWER_SECONDS = 2.0
"""Time that a service has to say where it is."""

ASKED_SECONDS = 60.0
"""Time after the last who asked for which somebody still looks."""

LOOK_SECONDS = 600.0
"""The longest look: what it has kept of the network's talk is forgotten then."""

SETTLED_SECONDS = 10.0
"""Time from the beginning of a look for which the finds of the one before are good, too."""

GATHER_SECONDS = 2.0
"""Time from the beginning of a look in which boards come together."""

CHANGE_SECONDS = 60.0
"""Between two changes of what is told: with each OctoPrint's pages set their panel anew, in which
somebody may be writing."""

PAUSE_SECONDS = 60.0
"""Between two looks where there was nothing to look with."""


class FoundBoards:
    """Finds boards from the first time that it is asked; any thread may.

    ``addresses()`` are those of this host at which to look.
    """

    def __init__(self, addresses, clock):
        self._addresses = addresses
        self._clock = clock
        self._lock = threading.Lock()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.network")
        self._thread = None
        self._ended = threading.Event()
        self._asked_at = 0.0
        self._not_before = 0.0
        self._boards = {}
        self._changed_at = None

    def boards(self):
        """Return address to name of what was found until now; replaced whole. Never waits."""
        self._asked_at = now = self._clock()
        with self._lock:
            is_looking = self._thread is not None or self._ended.is_set()
            if not is_looking and now >= self._not_before:
                self._thread = threading.Thread(
                    target=self._run, name="rrfmodel.found", daemon=True
                )
                self._thread.start()
        return self._boards

    def stop(self):
        """End the look, and never look again."""
        self._ended.set()
        with self._lock:
            thread = self._thread
        if thread is not None:
            thread.join(timeout=5)

    ##~~ on the thread

    def _run(self):
        try:
            self._look()
        except ImportError:
            self._logger.info("Boards are not looked for: zeroconf is not installed")
            self._not_before = float("inf")
        except Exception:
            self._logger.info("Boards can't be looked for now", exc_info=True)
            self._not_before = self._clock() + PAUSE_SECONDS
        finally:
            with self._lock:
                self._thread = None

    def _look(self):
        addresses = self._addresses()
        if not addresses:
            self._not_before = self._clock() + PAUSE_SECONDS
            return
        before, found, began = self._boards, {}, self._clock()
        with browsing(addresses) as (changes, ask):
            while self._goes_on(began):
                with contextlib.suppress(queue.Empty):
                    self._take(*changes.get(timeout=0.5), ask, found)
                passed, boards = self._clock() - began, dict(found.values())
                if passed > GATHER_SECONDS:
                    self._tell(boards if passed > SETTLED_SECONDS else {**before, **boards})

    def _tell(self, boards):
        """Tell of other boards than before, now and then."""
        now, changed_at = self._clock(), self._changed_at
        if boards != self._boards and (changed_at is None or now - changed_at >= CHANGE_SECONDS):
            self._boards, self._changed_at = boards, now

    def _goes_on(self, began):
        now = self._clock()
        is_asked = now - self._asked_at < ASKED_SECONDS
        return is_asked and now - began < LOOK_SECONDS and not self._ended.is_set()

    def _take(self, is_there, name, ask, found):
        """Note a service that has come, has changed or is gone."""
        board = board_of(ask(name)) if is_there else None
        if board is None:
            found.pop(name, None)
        elif name in found or len(found) < MOST_BOARDS:
            found[name] = board


def board_of(service):
    """Return address and name of the board that a service is, ``None`` where it is none.

    ``service`` is Zeroconf's, ``None`` where it has not answered.
    """
    if service is None:
        return None
    name = announced(service.server or "", service.properties)
    addresses = [found for found in service.parsed_addresses() if is_place(found)]
    if name is None or not addresses:
        return None
    # as strictly as what a person writes
    address = address_of(f"{addresses[0]}:{service.port}")
    return (address.text, name) if address else None


@contextlib.contextmanager
def browsing(addresses):
    """Yield a queue of services (whether one is there, its name), and what asks about a name."""
    # OctoPrint brings it, which another one need not
    import zeroconf

    changes = queue.Queue(MOST_WAITING)

    def hear(is_there, name):
        with contextlib.suppress(queue.Full):
            changes.put_nowait((is_there, name))

    class Listener:
        def add_service(self, _, kind, name):
            hear(True, name)

        update_service = add_service

        def remove_service(self, _, kind, name):
            hear(False, name)

    with contextlib.closing(zeroconf.Zeroconf(interfaces=addresses)) as network:
        browser = zeroconf.ServiceBrowser(network, SERVICE, Listener())
        try:
            yield (
                changes,
                lambda name: network.get_service_info(
                    SERVICE, name, timeout=int(ANSWER_SECONDS * 1000)
                ),
            )
        finally:
            browser.cancel()
