"""``gcode_move``, ``toolhead`` and others about motion."""

from __future__ import annotations

import math
from typing import Any

from ..views.machine import array, mapping
from .printer import LETTERS, Printer
from .values import least, number, text, truth
from .view import ABSENT, Row, View, one, where

SECONDS = 60
"""In a minute: RRF's speeds of axes are in mm/min, Klipper's in mm/s."""

NAMES_OF_RETRACTION = {
    "retract_length": "length",
    "retract_speed": "speed",
    "unretract_extra_length": "extraRestart",
    "unretract_speed": "unretractSpeed",
}
"""Klipper's names and RRF's; millimetres and mm/s in both."""


def _coordinates(name: str) -> Any:
    """Return a field: that member of X, Y and Z, and the extruder's virtual position."""

    def field(view: View, thing: Any) -> list[float]:
        axes = [view.of_axis(letter, name) or 0.0 for letter in LETTERS]
        return [*axes, number(view.motion("virtualEPos")) or 0.0]

    return field


_machine_position = _coordinates("machinePosition")


def _limits(name: str) -> Any:
    """Return a field: that member of X, Y and Z, and 0 for E."""
    return lambda view, thing: [*(view.of_axis(letter, name) for letter in LETTERS), 0.0]


def _speed_factor(view: View, thing: Any) -> float:
    factor = number(view.motion("speedFactor"))
    return 1.0 if factor is None else factor


def _extrude_factor(view: View, thing: Any) -> float:
    factor = number(view.drive(view.tool).get("factor"))
    return 1.0 if factor is None else factor


def _homing_origin(view: View, thing: Any) -> list[float]:
    return [*(view.of_axis(letter, "babystep") or 0.0 for letter in LETTERS), 0.0]


def _homed_axes(view: View, thing: Any) -> str:
    homed = [letter for letter, axis in view.axes.items() if truth(axis.get("homed"))]
    return "".join(letter.lower() for letter in homed if letter in LETTERS)


def _print_time(view: View, thing: Any) -> float | None:
    seconds = view.up_time
    if seconds is None:
        return None
    return seconds + (number(view.state.get("msUpTime")) or 0) / 1000


def max_velocity(view: Printer) -> float | None:
    """Return the speed that X and Y both reach, in mm/s."""
    speed = least(view.of_axis("X", "speed"), view.of_axis("Y", "speed"))
    return None if speed is None else speed / SECONDS


def max_accel(view: Printer) -> float | None:
    """Return the acceleration of prints that X and Y both take, in mm/s²."""
    return least(
        number(view.motion("printingAcceleration")),
        view.of_axis("X", "acceleration"),
        view.of_axis("Y", "acceleration"),
    )


def _max_accel_to_decel(view: View, thing: Any) -> float | None:
    accel = max_accel(view)
    return None if accel is None else accel / 2


def _square_corner_velocity(view: View, thing: Any) -> float | None:
    jerk = view.of_axis("X", "jerk")
    return None if jerk is None else jerk / SECONDS


def _cone_start(view: View, thing: Any) -> Any:
    """Return the height of a delta's effector below which it reaches the whole bed, in mm.

    As Klipper has it: the lowest height at which an arm would stand upright.
    """
    kinematics = mapping(view.move.get("kinematics"))
    if "delta" not in text(kinematics.get("name")).lower() or "towers" not in kinematics:
        return ABSENT
    radius, height = number(kinematics.get("deltaRadius")), number(kinematics.get("homedHeight"))
    starts = []
    for tower in map(mapping, array(kinematics.get("towers"))):
        arm = number(tower.get("diagonal"))
        if radius is None or height is None or arm is None or not 0 <= radius <= arm < 1e6:
            return None
        endstop = height + (number(tower.get("endstopAdjustment")) or 0.0)
        starts.append(endstop + math.sqrt(arm * arm - radius * radius) - arm)
    return min(starts, default=None)


def _live_velocity(view: View, thing: Any) -> float | None:
    move = mapping(view.motion("currentMove"))
    top = number(move.get("topSpeed"))
    return number(move.get("requestedSpeed")) if top is None else top


def _live_extruder_velocity(view: View, thing: Any) -> float | None:
    return number(mapping(view.motion("currentMove")).get("extrusionRate"))


def _retraction(name: str) -> Any:
    """Return a field: a member of the current tool's retraction."""
    return lambda view, thing: number(mapping((view.tool or {}).get("retraction")).get(name))


def _retracts(view: View) -> Any:
    return any("retraction" in tool for tool in view.tools.values())


def _skew(view: View) -> Any:
    return mapping(mapping(view.move.get("compensation")).get("skew"))


def _skew_profile(view: View, skew: Any) -> str | None:
    is_skewed = any(number(skew.get(name)) for name in ("tanXY", "tanXZ", "tanYZ"))
    return "default" if is_skewed else None


def _mesh_profile(view: View, thing: Any) -> str:
    compensation = mapping(view.move.get("compensation"))
    if text(compensation.get("type")).lower() != "mesh":
        return ""
    name = text(compensation.get("file")).rpartition("/")[2]
    return (name[: -len(".csv")] if name.lower().endswith(".csv") else name) or "default"


def _mesh_corner(name: str) -> Any:
    """Return a field: a corner of the height map in use, X and Y in mm."""

    def field(view: View, thing: Any) -> list[float]:
        grid = mapping(mapping(view.move.get("compensation")).get("liveGrid"))
        values = [number(value) for value in array(grid.get(name))[:2]]
        if len(values) < 2:
            return [0.0, 0.0]
        if array(grid.get("axes"))[:2] == ["Y", "X"]:
            values.reverse()
        return [0.0 if value is None else value for value in values]

    return field


def _mesh_matrix(view: View, thing: Any) -> list[list[float | None]]:
    """Return the heights of the mesh in use, a list for each Y, where its file was read."""
    found = view.host.heights
    if found is None or not _mesh_profile(view, thing):
        return [[]]
    rows = [list(row) for row in found.points]
    if found.axes == ("Y", "X"):
        return [list(column) for column in zip(*rows)]
    return rows if found.axes == ("X", "Y") else [[]]


ROWS = (
    Row(
        "gcode_move",
        one("gcode_move"),
        {
            "speed_factor": _speed_factor,
            "speed": lambda view, _: number(view.channel.get("feedRate")) or 0.0,
            "extrude_factor": _extrude_factor,
            "absolute_coordinates": lambda view, _: not truth(view.channel.get("axesRelative")),
            "absolute_extrude": lambda view, _: not truth(view.channel.get("drivesRelative")),
            "homing_origin": _homing_origin,
            "position": _machine_position,
            "gcode_position": _coordinates("userPosition"),
            "axis_map": lambda view, _: {"X": 0, "Y": 1, "Z": 2, "E": 3},
        },
    ),
    Row(
        "toolhead",
        one("toolhead"),
        {
            "homed_axes": _homed_axes,
            "print_time": _print_time,
            "estimated_print_time": _print_time,
            "extruder": lambda view, _: view.extruder,
            "position": _machine_position,
            "max_velocity": lambda view, _: max_velocity(view),
            "max_accel": lambda view, _: max_accel(view),
            "max_accel_to_decel": _max_accel_to_decel,
            "square_corner_velocity": _square_corner_velocity,
            "axis_minimum": _limits("min"),
            "axis_maximum": _limits("max"),
            "stalls": lambda view, _: 0,
            "minimum_cruise_ratio": lambda view, _: 0.5,
            "extra_axes": lambda view, _: {view.extruder: 3} if view.extruder else {},
            "cone_start_z": _cone_start,
        },
    ),
    Row(
        "motion_report",
        where("motion_report", lambda view: view.axes),
        {
            "live_position": _machine_position,
            "live_velocity": _live_velocity,
            "live_extruder_velocity": _live_extruder_velocity,
            "steppers": lambda view, _: list(view.axes),
            "trapq": lambda view, _: [],
        },
    ),
    Row(
        "bed_mesh",
        one("bed_mesh"),
        {
            "profile_name": _mesh_profile,
            "mesh_min": _mesh_corner("mins"),
            "mesh_max": _mesh_corner("maxs"),
            "probed_matrix": _mesh_matrix,
            "mesh_matrix": _mesh_matrix,
            "profiles": lambda view, _: {},
        },
    ),
    Row(
        "firmware_retraction",
        where("firmware_retraction", _retracts),
        {name: _retraction(member) for name, member in NAMES_OF_RETRACTION.items()},
    ),
    Row(
        "skew_correction", where("skew_correction", _skew), {"current_profile_name": _skew_profile}
    ),
)
