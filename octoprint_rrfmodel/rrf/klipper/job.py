"""``virtual_sdcard``, ``print_stats`` and others about the print."""

from __future__ import annotations

from typing import Any

from ..views.machine import array, mapping
from .values import element, number, text, whole
from .view import Row, View, one, where
from .world import HOST, PRINTING

FOLDER = "0:/gcodes/"
"""Where jobs lie; Klipper's names of files leave it out."""

ACTIVE = frozenset(
    (
        "processing",
        "simulating",
        "pausing",
        "resuming",
        "changingTool",
        "busy",
        "cancelling",
    )
)
"""Values of ``state.status`` in which a job that is there moves on."""


def _own_name(path: str) -> str:
    return path[len(FOLDER) :] if path.lower().startswith(FOLDER) else path


def _is_active(view: View, thing: Any) -> bool:
    job = view.job
    if job.source == HOST:
        return job.phase == PRINTING
    # M408 tells no name
    is_there = job.runs and view.file.get("fileName", "") is not None
    return is_there and view.status in ACTIVE


def _file_path(view: View, thing: Any) -> str | None:
    job = view.job
    path = job.path if job.source == HOST and job.runs else text(view.file.get("fileName"))
    return path or None


def _file_size(view: View, thing: Any) -> int:
    is_selected = not view.job.runs and text(view.file.get("fileName"))
    return whole(view.file.get("size")) or 0 if is_selected else view.job.size


def _filename(view: View, thing: Any) -> str:
    job = view.job
    if job.source == HOST:
        return job.path
    known = text(view.file.get("fileName")) or text(view.card.get("lastFileName"))
    return _own_name(known or job.path)


def _print_duration(view: View, thing: Any) -> float:
    job = view.job
    if job.runs or job.source == HOST or not text(view.card.get("lastFileName")):
        return job.duration
    last = number(view.card.get("lastDuration"))
    return job.duration if last is None else last


def _total_duration(view: View, thing: Any) -> float:
    return _print_duration(view, thing) + view.job.pauses


def _info(view: View, thing: Any) -> dict[str, int | None]:
    if view.job.source == HOST:
        return {"total_layer": None, "current_layer": None}
    return {
        # 0 where there is none
        "total_layer": whole(view.file.get("numLayers")) or None,
        "current_layer": whole(view.card.get("layer")) or None,
    }


def _progress(view: View, thing: Any) -> float:
    return view.job.progress


def _builds(view: View) -> Any:
    """Return whether the firmware knows of objects; there is no ``build`` without a job."""
    return "build" in view.card


def _objects(view: View) -> list[dict[str, Any]]:
    build = mapping(view.card.get("build"))
    return [
        {**mapping(item), "name": text(mapping(item).get("name")) or f"object{index}"}
        for index, item in enumerate(array(build.get("objects")))
    ]


def _outline(item: dict[str, Any]) -> dict[str, Any]:
    """Return an object's name and, where its extent is known, the box around it, in mm."""
    ranges = [[number(end) for end in array(item.get(axis))[:2]] for axis in ("x", "y")]
    if any(len(ends) < 2 or None in ends for ends in ranges):
        return {"name": item["name"]}
    (left, right), (front, back) = ranges
    return {
        "name": item["name"],
        "center": [_middle(left, right), _middle(front, back)],
        "polygon": [[left, front], [right, front], [right, back], [left, back]],
    }


def _middle(low: float | None, high: float | None) -> float | None:
    return None if low is None or high is None else (low + high) / 2


def _current_object(view: View, thing: Any) -> str | None:
    index = mapping(view.card.get("build")).get("currentObject")
    return element(_objects(view), index).get("name")


ROWS = (
    Row(
        "virtual_sdcard",
        one("virtual_sdcard"),
        {
            "progress": _progress,
            "is_active": _is_active,
            "file_position": lambda view, _: view.job.position,
            "file_path": _file_path,
            "file_size": _file_size,
        },
        settings=lambda view, _: {
            "path": text(mapping(view.model.get("directories")).get("gCodes")) or FOLDER
        },
    ),
    Row(
        "print_stats",
        one("print_stats"),
        {
            "filename": _filename,
            "total_duration": _total_duration,
            "print_duration": _print_duration,
            "filament_used": lambda view, _: view.job.filament,
            "state": lambda view, _: view.job.state,
            "message": lambda view, _: view.job.message if view.job.state == "error" else "",
            "info": _info,
        },
    ),
    Row(
        "display_status",
        one("display_status"),
        {
            "message": lambda view, _: text(view.state.get("displayMessage")),
            "progress": _progress,
        },
    ),
    Row(
        "pause_resume",
        one("pause_resume"),
        {"is_paused": lambda view, _: view.status in ("pausing", "paused")},
    ),
    Row(
        "exclude_object",
        where("exclude_object", _builds),
        {
            "objects": lambda view, _: [_outline(item) for item in _objects(view)],
            "excluded_objects": lambda view, _: [
                item["name"] for item in _objects(view) if item.get("cancelled") is True
            ],
            "current_object": _current_object,
        },
    ),
)
