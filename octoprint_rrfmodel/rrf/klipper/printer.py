"""The model as the objects ask for it: axes by letter, tools by number, things by name."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

from ..views.channels import CARD, channel_called, own_channel
from ..views.machine import Machine, array, mapping
from ..views.sensor_kinds import is_thermometer
from .values import element, first, named, number, text, whole

Model = Mapping[str, Any]

LETTERS = ("X", "Y", "Z")
"""The axes of Klipper's coordinates; also the letters of the first three where none are told."""

FED_BY_FILE = frozenset(("processing", "simulating", "pausing", "resuming", "paused"))
"""Values of ``state.status`` while the channel ``File`` feeds motion."""


class Extruder(NamedTuple):
    """A tool that has a heater, and that heater."""

    tool: Model
    heater: Model


class Printer:
    """Answers from one snapshot of the model, whatever is in it; nothing is computed twice."""

    def __init__(self, model: Model) -> None:
        self.model = mapping(model)

    @cached_property
    def state(self) -> Model:
        """``state``."""
        return mapping(self.model.get("state"))

    @cached_property
    def status(self) -> str:
        """``state.status``; empty while nothing is known."""
        return text(self.state.get("status"))

    @property
    def up_time(self) -> float | None:
        """Whole seconds since the board started."""
        return number(self.state.get("upTime"))

    @cached_property
    def move(self) -> Model:
        """``move``."""
        return mapping(self.model.get("move"))

    def motion(self, name: str) -> Any:
        """Return a member of ``move``, which 3.7 keeps for each motion system."""
        value = self.move.get(name)
        return element(self.move.get("motionSystems"), 0).get(name) if value is None else value

    @cached_property
    def axes(self) -> dict[str, Model]:
        """The axes by letter, in their order."""
        axes: dict[str, Model] = {}
        for place, axis in enumerate(map(mapping, array(self.move.get("axes")))):
            letter = text(axis.get("letter"))
            if not letter and axis and place < len(LETTERS):
                letter = LETTERS[place]
            if letter:
                axes.setdefault(letter, axis)
        return axes

    def of_axis(self, letter: str, name: str) -> float | None:
        """Return a number that an axis has."""
        return number(self.axes.get(letter, {}).get(name))

    @cached_property
    def channel(self) -> Model:
        """The channel that feeds motion, ``File`` or our own; empty where it is null."""
        if self.status in FED_BY_FILE:
            return channel_called(self.model, CARD)
        return own_channel(self.model)

    @cached_property
    def heat(self) -> Model:
        """``heat``."""
        return mapping(self.model.get("heat"))

    def heater(self, index: Any) -> Model:
        """Return a heater, an empty object where there is none."""
        return element(self.heat.get("heaters"), index)

    def slot(self, kind: str) -> Model:
        """Return the heater of the first slot of ``bedHeaters`` or ``chamberHeaters`` with one."""
        slots = array(self.heat.get(kind))
        return self.heater(next((h for h in map(whole, slots) if h is not None), None))

    @cached_property
    def tools(self) -> dict[int, Model]:
        """The tools by number; where no numbers are told, one for each heater that is no slot's."""
        tools = {
            number: tool
            for number, tool in Machine(self.model).tools.items()
            if whole(number) is not None
        }
        if tools or "seqs" in self.model or "coldExtrudeTemperature" in self.heat:
            return tools
        # only M408 S0 to S2 are left, which tell heaters and at most how many each tool has
        slots = array(self.heat.get("bedHeaters")) + array(self.heat.get("chamberHeaters"))
        heaters = array(self.heat.get("heaters"))
        free = [h for h, heater in enumerate(heaters) if mapping(heater) and h not in slots]
        if told := array(self.model.get("tools")):
            free = free[: sum(len(array(mapping(tool).get("active"))) for tool in told)]
        return {
            place: {"number": place, "heaters": [heater], "extruders": [place]}
            for place, heater in enumerate(free)
        }

    @cached_property
    def tool(self) -> Model | None:
        """The current tool."""
        current = whole(self.state.get("currentTool"))
        return None if current is None else self.tools.get(current)

    @cached_property
    def extruders(self) -> dict[str, Extruder]:
        """Tools with a heater by the name that Klipper has for an extruder."""
        found = {}
        for tool_number, tool in sorted(self.tools.items()):
            heater = self.heater(first(tool.get("heaters")))
            if heater:
                found[extruder_name(tool_number)] = Extruder(tool, heater)
        return found

    @property
    def extruder(self) -> str:
        """Name of the current tool's extruder, empty where it has none."""
        name = extruder_name(self.tool.get("number")) if self.tool else ""
        return name if name in self.extruders else ""

    def drive(self, tool: Model | None) -> Model:
        """Return the first extruder drive of a tool; the very first without a tool."""
        index = first(tool.get("extruders")) if tool else 0
        return element(self.move.get("extruders"), index)

    @cached_property
    def extruded(self) -> tuple[float | None, ...]:
        """How far each extruder drive was fed, in millimetres.

        Without the extrusion factor where that is told, as Klipper counts filament.
        """
        # M408 tells raw positions only while the card prints, and old ones stay in the model
        names = ("position",) if "m408" in self.model else ("rawPosition", "position")
        fed = []
        for drive in map(mapping, array(self.move.get("extruders"))):
            known = [number(drive.get(name)) for name in names]
            fed.append(next((value for value in known if value is not None), None))
        return tuple(fed)

    @cached_property
    def analog(self) -> dict[str, Model]:
        """Thermometers that no heater uses, by name."""
        heaters = array(self.heat.get("heaters"))
        used = {whole(mapping(heater).get("sensor")) for heater in heaters}
        sensors = array(mapping(self.model.get("sensors")).get("analog"))
        return named(
            (text(mapping(sensor).get("name")), f"sensor{index}", mapping(sensor))
            for index, sensor in enumerate(sensors)
            if mapping(sensor) and index not in used and is_thermometer(mapping(sensor))
        )

    @cached_property
    def boards(self) -> dict[str, Model]:
        """The boards by number: their CAN address, or their place where they have none."""
        boards = [mapping(board) for board in array(self.model.get("boards"))]
        return named(
            (_board_number(board, place), f"{place}", board)
            for place, board in enumerate(boards)
            if board
        )

    @cached_property
    def card(self) -> Model:
        """``job``: what the board knows of a print from its card."""
        return mapping(self.model.get("job"))

    @cached_property
    def file(self) -> Model:
        """``job.file``."""
        return mapping(self.card.get("file"))


def extruder_name(number: Any) -> str:
    """Return Klipper's name of the extruder of that tool."""
    return "extruder" if number == 0 else f"extruder{number}"


def _board_number(board: Model, place: int) -> str:
    address = whole(board.get("canAddress"))
    return f"{place if address is None else address}"
