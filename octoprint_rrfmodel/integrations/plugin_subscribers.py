"""Other plugins that listen: told of changes on a thread of their own, however slow they are."""

import logging
import threading

from ..link.worker import Worker
from ..rrf.model.changes import Subscriptions
from ..rrf.model.frozen import frozen

UPDATED_HOOK = "octoprint.plugin.rrfmodel.updated"


class Audience:
    """Tells subscribers and hook handlers what has changed, one change after the other.

    Changes that come while somebody is still busy with an earlier one are told as one.
    ``handlers()`` gives what is to be called with the top-level keys that changed and the model.
    """

    def __init__(self, handlers):
        self._handlers = handlers
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.audience")
        self._subscriptions = Subscriptions(self._failed)
        self._lock = threading.Lock()
        self._pending = None
        self._worker = Worker({"changed": self._tell}, [], "rrfmodel.audience")

    def start(self):
        """Begin to tell."""
        self._worker.start()

    def stop(self):
        """Tell no more."""
        self._worker.stop()

    def subscribe(self, path, callback):
        """Have ``callback(path, new, old)`` called after changes; return what ends that.

        Raises ``ValueError`` for a path that is no key of the model.
        """
        return self._subscriptions.subscribe(
            path, lambda key, new, old: callback(key, frozen(new), frozen(old))
        )

    def changed(self, before, after, keys):
        """Note that top-level keys have changed between two snapshots; returns at once."""
        with self._lock:
            waiting = self._pending
            if waiting is not None:
                before, keys = waiting[0], waiting[2] | frozenset(keys)
            self._pending = before, after, frozenset(keys)
        if waiting is None:
            self._worker.notify("changed")

    def _tell(self):
        with self._lock:
            before, after, keys = self._pending
            self._pending = None
        self._subscriptions.tell(before, after, dict.fromkeys(keys, True))
        handlers = self._handlers()
        model = frozen(after) if handlers else None
        for handler in handlers:
            try:
                handler(keys, model)
            except Exception as error:
                self._failed(error)

    def _failed(self, error):
        self._logger.error("A listener failed", exc_info=error)
