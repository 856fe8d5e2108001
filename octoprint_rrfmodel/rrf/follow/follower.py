"""One board followed: the plan, the replies and the model that they make.

    next_request() -> (somebody sends it, somebody hears the line) -> take(text)

Belongs to one thread; ``store.model`` may be read by any.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..model.merge import NestedTooDeep
from ..model.store import ModelStore
from ..wire.live_reader import LiveReader
from ..wire.reply import MalformedReply, ModelReply, NoBuffers, StatusReply, decode, foreign_strings
from ..wire.report import entries
from ..wire.request import KEY_FLAGS, LIVE_FLAGS, ModelRequest, Request
from .doubts import Doubts
from .live import LIVE_KEYS
from .poll import ModelPlan
from .poll408 import StatusPlan
from .reported import members_of, patch_of
from .rows import Rows
from .update import Taken, Update, Warmed

LIVE_ROOT = ModelRequest("", LIVE_FLAGS)

NOT_SUPPORTED_AFTER = 3
"""Times that ``M409`` may stay without any answer before ``M408`` is tried."""


class Follower:
    """Keeps the model of one board fresh, whatever the board answers to.

    ``rows`` are the parts by which it does so on a line whose time is dear.
    """

    def __init__(self, rows: Rows | None = None) -> None:
        self.rows = rows or Rows(lambda: 0.0)
        self.store = ModelStore()
        self.protocol: str | None = None
        """``M409`` or ``M408`` once one of them was answered."""
        self.counters = {"replies": 0, "malformed": 0, "out_of_buffers": 0, "timeouts": 0}
        self.resets = 0
        self.is_mute = False
        """Whether the board answered neither to ``M409`` nor to ``M408``; both are tried again."""
        self._start()

    def _start(self) -> None:
        self._plan: ModelPlan | StatusPlan = ModelPlan(self.rows)
        self._reader = LiveReader()
        self._doubts = Doubts()
        self._is_root = False
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
        """The keys by which live values come one by one, none where they come as a whole.

        Where parts come as they are needed it is those that the guard needs: by them the model's
        age is told.
        """
        return self.rows.guarded if self.is_sparing else self._plan.live_keys

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
        self._is_root = request == LIVE_ROOT
        if self.is_sparing and isinstance(request, ModelRequest):
            self.rows.spent(len(text), request)
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
        if is_doubted or (updates and not self._is_root):
            # the last live reply isn't what the model has
            self._reader.forget()
        if is_doubted:
            self._plan.again(updates)
            return Taken({}, False, True)
        self.store.keep(model)
        if self._tells_time(updates) and self._doubts.is_reset(model):
            self.resets += 1
            self._plan.restart()
            self.store.forget()
            self._reader.forget()
            return Taken(changes, True)
        self._plan.observe(model)
        return Taken(changes, False)

    def _tells_time(self, updates: list[Update]) -> bool:
        """Return whether the model's up-time is news: a small part says nothing of it."""
        if not self.is_sparing:
            return True
        return any("state" in (path or value) for path, value in updates)

    def told(self) -> None:
        """Note that the firmware has said by itself that something is wrong: believe it at once."""
        self._doubts.told()

    def spare(self, bytes_a_second: float, share: float, is_free: bool = False) -> None:
        """Follow by small parts that take that share of a line; with 0 by whole answers.

        ``is_free`` where nobody waits for the line, and a long answer now and then does no harm.
        """
        if isinstance(self._plan, ModelPlan):
            self._plan.spare(bytes_a_second, share, is_free)

    @property
    def is_sparing(self) -> bool:
        """Whether the model is followed by small parts."""
        return isinstance(self._plan, ModelPlan) and self._plan.is_sparing

    @property
    def wanted(self) -> frozenset[str]:
        """Keys that are known to have changed, and wait to be fetched."""
        return self._plan.wanted

    @property
    def live_roots(self) -> frozenset[str]:
        """Top-level keys with members that change all the time."""
        is_old = isinstance(self._plan, StatusPlan)
        return frozenset(self.store.model if is_old else LIVE_KEYS)

    @property
    def live_parts(self) -> tuple[str, ...]:
        """All parts by which live values come, none where they come as a whole."""
        return self.rows.paths if self.is_sparing else self._plan.live_keys

    def warm(self, line: str) -> Warmed | None:
        """Put a report of temperatures into the model; ``None`` where it tells nothing."""
        model = self.store.model
        members = members_of(entries(line), model)
        if not members:
            return None
        # the next live reply is compared with what stands in the model now
        self._reader.forget()
        return Warmed(self.store.patch(patch_of(members, model)), frozenset(members))

    def show_box(self, box: dict[str, Any] | None) -> Taken:
        """Put a box into the model that only text has told of, ``None`` for one that is gone."""
        # the next live reply is compared with what stands in the model now
        self._reader.forget()
        if box is None:
            # there may be another one by now
            self._plan.refetch("state")
        return Taken(self.store.replace("state.messageBox", box), False)

    def _confirm(self, request: Request, strings: tuple[str, ...]) -> None:
        """Ask for a key again until its letters beyond ASCII come twice the same.

        Lines have no checksum here, and a broken byte in a name is still a name: what is read
        once may be wrong for good, since nothing but a change makes the key be asked for again.
        """
        # live values are asked for again anyway
        if not isinstance(request, ModelRequest) or request.flags != KEY_FLAGS:
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
