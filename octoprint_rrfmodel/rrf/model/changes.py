"""Who wants to know of what changes below a key, and telling them."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any, Callable

from .keys import Key
from .merge import Changes, replaced

Callback = Callable[[str, Any, Any], object]
"""Called with the key, the new value and the old one; ``None`` stands for no value."""


class Subscription:
    """One callback for one key, until it is ended."""

    def __init__(self, key: Key, callback: Callback) -> None:
        self.key = key
        self.callback = callback
        self.is_on = True


class Subscriptions:
    """Tells callbacks of changes; any thread may subscribe and end it, callbacks too.

    ``failed`` gets what a callback raises; the others are told all the same.
    """

    def __init__(self, failed: Callable[[Exception], object]) -> None:
        self._failed = failed
        self._lock = threading.Lock()
        # never changed in place, so that telling needs no lock
        self._subscriptions: tuple[Subscription, ...] = ()

    def subscribe(self, path: str, callback: Callback) -> Callable[[], None]:
        """Have ``callback(path, new, old)`` called after each change below a key.

        Return a function that ends it; calling that again does nothing. A change that is just
        being told may still come on another thread. Raises ``MalformedKey``, a ``ValueError``.
        """
        subscription = Subscription(Key(path), callback)
        with self._lock:
            self._subscriptions = (*self._subscriptions, subscription)

        def unsubscribe() -> None:
            subscription.is_on = False
            with self._lock:
                self._subscriptions = tuple(row for row in self._subscriptions if row.is_on)

        return unsubscribe

    @property
    def paths(self) -> tuple[str, ...]:
        """The keys of which somebody wants changes."""
        return tuple(subscription.key.text for subscription in self._subscriptions)

    def tell(
        self, before: Mapping[str, Any], after: Mapping[str, Any], changes: Changes | None
    ) -> None:
        """Call each callback whose value is another now, in the order of subscribing.

        ``changes`` are those between the two snapshots (``store``), ``True`` where all may be
        another, as after a reset.
        """
        told: dict[str, tuple[bool, Any, Any]] = {}
        for subscription in self._subscriptions:
            key = subscription.key
            if not subscription.is_on or not key.touches(changes):
                continue
            if key.text not in told:
                told[key.text] = _compared(key.value(before), key.value(after))
            is_another, new, old = told[key.text]
            if is_another:
                self._call(subscription, new, old)

    def _call(self, subscription: Subscription, new: Any, old: Any) -> None:
        try:
            subscription.callback(subscription.key.text, new, old)
        except Exception as error:
            self._failed(error)


def _compared(old: Any, new: Any) -> tuple[bool, Any, Any]:
    return old is not new and replaced(old, new)[1] is not None, new, old
