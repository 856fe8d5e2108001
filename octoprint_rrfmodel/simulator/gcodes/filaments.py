"""M701, M702, M703: the filament of the current tool (RRF 3.5 GCodes.cpp:4227-4263)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..line.channel import Channel, Outcome, Running
from ..text.command import Command, GCodeError
from .moves import standstill

if TYPE_CHECKING:
    from ..core import Core


def _extruder_of_tool(board: Core) -> dict[str, Any]:
    tool = board.current_tool()
    if tool is None:
        raise GCodeError("No tool selected")
    drive = tool.get("filamentExtruder", -1)
    if not 0 <= drive < len(board.motion.extruders):
        raise GCodeError("The current tool has no filament drive")
    extruder: dict[str, Any] = board.motion.extruders[drive]
    return extruder


def load_filament(board: Core, channel: Channel, command: Command) -> Outcome:
    """M701: runs load.g of that filament, for the current tool."""
    extruder = _extruder_of_tool(board)
    name = command.string("S")
    if name is None:
        loaded = extruder["filament"]
        return f"Loaded filament in the selected tool: {loaded}" if loaded else "No filament loaded"
    if extruder["filament"]:
        raise GCodeError("Unload the current filament before attempting to load another one")
    if not board.card.has_folder(f"0:/filaments/{name}"):
        raise GCodeError("Filament configuration directory not found")
    return _filament_macro(board, channel, extruder, name, f"0:/filaments/{name}/load.g", name)


def unload_filament(board: Core, channel: Channel, command: Command) -> Outcome:
    """M702."""
    extruder = _extruder_of_tool(board)
    name = extruder["filament"]
    if not name:
        return None
    return _filament_macro(board, channel, extruder, "", f"0:/filaments/{name}/unload.g", name)


def configure_filament(board: Core, channel: Channel, command: Command) -> Outcome:
    """M703."""
    extruder = _extruder_of_tool(board)
    name = extruder["filament"]
    if not name:
        return None
    return _filament_macro(board, channel, extruder, name, f"0:/filaments/{name}/config.g", name)


def _filament_macro(
    board: Core, channel: Channel, extruder: dict[str, Any], after: str, path: str, name: str
) -> Running:
    yield standstill(board)
    lines = board.card.lines(path) or []
    with board.running_macro(channel):
        yield from channel.macro(lines)
    if extruder["filament"] != after:
        extruder["filament"] = after
        board.bump("move")


TABLE = {"M701": load_filament, "M702": unload_filament, "M703": configure_filament}
