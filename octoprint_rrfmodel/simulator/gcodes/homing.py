"""Homing and probing: G28, G29, G30, G32."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..line.channel import Channel, Outcome, Running
from ..model.build import NO_TAPER
from ..text.command import Command, GCodeError
from .moves import axis_index, is_delta, named_axes, standstill

if TYPE_CHECKING:
    from ..core import Core

HOMING_SECONDS = 4.0
"""Simulated time to home one axis."""
PROBING_SECONDS = 6.0


def home(board: Core, channel: Channel, command: Command) -> Running:
    """G28: homes the axes named, all without any; ok comes at the end."""
    yield standstill(board)
    axes = board.motion.axes
    indexes = named_axes(board, command) or list(range(len(axes)))
    with board.running_macro(channel):
        for index in indexes:
            axes[index]["homed"] = False
        board.bump("move")
        at_end = is_delta(board)
        for index in indexes:
            yield board.after(HOMING_SECONDS)
            axis = axes[index]
            axis["homed"] = True
            board.motion.jump({index: _homed_position(board, index, at_end)})
            board.bump("move")


def _homed_position(board: Core, index: int, at_end: bool) -> float:
    if at_end:
        kinematics = board.data["move"]["kinematics"]
        return float(kinematics.get("homedHeight") or 0.0) if index == 2 else 0.0
    endstops = board.data["sensors"].get("endstops") or []
    endstop = endstops[index] if index < len(endstops) else None
    axis = board.motion.axes[index]
    return float(axis["max"] if endstop and endstop.get("highEnd") else axis["min"])


def mesh(board: Core, channel: Channel, command: Command) -> Outcome:
    """G29: S0 or none probes, S1 loads, S2 clears, S3 saves the height map."""
    mode = command.integer("S", 0)
    compensation = board.data["move"]["compensation"]
    if mode == 2:
        compensation.update(file=None, fadeHeight=NO_TAPER, liveGrid=None, meshDeviation=None)
        compensation["type"] = "none"
        board.bump("move")
        return None
    if mode == 1:
        _load_mesh(board)
        return None
    if mode == 3:
        return "Height map saved to file 0:/sys/heightmap.csv"
    return _probe_mesh(board, channel)


def _load_mesh(board: Core) -> None:
    compensation = board.data["move"]["compensation"]
    compensation.update(
        file="0:/sys/heightmap.csv", type="mesh", meshDeviation={"deviation": 0.043, "mean": -0.012}
    )
    if "liveGrid" in compensation:
        compensation["liveGrid"] = dict(compensation["probeGrid"])
    board.bump("move")


def _probe_mesh(board: Core, channel: Channel) -> Running:
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


def probe_point(board: Core, channel: Channel, command: Command) -> Running:
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


def true_bed(board: Core, channel: Channel, command: Command) -> Running:
    """G32: runs bed.g."""
    yield standstill(board)
    with board.running_macro(channel):
        yield from board.run_system_macro(channel, "bed.g")
        yield board.after(3 * PROBING_SECONDS)


TABLE = {"G28": home, "G29": mesh, "G30": probe_point, "G32": true_bed}
