"""G-codes that move, home and set coordinates, and those that set how others are read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Callable

from ..line.channel import Channel, MoveError, Outcome, Running
from ..text.command import Command

if TYPE_CHECKING:
    from ..core import Core

INCH = 25.4
_NO_TOOL = "Error: Attempting to extrude with no tool selected.\n"


def axis_index(board: Core, letter: str) -> int | None:
    for index, axis in enumerate(board.motion.axes):
        if axis["letter"] == letter:
            return index
    return None


def named_axes(board: Core, command: Command) -> list[int]:
    """Return the indexes of the axes whose letters are among the parameters."""
    return [i for i, axis in enumerate(board.motion.axes) if axis["letter"] in command]


def linear_move(board: Core, channel: Channel, command: Command) -> Outcome:
    """G0 to G3: answers once the move is in the queue, later while that is full."""
    if board.motion.is_full:
        return _when_there_is_room(board, channel, command)
    _queue_move(board, channel, command)
    return None


def _when_there_is_room(board: Core, channel: Channel, command: Command) -> Running:
    yield lambda: not board.motion.is_full
    _queue_move(board, channel, command)


def _queue_move(board: Core, channel: Channel, command: Command) -> None:
    words = command.coordinates()
    modal = channel.input
    scale = INCH if modal["distanceUnit"] == "in" else 1.0
    if "F" in words:
        modal["feedRate"] = words["F"] * scale / 60
    motion = board.motion
    motion.last_code = command.number
    code = int(words.get("H", 0))
    begin = motion.target()
    target = list(begin)
    involved: list[int] = []
    relative = modal["axesRelative"]
    for index, axis in enumerate(motion.axes):
        letter = axis["letter"]
        if letter in words:
            value = words[letter] * scale
            target[index] = begin[index] + value if relative else value + motion.offset(index)
            involved.append(index)
    if involved and not code:
        _check_homed(board, involved)
    if code in (1, 3):
        _home_by_move(board, involved)
    elif not code:
        target = _inside_limits(board, target, involved)
    speed = modal["feedRate"] * float(board.data["move"].get("speedFactor") or 1.0)
    if command.number == 0 and board.is_cnc and "F" not in words:
        speed = max(float(axis["speed"]) / 60 for axis in motion.axes)
    motion.queue(target, _extrusion(board, channel, command, words, scale, bool(involved)), speed)


def _check_homed(board: Core, involved: Sequence[int]) -> None:
    move = board.data["move"]
    if not move.get("noMovesBeforeHoming", True):
        return
    axes = board.motion.axes
    needed = range(min(3, len(axes))) if is_delta(board) else involved
    if not all(axes[index]["homed"] for index in needed):
        raise MoveError("insufficient axes homed")


def is_delta(board: Core) -> bool:
    return "elta" in str((board.data["move"].get("kinematics") or {}).get("name"))


def _home_by_move(board: Core, involved: Sequence[int]) -> None:
    for index in involved:
        board.motion.axes[index]["homed"] = True
    board.bump("move")


def _inside_limits(board: Core, target: list[float], involved: Sequence[int]) -> list[float]:
    """Return the target clamped to the axis limits; on a CNC machine that is an error."""
    if not board.data["move"].get("limitAxes", True):
        return target
    axes = board.motion.axes
    clamped = list(target)
    for index in involved:
        if axes[index]["homed"]:
            low, high = float(axes[index]["min"]), float(axes[index]["max"])
            clamped[index] = min(max(target[index], low), high)
    if clamped != target and board.is_cnc:
        raise MoveError("target position outside machine limits")
    return clamped


def _extrusion(
    board: Core,
    channel: Channel,
    command: Command,
    words: dict[str, float],
    scale: float,
    has_axes: bool,
) -> list[float]:
    """Return the extrusion of each extruder, none where the tool is missing or cold."""
    amounts = [0.0] * len(board.motion.extruders)
    if "E" not in words:
        return amounts
    drives_relative = channel.input["drivesRelative"]
    motion = board.motion
    if drives_relative and ":" in command.text:
        requested = [value * scale for value in command.numbers("E") or [0.0]]
    elif drives_relative:
        requested = [words["E"] * scale]
    else:
        requested = [words["E"] * scale - motion.virtual_e]
    motion.virtual_e += sum(requested)
    tool = board.current_tool()
    if tool is None:
        if not motion.cold_reported:
            motion.cold_reported = True
            board.message(_NO_TOOL)
        return amounts
    if not board.thermal.can_extrude(tool):
        if not motion.cold_reported:
            motion.cold_reported = True
            board.message(
                f"Error: Tool {tool['number']} was not driven because its heater temperatures were "
                "not high enough or it has a heater fault\n"
            )
        return amounts
    motion.cold_reported = False
    drives = tool.get("extruders") or []
    mix = tool.get("mix") or [1.0]
    for position, drive in enumerate(drives):
        if drive >= len(amounts):
            continue
        if len(requested) > 1:
            amounts[drive] = requested[position] if position < len(requested) else 0.0
        else:
            amounts[drive] = requested[0] * (mix[position] if position < len(mix) else 0.0)
    if has_axes and any(amount > 0 for amount in amounts):
        board.job.extruded(sum(amounts), motion.target())
    return amounts


def standstill(board: Core) -> Callable[[], bool]:
    """Return the condition that the queue has run empty."""
    return lambda: not board.motion.is_moving


def dwell(board: Core, channel: Channel, command: Command) -> Running:
    """G4: waits for the queue, then for P milliseconds or S seconds."""
    milliseconds = command.number_of("P", 0.0) or 0.0
    seconds = (command.number_of("S", 0.0) or 0.0) + milliseconds / 1000
    yield standstill(board)
    yield board.after(seconds)


def wait_for_moves(board: Core, channel: Channel, command: Command) -> Running:
    """M400."""
    yield standstill(board)


TABLE = {
    "G0": linear_move,
    "G1": linear_move,
    "G2": linear_move,
    "G3": linear_move,
    "G4": dwell,
    "M400": wait_for_moves,
}
