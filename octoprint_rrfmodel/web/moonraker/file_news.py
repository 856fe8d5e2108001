"""What the sockets are told of files, by OctoPrint's events."""

from octoprint.events import Events

from ...host.answers import RequestRefused
from ...host.print_files import LOCAL
from .places import CARD, GCODES, below

METHOD = "notify_filelist_changed"

ACTIONS = {
    Events.FILE_ADDED: "create_file",
    Events.FILE_REMOVED: "delete_file",
    Events.FILE_MOVED: "move_file",
    Events.FOLDER_ADDED: "create_dir",
    Events.FOLDER_REMOVED: "delete_dir",
    Events.FOLDER_MOVED: "move_dir",
}

MOVE = "move"
"""Of a file that is moved OctoPrint also says that one was removed and one was added."""


class FileNews:
    """Tells the sockets by ``tell(method, params, permission)``.

    ``item(place)`` is what is told of a file, ``count()`` how many sockets there are.
    """

    def __init__(self, item, tell, count):
        self._item = item
        self._tell = tell
        self._count = count

    def subscribe(self, events):
        """Begin to hear OctoPrint's events (``octoprint.events.EventManager``)."""
        for event in ACTIONS:
            events.subscribe(event, self.on_event)

    def on_event(self, event, payload):
        """Tell of a change (OctoPrint's callback, on the thread of its events)."""
        if payload.get("operation") == MOVE or not self._count():
            return
        root = GCODES if payload.get("storage") == LOCAL else CARD
        names = ("destination_path", "source_path") if event in MOVED else ("path",)
        try:
            places = [below(root, payload.get(name) or "") for name in names]
            told = {"action": ACTIONS[event], "item": self._item(places[0])}
        except RequestRefused:
            return
        for source in places[1:]:
            told["source_item"] = {"path": source.path, "root": source.root}
        self._tell(METHOD, [told], "FILES_LIST")


MOVED = (Events.FILE_MOVED, Events.FOLDER_MOVED)
