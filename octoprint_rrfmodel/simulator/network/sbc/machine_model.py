"""The whole model as DSF has it: the board's, and what the computer adds."""

from __future__ import annotations

import json
import math
from typing import Any

from ...device.live_members import LiveMembers
from ...firmware import Firmware
from ...model.om import ModelText
from ...model.tree import ObjectModel
from .layers import Layers
from .messages import Messages

SBC_SINCE = (3, 5)
"""From here on what is of the computer stands in ``sbc``."""


def as_json(value: Any) -> str:
    """Return JSON as DSF writes it, letters beyond ASCII as they are."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def plain(value: Any, node: Any) -> Any:
    """Return a copy with as many decimals as the board has told, and no number that isn't one."""
    if isinstance(value, dict):
        members = node if isinstance(node, dict) else {}
        return {name: plain(member, members.get(name)) for name, member in value.items()}
    if isinstance(value, (list, tuple)):
        below = node.get("[]") if isinstance(node, dict) else None
        return [plain(element, below) for element in value]
    if not isinstance(value, float):
        return value
    if not math.isfinite(value):
        return None
    return round(value, node) if isinstance(node, int) else value


class MachineModel:
    """Reads the model; nothing of it is shared with the board."""

    def __init__(
        self,
        model: ObjectModel,
        live: LiveMembers,
        *,
        text: ModelText,
        firmware: Firmware,
        messages: Messages,
    ):
        self._model = model
        self._live = live
        self._decimals = text.decimals
        self._firmware = firmware
        self._messages = messages
        self._layers = Layers()

    def whole(self) -> dict[str, Any]:
        """Return the model with the messages of the last minute."""
        self._live.refresh()
        found: dict[str, Any] = {
            name: plain(value, self._decimals.get(name))
            for name, value in self._model.data.items()
            if name != "seqs"
        }
        found["job"] = {**found["job"], "layers": self._layers.seen(found)}
        found.update(messages=self._messages.recent(), plugins={})
        found["state"] = {**found["state"], "thisInput": None, **self._own_state()}
        if self._firmware.release >= SBC_SINCE:
            found["sbc"] = self._computer()
        else:
            found.update(httpEndpoints=[], userSessions=[])
        found["volumes"] = [
            {**volume, "name": None, "path": f"{number}:/"}
            for number, volume in enumerate(found.get("volumes") or [])
            if volume is not None
        ]
        return found

    def _own_state(self) -> dict[str, Any]:
        if self._firmware.release >= SBC_SINCE:
            return {}
        return {
            "dsfVersion": self._firmware.version,
            "dsfPluginSupport": True,
            "dsfRootPluginSupport": False,
            "pluginsStarted": True,
        }

    def _computer(self) -> dict[str, Any]:
        return {
            "appArmor": False,
            "cpu": {"avgLoad": 4.1, "hardware": "BCM2835", "numCores": 4, "temperature": 48.3},
            "distribution": "Raspbian GNU/Linux 12 (bookworm)",
            "dsf": {
                "httpEndpoints": [],
                "is64Bit": True,
                "pluginSupport": True,
                "rootPluginSupport": False,
                "userSessions": [],
                "version": self._firmware.version,
            },
            "memory": {"available": 3012046848, "total": 3974811648},
            "model": "Raspberry Pi 4 Model B Rev 1.4",
            "serial": "10000000simulat",
        }
