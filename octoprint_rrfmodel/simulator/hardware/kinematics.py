"""``move.kinematics`` of the machines."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any


def matrix(*rows: Sequence[float]) -> list[list[float]]:
    return [list(map(float, row)) for row in rows]


def cartesian(axes: int = 3, name: str = "cartesian") -> dict[str, Any]:
    """Return cartesian kinematics for any number of axes."""
    unit = [[float(row == column) for column in range(axes)] for row in range(axes)]
    return {
        "forwardMatrix": unit,
        "inverseMatrix": copy.deepcopy(unit),
        "name": name,
        "segmentation": None,
        "tiltCorrection": tilt(),
    }


def tilt(xs: Sequence[float] = (), ys: Sequence[float] = ()) -> dict[str, Any]:
    return {
        "correctionFactor": 1.0,
        "lastCorrections": [0.0] * len(xs),
        "maxCorrection": 1.0,
        "screwPitch": 0.5,
        "screwX": list(xs),
        "screwY": list(ys),
    }


def core_xy() -> dict[str, Any]:
    return {
        "forwardMatrix": matrix((0.5, 0.5, 0), (0.5, -0.5, 0), (0, 0, 1)),
        "inverseMatrix": matrix((1, 1, 0), (1, -1, 0), (0, 0, 1)),
        "name": "coreXY",
        "segmentation": {"minSegLength": 0.5, "segmentsPerSec": 10.0},
        "tiltCorrection": tilt((-40.0, 175.0, 390.0), (20.0, 330.0, 20.0)),
    }


def linear_delta() -> dict[str, Any]:
    def tower(x: float, y: float, adjustment: float) -> dict[str, Any]:
        return {
            "angleCorrection": 0.0,
            "diagonal": 288.4,
            "endstopAdjustment": adjustment,
            "xPos": x,
            "yPos": y,
        }

    return {
        "deltaRadius": 146.732,
        "homedHeight": 330.215,
        "name": "delta",
        "printRadius": 120.0,
        "segmentation": {"minSegLength": 0.2, "segmentsPerSec": 100.0},
        "towers": [
            tower(-127.074, -73.366, 0.112),
            tower(127.074, -73.366, -0.24),
            tower(0.0, 146.732, 0.128),
        ],
        "xTilt": 0.00012,
        "yTilt": -0.00031,
    }
