"""Where the layers of a print file begin, by what slicers write into it.

RepRapFirmware counts the layers of what it prints itself by the same comments (3.5
GCodeBuffer/StringParser.cpp, CheckForCommentMark). What a host streams comes to it without them.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_right
from collections.abc import Iterable

CHUNK = 64 * 1024
"""Small, as nothing else of Python runs while one is searched."""

MOST = 50_000

LONGEST = 200
"""Letters of a line that are looked at; what is cut at the end of a chunk is seen with the next."""

_MARK = re.compile(
    rb"\n;[ \t]*(?:LAYER_CHANGE\b|LAYER:[ \t]*\d+"
    rb"|BEGIN_LAYER_OBJECT\b(?:[^\r\n]*?z=(?P<object>[\d.]+))?"
    rb"|layer[ \t]+\d+(?:,[ \t]*Z[ \t]*=[ \t]*(?P<simplify>[\d.]+))?)"
)
"""PrusaSlicer, SuperSlicer and Orca; Cura and ideaMaker; KISSlicer; Simplify3D. Groups: the height
where the same comment tells it. It begins with letters, which are searched for fast."""

_HEIGHT = re.compile(rb"\n;[ \t]*Z[: \t=]+(?P<height>[\d.]+)")
"""In the lines behind PrusaSlicer's mark."""


class LayerMarks:
    """The beginnings of layers: places in the file, and heights where the file tells them."""

    def __init__(self, places: Iterable[int] = (), heights: Iterable[float] = ()) -> None:
        self._places = array("Q", places)
        self._heights = array("f", heights)

    @property
    def count(self) -> int:
        """How many layers the file has, 0 where it tells of none."""
        return len(self._places)

    def layer_at(self, place: int) -> int:
        """Return the number of the layer that a place belongs to, 0 before the first."""
        return bisect_right(self._places, place)

    def height_of(self, layer: int) -> float | None:
        """Return the height of a layer, counted from 1, in mm."""
        if not 1 <= layer <= len(self._heights):
            return None
        height = self._heights[layer - 1]
        return round(height, 3) if height == height else None


def layer_marks(chunks: Iterable[bytes]) -> LayerMarks:
    """Return where the layers of a file begin, which comes in pieces.

    >>> layer_marks([b";LAYER:0\\nG1 X1\\n;LAY", b"ER:1\\nG1"]).layer_at(17)
    2
    """
    places, heights = array("Q"), array("f")
    # as if there were a line before the first one
    kept, begin = b"\n", -1
    for chunk in chunks:
        text = kept + chunk
        # what is near the end is seen with the next piece: its line goes on, and so does the next
        end = max(text.rfind(b"\n", 0, max(0, len(text) - LONGEST)), len(text) - 4 * LONGEST, 0)
        _find(text, end, begin, places, heights)
        kept, begin = text[end:], begin + end
        if len(places) >= MOST:
            break
    else:
        _find(kept, len(kept), begin, places, heights)
    return LayerMarks(places, heights)


def _find(text: bytes, end: int, begin: int, places: array[int], heights: array[float]) -> None:
    """Take the marks that begin before ``end``; ``begin`` is where the text is in the file."""
    for found in _MARK.finditer(text):
        if found.start() >= end:
            return
        height = found["object"] or found["simplify"]
        if height is None:
            near = _HEIGHT.search(text, found.end(), found.end() + LONGEST // 2)
            height = near["height"] if near else None
        places.append(begin + found.start() + 1)
        heights.append(_number(height))


def _number(text: bytes | None) -> float:
    try:
        return float(text) if text else float("nan")
    except ValueError:
        return float("nan")
