"""What every open page is told, collected and sent a few times a second.

Messages of the plugin ``rrfmodel``, for those who have READ:

* ``{"type": "model", "revision": n, "changed": {key: value}, "status": {...}}``: top-level keys
  of the object model that changed since the last message, each whole.
* ``{"type": "status", "status": {...}}``: nothing of the model changed, but the state did.
* ``{"type": "reset", "status": {...}}``: what was known holds no longer, more will follow.
* ``{"type": "notice", "code", "detail", "text", "at"}``, at once: something that was asked for
  didn't happen.

OctoPrint keeps the first messages that nobody on a page may see, and hands them over when somebody
logs in there; ``at``, of the state too, is the time by which a page tells old ones.
"""

from ..link.status import worth_telling

SHORTEST_SECONDS = 0.5

GATHERED_SECONDS = 0.4
"""So long a change waits for the keys that a reply has said are to be asked for."""


class ModelPush:
    """Tells the pages; runs on the worker thread.

    ``pages`` reach them. ``model()`` is the snapshot, ``status()`` the plugin's state;
    ``follower.behind`` while keys wait to be asked for. While pages are behind it only goes on
    collecting, and while there are none it forgets.
    """

    def __init__(self, pages, model, status, *, follower, clock):
        self._pages = pages
        self._send = pages.tell
        self._model = model
        self._status = status
        self._follower = follower
        self._clock = clock
        self._changed, self._warmed = set(), set()
        self._forgotten = False
        self._told = None
        self._looked_at = self._sent_at = self._changed_at = self._warmed_at = 0.0

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Note top-level keys that changed."""
        if not self._changed:
            self._changed_at = self._clock()
        self._changed.update(taken.changes)

    def warmed(self, warmed):
        """Note temperatures that a line has told, also those that are as before: they are fresh."""
        if not self._warmed:
            self._warmed_at = self._clock()
        self._warmed.update(warmed.changes)
        self._told = None

    def reset(self):
        """Note that the board began anew."""
        self.forgotten()

    def forgotten(self):
        """Note that the model was emptied."""
        self._changed.clear()
        self._warmed.clear()
        self._forgotten = True

    def _due_at(self):
        """Return when something is to be told, or the state to be looked at."""
        if self._changed and self._follower.behind:
            # told alone, what the reply itself brought would hold back what it was about
            return max(self._sent_at + SHORTEST_SECONDS, self._changed_at + GATHERED_SECONDS)
        if self._changed or self._forgotten:
            return self._sent_at + SHORTEST_SECONDS
        if self._warmed:
            # told alone it would hold back what changes next
            return max(self._sent_at, self._warmed_at) + SHORTEST_SECONDS
        return self._looked_at + SHORTEST_SECONDS

    def tick(self):
        """Send what is due; return the seconds until something may be."""
        now = self._clock()
        due = self._due_at() - now
        if due > 0:
            return due
        if not self._pages.are_there():
            # a page that opens reads all of it
            self._changed.clear()
            self._warmed.clear()
            self._forgotten = False
            return SHORTEST_SECONDS
        if self._pages.are_behind():
            return SHORTEST_SECONDS
        self._looked_at = now
        self._changed |= self._warmed
        self._warmed.clear()
        status = self._status()
        told = worth_telling(status)
        if self._forgotten:
            self._forgotten = False
            self._sent_at = now
            self._send({"type": "reset", "status": status})
        elif self._changed:
            model = self._model()
            changed = {key: model.get(key) for key in self._changed}
            self._changed.clear()
            self._sent_at = now
            revision = status["revision"]
            self._send(
                {"type": "model", "revision": revision, "changed": changed, "status": status}
            )
        elif told != self._told:
            self._send({"type": "status", "status": status})
        self._told = told
        return SHORTEST_SECONDS
