"""What is known of the machine, and how fresh that is."""

from ..rrf.follow.follower import LIVE_ROOT
from ..rrf.views.machine import Machine
from ..rrf.views.temperatures import temperatures
from ..rrf.wire.request import ModelRequest, StatusRequest


class Known:
    """The snapshot with its age; noted by the worker, read by any thread.

    ``follower`` has the model, ``link`` knows what was sent since.
    """

    def __init__(self, follower, link, clock):
        self._follower = follower
        self._link = link
        self._clock = clock
        self._live = {}
        self.applied_at = None
        """When the last reply was applied; ``None`` before the first of a connection."""
        self.asked_at = 0.0
        """When the live values of the model were asked for, the oldest of them."""

    def model(self):
        """Return the snapshot."""
        return self._follower.store.model

    def machine(self):
        """Return the view that commands depend on."""
        return Machine(self.model(), self.is_current())

    def is_ready(self):
        """Return whether the whole model is known."""
        return self._follower.ready

    def is_current(self):
        """Return whether the model is newer than all that could have changed the machine.

        It isn't while something that could is queued or under way.
        """
        is_newer = self.asked_at > self._link.settled_at and not self._follower.behind
        return is_newer and not self._link.is_changing()

    def heat(self):
        """Return what the model says of heat, ``None`` while it says nothing, and of its targets
        whether they are newer than the last command that gave a heater one."""
        model = self.model()
        told = temperatures(model) if "heat" in model else None
        return told, self.asked_at > self._link.target_command_at

    def now(self):
        """Return the time by the plugin's clock."""
        return self._clock()

    def age(self):
        """Return the seconds since the last reply that was applied, ``None`` before the first.

        Where live values come one by one it is the oldest of them that counts.
        """
        applied_at = self.applied_at
        live = self._live
        if self._follower.live_keys and live:
            applied_at = min(applied for _, applied in live.values())
        return None if applied_at is None else self._clock() - applied_at

    ##~~ on the worker

    def note(self, request, asked_at):
        """Note that the reply to a request, asked for then, was applied."""
        self.applied_at = self._clock()
        times = (asked_at, self.applied_at)
        if isinstance(request, StatusRequest):
            self._live = {"": times}
        elif isinstance(request, ModelRequest) and request.flags.startswith(LIVE_ROOT.flags):
            # all live values at once, or one key of a board without room
            self._live = self._with_live(request.key, times)
        self.asked_at = min((asked for asked, _ in self._live.values()), default=0.0)

    def _with_live(self, key, times):
        """Return the live values by what they came with, the whole until each part is newer."""
        parts = self._follower.live_keys
        if not key or not parts:
            return {key: times}
        known = {name: at for name, at in self._live.items() if name in ("", *parts)}
        known[key] = times
        if known.keys() >= set(parts):
            known.pop("", None)
        return known

    def forget(self):
        """Know nothing: the connection is gone."""
        self.applied_at = None
        self._live = {}
        self.asked_at = 0.0
