"""Who looks at the model, and at which parts of it: on a slow line those are kept fresh.

A page says which of its views is open, a program reads a key, Prometheus scrapes: each is a look
that lasts for a while. Who has subscribed looks as long as that lasts.
"""

TICK_SECONDS = 10.0

SCRAPE_SECONDS = 120.0
"""Time until the next scrape, at the longest that is usual."""

STRIP = ("heat.heaters[].current", "heat.heaters[].active", "job", "move.axes", "tools")
"""What a page shows beside any of its views: sidebar and strip."""

VIEWS = {
    "": STRIP,
    "machine": (*STRIP, "fans", "move", "sensors", "spindles"),
    "job": (*STRIP, "fans", "move"),
    "chart": (*STRIP, "heat.heaters[].avgPwm"),
    "model": ("",),
}
"""View of the page to the parts that it shows."""

CHART = ("heat.heaters[].current", "heat.heaters[].active", "heat.heaters[].avgPwm")

METRICS = ("heat", "tools", "job", "fans", "move", "sensors", "boards", "spindles")

KLIPPER = (*STRIP, "fans", "move")
"""What Klipper's printer objects are made from that changes all the time."""


class Audience:
    """Keeps ``interest`` (``rrf.follow.interest``); any thread may call it.

    ``sockets()`` is how many ask for printer objects, ``subscribed()`` the keys of which other
    plugins want changes.
    """

    def __init__(self, interest, sockets, subscribed):
        self._interest = interest
        self._sockets = sockets
        self._subscribed = subscribed
        self.publishes = bool
        """Returns whether what changes is published; made later than this."""

    def sees(self, view):
        """Note the view that a page has open, "" for none of the plugin's own."""
        self._interest.look(*VIEWS.get(view, STRIP))

    def reads(self, key):
        """Note that somebody has read a key of the model."""
        self._interest.look(key.lstrip("#"))

    def charts(self):
        """Note that somebody has read what is kept of temperatures."""
        self._interest.look(*CHART)

    def scrapes(self):
        """Note that the metrics were read."""
        self._interest.look(*METRICS, seconds=SCRAPE_SECONDS)

    ##~~ a listener

    def tick(self):
        """Note who still wants to be told; return the seconds until next time."""
        if self._sockets():
            self._interest.look(*KLIPPER)
        if self.publishes():
            self._interest.look(*STRIP)
        subscribed = self._subscribed()
        if subscribed:
            self._interest.look(*subscribed)
        return TICK_SECONDS
