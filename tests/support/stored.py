"""OctoPrint's own file manager on a folder, and a printer that does what it is told."""

from types import SimpleNamespace

import octoprint.filemanager
import octoprint.plugin
import octoprint.settings
from octoprint.filemanager.storage import LocalFileStorage

PROFILE = {"id": "_default", "name": "Default"}


class Printer:
    """Stands for OctoPrint's printer; ``state`` is one of the words behind ``is_``."""

    def __init__(self):
        self.state = "ready"
        self.job = None, None
        self.is_starting = False
        self.asked = []

    def __getattr__(self, name):
        if name.startswith("is_"):
            return lambda: (
                name[len("is_") :] == self.state
                or (name == "is_operational" and self.state != "offline")
            )
        return lambda *arguments, **named: self.asked.append((name, arguments, named))

    def get_state_id(self):
        return "STARTING" if self.is_starting else "PRINTING"

    def get_current_job(self):
        origin, path = self.job
        return {"file": {"origin": origin, "path": path}}


class _Queue:
    """Stands for the queue of files that are to be analysed."""

    def __getattr__(self, name):
        return lambda *arguments, **named: None


def file_manager(folder, monkeypatch):
    """Return OctoPrint's file manager on a folder."""
    settings = SimpleNamespace(
        getBaseFolder=lambda name, **_: str(folder), get=lambda *_, **__: None
    )
    plugins = SimpleNamespace(get_hooks=lambda name: {}, get_implementations=lambda *_: [])
    monkeypatch.setattr(octoprint.settings, "settings", lambda: settings)
    monkeypatch.setattr(octoprint.plugin, "plugin_manager", lambda: plugins)
    uploads = folder / "uploads"
    uploads.mkdir()
    return octoprint.filemanager.FileManager(
        _Queue(),
        None,
        SimpleNamespace(get_current_or_default=PROFILE.copy, get_default=PROFILE.copy),
        initial_storage_managers={"local": LocalFileStorage(str(uploads))},
    )
