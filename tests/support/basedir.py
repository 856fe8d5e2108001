"""Everything an OctoPrint server finds in its base folder before its first start."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import argon2
import yaml


@dataclass(frozen=True)
class User:
    """Somebody with an account; the API key is known before the server starts."""

    name: str
    group: str
    password: str
    api_key: str


ADMIN = User("admin", "admins", "admin-password", "A0" * 16)
OPERATOR = User("operator", "users", "operator-password", "B0" * 16)
READER = User("reader", "readonly", "reader-password", "C0" * 16)
USERS = (ADMIN, OPERATOR, READER)

USB_BAUD = 1_000_000
"""Rate that means nothing, as on USB; no line is spared for it however busy the machine is."""

# bundled plugins that ask the internet, measure the host or nag; none of them changes what is
# tested, and the plugin manager's look at pip takes a second of each start
DISABLED_PLUGINS = [
    "achievements",
    "announcements",
    "backup",
    "discovery",
    "errortracking",
    "file_check",
    "firmware_check",
    "health_check",
    "pi_support",
    "pluginmanager",
    "softwareupdate",
    "tracking",
]

# OctoPrint takes a profile only if it is complete
DEFAULT_PROFILE: dict[str, Any] = {
    "id": "_default",
    "name": "Default",
    "model": "Test printer",
    "color": "default",
    "volume": {
        "width": 200.0,
        "depth": 200.0,
        "height": 200.0,
        "formFactor": "rectangular",
        "origin": "lowerleft",
        "custom_box": False,
    },
    "heatedBed": True,
    "heatedChamber": False,
    "extruder": {
        "count": 1,
        "offsets": [[0.0, 0.0]],
        "nozzleDiameter": 0.4,
        "sharedNozzle": False,
        "defaultExtrusionLength": 5,
    },
    "axes": {
        "x": {"speed": 6000, "inverted": False},
        "y": {"speed": 6000, "inverted": False},
        "z": {"speed": 200, "inverted": False},
        "e": {"speed": 300, "inverted": False},
    },
}


def is_version_2(version: str) -> bool:
    """Return whether ``version`` keeps its serial settings where OctoPrint 2.0 moved them."""
    return int(version.split(".")[0]) >= 2


def merged(*layers: dict[str, Any] | None) -> dict[str, Any]:
    """Return a new dictionary of all layers; a later one wins, dictionaries merge."""
    result: dict[str, Any] = {}
    for layer in layers:
        for key, value in (layer or {}).items():
            both = isinstance(value, dict) and isinstance(result.get(key), dict)
            result[key] = merged(result[key], value) if both else value
    return result


# a hash is meant to take long, and these guard nothing: each start makes some, each login one
HASHER = argon2.PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)


def configuration(
    version: str,
    *,
    plugins_config: dict[str, Any] | None = None,
    serial: dict[str, Any] | None = None,
    autoconnect: tuple[str, int] | None = None,
    settings: dict[str, Any] | None = None,
) -> dict[str, Any]:
    """Return the content of ``config.yaml`` for that OctoPrint.

    ``serial`` are settings that 1.11 keeps in ``serial`` and 2.0 in ``plugins.serial_connector``,
    ``autoconnect`` is the port and baud rate to open at start-up, ``settings`` goes over it all.
    """
    config: dict[str, Any] = {
        "accessControl": {"autologinLocal": False},
        "devel": {"enableRateLimiter": False},
        # no process that reads each uploaded file beside the test
        "gcodeAnalysis": {"runAt": "never"},
        # the wizard for the first machine would stand before what a test looks at
        "plugins": {"_disabled": DISABLED_PLUGINS, "rrfmodel": {"wizard_seen": True}},
        # where OctoPrint itself writes it when a profile is changed
        "printerProfiles": {"default": "_default"},
        "server": {
            "firstRun": False,
            "secretKey": "0123456789abcdef" * 2,
            "onlineCheck": {"enabled": False},
            "seenWizards": {"corewizard": 5, "tracking": 1, "backup": None, "file_check": 1},
        },
    }
    serial = merged({"log": True, "additionalBaudrates": [USB_BAUD]}, serial)
    port, baudrate = autoconnect or (None, None)
    if is_version_2(version):
        placed = {
            "plugins": {"serial_connector": {"_config_version": 3, **serial}},
            "printerConnection": {
                "autoconnect": autoconnect is not None,
                "preferred": {
                    "connector": "serial",
                    "parameters": {"port": port, "baudrate": baudrate},
                },
            },
            "server": {"pluginBlocklist": {"enabled": False}},
        }
    else:
        if autoconnect is not None:
            serial = merged(serial, {"autoconnect": True, "port": port, "baudrate": baudrate})
        placed = {"serial": serial, "server": {"pluginBlacklist": {"enabled": False}}}
    return merged(config, placed, {"plugins": plugins_config or {}}, settings)


def write_basedir(
    basedir: Path,
    config: dict[str, Any],
    *,
    users: tuple[User, ...] = USERS,
    profile: dict[str, Any] | None = None,
) -> None:
    """Create the folder with configuration, users and printer profile.

    ``profile`` holds what differs from ``DEFAULT_PROFILE``.
    """
    basedir.mkdir(parents=True, exist_ok=True)
    _dump(basedir / "config.yaml", config)
    # left by a start that was broken off; without plugins there would be nothing to see
    (basedir / ".incomplete_startup").unlink(missing_ok=True)
    accounts = {
        user.name: {
            "active": True,
            "apikey": user.api_key,
            "groups": [user.group],
            "password": HASHER.hash(user.password),
            "permissions": [],
            "roles": ["user", "admin"] if user.group == "admins" else ["user"],
            "settings": {},
        }
        for user in users
    }
    _dump(basedir / "users.yaml", {"_version": 2, **accounts})
    (basedir / "printerProfiles").mkdir(exist_ok=True)
    _dump(basedir / "printerProfiles" / "_default.profile", complete_profile(profile))


def complete_profile(profile: dict[str, Any] | None) -> dict[str, Any]:
    """Return a whole printer profile; ``profile`` holds what differs from ``DEFAULT_PROFILE``."""
    complete = merged(DEFAULT_PROFILE, profile)
    extruder = complete["extruder"]
    # one offset for each extruder; where there are more extruders the rest lie on the first
    missing = extruder["count"] - len(extruder["offsets"])
    extruder["offsets"] = extruder["offsets"] + [[0.0, 0.0]] * missing
    return complete


def _dump(path: Path, content: dict[str, Any]) -> None:
    path.write_text(yaml.safe_dump(content), encoding="utf-8")
