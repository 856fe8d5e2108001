"""The height map that a board writes to its card (RRF 3.5 Grid.cpp:369-430)."""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

MEAN, DEVIATION = -0.012, 0.043
"""Of the simulated bed, in mm, as the model tells them."""
NOT_PROBED = "      0"


class Grid(NamedTuple):
    """Where is probed."""

    axes: Sequence[str]
    mins: Sequence[float]
    maxs: Sequence[float]
    spacings: Sequence[float]
    radius: float

    @property
    def counts(self) -> tuple[int, int]:
        """Points of a row, and rows."""
        first, second = (
            int((end - begin) / step + 1.01)
            for begin, end, step in zip(self.mins, self.maxs, self.spacings)
        )
        return first, second


def grid_of(told: Mapping[str, Any]) -> Grid | None:
    """Return the grid that the model tells of, ``None`` where that is none (no M557)."""

    def pair(name: str, first: str, second: str) -> Any:
        return told.get(name) or [told.get(first, 0.0), told.get(second, 0.0)]

    grid = Grid(
        told.get("axes") or ["X", "Y"],
        pair("mins", "xMin", "yMin"),
        pair("maxs", "xMax", "yMax"),
        pair("spacings", "xSpacing", "ySpacing"),
        told.get("radius", -1.0),
    )
    is_grid = min(grid.spacings) > 0 and all(map(operator.le, grid.mins, grid.maxs))
    return grid if is_grid else None


def height_map_text(grid: Grid, moment: str) -> str:
    """Return the file of a probed grid; ``moment`` is when that was."""
    points = _points(grid)
    known = [height for row in points for height in row if height is not None]
    mean = sum(known) / len(known)
    deviation = math.sqrt(sum((height - mean) ** 2 for height in known) / len(known))
    (min0, min1), (max0, max1) = grid.mins, grid.maxs
    spacing0, spacing1 = grid.spacings
    told = (min0, max0, min1, max1, grid.radius, spacing0, spacing1)
    return "\n".join(
        [
            f"RepRapFirmware height map file v2 generated at {moment[:16].replace('T', ' ')}, "
            f"min error {min(known):.3f}, max error {max(known):.3f}, mean {mean:.3f}, "
            f"deviation {deviation:.3f}",
            "axis0,axis1,min0,max0,min1,max1,radius,spacing0,spacing1,num0,num1",
            ",".join([*grid.axes, *(f"{value:.2f}" for value in told), *map(str, grid.counts)]),
            *(
                ",".join(NOT_PROBED if height is None else f"{height:7.3f}" for height in row)
                for row in points
            ),
            "",
        ]
    )


def _points(grid: Grid) -> list[list[float | None]]:
    """Return a bed that hangs through, with the mean and deviation that the model tells."""
    counts = grid.counts
    shape = [
        [_shape(grid, counts, column, row) for column in range(counts[0])]
        for row in range(counts[1])
    ]
    known = [height for row in shape for height in row if height is not None]
    mean = sum(known) / len(known)
    spread = math.sqrt(sum((height - mean) ** 2 for height in known) / len(known)) or 1.0
    return [
        [
            None if height is None else round(MEAN + DEVIATION * (height - mean) / spread, 3)
            for height in row
        ]
        for row in shape
    ]


def _shape(grid: Grid, counts: tuple[int, int], column: int, row: int) -> float | None:
    places = [
        begin + step * index for begin, step, index in zip(grid.mins, grid.spacings, (column, row))
    ]
    radius = grid.radius
    if radius > 0 and math.hypot(*places) >= radius:
        return None
    across, along = (
        2 * index / max(count - 1, 1) - 1 for index, count in zip((column, row), counts)
    )
    return across**2 + 0.7 * along**2 + 0.3 * across
