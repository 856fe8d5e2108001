"""Lines for the machine's own jobs, their objects, filaments and macros."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ...card.listing import path_of
from ...views.machine import array, mapping
from ...wire.gcode_words import quoted
from .outcome import Request, bad, forbidden
from .parameters import MOST_PATH_BYTES, listed, missing, whole_number
from .states import PRINTING_OR_PAUSED, STREAMED, forbid
from .things import MOST

OBJECTS_SINCE = (3, 1)
"""From here on there is M486."""

FILES = {"start": "M32 {}", "simulate": "M37 P{}"}
"""Actions that begin a job, and their lines."""


class Change(NamedTuple):
    """What an action does to a job that is there."""

    lines: Mapping[str, Sequence[str]]
    """By ``state.status``."""
    refusal: str
    """Code for every other status."""


GOING_ON = ("processing", "simulating", "resuming", "pausing")
CANCEL = ("M25", "M0")

CHANGES = {
    "pause": Change(dict.fromkeys(("processing", "simulating", "resuming"), ("M25",)), "no_job"),
    "resume": Change({"paused": ("M24",)}, "not_paused"),
    # M0 from this line runs cancel.g, once the job is paused (3.5 GCodes2.cpp, M0)
    "cancel": Change({**dict.fromkeys(GOING_ON, CANCEL), "paused": ("M0",)}, "no_job"),
}

JOB_ACTIONS = (*FILES, *CHANGES)


def job(request: Request) -> Sequence[str]:
    """M32, M37, M25, M24, M0."""
    machine, action, path = request.machine, request.values["action"], request.values["path"]
    if action in FILES:
        if path is None:
            raise missing("path")
        full = path_of(path)
        if len(full.encode("utf-8")) > MOST_PATH_BYTES:
            raise bad("wrong_length", parameter="path", most=str(MOST_PATH_BYTES))
        forbid(request, STREAMED, PRINTING_OR_PAUSED)
        return [FILES[action].format(quoted(full))]
    if path is not None:
        raise bad("needless", parameter="path", known=listed(list(FILES)))
    forbid(request, STREAMED)
    change = CHANGES[action]
    if machine.status in change.lines:
        return change.lines[machine.status]
    if machine.is_current and machine.status:
        raise forbidden(change.refusal)
    # something has just happened: the firmware knows better
    return CANCEL if action == "cancel" else next(iter(change.lines.values()))


def an_object(request: Request) -> Sequence[str]:
    """M486."""
    machine, index = request.machine, request.values["index"]
    known = mapping(mapping(machine.model.get("job")).get("build")).get("objects")
    if machine.version < OBJECTS_SINCE:
        raise forbidden("objects_firmware", version="3.1")
    if not isinstance(known, list) or not known:
        raise forbidden("no_objects")
    if index >= len(known):
        raise bad("no_such_object", value=str(index), known=f"0–{len(known) - 1}")
    letter = "P" if request.values["action"] == "cancel" else "U"
    return [f"M486 {letter}{index}"]


def object_index(name: str, value: Any, machine: Any) -> int:
    """Return the number of an object, which some firmware could have."""
    index = whole_number(name, value, machine)
    tracked = mapping(machine.model.get("limits")).get("trackedObjects")
    most = tracked if isinstance(tracked, int) else MOST
    if not 0 <= index < most:
        raise bad("out_of_range", parameter=name, low="0", high=str(most - 1))
    return index


def filament(request: Request) -> Sequence[str]:
    """M701 and M703 to load, M702 to unload: what is loaded has to be unloaded first."""
    machine, values = request.machine, request.values
    tool = machine.current_tool
    name = values["name"]
    if values["action"] == "load":
        if name is None:
            raise missing("name")
        if "," in name or "/" in name or "\\" in name:
            raise bad("filament_name", parameter="name")
    if not machine.is_current:
        # another tool may be under way, with another filament in it or none
        tool = {}
    elif tool is None:
        raise forbidden("no_tool_selected")
    drive = tool.get("filamentExtruder")
    if isinstance(drive, int) and drive < 0:
        raise forbidden("no_filament_drive", tool=str(tool["number"]))
    if values["action"] == "unload":
        return ["M702"]
    extruders = array(mapping(machine.model.get("move")).get("extruders"))
    load = [f"M701 S{quoted(name)}", "M703"]
    if isinstance(drive, int) and drive < len(extruders):
        is_loaded = bool(mapping(extruders[drive]).get("filament"))
    else:
        # without M409 nobody tells in time what is loaded; to unload nothing does nothing
        is_loaded = True
    return ["M702", *load] if is_loaded else load


def macro(request: Request) -> Sequence[str]:
    """M98; a name without a folder is one of 0:/sys."""
    return [f"M98 P{quoted(request.values['path'])}"]
