"""View: the questions about a machine that commands depend on, answered from the model."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

_VERSION = re.compile(r"(\d+)\.(\d+)(?:\.(\d+))?")
"""The numbers of a firmware version: major, minor and patch level."""

M568_SETS_TOOLS = (3, 3)
"""From here on M568 sets a tool's temperatures and state; before, G10 and M104 do."""

STOPS_AT_ONCE = (3, 6, 3)
"""From here on M112 is acted on as it is read; before, it waits behind what the line runs."""

PRINTING = ("processing", "simulating", "pausing", "resuming")
"""Words of ``state.status`` while a file on the card is under way."""

UNSENDABLE = 1e9
"""Far beyond every temperature and number of a thing; more digits than a line should have."""

HAS_EXPRESSIONS = (3, 0)
"""From here on a parameter may be an expression in braces."""


class Machine:
    """Answers from one snapshot of the model.

    ``is_current`` says that nothing has happened since that could have homed an axis or heated
    a tool; otherwise the firmware is left to refuse what it can't do.
    """

    def __init__(self, model: Mapping[str, Any], is_current: bool = True) -> None:
        self._model = model
        self._is_current = is_current

    @property
    def model(self) -> Mapping[str, Any]:
        """The snapshot itself."""
        return self._model

    @property
    def is_current(self) -> bool:
        """Whether nothing has happened since the snapshot that could have changed the state."""
        return self._is_current

    @property
    def status(self) -> str:
        """``state.status``; empty where it isn't known."""
        status = mapping(self._model.get("state")).get("status")
        return status if isinstance(status, str) else ""

    @property
    def version(self) -> tuple[int, int, int]:
        """The firmware's version; ``(0, 0, 0)`` where none is known."""
        board = mapping(next(iter(array(self._model.get("boards"))), None))
        found = _VERSION.search(str(board.get("firmwareVersion", "")))
        return tuple(int(part or 0) for part in found.groups()) if found else (0, 0, 0)  # type: ignore[return-value]

    @property
    def is_halted(self) -> bool:
        """Whether an emergency stop holds until the next reset."""
        return self.status == "halted"

    @property
    def prints(self) -> bool:
        """Whether the machine prints a file of its own and isn't paused."""
        return self.status in PRINTING

    @property
    def tools(self) -> dict[int, Mapping[str, Any]]:
        """The tools by their numbers."""
        tools = {}
        for tool in array(self._model.get("tools")):
            number = mapping(tool).get("number")
            if type(number) is int:
                tools[number] = tool
        return tools

    @property
    def knows_tools(self) -> bool:
        """Whether the model says anything about tools."""
        return isinstance(self._model.get("tools"), list)

    @property
    def current_tool(self) -> Mapping[str, Any] | None:
        """The tool that is selected."""
        number = mapping(self._model.get("state")).get("currentTool")
        return self.tools.get(number) if isinstance(number, int) else None

    @property
    def default_tool(self) -> Mapping[str, Any] | None:
        """The tool that M104 without T means: the current one, else the lowest numbered."""
        tools = self.tools
        return self.current_tool or (tools[min(tools)] if tools else None)

    def heater(self, index: Any) -> Mapping[str, Any]:
        """Return a heater by its number, an empty one where there is none."""
        heaters = array(mapping(self._model.get("heat")).get("heaters"))
        there = isinstance(index, int) and 0 <= index < len(heaters)
        return mapping(heaters[index]) if there else {}

    def slot(self, kind: str) -> int | None:
        """Return the first slot of ``bedHeaters`` or ``chamberHeaters`` that has a heater."""
        heat = mapping(self._model.get("heat"))
        for slot, heater in enumerate(array(heat.get(kind))):
            if isinstance(heater, int) and heater >= 0:
                return slot
        return None

    def unhomed(self, letters: str) -> str:
        """Return those of the axes that may not be moved because they aren't homed."""
        move = mapping(self._model.get("move"))
        # told from 3.4 on; off after M564 H0
        if not self._is_current or move.get("noMovesBeforeHoming") is not True:
            return ""
        axes = map(mapping, array(move.get("axes")))
        homed = {str(axis.get("letter")): axis.get("homed") for axis in axes}
        return "".join(letter for letter in letters if homed.get(letter) is False)

    def is_cold(self, tool: Mapping[str, Any], retracts: bool = False) -> bool:
        """Return whether a heater of the tool is too cold to extrude, or to retract."""
        heat = mapping(self._model.get("heat"))
        limit = heat.get("coldRetractTemperature" if retracts else "coldExtrudeTemperature")
        if not self._is_current or not isinstance(limit, (int, float)):
            return False
        for index in array(tool.get("heaters")):
            current = self.heater(index).get("current")
            if isinstance(current, (int, float)) and current < limit:
                return True
        return False


def mapping(value: Any) -> Mapping[str, Any]:
    """Return an object of the model, an empty one for anything else."""
    return value if isinstance(value, Mapping) else {}


def numbers_of(value: Any) -> list[float]:
    """Return an array of numbers that can be sent, an empty one for anything else."""
    found = array(value)
    are_numbers = all(type(each) in (int, float) and abs(each) < UNSENDABLE for each in found)
    return found if are_numbers else []


def array(value: Any) -> list[Any]:
    """Return an array of the model, an empty one for anything else."""
    return value if isinstance(value, list) else []
