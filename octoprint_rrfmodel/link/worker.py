"""The one thread that decodes, polls and pushes.

Which thread runs what:

* OctoPrint's receiving thread (``comm._monitor``), its sending thread and whoever queues a
  command: the hooks of ``comm.CommBridge``, which put a note into this worker's queue.
* this worker: ``polling.Poller``, ``rrf.follower.Follower`` with the store, ``push.ModelPush``,
  ``events``, and what ``printer_objects`` keeps from one reply to the next.
* Flask's threads: ``api``, ``moonraker``, ``commands``, which read ``store.model`` (a snapshot that
  never changes) and numbers, and put commands into OctoPrint's queue.
* Tornado's loop: ``live``, which waits for a future that this worker resolves, ``websocket`` and
  ``subscribers``; others call them by ``add_callback`` alone, and clients' G-code goes back to this
  worker to be sent.
* ``rrfmodel.audience``, another ``Worker``: callbacks and hook handlers of other plugins.
* ``rrfmodel.neighbours``, another: MQTT, PSUControl and the like.
* ``rrfmodel.recovery``: one restart of the board, waiting for it to come back.
"""

import logging
import queue
import threading

LONGEST_WAIT = 0.5


class Worker:
    """Calls handlers by the name of each note, and between notes whatever is due.

    ``handlers`` maps a note's name to a callable. ``ticks`` are callables without arguments that
    return the seconds until they want to be called again.
    """

    def __init__(self, handlers, ticks, name="rrfmodel.worker"):
        self._handlers = handlers
        self._ticks = ticks
        self._notes = queue.SimpleQueue()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.worker")
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def start(self):
        """Begin to work through the notes."""
        self._thread.start()

    def stop(self):
        """End the thread after the notes that are already there."""
        self._notes.put(None)
        self._thread.join(timeout=5)

    def notify(self, name, *arguments):
        """Leave a note; any thread may, and never waits."""
        self._notes.put((name, arguments))

    def _run(self):
        while True:
            try:
                note = self._notes.get(timeout=self._wait())
            except queue.Empty:
                continue
            if note is None:
                return
            name, arguments = note
            try:
                self._handlers[name](*arguments)
            except Exception:
                self._logger.exception("Could not handle %s", name)

    def _wait(self):
        """Run what is due and return how long nothing will be."""
        wait = LONGEST_WAIT
        for tick in self._ticks:
            try:
                wait = min(wait, tick())
            except Exception:
                self._logger.exception("Could not run %s", tick)
        return wait
