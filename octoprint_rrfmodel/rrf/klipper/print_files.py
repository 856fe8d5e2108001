"""What Moonraker's clients are told of a print file (Moonraker 0.9, external_api/file_manager).

A member that nobody knows is left out, as Moonraker does.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from ..card.sliced import Sliced, slicer_of
from ..card.thumbnail import Thumbnail

FOLDER = ".thumbs"
"""Folder in which the pictures of files seem to be, beside each file."""

ENDINGS = {"png": "png", "jpeg": "jpg", "jpg": "jpg", "qoi": "png"}
"""A picture's format and how its name ends; no browser shows QOI, which is sent as PNG."""

_PICTURE = re.compile(
    rf"(?P<folder>(?:.*/)?){re.escape(FOLDER)}/(?P<name>[^/]+)"
    r"-(?P<width>\d{1,4})x(?P<height>\d{1,4})\.(?:png|jpg)"
)
"""Groups: the file's folder with a slash, its name, the sides of the picture."""


class Wanted(NamedTuple):
    """A picture as its path names it."""

    file: str
    width: int
    height: int


def picture_wanted(path: str) -> Wanted | None:
    """Return which picture a path is of, ``None`` where it is the path of something else."""
    found = _PICTURE.fullmatch(path)
    if found is None:
        return None
    return Wanted(found["folder"] + found["name"], int(found["width"]), int(found["height"]))


def thumbnails(name: str, pictures: Iterable[Thumbnail]) -> list[dict[str, Any]]:
    """Return the pictures of a file, whose own name is ``name``, the smallest first."""
    told = [
        {
            "width": each.width,
            "height": each.height,
            "size": each.size * 3 // 4,
            "relative_path": f"{FOLDER}/{name}-{each.width}x{each.height}"
            f".{ENDINGS.get(each.format, 'png')}",
        }
        for each in pictures
    ]
    return sorted(told, key=lambda each: (each["width"], each["height"]))


def of_analysis(analysis: Any, sliced: Sliced, name: str) -> dict[str, Any]:
    """Return what OctoPrint's analysis and the file's beginning tell; ``name`` is its own."""
    told = _mapping(analysis)
    lengths = [
        _number(_mapping(each).get("length")) for each in _mapping(told.get("filament")).values()
    ]
    found = {
        "slicer": sliced.slicer or None,
        "slicer_version": sliced.version or None,
        "estimated_time": _positive(told.get("estimatedPrintTime")),
        "object_height": _positive(_mapping(told.get("printingArea")).get("maxZ")),
        "filament_total": _total(lengths),
        "thumbnails": thumbnails(name, sliced.thumbnails) or None,
    }
    return _known(found)


def of_card(told: Mapping[str, Any], pictures: Iterable[Thumbnail], name: str) -> dict[str, Any]:
    """Return what the board has read from a file, as ``M36`` and ``job.file`` tell it."""
    slicer, version = slicer_of(str(told.get("generatedBy") or ""))
    filament = told.get("filament")
    found = {
        "slicer": slicer or None,
        "slicer_version": version or None,
        "estimated_time": _positive(told.get("printTime")) or _positive(told.get("simulatedTime")),
        "object_height": _positive(told.get("height")),
        "layer_height": _positive(told.get("layerHeight")),
        "layer_count": _positive(told.get("numLayers")),
        "filament_total": _total(map(_number, filament if isinstance(filament, list) else ())),
        "thumbnails": thumbnails(name, pictures) or None,
    }
    return _known(found)


def _known(found: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in found.items() if value is not None}


def _total(lengths: Iterable[float | None]) -> float | None:
    return _positive(sum(length for length in lengths if length is not None and length > 0))


def _positive(value: Any) -> float | None:
    number = _number(value)
    return number if number is not None and number > 0 else None


def _number(value: Any) -> float | None:
    is_one = isinstance(value, (int, float)) and not isinstance(value, bool)
    return value if is_one and math.isfinite(value) else None


def _mapping(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}
