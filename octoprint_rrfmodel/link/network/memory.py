"""What the plugin's settings keep of boards on the network: which there were, their passwords."""

import threading

PATH = "network"


class Memory:
    """Reads and writes the plugin's settings; ``settings()`` are those. Any thread may ask.

    Passwords are kept by address. They are in no parameter of a connection: those are shown to
    everybody who may see OctoPrint's state.
    """

    def __init__(self, settings):
        self._settings = settings
        self._lock = threading.Lock()

    def password(self, address):
        """Return the password of the board at an address, an empty one where none is kept."""
        return self._all("passwords").get(address.text, "")

    def keep_password(self, address, password):
        """Keep a board's password; an empty one is forgotten."""
        self._change("passwords", address.text, password)

    def hosts(self):
        """Return the addresses that somebody who may has connected to."""
        return sorted(self._all("hosts"))

    def keep_host(self, address):
        """Remember an address."""
        self._change("hosts", address.text, True)

    def patience(self):
        """Return how many seconds a board may be gone for before the connection ends."""
        minutes = self._settings().get_float([PATH, "gap_minutes"], min=0.5)
        return 60.0 * (minutes if minutes else 30.0)

    def _all(self, name):
        kept = self._settings().get([PATH, name], merged=True)
        return dict(kept) if isinstance(kept, dict) else {}

    def _change(self, name, key, value):
        with self._lock:
            before = self._all(name)
            after = {other: kept for other, kept in before.items() if other != key}
            if value:
                after[key] = value
            if after != before:
                self._settings().set([PATH, name], after, force=True)
                self._settings().save()
