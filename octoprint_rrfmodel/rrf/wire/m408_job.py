"""What is printed, on firmware that tells it in pieces: ``M408`` how far, ``M36`` which file.

``M36`` without a name is about the file being printed (2.05 PrintMonitor.cpp, GetFileInfoResponse).
"""

from __future__ import annotations

from typing import Any, Callable

OF_A_JOB = frozenset(
    (
        "currentLayer",
        "currentLayerTime",
        "filePosition",
        "firstLayerDuration",
        "fractionPrinted",
        "printDuration",
        "timesLeft",
        "warmUpDuration",
    )
)
"""Members that S4 has while something is printed; once it has ended they are merely missing."""

WITHOUT_JOB = ("C", "F", "H", "I", "O")
"""Letters of S2 and above with which nothing is printed."""

LEGACY_OF_A_JOB = frozenset(("fraction_printed", "timesLeft"))
"""Members of S0 and S1 that are there while something is printed; S1 leaves the second out."""


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def _is_number(value: Any) -> bool:
    return type(value) in (int, float) and 0 <= value < 1e15


def _are_numbers(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_number, value))


OF_A_FILE: dict[str, Callable[[Any], bool]] = {
    "fileName": _is_text,
    "size": lambda value: type(value) is int and _is_number(value),
    "lastModified": _is_text,
    "height": _is_number,
    "firstLayerHeight": _is_number,
    "layerHeight": _is_number,
    "numLayers": _is_number,
    "printTime": _is_number,
    "simulatedTime": _is_number,
    "filament": _are_numbers,
    "generatedBy": _is_text,
}
"""Members of an answer to ``M36`` that are those of ``job.file``, and what each has to be."""


def file_of(fields: dict[str, Any]) -> dict[str, Any]:
    """Return ``job.file`` as an answer to ``M36`` tells it, nothing where it tells no name."""
    if not isinstance(fields.get("fileName"), str):
        return {}
    return {
        name: fields[name]
        for name, fits in OF_A_FILE.items()
        if name in fields and fits(fields[name])
    }


def is_another(before: dict[str, Any], now: dict[str, Any]) -> bool:
    """Return whether a status tells of another job than the one before it."""
    if now.get("status") in WITHOUT_JOB:
        return True
    lasted: Any = before.get("printDuration")
    lasts: Any = now.get("printDuration")
    return _is_number(lasted) and _is_number(lasts) and lasts < lasted


def has_ended(fields: dict[str, Any]) -> bool:
    """Return whether S0 or S1 tells that nothing is printed."""
    return "fraction_printed" not in fields


def put_job(model: dict[str, Any], file: dict[str, Any]) -> None:
    """Put a file into the model, and where no place in it is told the one that a share means."""
    if not file:
        return
    job = model.setdefault("job", {})
    job["file"] = {**job.get("file", {}), **file}
    told = model.get("m408", {})
    percent: Any = told.get("fractionPrinted")
    fraction: Any = told.get("fraction_printed")
    if _is_number(percent):
        fraction = percent / 100
    if "filePosition" not in job and "size" in file and _is_number(fraction):
        job["filePosition"] = round(min(fraction, 1.0) * file["size"])
