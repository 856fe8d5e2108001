"""A plugin that tells how large its OctoPrint is, and what waits in its queues.

``GET /api/plugin/gauges``: names and numbers. With ``rest=1`` garbage is collected first, and the
objects that are left are counted. Threads are counted without OctoPrint's ``RepeatedTimer``: one of
each socket of its own sleeps on for a minute when that has been closed. OctoPrint 1.11 leaves a
sending thread behind where a connection ends while an ok is awaited: its ``close`` takes a count
where 2.0 sets it, so that who waits for it waits for ever; these aren't counted either.
"""

import collections
import gc
import os
import threading

import flask
import octoprint.plugin
from octoprint.events import eventManager
from octoprint.util import RepeatedTimer

from octoprint_rrfmodel.link.worker import Worker

__plugin_name__ = "Gauges"
__plugin_pythoncompat__ = ">=3.9,<4"


class Gauges(octoprint.plugin.SimpleApiPlugin):
    def __init__(self):
        self._workers = None

    def is_api_protected(self):
        return True

    def on_api_get(self, request):
        at_rest = "rest" in request.values
        if at_rest:
            gc.collect()
        return flask.jsonify(
            memory=_memory(),
            threads=sum(not _is_octoprints(each) for each in threading.enumerate()),
            handles=len(os.listdir("/proc/self/fd")),
            **(_objects() if at_rest else {}),
            sockets=self._plugin().parts.moonraker.sockets.count(),
            queues=self._queues(),
            thread_names=sorted(map(_name_of, threading.enumerate())),
        )

    def _plugin(self):
        return self._plugin_manager.get_plugin_info("rrfmodel").implementation

    def _queues(self):
        """Return the length of each queue of the plugin and of OctoPrint, by name."""
        if self._workers is None:
            # all are made with the plugin
            self._workers = [found for found in gc.get_objects() if isinstance(found, Worker)]
        queues = {worker._thread.name: worker.waiting for worker in self._workers}
        queues["events"] = eventManager()._queue.qsize()
        comm = self._plugin().parts.link.connection
        for name in ("_send_queue", "_command_queue"):
            queue = getattr(comm, name, None)
            if queue is not None:
                queues[name.strip("_")] = queue.qsize()
        return queues


def _name_of(thread):
    """Return a thread's name, with what it runs where it has been given none."""
    if not thread.name.startswith("Thread-"):
        return thread.name
    target = getattr(thread, "_target", None) or type(thread)
    return f"{target.__module__}.{getattr(target, '__qualname__', target)}"


def _objects():
    """Return how many objects there are, and how many of each of the most frequent kinds."""
    objects = gc.get_objects()
    kinds = collections.Counter(str(type(each)) for each in objects)
    return {"objects": len(objects), "kinds": dict(kinds.most_common(40))}


def _is_octoprints(thread):
    comm = getattr(getattr(thread, "_target", None), "__self__", None)
    return isinstance(thread, RepeatedTimer) or getattr(comm, "_send_queue_active", None) is False


def _memory():
    """Return the resident memory in MB."""
    with open("/proc/self/status", encoding="utf-8") as status:
        line = next(line for line in status if line.startswith("VmRSS"))
    return round(int(line.split()[1]) / 1024, 1)


def __plugin_load__():
    global __plugin_implementation__
    __plugin_implementation__ = Gauges()
