"""One board followed: the plan, the replies and the model that they make.

    next_request() -> (somebody sends it, somebody hears the line) -> take(text)

Belongs to one thread; ``store.model`` may be read by any.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ..model.merge import NestedTooDeep
from ..model.store import ModelStore
from ..wire.live_reader import LiveReader
from ..wire.reply import MalformedReply, ModelReply, NoBuffers, StatusReply, decode, foreign_strings
from ..wire.report import entries
from ..wire.request import LIVE_FLAGS, ModelRequest, Request
from .doubts import Doubts
from .poll import ModelPlan, Update
from .poll408 import StatusPlan
from .reported import members_of, patch_of

LIVE_ROOT = ModelRequest("", LIVE_FLAGS)

NOT_SUPPORTED_AFTER = 3
"""Times that ``M409`` may stay without any answer before ``M408`` is tried."""


class Taken(NamedTuple):
    """What a reply did."""

    changes: dict[str, Any]
    """What changed, by top-level key; see ``merge.Changes``."""
    reset: bool
    """Whether it showed that the board had been reset; the model then begins anew."""
    is_doubted: bool = False
    """Whether it tells of something bad for the first time: it doesn't count, ask again at once."""


class Warmed(NamedTuple):
    """What a report of temperatures did; all else of the model is as old as before."""

    changes: dict[str, Any]
    """As in ``Taken``."""
    heaters: frozenset[int]
    """Indices of those that it told of."""


class Follower:
    """Keeps the model of one board fresh, whatever the board answers to."""

    def __init__(self) -> None:
        self.store = ModelStore()
        self.protocol: str | None = None
        """``M409`` or ``M408`` once one of them was answered."""
        self.counters = {"replies": 0, "malformed": 0, "out_of_buffers": 0, "timeouts": 0}
        self.resets = 0
        self.is_mute = False
        """Whether the board answered neither to ``M409`` nor to ``M408``; both are tried again."""
        self._start()

    def _start(self) -> None:
        self._plan: ModelPlan | StatusPlan = ModelPlan()
        self._reader = LiveReader()
        self._doubts = Doubts()
        self._unanswered = 0
        self._unconfirmed: dict[Request, tuple[str, ...]] = {}

    @property
    def ready(self) -> bool:
        """Whether every key was fetched since the connection or the last reset."""
        return self._plan.ready

    @property
    def too_large(self) -> tuple[str, ...]:
        """What the board has no room to tell; it is asked for rarely."""
        return self._plan.too_large.paths

    @property
    def behind(self) -> bool:
        """Whether there is more to ask than live values."""
        return self._plan.behind

    @property
    def is_amid(self) -> bool:
        """Whether what is asked next belongs to what has just come, and is to follow at once."""
        return self._plan.is_amid

    @property
    def live_keys(self) -> tuple[str, ...]:
        """The keys by which live values come one by one, none where they come as a whole."""
        return self._plan.live_keys

    @property
    def short_of_buffers(self) -> int:
        """How many times in a row the board had no room for its answer."""
        return self._plan.short_of_buffers

    def next_request(self) -> Request:
        """Return what to ask the board now."""
        return self._plan.next_request()

    def take(self, text: str) -> Taken | None:
        """Take a reply; return what it did, ``None`` where it answers another request.

        Raises ``MalformedReply`` for one that can't be read: what was asked for stays wanted.
        """
        request = self._plan.next_request()
        try:
            reply = self._decode(text, request)
            if isinstance(reply, NoBuffers):
                self.counters["out_of_buffers"] += 1
                updates = self._plan.no_buffers()
                model, changes = self.store.merged(updates)
                self._begin_if_exhausted()
                return self._taken(updates, model, changes)
            if not answers(reply, request):
                if isinstance(reply, ModelReply) and isinstance(self._plan, StatusPlan):
                    # it was only late, or somebody else asked: the board has M409 after all
                    self.forget()
                return None
            self.counters["replies"] += 1
            self.protocol = "M409" if isinstance(reply, ModelReply) else "M408"
            self._unanswered = 0
            self.is_mute = False
            updates = self._plan.take(reply)  # type: ignore[arg-type]
            model, changes = self.store.merged(updates)
        except (MalformedReply, NestedTooDeep) as error:
            self.counters["malformed"] += 1
            self._reader.forget()
            self._failed()
            raise MalformedReply(str(error)) from None
        taken = self._taken(updates, model, changes)
        if not taken.is_doubted and not taken.reset:
            self._confirm(request, foreign_strings(text))
        return taken

    def _taken(self, updates: list[Update], model: Mapping[str, Any], changes: Any) -> Taken:
        """Take a model that a reply has led to, unless it is doubtful."""
        is_doubted = self._doubts.is_doubtful(self.store.model, model) if updates else False
        if is_doubted or any(update.path for update in updates):
            # the last live reply isn't what the model has
            self._reader.forget()
        if is_doubted:
            self._plan.again(updates)
            return Taken({}, False, True)
        self.store.keep(model)
        if self._doubts.is_reset(model):
            self.resets += 1
            self._plan.restart()
            self.store.forget()
            self._reader.forget()
            return Taken(changes, True)
        self._plan.observe(model)
        return Taken(changes, False)

    def told(self) -> None:
        """Note that the firmware has said by itself that something is wrong: believe it at once."""
        self._doubts.told()

    def warm(self, line: str) -> Warmed | None:
        """Put a report of temperatures into the model; ``None`` where it tells nothing."""
        model = self.store.model
        members = members_of(entries(line), model)
        if not members:
            return None
        # the next live reply is compared with what stands in the model now
        self._reader.forget()
        return Warmed(self.store.patch(patch_of(members, model)), frozenset(members))

    def _confirm(self, request: Request, strings: tuple[str, ...]) -> None:
        """Ask for a key again until its letters beyond ASCII come twice the same.

        Lines have no checksum here, and a broken byte in a name is still a name: what is read
        once may be wrong for good, since nothing but a change makes the key be asked for again.
        """
        if not isinstance(request, ModelRequest) or not request.key:
            return
        if not strings or self._unconfirmed.get(request) == strings:
            self._unconfirmed.pop(request, None)
        else:
            self._unconfirmed[request] = strings
            self._plan.refetch(request.key.partition(".")[0])

    def timed_out(self) -> None:
        """Note that ``next_request`` was sent and nothing came."""
        self.counters["timeouts"] += 1
        self._unanswered += 1
        if self._unanswered >= NOT_SUPPORTED_AFTER:
            self.not_supported()
        else:
            self._failed()

    def not_supported(self) -> None:
        """Note that the firmware doesn't know the command: try the other one, turn by turn."""
        if self.protocol is None and isinstance(self._plan, ModelPlan):
            self._plan = StatusPlan()
            self._unanswered = 0
        else:
            self._failed()

    def _failed(self) -> None:
        self._plan.failed()
        self._begin_if_exhausted()

    def _begin_if_exhausted(self) -> None:
        """Try ``M409`` once more where ``M408`` brought nothing either."""
        if isinstance(self._plan, StatusPlan) and self._plan.exhausted:
            self.forget()
            self.is_mute = True

    def refetch(self, key: str = "") -> None:
        """Ask for a key again, or for all of them."""
        self._plan.refetch(key)

    def forget(self) -> None:
        """Begin anew: another connection, perhaps another board."""
        self.store.forget()
        self.protocol = None
        self.is_mute = False
        self._start()

    def _decode(self, text: str, request: Request) -> ModelReply | StatusReply | NoBuffers:
        if request != LIVE_ROOT:
            return decode(text)
        members = self._reader.changed(text)
        if members is not None:
            return ModelReply("", LIVE_FLAGS, members, 0)
        reply = decode(text)
        if isinstance(reply, ModelReply) and answers(reply, request):
            self._reader.remember(text)
        return reply


def answers(reply: ModelReply | StatusReply | NoBuffers, request: Request) -> bool:
    """Return whether a reply is one to this request.

    ``M409`` echoes key and flags; in SBC mode ``network`` and ``volumes`` come without flags.
    ``M408`` echoes nothing.
    """
    if isinstance(request, ModelRequest):
        return (
            isinstance(reply, ModelReply)
            and reply.key == request.key
            and reply.flags in (None, request.flags)
        )
    return isinstance(reply, StatusReply)
