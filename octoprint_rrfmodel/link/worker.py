"""The one thread that decodes, polls and pushes.

Which thread runs what:

* OctoPrint's receiving thread (``comm._monitor``), its sending thread and whoever queues a
  command: the hooks in ``link.serial``, which put a note into this worker's queue.
* this worker: ``link.poller``, ``rrf.follow.follower`` with the store, and all listeners
  (``link.listeners``) in the order of ``assembly``.
* Flask's threads: ``web.*_api``, ``web.moonraker.moonraker_api``, which read the snapshot, which
  never changes, and numbers, and put commands into OctoPrint's queue.
* Tornado's loop: ``web.live_api`` and its like, which wait for a future that this worker resolves,
  ``web.moonraker.websocket`` and ``subscribers``; others call them by ``add_callback`` alone.
* ``rrfmodel.sockets``: what the sockets of printer objects ask for, worked out off that loop.
* ``rrfmodel.plugin_subscribers``, another ``Worker``: callbacks and hook handlers of plugins.
* ``rrfmodel.other_plugins``, another: MQTT, PSUControl and the like.
* ``rrfmodel.file_check``, another: files that are selected, looked through.
* ``rrfmodel.jobs``, another: the file of the last jobs, and the layers of a file that is sent.
* ``rrfmodel.recovery``: one restart of the board, waiting for it to come back.
* ``rrfmodel.sender``, another: what the worker gives to OctoPrint's queue, where hooks of other
  plugins run; ``rrfmodel.pages``, another: messages to pages and to other plugins' receivers.
* ``rrfmodel.pause``, ``rrfmodel.stop``: one pause of a print, one emergency stop; other plugins'
  hooks run there, too.
"""

import logging
import math
import queue
import threading
import time

LONGEST_WAIT = 0.5
"""Between two looks of each tick: what changes on another thread may leave no note."""


GRID = 0.125
"""What isn't due soon is due together with others: to wake costs more than most looks."""


def _due_at(now, wait):
    """Return when a tick that wants to wait so long is called again."""
    due_at = now + min(wait, LONGEST_WAIT)
    return due_at if wait < 2 * GRID else math.ceil(due_at / GRID) * GRID


class Worker:
    """Calls handlers by the name of each note, and between notes whatever is due.

    ``handlers`` maps a note's name to a callable. ``ticks`` are callables without arguments that
    return the seconds until they want to be called again; behind a note all of them are called.
    """

    def __init__(self, name):
        self._handlers = {}
        # tick -> when it is due
        self._ticks = {}
        self._notes = queue.SimpleQueue()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.worker")
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def attach(self, handlers, ticks=()):
        """Take the handlers and what is called between notes; before ``start``."""
        self._handlers = handlers
        self._ticks = dict.fromkeys(ticks, 0.0)

    def start(self):
        """Begin to work through the notes, also those that are there already."""
        self._thread.start()

    def stop(self):
        """End the thread after the notes that are already there."""
        self._notes.put(None)
        self._thread.join(timeout=5)

    def notify(self, name, *arguments):
        """Leave a note; any thread may, and never waits."""
        self._notes.put((name, arguments))

    @property
    def waiting(self):
        """How many notes wait, the one that is worked on not counted."""
        return self._notes.qsize()

    def _run(self):
        has_news = True
        while True:
            try:
                note = self._notes.get(timeout=self._wait(has_news))
            except queue.Empty:
                has_news = False
                continue
            has_news = True
            if note is None:
                return
            name, arguments = note
            try:
                self._handlers[name](*arguments)
            except Exception:
                self._logger.exception("Could not handle %s", name)

    def _wait(self, has_news):
        """Run what is due, with news everything, and return how long nothing will be.

        ``None`` where nothing ever is.
        """
        if not self._ticks:
            return None
        now = time.monotonic()
        soonest = now + LONGEST_WAIT
        for tick, due_at in self._ticks.items():
            if has_news or due_at <= now:
                try:
                    due_at = _due_at(now, tick())
                except Exception:
                    self._logger.exception("Could not run %s", tick)
                    due_at = now + LONGEST_WAIT
                self._ticks[tick] = due_at
            soonest = min(soonest, due_at)
        return max(0.0, soonest - time.monotonic())
