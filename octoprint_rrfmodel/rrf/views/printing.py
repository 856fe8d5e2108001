"""View: how far a print is, in layers, height, share of the file and time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from .channels import CARD, channel_called, own_channel
from .job import card_job, progress
from .machine import Machine, array, mapping

GCODES = "0:/gcodes/"

ESTIMATES = ("slicer", "filament", "file")
"""Members of ``job.timesLeft``, the one that knows most first."""


class Printing(NamedTuple):
    """What the model says of a print; ``None`` for what it doesn't."""

    is_card_job: bool
    """Whether the board prints from its card."""
    is_paused: bool
    name: str
    """The file, below ``0:/gcodes``."""
    layer: int | None
    layers: int | None
    height: float | None
    """User position of Z in mm."""
    total_height: float | None
    fraction: float | None
    """Share of the file that was read, 0 to 1."""
    seconds_left: float | None
    feed_rate: float | None
    """As the print's last F set it, in mm/min."""
    fan: float | None
    """What ``M106 S`` of the print set, 0 to 1."""


def printing(model: Mapping[str, Any]) -> Printing:
    """Return how far the print from the card is.

    Without one: what is known of the height, the feed rate and the fan while a host streams.
    """
    job = card_job(model)
    tree = mapping(model.get("job")) if job.is_active else {}
    file = mapping(tree.get("file"))
    left = mapping(tree.get("timesLeft"))
    name = job.path[len(GCODES) :] if job.path.startswith(GCODES) else job.path
    return Printing(
        is_card_job=job.is_active,
        is_paused=job.status in ("pausing", "paused"),
        name=name,
        layer=_whole(tree.get("layer")),
        # 0 where the file's comments tell nothing
        layers=_whole(file.get("numLayers")) or None,
        height=_height(model),
        total_height=_real(file.get("height")) or None,
        fraction=progress(model) if job.is_active else None,
        seconds_left=next(
            (time for name in ESTIMATES if (time := _real(left.get(name))) is not None), None
        ),
        feed_rate=_feed_rate(channel_called(model, CARD) if job.is_active else own_channel(model)),
        fan=_fan(model),
    )


def _height(model: Mapping[str, Any]) -> float | None:
    for axis in map(mapping, array(mapping(model.get("move")).get("axes"))):
        if axis.get("letter") == "Z":
            return _real(axis.get("userPosition"))
    return None


def _feed_rate(channel: Mapping[str, Any]) -> float | None:
    speed = _real(channel.get("feedRate"))
    return None if speed is None else speed * 60


def _fan(model: Mapping[str, Any]) -> float | None:
    """Return the first fan of the tool in use, else fan 0: that is whom M106 without P means."""
    tool = Machine(model).current_tool or {}
    mapped = array(tool.get("fans"))
    index = mapped[0] if mapped else 0
    fans = array(model.get("fans"))
    if not isinstance(index, int) or not 0 <= index < len(fans):
        return None
    return _real(mapping(fans[index]).get("requestedValue"))


def _whole(value: Any) -> int | None:
    return value if type(value) is int else None


def _real(value: Any) -> float | None:
    return float(value) if type(value) in (int, float) else None
