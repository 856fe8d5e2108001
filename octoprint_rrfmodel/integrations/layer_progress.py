"""What users of DisplayLayerProgress read, for prints of which that plugin can't know.

Payload and events have the members and the forms that DisplayLayerProgress gives them with its
default settings (its ``_updateDisplay`` and the developers' section of its README); a text is
``-`` while its value isn't known. Layers, heights and times of a print from the card are the
machine's. Of a print that OctoPrint streams the machine knows no layers, and progress and time
are OctoPrint's.
"""

import time
from collections import deque
from typing import Callable, NamedTuple

from ..rrf.views.printing import printing

PLUGIN = "DisplayLayerProgress"
MESSAGE = "DisplayLayerProgress-websocket-payload"
"""In whose name the payload goes to OctoPrint's pages and other listeners of its socket."""

SHORTEST_SECONDS = 1.0

UNKNOWN = "-"
LAYERS_FOR_AVERAGE = 5

CHANGES = (
    ("layerChanged", "currentLayer"),
    ("progressChanged", "progress"),
    ("heightChanged", "currentHeight"),
    ("feedrateChanged", "feedrate"),
    ("fanspeedChanged", "fanspeed"),
    ("printerStateChanged", "printerState"),
)
"""Reason of an update, also the end of its event's name, and the member that has changed."""


class StreamedPrint(NamedTuple):
    """What OctoPrint knows of a print that it streams."""

    is_paused: bool
    path: str
    completion: float
    """In percent."""
    seconds_left: float


def streamed_print(data):
    """Return the print that OctoPrint's current data tell of; members may be ``None``."""
    flags, progress = data["state"]["flags"], data["progress"]
    return StreamedPrint(
        bool(flags.get("paused") or flags.get("pausing")),
        data["job"]["file"].get("path"),
        progress.get("completion"),
        progress.get("printTimeLeft"),
    )


class Readers(NamedTuple):
    """Whom the payload is sent to."""

    send: Callable[[str, dict], object]
    """Reaches the pages of those who may read the model: message and payload."""
    fire: Callable[[str, dict], object]
    """Reaches OctoPrint's other plugins: event and payload."""


class LayerProgress:
    """Sends the payload on changes during a print, at most once a second, and once when it ends.

    ``readers`` are whom it is sent to. ``model()`` is the snapshot. ``streamed()`` is the print
    that OctoPrint streams, ``None`` where it doesn't. ``is_wanted()`` says whether to send at all.
    ``now()`` is the time of day in seconds. One thread calls ``tick``.
    """

    def __init__(self, readers, model, streamed, *, is_wanted, clock, now=time.time):
        self._readers = readers
        self._model = model
        self._streamed = streamed
        self._is_wanted = is_wanted
        self._clock = clock
        self._now = now
        self._looked_at = None
        self._sent = None
        self._layers = LayerTimes()

    def tick(self):
        """Send what is due; return the seconds until something may be."""
        clock = self._clock()
        if self._looked_at is not None and clock < self._looked_at + SHORTEST_SECONDS:
            return self._looked_at + SHORTEST_SECONDS - clock
        self._looked_at = clock
        # mostly there is none, and to look up a setting takes OctoPrint longer than all of this
        print_ = self._print()
        if print_ is not None and self._is_wanted():
            self._update(print_, clock)
        elif self._sent is not None:
            self._end()
        return SHORTEST_SECONDS

    def _print(self):
        """Return the print under way, ``None`` where there is none."""
        known = printing(self._model())
        if known.is_card_job:
            return known
        streamed = self._streamed()
        if streamed is None:
            return None
        return known._replace(
            is_paused=streamed.is_paused,
            name=streamed.path or "",
            fraction=None if streamed.completion is None else streamed.completion / 100,
            seconds_left=streamed.seconds_left,
        )

    def _update(self, print_, clock):
        if self._sent is None:
            self._layers = LayerTimes()
        self._layers.see(print_.layer, clock)
        self._publish(payload_of(print_, self._layers, self._now()))

    def _end(self):
        """Say that the print is over: what it came to stays, nothing is left to do."""
        over = {"progress": "0", "printerState": "operational", **_time_left(None, 0)}
        self._publish({**self._sent, **over})
        self._sent = None

    def _publish(self, payload):
        before = self._sent or {}
        reasons = [
            reason for reason, member in CHANGES if payload[member] != before.get(member, UNKNOWN)
        ]
        self._sent = payload
        if not reasons:
            return
        for reason in reasons:
            # an event reaches whoever listens, so that it doesn't tell the file's name
            told = {**payload, "updateReason": reason, "currentFilename": UNKNOWN}
            self._readers.fire(f"{PLUGIN}_{reason}", told)
        self._readers.send(MESSAGE, {**payload, "updateReason": reasons[0]})


class LayerTimes:
    """How long the layers of a print took, measured where the number changes."""

    def __init__(self):
        self._layer = None
        self._began_at = None
        self._durations = deque(maxlen=LAYERS_FOR_AVERAGE)

    def see(self, layer, clock):
        """Note the current layer."""
        if layer == self._layer:
            return
        if self._began_at is not None and layer is not None:
            self._durations.append(clock - self._began_at)
        # how long the first one that is seen has been under way isn't known
        self._began_at = clock if self._layer is not None else None
        self._layer = layer

    @property
    def last(self):
        """Seconds of the last whole layer, ``None`` before there is one."""
        return self._durations[-1] if self._durations else None

    @property
    def average(self):
        """Seconds of the last five on average, ``None`` before there are so many."""
        if len(self._durations) < LAYERS_FOR_AVERAGE:
            return None
        return sum(self._durations) / LAYERS_FOR_AVERAGE


def payload_of(print_, layers, now):
    """Return the payload for a print, without the reason of an update."""
    fan = print_.fan
    return {
        "totalLayer": _text(print_.layers, "{}"),
        "currentLayer": _text(print_.layer, "{}"),
        "lastLayerDuration": _duration(layers.last),
        "lastLayerDurationInSeconds": _seconds(layers.last),
        "averageLayerDuration": _duration(layers.average),
        "averageLayerDurationInSeconds": _seconds(layers.average),
        "currentHeight": _text(print_.height, "{:.2f}"),
        "currentHeightFormatted": _text(print_.height, "{:.1f}"),
        "totalHeight": _text(print_.total_height, "{}"),
        "totalHeightFormatted": _text(print_.total_height, "{:.1f}"),
        "feedrate": _text(print_.feed_rate, "{:g}"),
        # the machine doesn't tell the two apart
        "feedrateG0": UNKNOWN,
        "feedrateG1": UNKNOWN,
        "fanspeed": "Off" if fan == 0 else _text(fan, "{:.0%}"),
        "progress": str(_percent(print_.fraction or 0)),
        "m73progress": "",
        **_time_left(print_.seconds_left, now),
        "printerState": "paused" if print_.is_paused else "printing",
        # when the filament has to be changed stands in files that OctoPrint sends
        "estimatedChangedFilamentTime": UNKNOWN,
        "changeFilamentTimeLeft": UNKNOWN,
        "changeFilamentTimeLeftInSeconds": 0,
        "changeFilamentCount": 0,
        "currentFilename": print_.name or UNKNOWN,
    }


def _percent(fraction):
    """Return whole percents as OctoPrint counts them, down; 0.29 is a little less than 29 %."""
    return int(fraction * 100 + 1e-6)


def _time_left(seconds, now):
    if seconds is None:
        return {
            "printTimeLeft": UNKNOWN,
            "printTimeLeftInSeconds": UNKNOWN,
            "estimatedEndTime": UNKNOWN,
        }
    whole = int(seconds)
    return {
        "printTimeLeft": _time(whole),
        "printTimeLeftInSeconds": whole,
        "estimatedEndTime": time.strftime("%H:%M", time.localtime(now + whole)),
    }


def _time(seconds):
    """Return a time as ``1d2h3m``, ``2h3m``, ``3m``, or ``40s``."""
    days, rest = divmod(seconds, 86400)
    hours, rest = divmod(rest, 3600)
    minutes, rest = divmod(rest, 60)
    if days:
        return f"{days}d{hours}h{minutes}m"
    if hours:
        return f"{hours}h{minutes}m"
    return f"{minutes}m" if minutes else f"{rest}s"


def _duration(seconds):
    """Return a layer's time as ``0h:01m:03s``."""
    if seconds is None:
        return UNKNOWN
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}h:{minutes:02}m:{rest:02}s"


def _seconds(value):
    return UNKNOWN if value is None else int(value)


def _text(value, form):
    return UNKNOWN if value is None else form.format(value)
