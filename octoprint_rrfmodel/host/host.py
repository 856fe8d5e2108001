"""OctoPrint as the parts of the plugin see it."""

from typing import Any, Callable, NamedTuple


class Host(NamedTuple):
    """What OctoPrint gives a plugin; it does so after the parts were made, hence the calls."""

    printer: Callable[[], Any]
    profiles: Callable[[], Any]
    """The printer profile manager."""
    plugins: Callable[[], Any]
    """The plugin manager."""
    settings: Callable[[], Any]
    """The plugin's own settings."""
    users: Callable[[], Any]
    """The user manager."""
    folder: Callable[[], str]
    """Where the plugin may keep files."""
    version: Callable[[], str]
    """The plugin's version."""
    fire: Callable[[str, dict], Any]
    """Fires an event."""
    tell_pages: Callable[[dict], Any]
    """Sends a message to the pages of those who may read the model."""
    files: Callable[[], Any]
    """The file manager."""
    path_on_disk: Callable[[str], str]
    """Where a file of OctoPrint's own is kept."""

    def is_set(self, *path):
        """Return whether a switch of the plugin's settings is on."""
        return self.settings().get_boolean(list(path))

    def simulator(self):
        """Return the settings of the simulated board."""
        return self.settings().get(["simulator"], merged=True)

    def silence_minutes(self):
        """Return how long the board may say nothing during a long command, 0 for no limit."""
        return self.settings().get_float(["silence_minutes"], min=0.0) or 0.0
