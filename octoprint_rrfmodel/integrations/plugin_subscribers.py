"""Other plugins that listen: told of changes on a thread of their own, however slow they are."""

import logging
import threading

from ..link.worker import Worker
from ..rrf.model.changes import Subscriptions
from ..rrf.model.frozen import frozen

UPDATED_HOOK = "octoprint.plugin.rrfmodel.updated"


class PluginSubscribers:
    """Tells subscribers and hook handlers what has changed, one change after the other.

    Changes that come while somebody is still busy with an earlier one are told as one.
    ``plugins()`` is OctoPrint's plugin manager, ``model()`` the snapshot.
    """

    def __init__(self, plugins, model):
        self._plugins = plugins
        self._model = model
        self._told = model()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.plugin_subscribers")
        self._subscriptions = Subscriptions(self._failed)
        self._lock = threading.Lock()
        self._pending = None
        self._worker = Worker("rrfmodel.plugin_subscribers")
        self._worker.attach({"changed": self._tell})

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

    def paths(self):
        """Return the keys of which somebody wants changes."""
        return self._subscriptions.paths

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Note what a reply has changed."""
        self._changed(taken.changes)

    def warmed(self, warmed):
        """Note temperatures that a line has told."""
        self._changed(warmed.changes)

    def reset(self):
        """Note that the model was emptied."""
        self._changed(())

    def forgotten(self):
        """Note that the model was emptied."""
        self._changed(())

    def _changed(self, keys):
        """Note that top-level keys have changed since the last snapshot; returns at once."""
        before, self._told = self._told, self._model()
        after = self._told
        # a reset or the end of a connection empties the model
        keys = keys if after else before
        if not keys:
            return
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
        handlers = list(self._plugins().get_hooks(UPDATED_HOOK).values())
        model = frozen(after) if handlers else None
        for handler in handlers:
            try:
                handler(keys, model)
            except Exception as error:
                self._failed(error)

    def _failed(self, error):
        self._logger.error("A listener failed", exc_info=error)
