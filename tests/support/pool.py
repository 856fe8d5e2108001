"""Servers that one module after another has: a start costs more than most tests.

A server is handed on only as it was after its start. What can be set back is set back, all else is
compared, and a server that is another one than before is stopped.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Any, Callable

import requests
import yaml

from .basedir import complete_profile, is_version_2
from .server import OctoPrintServer

PROFILE = "/api/printerprofiles/_default"
CHANGED_PROFILES = "rrfmodel_changed_profiles.json"

SET_BY_REQUEST = {"serial", "plugins_config", "profile"}
"""Options that a running server can be given; any other makes a server of the module's own."""

KEPT = 2
"""Servers that wait for the next module; each takes memory, and a little of the processor."""

AT_REST = {
    "connected": False,
    "is_rrf": False,
    "ready": False,
    "protocol": None,
    "firmware": None,
    "blocked": None,
    "age": None,
}
"""What the plugin says of itself while nothing is connected."""


class ServerPool:
    """The servers of one process of tests; ``make_basedir`` returns a new folder each time."""

    def __init__(self, make_basedir: Callable[[], Path], ports_glob: str) -> None:
        self._make_basedir = make_basedir
        self._ports_glob = ports_glob
        self._free: list[OctoPrintServer] = []
        self._lent: dict[OctoPrintServer, dict[str, Any]] = {}

    def lend(self, *, own: bool = False, **options: Any) -> OctoPrintServer:
        """Return a server with these options and no printer, as it is after its start.

        With ``own`` it is one that nobody had before, and that nobody has afterwards.
        """
        if own or not set(options) <= SET_BY_REQUEST:
            return self._started(**options)
        server = self._free.pop() if self._free else self._started()
        self._lent[server] = _remembered(server)
        server.forget_logs()
        _set(server, **options)
        return server

    def _started(self, **options: Any) -> OctoPrintServer:
        options.setdefault("ports_glob", self._ports_glob)
        return OctoPrintServer(self._make_basedir(), **options).start()

    def take_back(self, server: OctoPrintServer) -> None:
        """Keep the server for the next who wants one, or stop it."""
        before = self._lent.pop(server, None)
        if before is not None and len(self._free) < KEPT and _is_as_before(server, before):
            self._free.append(server)
        else:
            server.stop()

    def stop(self) -> None:
        """Stop all, those too that nobody gave back."""
        for server in (*self._free, *self._lent):
            server.stop()
        self._free.clear()
        self._lent.clear()


def _set(
    server: OctoPrintServer,
    serial: dict[str, Any] | None = None,
    plugins_config: dict[str, Any] | None = None,
    profile: dict[str, Any] | None = None,
) -> None:
    settings: dict[str, Any] = {"plugins": plugins_config or {}}
    if serial:
        if is_version_2(server.version):
            settings["plugins"] = {**settings["plugins"], "serial_connector": serial}
        else:
            settings["serial"] = _by_names_of_1_11(serial)
    if settings != {"plugins": {}}:
        _post_settings(server, settings)
    if profile is not None:
        _patch_profile(server, complete_profile(profile))


def _by_names_of_1_11(serial: dict[str, Any]) -> dict[str, Any]:
    """Return settings of the serial line by the names that 1.11 has for them over HTTP."""
    prefixes = {"timeout": "timeout", "maxCommunicationTimeouts": "maxTimeouts"}
    found = {}
    for name, value in serial.items():
        if name in prefixes:
            for part, seconds in value.items():
                found[prefixes[name] + part[0].upper() + part[1:]] = seconds
        else:
            found[name] = value
    return found


def _is_as_before(server: OctoPrintServer, before: dict[str, Any]) -> bool:
    """Set back what can be, and return whether the server is as it was."""
    with suppress(AssertionError, requests.RequestException, KeyError):
        _set_back(server, before)
        return _remembered(server) == before
    return False


def _set_back(server: OctoPrintServer, before: dict[str, Any]) -> None:
    if server.state().startswith(("Printing", "Starting", "Paus", "Resum")):
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 20)
    if not server.state().startswith(("Offline", "Closed")):
        server.disconnect()
        server.wait_disconnected()
    server.wait_for(lambda: _status(server) == AT_REST, 10, "the plugin to be at rest")
    for entry in server.get("/api/files/local").json()["files"]:
        # what is selected isn't any more once it is deleted
        server.delete(f"/api/files/local/{entry['path']}")
    if server.get(PROFILE).json() != before["profile"]:
        _patch_profile(server, before["profile"])
    if _config(server) != before["config"]:
        now = _settings(server)
        changed = {
            name: _differing(before["settings"][name], now[name]) for name in ("serial", "plugins")
        }
        _post_settings(server, changed)


def _differing(before: dict[str, Any], now: dict[str, Any]) -> dict[str, Any]:
    """Return what was another value before, as it was."""
    found = {}
    for name, value in before.items():
        if isinstance(value, dict) and isinstance(now.get(name), dict):
            if inner := _differing(value, now[name]):
                found[name] = inner
        elif value != now.get(name):
            found[name] = value
    return found


def _post_settings(server: OctoPrintServer, settings: dict[str, Any]) -> None:
    response = server.post("/api/settings", json=settings)
    assert response.status_code == 200, response.text


def _patch_profile(server: OctoPrintServer, profile: dict[str, Any]) -> None:
    response = server.patch(PROFILE, json={"profile": profile})
    assert response.status_code == 200, response.text


def _status(server: OctoPrintServer) -> dict[str, Any]:
    status = server.get("/plugin/rrfmodel/status").json()
    return {name: status[name] for name in AT_REST}


def _remembered(server: OctoPrintServer) -> dict[str, Any]:
    """Return all that would make the next test's server another one."""
    return {
        "settings": _settings(server),
        "config": _config(server),
        "profile": server.get(PROFILE).json(),
        "groups": server.get("/api/access/groups").json(),
        "users": server.get("/api/access/users").json(),
        "files": server.get("/api/files/local").json()["files"],
        "selected": server.job()["job"]["file"]["name"],
        "first_run": server.get("/plugin/rrfmodel/status").json()["first_run"],
        "changed profiles": (server.basedir / CHANGED_PROFILES).exists(),
        "scripts": sorted(path.name for path in (server.basedir / "scripts").rglob("*")),
    }


def _settings(server: OctoPrintServer) -> dict[str, Any]:
    found = server.get("/api/settings").json()
    # the ports that there are now
    found["serial"].pop("portOptions", None)
    return {name: found[name] for name in ("serial", "plugins")}


def _config(server: OctoPrintServer) -> Any:
    """Return what OctoPrint has in its file, without groups that have nothing in them."""
    return _without_empty(yaml.safe_load((server.basedir / "config.yaml").read_text("utf-8")))


def _without_empty(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    inner = {name: _without_empty(each) for name, each in value.items()}
    return {name: each for name, each in inner.items() if each != {}}
