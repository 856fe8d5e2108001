"""Those who subscribed to printer objects, and what each of them has been told.

It lives on Tornado's loop, and what may take long is done elsewhere meanwhile: objects are computed
and compared. A change is told at once, and then nothing for a quarter of a second. What many asked
for alike is computed, compared and written as text once for all.
"""

import collections
from functools import partial

from ...rrf import klipper
from . import jsonrpc

QUIET_SECONDS = 0.25
"""Time after a message in which a subscriber gets no other (Klipper's own period)."""


class _Subscription:
    """What one connection wants, what it was told last, and when."""

    def __init__(self, wanted, told):
        self.wanted = wanted
        self.told = told
        self.told_at = float("-inf")


class Subscribers:
    """Tells each connection what has changed of the objects that it subscribed to.

    ``world()`` is what objects are computed from. ``loop`` is Tornado's: ``time()``,
    ``call_at(when, function)``. ``run(function, then)`` calls ``function()`` off the loop, and
    ``then`` on it with a future of the result. A connection has ``send(text)``, which doesn't wait.
    """

    def __init__(self, world, loop, run):
        self._world = world
        self._loop = loop
        self._run = run
        self._subscriptions = {}
        self._latest = {}
        # how many want the same; what nobody wants any more is kept no longer
        self._counts = collections.Counter()
        self._timer = None
        self._is_at_work = self._has_news = False

    def subscribe(self, connection, wanted, status):
        """Replace what a connection subscribed to; it is being told the complete ``status``."""
        self.unsubscribe(connection)
        if wanted:
            key = _key(wanted)
            # who knows the same is told the same, whenever they came
            if self._latest.get(key) == status:
                status = self._latest[key]
            self._latest[key] = status
            self._subscriptions[connection] = _Subscription(key, status)
            self._counts[key] += 1

    def unsubscribe(self, connection):
        """Forget a connection."""
        subscription = self._subscriptions.pop(connection, None)
        if subscription is None:
            return
        key = subscription.wanted
        self._counts[key] -= 1
        if not self._counts[key]:
            del self._counts[key]
            self._latest.pop(key, None)

    def __len__(self):
        """Return how many connections are subscribed."""
        return len(self._subscriptions)

    def changed(self):
        """Tell those whose quiet time is over, and see to the others when theirs is."""
        if not self._subscriptions:
            return
        self._has_news = self._is_at_work
        if self._is_at_work:
            return
        now = self._loop.time()
        due = [
            (connection, subscription)
            for connection, subscription in self._subscriptions.items()
            if now - subscription.told_at >= QUIET_SECONDS
        ]
        if due:
            self._is_at_work = True
            told = {_group(each): each.told for _, each in due}
            self._run(partial(self._texts, told), partial(self._tell, due))
        else:
            self._see_to_the_quiet()

    def _see_to_the_quiet(self):
        now = self._loop.time()
        # those just told, too: the next change may come while they are to be left in peace
        quiet = [
            subscription.told_at
            for subscription in self._subscriptions.values()
            if now - subscription.told_at < QUIET_SECONDS
        ]
        if quiet and self._timer is None:
            self._timer = self._loop.call_at(min(quiet) + QUIET_SECONDS, self._on_timer)

    def _on_timer(self):
        self._timer = None
        self.changed()

    def _texts(self, told):
        """Return for each group of subscribers its status and what to tell; not on the loop."""
        world = self._world()
        moment = klipper.Moment(world)
        statuses = {}
        texts = {}
        for group, last in told.items():
            wanted, _ = group
            if wanted not in statuses:
                statuses[wanted] = moment.status(dict(wanted))
            status = statuses[wanted]
            texts[group] = status, _text(moment.difference(last, status), world.eventtime)
        return texts

    def _tell(self, due, texts):
        self._is_at_work = False
        now, texts = self._loop.time(), texts.result()
        for connection, subscription in due:
            if self._subscriptions.get(connection) is not subscription:
                continue  # gone since, or it wants something else
            status, text = texts[_group(subscription)]
            if text is not None:
                self._latest[subscription.wanted] = status
                subscription.told, subscription.told_at = status, now
                connection.send(text)
        if self._has_news:
            self.changed()
        else:
            self._see_to_the_quiet()


def _group(subscription):
    """Return what those have in common who are told the same: what they were told is one object."""
    return subscription.wanted, id(subscription.told)


def _key(wanted):
    """Return a request in a form that is equal for equal requests."""
    return tuple(
        (name, None if fields is None else tuple(fields)) for name, fields in sorted(wanted.items())
    )


def _text(difference, eventtime):
    """Return the message with what has changed, ``None`` where nothing has."""
    if not difference:
        return None
    return jsonrpc.notification("notify_status_update", [difference, eventtime])
