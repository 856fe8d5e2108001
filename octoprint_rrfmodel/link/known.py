"""What is known of the machine, and how fresh that is."""

from typing import NamedTuple

from ..rrf.follow.follower import LIVE_ROOT
from ..rrf.follow.freshness import above, is_below
from ..rrf.views.machine import Machine
from ..rrf.views.temperatures import temperatures
from ..rrf.wire.request import ModelRequest, StatusRequest


class Times(NamedTuple):
    """When a part of the model was asked for, and when its answer was applied."""

    asked: float
    applied: float


NEVER = Times(0.0, 0.0)

TARGETS = ("heat.heaters[].active", "heat.heaters[].state")
"""Parts by which a heater's target is known."""


class Known:
    """The snapshot with its age; noted by the worker, read by any thread.

    ``follower`` has the model, ``link`` knows what was sent since.
    """

    def __init__(self, follower, link, clock):
        self._follower = follower
        self._link = link
        self._clock = clock
        self._parts = {}
        self.applied_at = None
        """When the last reply was applied; ``None`` before the first of a connection."""
        self.asked_at = 0.0
        """When the live values of the model were asked for, the oldest of them that decides."""

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
        return told, self._oldest(TARGETS).asked > self._link.target_command_at

    def now(self):
        """Return the time by the plugin's clock."""
        return self._clock()

    def age(self):
        """Return the seconds since the last reply that was applied, ``None`` before the first.

        Where live values come one by one it is the oldest of them that counts, and of parts that
        come as they are needed the oldest of those that the guard needs.
        """
        applied_at = self.applied_at
        live = self._follower.live_keys
        if live and self._parts:
            applied_at = min(map(self._newest, live)).applied
        return None if applied_at is None else self._clock() - applied_at

    def age_of(self, path):
        """Return the seconds since the answer that told of the oldest part below a path."""
        heard_at = self._oldest((path,)).applied
        return self._clock() - heard_at if heard_at else None

    def ages(self):
        """Return the seconds since each top-level key was heard of, that of its oldest part.

        A key that doesn't change all the time is as fresh as the counters that tell of changes,
        unless one has told of one: then it is as old as what is known of it.
        """
        now = self._clock()
        times = {key: self._time_of(key) for key in self.model()}
        return {key: round(now - at, 2) for key, at in times.items() if at}

    def _time_of(self, key):
        follower = self._follower
        if key in follower.live_roots:
            heard_at = self._oldest((key,)).applied
        else:
            heard_at = self._oldest(("seqs",)).applied
        known_at = self._parts.get(key, NEVER).applied
        return min(known_at, heard_at) if key in follower.wanted else heard_at

    def _oldest(self, paths):
        """Return the times of the oldest part of what is live below some paths."""
        parts = self._follower.live_parts or ("",)
        needed = [
            part
            for part in parts
            if any(is_below(part, path) or is_below(path, part) for path in paths)
        ]
        return min((self._newest(part) for part in needed or paths), default=NEVER)

    def _newest(self, part):
        """Return the times of the newest answer that has told of a part, with or without others."""
        # another thread may note meanwhile, in another dictionary
        known = self._parts
        return max((known[path] for path in above(part) if path in known), default=NEVER)

    ##~~ on the worker

    def note(self, request, asked_at):
        """Note that the reply to a request, asked for then, was applied."""
        self.applied_at = self._clock()
        times = Times(asked_at, self.applied_at)
        if isinstance(request, StatusRequest) or request == LIVE_ROOT:
            self._parts = {**self._parts_of_keys(), "": times}
        elif isinstance(request, ModelRequest):
            self._parts = {**self._parts, request.key: times}
        self.asked_at = min(map(self._newest, self._follower.live_keys or ("",))).asked

    def note_report(self, path):
        """Note that a line has told of a part unasked."""
        now = self._clock()
        self._parts = {**self._parts, path: Times(now, now)}

    def _parts_of_keys(self):
        """Return the times of whole keys: a root tells of what changes all the time, no more."""
        return {key: at for key, at in self._parts.items() if key in self.model()}

    def forget(self):
        """Know nothing: the connection is gone."""
        self.applied_at = None
        self._parts = {}
        self.asked_at = 0.0
