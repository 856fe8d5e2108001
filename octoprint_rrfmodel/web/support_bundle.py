"""What is known of a machine and of the plugin's doings, as a file to be sent to a stranger.

Made on request and kept nowhere. All that goes into it goes through one ``Anonymiser``.
"""

import datetime
import platform
import re
from pathlib import Path
from typing import Any, NamedTuple

import octoprint

from ..host.own_log import OwnLog
from ..host.plugin_settings import DEFAULTS
from ..rrf.wire import bundle
from ..rrf.wire.anonymiser import Anonymiser

README = """\
A support bundle of the plugin RRFModel for OctoPrint

versions.json   versions of OctoPrint, the plugin, Python, the system, and of some plugins
machine.json    what firmware and boards the machine has
model.json      the machine's object model
status.json     the plugin's state, with its warnings
settings.json   the plugin's settings, and those of OctoPrint's that a machine depends on
exchanges.txt   what the plugin has asked the machine lately, and its answers
console.txt     what else was said lately, without the lines of a print
log.txt         what the plugin has logged since OctoPrint's start

Names, addresses, identifiers, names of files, texts that people have written, their variables
and passwords are not in it. What stands in their places is the same where they were: "file-1.gcode"
is one file throughout. What a machine can do, temperatures and positions are in it as they are.
Look through it before you send it.

A simulated board can be this machine:
    python -m octoprint_rrfmodel.simulator --replay BUNDLE --link PATH
"""

MOST_LINES = 400
"""Of the console."""

KNOWN_PLUGINS = (
    "DisplayLayerProgress",
    "PrintTimeGenius",
    "SpoolManager",
    "Spoolman",
    "arc_welder",
    "bedlevelvisualizer",
    "cancelobject",
    "dashboard",
    "excluderegion",
    "filamentmanager",
    "gcodesystemcommands",
    "mqtt",
    "obico",
    "octoapp",
    "octoeverywhere",
    "octolapse",
    "octorelay",
    "psucontrol",
    "telegram",
    "themeify",
    "uicustomizer",
)
"""Identifiers of plugins that many have and that look at lines, prints or pages; others are
counted."""

SYSTEMS = re.compile(
    r'^(ID|VERSION_ID)="?((?:debian|raspbian|ubuntu|fedora|arch|alpine|nixos|opensuse)|[\d.]{1,8})"?$',
    re.MULTILINE,
)
"""Lines of a system's description of itself that many have in common."""

RELEASE = re.compile(r"\d{1,3}(?:\.\d{1,3}){0,2}")
"""A version without what somebody has put behind it."""

PUBLISHED = re.compile(r"\d{1,3}(?:\.\d{1,3}){1,3}(?:(?:a|b|rc|\.dev|\.post)\d{1,4})?")
"""A version as it is published; what follows is of somebody's own build."""


class Heard(NamedTuple):
    """What keeps something of what was said lately."""

    exchanges: Any
    """``link.exchanges.Exchanges``."""
    console: Any
    """``web.moonraker.gcode_store.GcodeStore``."""
    log: OwnLog


class SupportBundle:
    """Makes bundles; any thread may ask, but for Tornado's: it takes its time.

    ``status()`` is the plugin's state, ``model()`` the snapshot, ``link`` knows what the board has
    told of its firmware, ``octoprint_settings()`` are the rows of those that matter.
    """

    def __init__(self, host, status, model, *, link, octoprint_settings, heard):
        self._host = host
        self._status = status
        self._model = model
        self._link = link
        self._octoprint_settings = octoprint_settings
        self._heard = heard
        self.start = heard.log.start
        self.stop = heard.log.stop

    def archive(self):
        """Return a bundle of now, as bytes."""
        anonymiser = Anonymiser()
        # first of all, so that what has a name in the model has a fitting one everywhere
        model = anonymiser.model(self._model())
        status = self._status()
        return bundle.packed(
            {
                "README.txt": README,
                "versions.json": self._versions(),
                bundle.MACHINE: self._machine(status, anonymiser),
                bundle.MODEL: {"key": "", "flags": "d99vno", "result": model},
                "status.json": _shown_status(status, anonymiser),
                "settings.json": self._settings(anonymiser),
                "exchanges.txt": self._exchanges(anonymiser),
                "console.txt": self._console(anonymiser),
                "log.txt": self._log(anonymiser),
            }
        )

    def _versions(self):
        found = self._host.plugins().enabled_plugins
        others = {name: each for name, each in found.items() if not each.bundled}
        return {
            "octoprint": _version(PUBLISHED, octoprint.__version__),
            "plugin": _version(PUBLISHED, self._host.version()),
            "python": platform.python_version(),
            "system": platform.system(),
            "kernel": _version(RELEASE, platform.release()),
            "machine": platform.machine(),
            "distribution": dict(SYSTEMS.findall(_distribution())),
            "plugins": {
                name: _version(PUBLISHED, others[name].version)
                for name in KNOWN_PLUGINS
                if name in others
            },
            "other_plugins": len(others.keys() - {*KNOWN_PLUGINS, "rrfmodel"}),
        }

    def _machine(self, status, anonymiser):
        return {
            "form": bundle.FORM,
            "protocol": status["protocol"],
            "link": status["link"],
            "reported": anonymiser.members(self._link.reported),
        }

    def _settings(self, anonymiser):
        own = self._host.settings()
        plugin = {
            name: own.get([name], merged=isinstance(default, dict))
            for name, default in DEFAULTS.items()
        }
        rows = [
            {"setting": row["setting"], "now": row["now"], "fulfilled": row["fulfilled"]}
            for row in self._octoprint_settings()
        ]
        shown = [{**row, "now": anonymiser.codes(row["now"])} for row in rows]
        return {"plugin": anonymiser.settings(plugin), "octoprint": shown}

    def _exchanges(self, anonymiser):
        shown = {"sent": anonymiser.command}
        return _text(
            f"{-ago:9.2f} {direction:8} {shown.get(direction, anonymiser.line)(text)}"
            for ago, direction, text in self._heard.exchanges.latest()
        )

    def _console(self, anonymiser):
        shown = {"command": anonymiser.command}
        return _text(
            f"{_time(line['time'])} {line['type']:8}"
            f" {shown.get(line['type'], anonymiser.line)(line['message'])}"
            for line in self._heard.console.latest(MOST_LINES)
        )

    def _log(self, anonymiser):
        return _text(_log_line(line, anonymiser) for line in self._heard.log.latest())


def _shown_status(status, anonymiser):
    """Return the plugin's state; warnings without their sentences, which are in any language."""
    warnings = [
        {name: value for name, value in warning.items() if name != "text"}
        for warning in status["warnings"]
    ]
    return anonymiser.members({**status, "warnings": warnings})


def _log_line(line, anonymiser):
    values = tuple(
        anonymiser.sentence(value) if isinstance(value, str) else value for value in line.values
    )
    try:
        said = line.sentence % values if values else line.sentence
    except (TypeError, ValueError):
        said = line.sentence
    raised = f"{line.error}: {anonymiser.sentence(line.message)}" if line.error else ""
    below = [f"    {each}" for each in (*line.frames, raised) if each]
    return "\n".join([f"{_time(line.at)} {line.level:8} {line.logger}: {said}", *below])


def _time(at):
    return datetime.datetime.fromtimestamp(at).strftime("%H:%M:%S")


def _text(lines):
    return "".join(f"{line}\n" for line in lines)


def _version(pattern, text):
    found = pattern.match(text or "")
    return found[0] if found else ""


def _distribution():
    try:
        return Path("/etc/os-release").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
