"""The file of a bed's mesh, as firmware writes it: a grid of heights, in one of three forms."""

from __future__ import annotations

import math
import re
from typing import Any, NamedTuple

MOST_BYTES = 128 * 1024
"""A file that is larger holds no map: boards take 961 points (3.5 Configuration.h)."""

MOST_POINTS = 10_000
MOST_IN_A_ROW = 200

FURTHEST = 1e6
"""Millimetres that nothing on a bed is away from anything."""

_TITLE = "RepRapFirmware height map file v"

_FORMS = (
    "axis0,axis1,min0,max0,min1,max1,radius,spacing0,spacing1,num0,num1",
    # up to 3.3-beta1
    "xmin,xmax,ymin,ymax,radius,xspacing,yspacing,xnum,ynum",
    # version 1 of the file
    "xmin,xmax,ymin,ymax,radius,spacing,xnum,ynum",
)
"""Labels of the grid's values; the newest form first."""

_NUMBER = re.compile(r"[+-]?(?:\d{1,12}(?:\.\d{0,9})?|\.\d{1,9})")

_AXIS = re.compile(r"'?[A-Za-z]")

_NOT_PROBED = "0"
"""What stands for a point that has no height; one of zero has decimals."""


class BrokenHeightMap(ValueError):
    """A text is no height map; ``code`` says why, ``detail`` where.

    ``title``, ``labels``, ``grid``, ``rows``, ``row``, ``value``, ``large``.
    """

    def __init__(self, code: str, detail: str = "") -> None:
        super().__init__(f"{code} {detail}".strip())
        self.code = code
        self.detail = detail


class HeightMap(NamedTuple):
    """The mesh of a bed; all lengths are millimetres."""

    axes: tuple[str, str]
    """Along a row, and from one row to the next."""
    min: tuple[float, float]
    spacing: tuple[float, float]
    size: tuple[int, int]
    """Points of a row, and rows."""
    radius: float
    """Points further away were not probed; -1 where the grid is a rectangle."""
    points: tuple[tuple[float | None, ...], ...]
    """Row by row; ``None`` where nothing was probed."""

    @property
    def known(self) -> list[float]:
        """The heights that were probed."""
        return [height for row in self.points for height in row if height is not None]

    def statistics(self) -> dict[str, float | None]:
        """Return ``deviation``, ``mean``, ``least`` and ``most``, as the firmware counts them."""
        known = self.known
        if not known:
            return dict.fromkeys(("deviation", "mean", "least", "most"))
        mean = math.fsum(known) / len(known)
        square = math.fsum((height - mean) ** 2 for height in known) / len(known)
        return {
            "deviation": round(math.sqrt(square), 4),
            "mean": round(mean, 4),
            "least": min(known),
            "most": max(known),
        }

    def members(self, file: str) -> dict[str, Any]:
        """Return what clients get of the map that is in a file."""
        return {
            "file": file,
            "axes": list(self.axes),
            "min": list(self.min),
            "spacing": list(self.spacing),
            "count": list(self.size),
            "radius": self.radius,
            "points": [list(row) for row in self.points],
            **self.statistics(),
        }


def height_map(text: str) -> HeightMap:
    """Return the map that a file holds; raise ``BrokenHeightMap`` for any other text.

    >>> found = height_map(
    ...     "RepRapFirmware height map file v2\\n"
    ...     "axis0,axis1,min0,max0,min1,max1,radius,spacing0,spacing1,num0,num1\\n"
    ...     "X,Y,20.00,60.00,20.00,20.00,-1.00,20.00,20.00,3,1\\n"
    ...     "  0.012,      0, -0.030\\n"
    ... )
    >>> found.size, found.points
    ((3, 1), ((0.012, None, -0.03),))
    """
    if len(text) > MOST_BYTES:
        raise BrokenHeightMap("large")
    lines = [line.strip() for line in text.splitlines()]
    while lines and not lines[-1]:
        lines.pop()
    if not lines or not lines[0].startswith(_TITLE):
        raise BrokenHeightMap("title")
    labels = lines[1].lower().replace(" ", "") if len(lines) > 1 else ""
    if labels not in _FORMS or len(lines) < 3:
        raise BrokenHeightMap("labels")
    grid = _grid(dict(zip(labels.split(","), _cells(lines[2], len(labels.split(","))))))
    rows = lines[3:]
    if len(rows) != grid.size[1]:
        raise BrokenHeightMap("rows", f"{len(rows)} / {grid.size[1]}")
    points = tuple(_row(row, grid.size[0], number) for number, row in enumerate(rows, 1))
    return grid._replace(points=points)


def _cells(line: str, count: int) -> list[str]:
    cells = [cell.strip() for cell in line.split(",")]
    if len(cells) != count:
        raise BrokenHeightMap("grid")
    return cells


def _grid(told: dict[str, str]) -> HeightMap:
    """Return the map without its points."""
    # the older forms name X and Y, and the oldest has one spacing for both
    axes = told.get("axis0", "X"), told.get("axis1", "Y")
    if not all(map(_AXIS.fullmatch, axes)) or axes[0] == axes[1]:
        raise BrokenHeightMap("grid")
    found = HeightMap(
        axes=axes,
        min=_pair(told, ("min0", "xmin"), ("min1", "ymin")),
        spacing=_pair(
            told, ("spacing0", "xspacing", "spacing"), ("spacing1", "yspacing", "spacing")
        ),
        size=(_count(told, "num0", "xnum"), _count(told, "num1", "ynum")),
        radius=_number(told["radius"], "grid"),
        points=(),
    )
    ends = _pair(told, ("max0", "xmax"), ("max1", "ymax"))
    is_grid = all(step > 0 for step in found.spacing) and all(
        end >= begin for begin, end in zip(found.min, ends)
    )
    if not is_grid or found.size[0] * found.size[1] > MOST_POINTS:
        raise BrokenHeightMap("grid")
    return found


def _pair(
    told: dict[str, str], first: tuple[str, ...], second: tuple[str, ...]
) -> tuple[float, float]:
    return _number(_named(told, first), "grid"), _number(_named(told, second), "grid")


def _named(told: dict[str, str], names: tuple[str, ...]) -> str:
    return next(told[name] for name in names if name in told)


def _count(told: dict[str, str], *names: str) -> int:
    text = _named(told, names)
    if not (text.isascii() and text.isdigit() and len(text) < 5 and 0 < int(text) <= MOST_IN_A_ROW):
        raise BrokenHeightMap("grid")
    return int(text)


def _number(text: str, code: str, detail: str = "") -> float:
    if not _NUMBER.fullmatch(text) or not text.isascii() or abs(float(text)) > FURTHEST:
        raise BrokenHeightMap(code, detail)
    return float(text)


def _row(line: str, count: int, number: int) -> tuple[float | None, ...]:
    cells = [cell.strip() for cell in line.split(",")]
    if len(cells) != count:
        raise BrokenHeightMap("row", str(number))
    return tuple(
        None if cell == _NOT_PROBED else _number(cell, "value", str(number)) for cell in cells
    )
