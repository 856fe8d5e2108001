"""What the charts show: kept here, so that every page has it, also one that was just opened."""

import math
import threading
import time

from flask_babel import gettext

from ..host.answers import answer, may_read, refusal
from ..rrf.views.history import INTERVAL_SECONDS, History
from ..rrf.views.layers import Layers

TICK_SECONDS = 1.0

WARM_SECONDS = 6.0
"""Time after which the next temperatures of a line are overdue: OctoPrint asks every five."""


class MachineHistory:
    """Keeps samples and layers, and answers requests for them.

    ``model()`` is the snapshot, ``is_stale()`` says whether it may still be shown as what is so
    now, ``now()`` is the time of day in seconds. ``audience`` is told who looks, ``streamed`` are
    the layers of a print that OctoPrint sends.
    """

    def __init__(self, model, is_stale, now=time.time, *, audience, streamed):
        self._model = model
        self._audience = audience
        self._streamed = streamed
        self._is_stale = is_stale
        self._now = now
        self._history = History()
        self._layers = Layers()
        self._warmed_at = -math.inf
        self._lock = threading.Lock()

    ##~~ a listener

    def identified(self):
        """Note that it may be another machine now."""
        with self._lock:
            self._history.connected()

    def replied(self, taken, asked_at):
        """Take what the model says after a reply."""
        self._sample()

    def warmed(self, warmed):
        """Take temperatures that a line has told; nothing else is known at the moment."""
        model, now = self._model(), self._now()
        self._warmed_at = now
        with self._lock:
            self._history.sample(model, now, warmed.heaters)

    def reset(self):
        """Take that the board began anew."""
        self._sample()

    def _sample(self):
        model, now = self._model(), self._now()
        with self._lock:
            self._history.sample(model, now)
            self._layers.look(model, now)

    def line(self, line):
        """Take a line of text from the printer."""
        with self._lock:
            self._layers.heard(line)

    def forgotten(self):
        """Leave a gap: the connection is gone."""
        with self._lock:
            self._history.gap(self._now())

    def tick(self):
        """Leave a gap where nothing has come for too long; return the seconds until next time."""
        self._streamed.tick()
        if self._is_stale() and not 0 <= self._now() - self._warmed_at < WARM_SECONDS:
            self.forgotten()
        return TICK_SECONDS

    ##~~ any thread

    def samples(self, since):
        """Return the samples that are later than a time of day."""
        with self._lock:
            return self._history.since(since)

    def get_history(self, arguments):
        """Return what is kept, or only what has come since a time."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        try:
            since = float(arguments.get("since", "-inf"))
        except ValueError:
            since = math.nan
        if math.isnan(since):
            return refusal(400, gettext("The time in since is a number of seconds."))
        self._audience.charts()
        return answer(self._told(since))

    def _told(self, since):
        with self._lock:
            now = self._now()
            samples = self._history.since(since)
            layers = self._latest_layers()
            began_at = layers.began_at
            ended = layers.since(since)
        return {
            "now": _rounded(now),
            "interval": INTERVAL_SECONDS,
            "times": [_rounded(at) for at in samples.times],
            "series": [{"id": each.id, **each._asdict()} for each in samples.series],
            "began": None if began_at is None else _rounded(began_at),
            "layers": [_layer(each) for each in ended],
            "streamed": self._streamed.told(),
        }

    def _latest_layers(self):
        """Return the layers of the job that was begun last, whoever runs it."""
        own, streamed = self._layers.began_at, self._streamed.began_at
        is_sent = streamed is not None and (own is None or streamed > own)
        return self._streamed if is_sent else self._layers


def _layer(layer):
    told = {
        name: value if value is None else round(value, 2) for name, value in layer._asdict().items()
    }
    return {**told, "layer": layer.layer, "at": _rounded(layer.at)}


def _rounded(seconds):
    """Return a time in milliseconds, never later than it is: it is asked for what came since."""
    return math.floor(seconds * 1000) / 1000
