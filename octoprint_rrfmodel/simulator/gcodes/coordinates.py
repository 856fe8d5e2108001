"""Where the axes are said to be, and how coordinates are read: G20 to G92, M120, M290, M564."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable

from ..line.channel import Channel, Outcome, Running
from ..text.command import Command
from .moves import INCH, named_axes, standstill

if TYPE_CHECKING:
    from ..core import Core


def set_position(board: Core, channel: Channel, command: Command) -> Outcome:
    """G92: the named axes are where it says, and count as homed."""
    words = command.coordinates()
    scale = INCH if channel.input["distanceUnit"] == "in" else 1.0
    if "E" in words or not words:
        board.motion.virtual_e = words.get("E", 0.0) * scale
    jumps = {
        index: words[axis["letter"]] * scale + board.motion.offset(index)
        for index, axis in enumerate(board.motion.axes)
        if axis["letter"] in words
    }
    return _jump_at_standstill(board, jumps) if jumps else None


def _jump_at_standstill(board: Core, jumps: dict[int, float]) -> Running:
    yield standstill(board)
    for index in jumps:
        board.motion.axes[index]["homed"] = True
    board.motion.jump(jumps)
    board.bump("move")


def motors_off(board: Core, channel: Channel, command: Command) -> Running:
    """M18 and M84: the axes named, or all, aren't homed any more; ``M84 S`` sets the idle time."""
    seconds = command.number_of("S")
    if seconds is not None:
        board.data["move"]["idle"]["timeout"] = seconds
        board.bump("move")
        return
    yield standstill(board)
    for index in named_axes(board, command) or range(len(board.motion.axes)):
        if "E" not in command:
            board.motion.axes[index]["homed"] = False
    board.bump("move")


def babystep(board: Core, channel: Channel, command: Command) -> Outcome:
    """M290: S or Z, other axes by letter; relative unless R0, clamped to 1 mm a command."""
    if not command.raw:
        axes = board.motion.axes
        offsets = ", ".join(f"{axis['letter']}:{axis['babystep']:.3f}" for axis in axes)
        return f"Baby stepping offsets (mm): {offsets}"
    absolute = command.integer("R", 1) == 0
    for index, axis in enumerate(board.motion.axes):
        letter = axis["letter"]
        amount = command.number_of(letter)
        if amount is None and letter == "Z":
            amount = command.number_of("S")
        if amount is None:
            continue
        change = amount - axis["babystep"] if absolute else max(-1.0, min(1.0, amount))
        axis["babystep"] += change
        board.motion.jump({index: board.motion.target()[index] + change})
    board.bump("move")
    return None


def limits(board: Core, channel: Channel, command: Command) -> Outcome:
    """M564: H0 allows moves of unhomed axes, S0 beyond the limits."""
    move = board.data["move"]
    before_homing, limit = command.integer("H"), command.integer("S")
    if before_homing is not None:
        move["noMovesBeforeHoming"] = before_homing != 0
    if limit is not None:
        move["limitAxes"] = limit != 0
    if before_homing is None and limit is None:
        outside = "not allowed" if move.get("limitAxes", True) else "allowed"
        unhomed = "not allowed" if move.get("noMovesBeforeHoming", True) else "allowed"
        return (
            f"Movement outside the bed is {outside}, "
            f"movement of axes that haven't been homed is {unhomed}"
        )
    board.bump("move")
    return None


def mode(member: str, value: Any) -> Callable[[Core, Channel, Command], Outcome]:
    """Return the command that sets one modal member of the channel (G90, M83, G20 ...)."""

    def set_mode(board: Core, channel: Channel, command: Command) -> Outcome:
        if channel.input.get(member) != value:
            channel.input[member] = value
            board.bump("inputs")
        return None

    return set_mode


def push(board: Core, channel: Channel, command: Command) -> Outcome:
    """M120."""
    channel.push()
    return None


def pop(board: Core, channel: Channel, command: Command) -> Outcome:
    """M121."""
    channel.pop()
    return None


def workplace(board: Core, channel: Channel, command: Command) -> Outcome:
    """G54 to G59.3: selects a coordinate system."""
    move = board.data["move"]
    if command.number == 59 and command.fraction > 0:
        move["workplaceNumber"] = 5 + command.fraction
    else:
        move["workplaceNumber"] = (command.number or 54) - 54
    if "workspaceNumber" in move:
        move["workspaceNumber"] = move["workplaceNumber"] + 1
    board.bump("move")
    return None


TABLE = {
    "G20": mode("distanceUnit", "in"),
    "G21": mode("distanceUnit", "mm"),
    "G54": workplace,
    "G55": workplace,
    "G56": workplace,
    "G57": workplace,
    "G58": workplace,
    "G59": workplace,
    "G90": mode("axesRelative", False),
    "G91": mode("axesRelative", True),
    "G92": set_position,
    "M18": motors_off,
    "M82": mode("drivesRelative", False),
    "M83": mode("drivesRelative", True),
    "M84": motors_off,
    "M120": push,
    "M121": pop,
    "M290": babystep,
    "M564": limits,
}
