"""The object model of a board: its data, and what its parts look up and announce in it."""

from __future__ import annotations

from typing import Any, Callable

from ..firmware import Firmware
from ..hardware.blank import INPUT_NAMES, gcode_input
from .members import for_firmware

USUAL_QUEUE_LENGTH = 40
SIZES = ("capacity", "freeSpace", "openFiles", "partitionSize", "speed")


class ObjectModel:
    """The data of one board, as ``build`` makes it at every restart."""

    def __init__(self, firmware: Firmware, build: Callable[[], dict[str, Any]]):
        self._firmware = firmware
        self._build = build
        self.restart()

    def restart(self) -> None:
        """Forget everything that has happened to the machine."""
        self.data = self._build()
        self._sizes: dict[str, Any] = {}
        self._spare_inputs: dict[str, dict[str, Any]] = {}

    def bump(self, *keys: str) -> None:
        """Count up ``seqs`` of these keys: something that isn't live has changed."""
        seqs = self.data.get("seqs")
        if seqs is None:
            return
        for key in keys:
            if key in seqs:
                seqs[key] = (seqs[key] + 1) & 0xFFFF

    def members_of(self, value: Any, path: str) -> Any:
        """Return that part of a model with only what this firmware has."""
        return for_firmware(value, self._firmware, path)

    @property
    def is_cnc(self) -> bool:
        return bool(self.data["state"].get("machineMode") == "CNC")

    @property
    def queue_length(self) -> int:
        """Moves that fit in the movement queue."""
        queues = self.data["move"].get("queue") or []
        return int(queues[0]["length"]) if queues else USUAL_QUEUE_LENGTH

    def input(self, name: str) -> dict[str, Any]:
        """Return the channel's element of ``inputs``, one of its own where the board has none."""
        index = INPUT_NAMES.index(name)
        inputs = self.data.get("inputs") or []
        found = inputs[index] if index < len(inputs) else None
        if found is None:
            found = self._spare_inputs.get(name)
            if found is None:
                found = self._spare_inputs[name] = gcode_input(name)
        return found

    def tools(self) -> list[dict[str, Any]]:
        """Return the tools there are, in the order of their numbers."""
        return [tool for tool in self.data.get("tools") or () if tool is not None]

    def tool(self, number: int | None) -> dict[str, Any] | None:
        """Return the tool of that number; ``None`` without one."""
        tools: list[dict[str, Any] | None] = self.data.get("tools") or []
        for tool in tools:
            if tool is not None and tool["number"] == number:
                return tool
        return None

    def current_tool(self) -> dict[str, Any] | None:
        return self.tool(self.data["state"].get("currentTool", -1))

    def volumes_changed(self, mounted: bool) -> None:
        """Show whether the card is mounted, and announce that files on it have changed."""
        volumes = self.data.get("volumes") or [None]
        if volumes[0] is not None:
            volumes[0]["mounted"] = mounted
            self._show_sizes(volumes[0], mounted)
        changes = (self.data.get("seqs") or {}).get("volChanges") or []
        if changes:
            changes[0] = (changes[0] + 1) & 0xFFFF
        self.bump("volumes")

    def _show_sizes(self, volume: dict[str, Any], mounted: bool) -> None:
        """A card that isn't mounted has no sizes (seen in firmware)."""
        if not mounted:
            self._sizes.update({name: volume[name] for name in SIZES if volume.get(name)})
        for name in SIZES:
            if name in volume:
                volume[name] = self._sizes.get(name, volume[name]) if mounted else None

    def volume_open(self, is_open: bool) -> None:
        """Show whether a file on the card is open."""
        volumes = self.data.get("volumes") or [None]
        if volumes[0] is not None:
            volumes[0]["openFiles"] = is_open
        self.bump("volumes")
