"""``server.info`` and ``printer.info``, as Moonraker gives them."""

from __future__ import annotations

from typing import Any

from .host import klippy_state
from .query import seen
from .values import text
from .world import World

API_VERSION = (1, 5, 0)
"""Of Moonraker, whose forms are served."""

NAME = "rrfmodel"
"""In front of the plugin's version: Mainsail and Fluidd take a bare number for Klipper's."""


def server_info(world: World, websocket_count: int, version: str) -> dict[str, Any]:
    """Return ``server.info``; the plugin's ``version`` stands where Moonraker has its own."""
    is_connected = world.host.is_connected
    return {
        "klippy_connected": is_connected,
        "klippy_state": klippy_state(seen(world))[0] if is_connected else "disconnected",
        "components": [],
        "failed_components": [],
        "registered_directories": ["gcodes", "printer"],
        "warnings": [],
        "websocket_count": websocket_count,
        "moonraker_version": _named(version),
        "missing_klippy_requirements": [],
        "api_version": list(API_VERSION),
        "api_version_string": ".".join(map(str, API_VERSION)),
    }


def printer_info(world: World, version: str, hostname: str) -> dict[str, Any]:
    """Return ``printer.info``; the plugin's ``version`` stands where Klipper has its own.

    Paths and numbers of Klipper's process are empty, the board is what it says of a processor.
    """
    view = seen(world)
    state, message = klippy_state(view)
    board: Any = next(iter(view.boards.values()), {})
    parts = [text(board.get(name)) for name in ("name", "firmwareName", "firmwareVersion")]
    return {
        "state": state,
        "state_message": message,
        "hostname": hostname,
        "klipper_path": "",
        "python_path": "",
        "process_id": None,
        "user_id": None,
        "group_id": None,
        "log_file": "",
        "config_file": "",
        "software_version": _named(version),
        "cpu_info": " ".join(part for part in parts if part),
    }


def _named(version: str) -> str:
    return f"{NAME}-{version}"
