"""The words that the model's states are told in; whoever passes one on passes on no other text."""

from __future__ import annotations

from typing import Any

from ..wire.m408_table import HEATER_STATES, STATUS

UNKNOWN = "unknown"
"""Stands for a word that isn't one of RepRapFirmware's."""

STATUSES = tuple(STATUS.values())
"""``state.status`` (3.5 RepRap.cpp:2391)."""

HEATERS = HEATER_STATES
"""``heat.heaters[].state`` (3.5 Heater.h)."""

TOOLS = ("off", "standby", "active")
"""``tools[].state`` (3.5 Tool.h)."""

SPINDLES = ("unconfigured", "stopped", "forward", "reverse")
"""``spindles[].state`` (3.5 Spindle.h)."""

MONITORS = (
    "noMonitor",
    "ok",
    "noDataReceived",
    "noFilament",
    "tooLittleMovement",
    "tooMuchMovement",
    "sensorError",
)
"""``sensors.filamentMonitors[].status`` (3.5 FilamentMonitor.h)."""

BOARDS = ("flashing", "flashFailed", "resetting", "running", "timedOut")
"""``boards[].state`` of a board on the CAN bus (3.5 ExpansionManager.h)."""


def known(word: Any, words: tuple[str, ...]) -> str:
    """Return the word where it is one of ``words``, else ``unknown``."""
    return word if isinstance(word, str) and word in words else UNKNOWN
