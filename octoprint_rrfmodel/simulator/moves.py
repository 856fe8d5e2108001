"""G-codes that move, home and set coordinates, and those that set how others are read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Sequence

from .channel import Channel, MoveError, Outcome, Running
from .command import Command, GCodeError

if TYPE_CHECKING:
    from .board import Board

INCH = 25.4
HOMING_SECONDS = 4.0
"""Simulated time to home one axis."""
PROBING_SECONDS = 6.0
_NO_TOOL = "Error: Attempting to extrude with no tool selected.\n"


def axis_index(board: Board, letter: str) -> Optional[int]:
    for index, axis in enumerate(board.motion.axes):
        if axis["letter"] == letter:
            return index
    return None


def named_axes(board: Board, command: Command) -> List[int]:
    """Return the indexes of the axes whose letters are among the parameters."""
    return [i for i, axis in enumerate(board.motion.axes) if axis["letter"] in command]


def linear_move(board: Board, channel: Channel, command: Command) -> Outcome:
    """G0 to G3: answers once the move is in the queue, later while that is full."""
    if board.motion.is_full:
        return _when_there_is_room(board, channel, command)
    _queue_move(board, channel, command)
    return None


def _when_there_is_room(board: Board, channel: Channel, command: Command) -> Running:
    yield lambda: not board.motion.is_full
    _queue_move(board, channel, command)


def _queue_move(board: Board, channel: Channel, command: Command) -> None:
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
    involved: List[int] = []
    relative = modal["axesRelative"]
    for index, axis in enumerate(motion.axes):
        letter = axis["letter"]
        if letter in words:
            value = words[letter] * scale
            target[index] = (
                begin[index] + value if relative else value + motion.offset(index)
            )
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


def _check_homed(board: Board, involved: Sequence[int]) -> None:
    move = board.data["move"]
    if not move.get("noMovesBeforeHoming", True):
        return
    axes = board.motion.axes
    needed = range(min(3, len(axes))) if _is_delta(board) else involved
    if not all(axes[index]["homed"] for index in needed):
        raise MoveError("insufficient axes homed")


def _is_delta(board: Board) -> bool:
    return "elta" in str((board.data["move"].get("kinematics") or {}).get("name"))


def _home_by_move(board: Board, involved: Sequence[int]) -> None:
    for index in involved:
        board.motion.axes[index]["homed"] = True
    board.bump("move")


def _inside_limits(board: Board, target: List[float], involved: Sequence[int]) -> List[float]:
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
    board: Board,
    channel: Channel,
    command: Command,
    words: Dict[str, float],
    scale: float,
    has_axes: bool,
) -> List[float]:
    """Return the extrusion of each extruder, none where the tool is missing or cold."""
    amounts = [0.0] * len(board.motion.extruders)
    if "E" not in words:
        return amounts
    drives_relative = channel.input["drivesRelative"]
    motion = board.motion
    if drives_relative:
        requested = [value * scale for value in command.floats("E") or [0.0]]
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


def standstill(board: Board) -> Callable[[], bool]:
    """Return the condition that the queue has run empty."""
    return lambda: not board.motion.is_moving


def home(board: Board, channel: Channel, command: Command) -> Running:
    """G28: homes the axes named, all without any; ok comes at the end."""
    yield standstill(board)
    axes = board.motion.axes
    indexes = named_axes(board, command) or list(range(len(axes)))
    with board.running_macro(channel):
        for index in indexes:
            axes[index]["homed"] = False
        board.bump("move")
        at_end = _is_delta(board)
        for index in indexes:
            yield board.after(HOMING_SECONDS)
            axis = axes[index]
            axis["homed"] = True
            board.motion.jump({index: _homed_position(board, index, at_end)})
            board.bump("move")


def _homed_position(board: Board, index: int, at_end: bool) -> float:
    if at_end:
        kinematics = board.data["move"]["kinematics"]
        return float(kinematics.get("homedHeight") or 0.0) if index == 2 else 0.0
    endstops = board.data["sensors"].get("endstops") or []
    endstop = endstops[index] if index < len(endstops) else None
    axis = board.motion.axes[index]
    return float(axis["max"] if endstop and endstop.get("highEnd") else axis["min"])


def mesh(board: Board, channel: Channel, command: Command) -> Outcome:
    """G29: S0 or none probes, S1 loads, S2 clears, S3 saves the height map."""
    mode = command.integer("S", 0)
    compensation = board.data["move"]["compensation"]
    if mode == 2:
        compensation.update(file=None, fadeHeight=None, liveGrid=None, meshDeviation=None)
        compensation["type"] = "none"
        board.bump("move")
        return None
    if mode == 1:
        _load_mesh(board)
        return None
    if mode == 3:
        return "Height map saved to file 0:/sys/heightmap.csv"
    return _probe_mesh(board, channel)


def _load_mesh(board: Board) -> None:
    compensation = board.data["move"]["compensation"]
    compensation.update(
        file="0:/sys/heightmap.csv", type="mesh", meshDeviation={"deviation": 0.043, "mean": -0.012}
    )
    if "liveGrid" in compensation:
        compensation["liveGrid"] = dict(compensation["probeGrid"])
    board.bump("move")


def _probe_mesh(board: Board, channel: Channel) -> Running:
    if not board.data["sensors"].get("probes"):
        raise GCodeError("Z probe number 0 not found")
    if not all(axis["homed"] for axis in board.motion.axes[:3]):
        raise GCodeError("Insufficient axes homed for bed probing")
    yield standstill(board)
    with board.running_macro(channel):
        yield board.after(5 * PROBING_SECONDS)
    _load_mesh(board)
    return (
        "100 points probed, min error -0.098, max error 0.104, mean -0.012, deviation 0.043\n"
        "Height map saved to file 0:/sys/heightmap.csv"
    )


def probe_point(board: Board, channel: Channel, command: Command) -> Running:
    """G30: probes where the head is."""
    if not board.data["sensors"].get("probes"):
        raise GCodeError("Z probe number 0 not found")
    yield standstill(board)
    with board.running_macro(channel):
        yield board.after(PROBING_SECONDS)
    probe = board.data["sensors"]["probes"][0]
    if command.integer("S", 0) == -1:
        return f"Stopped at height {probe['triggerHeight']:.3f} mm"
    index = axis_index(board, "Z")
    if index is not None:
        board.motion.axes[index]["homed"] = True
        board.motion.jump({index: float(probe["triggerHeight"])})
        board.bump("move")
    return None


def true_bed(board: Board, channel: Channel, command: Command) -> Running:
    """G32: runs bed.g."""
    yield standstill(board)
    with board.running_macro(channel):
        yield from board.run_system_macro(channel, "bed.g")
        yield board.after(3 * PROBING_SECONDS)


def dwell(board: Board, channel: Channel, command: Command) -> Running:
    """G4: waits for the queue, then for P milliseconds or S seconds."""
    milliseconds = command.float("P", 0.0) or 0.0
    seconds = (command.float("S", 0.0) or 0.0) + milliseconds / 1000
    yield standstill(board)
    yield board.after(seconds)


def wait_for_moves(board: Board, channel: Channel, command: Command) -> Running:
    """M400."""
    yield standstill(board)


def set_position(board: Board, channel: Channel, command: Command) -> Outcome:
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


def _jump_at_standstill(board: Board, jumps: Dict[int, float]) -> Running:
    yield standstill(board)
    for index in jumps:
        board.motion.axes[index]["homed"] = True
    board.motion.jump(jumps)
    board.bump("move")


def motors_off(board: Board, channel: Channel, command: Command) -> Running:
    """M18 and M84: the axes named, or all, aren't homed any more; ``M84 S`` sets the idle time."""
    seconds = command.float("S")
    if seconds is not None:
        board.data["move"]["idle"]["timeout"] = seconds
        board.bump("move")
        return
    yield standstill(board)
    for index in named_axes(board, command) or range(len(board.motion.axes)):
        if "E" not in command:
            board.motion.axes[index]["homed"] = False
    board.bump("move")


def babystep(board: Board, channel: Channel, command: Command) -> Outcome:
    """M290: S or Z, other axes by letter; relative unless R0, clamped to 1 mm a command."""
    if not command.raw:
        axes = board.motion.axes
        offsets = ", ".join(f"{axis['letter']}:{axis['babystep']:.3f}" for axis in axes)
        return f"Baby stepping offsets (mm): {offsets}"
    absolute = command.integer("R", 1) == 0
    for index, axis in enumerate(board.motion.axes):
        letter = axis["letter"]
        amount = command.float(letter)
        if amount is None and letter == "Z":
            amount = command.float("S")
        if amount is None:
            continue
        change = amount - axis["babystep"] if absolute else max(-1.0, min(1.0, amount))
        axis["babystep"] += change
        board.motion.jump({index: board.motion.target()[index] + change})
    board.bump("move")
    return None


def limits(board: Board, channel: Channel, command: Command) -> Outcome:
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


def mode(member: str, value: Any) -> Callable[[Board, Channel, Command], Outcome]:
    """Return the command that sets one modal member of the channel (G90, M83, G20 ...)."""

    def set_mode(board: Board, channel: Channel, command: Command) -> Outcome:
        if channel.input.get(member) != value:
            channel.input[member] = value
            board.bump("inputs")
        return None

    return set_mode


def push(board: Board, channel: Channel, command: Command) -> Outcome:
    """M120."""
    channel.push()
    return None


def pop(board: Board, channel: Channel, command: Command) -> Outcome:
    """M121."""
    channel.pop()
    return None


def workplace(board: Board, channel: Channel, command: Command) -> Outcome:
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
    "G0": linear_move,
    "G1": linear_move,
    "G2": linear_move,
    "G3": linear_move,
    "G4": dwell,
    "G20": mode("distanceUnit", "in"),
    "G21": mode("distanceUnit", "mm"),
    "G28": home,
    "G29": mesh,
    "G30": probe_point,
    "G32": true_bed,
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
    "M400": wait_for_moves,
    "M564": limits,
}
