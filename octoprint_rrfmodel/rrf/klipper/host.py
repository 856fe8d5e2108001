"""``webhooks``, ``idle_timeout``, ``mcu`` and others about the machine as a whole."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..views.machine import mapping
from .values import number, text
from .view import Row, View, each, one, where

IDLE_TIMEOUT = 600
"""Seconds of rest after which ``idle_timeout`` says ``Idle``, Klipper's default."""

STARTUP, READY, SHUTDOWN, ERROR = "startup", "ready", "shutdown", "error"

STATES = {
    "starting": (STARTUP, "Printer is not ready"),
    "updating": (STARTUP, "Printer is not ready"),
    "halted": (SHUTDOWN, "Emergency stop"),
    "off": (SHUTDOWN, "Power is off"),
}
"""Values of ``state.status`` in which Klipper would not be ready."""

HELP = {
    "G0": "Move",
    "G1": "Move",
    "G28": "Home axes",
    "G29": "Probe the bed, load or clear its height map",
    "G32": "Run bed.g",
    "M0": "Cancel a paused job",
    "M18": "Motors off",
    "M24": "Start or resume the job",
    "M25": "Pause the job",
    "M32": "Print a file from the card",
    "M37": "Simulate a file",
    "M80": "Power on",
    "M81": "Power off",
    "M98": "Run a macro",
    "M106": "Set a fan",
    "M112": "Emergency stop",
    "M115": "Firmware version",
    "M117": "Show a message",
    "M140": "Set the bed's temperature",
    "M141": "Set the chamber's temperature",
    "M144": "Bed to standby",
    "M220": "Set the speed factor",
    "M221": "Set an extrusion factor",
    "M290": "Babystepping",
    "M292": "Answer a message box",
    "M409": "Query the object model",
    "M486": "Cancel an object",
    "M562": "Reset a heater fault",
    "M568": "Set a tool's temperatures and state",
    "M701": "Load filament",
    "M702": "Unload filament",
    "M999": "Restart the board",
}
"""Commands that a person may want, and what they do."""

LAST_STATS = (
    "mcu_awake",
    "mcu_task_avg",
    "mcu_task_stddev",
    "bytes_write",
    "bytes_read",
    "bytes_retransmit",
    "bytes_invalid",
    "send_seq",
    "receive_seq",
    "retransmit_seq",
    "srtt",
    "rttvar",
    "rto",
    "ready_bytes",
    "upcoming_bytes",
    "freq",
)
"""Statistics of Klipper's own protocol; RRF has none of them."""


def klippy_state(view: View) -> tuple[str, str]:
    """Return ``webhooks.state`` and ``.state_message``."""
    if not view.host.is_connected:
        return SHUTDOWN, "Printer not connected"
    if not view.host.has_protocol:
        return ERROR, "Printer is not ready"
    if view.status in STATES:
        return STATES[view.status]
    if not view.host.is_ready:
        return STARTUP, "Printer is not ready"
    return READY, startup_error(view) or "Printer is ready"


def startup_error(view: View) -> str:
    """Return what went wrong in ``config.g``, ``file line n: message``; empty where nothing did."""
    error = mapping(view.state.get("startupError"))
    if not error:
        return ""
    line = number(error.get("line"))
    place = f"{text(error.get('file'))}{'' if line is None else f' line {line}'}".strip()
    return ": ".join(part for part in (place, text(error.get("message"))) if part)


def _idle_state(view: View, thing: Any) -> str:
    kept = view.kept
    # Klipper's word for any command that runs; the model can't be asked for meanwhile
    if kept.activity == "printing" or view.host.is_at_work:
        return "Printing"
    if kept.activity == "paused":
        return "Ready"
    rests = view.eventtime - kept.since
    return "Ready" if kept.activity == "idle" and rests < IDLE_TIMEOUT else "Idle"


def _printing_time(view: View, thing: Any) -> float:
    kept = view.kept
    return max(0.0, view.eventtime - kept.since) if kept.activity == "printing" else 0.0


def _mainboard(view: View) -> Any:
    return next(iter(view.boards.values()), None)


def _other_boards(view: View) -> Mapping[str, Any]:
    return dict(list(view.boards.items())[1:])


_MCU = {
    "mcu_version": lambda view, board: text(board.get("firmwareVersion")) or None,
    "mcu_constants": lambda view, board: {"MCU": text(board.get("shortName")) or None},
    "last_stats": lambda view, board: dict.fromkeys(LAST_STATS),
}


ROWS = (
    Row(
        "webhooks",
        one("webhooks"),
        {
            "state": lambda view, _: klippy_state(view)[0],
            "state_message": lambda view, _: klippy_state(view)[1],
        },
    ),
    Row(
        "idle_timeout",
        one("idle_timeout"),
        {
            "state": _idle_state,
            "printing_time": _printing_time,
            "idle_timeout": lambda view, _: IDLE_TIMEOUT,
        },
    ),
    Row(
        "gcode",
        one("gcode"),
        {"commands": lambda view, _: {code: {"help": help} for code, help in HELP.items()}},
    ),
    Row("mcu", where("mcu", _mainboard), _MCU),
    Row("mcu X", each("mcu", _other_boards), _MCU),
)
