"""Klipper's commands about prints, macros that clients look for, and restarts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..gcode.commands.outcome import bad, forbidden
from ..gcode.commands.parameters import listed, shown
from ..views.machine import array, mapping
from .steps import Asked, At, Operation, Restart, Row, Step
from .words import Command


def _asks(method: str) -> Any:
    # what else such a macro would be given is its own, and there is nothing that could want it
    return lambda command, at: [Asked(method)]


def _print_file(command: Command, at: At) -> Sequence[Step]:
    command.takes("FILENAME")
    return [Asked("printer.print.start", {"filename": command.text("FILENAME")})]


def _nothing(command: Command, at: At) -> Sequence[Step]:
    return []


def _restart(command: Command, at: At) -> Sequence[Step]:
    return [Restart()]


def _exclude(command: Command, at: At) -> Sequence[Step]:
    command.takes("NAME", "CURRENT", "RESET")
    build = mapping(at.view.card.get("build"))
    objects = [mapping(each) for each in array(build.get("objects"))]
    if not objects:
        raise forbidden("no_objects")
    resets = command.given.get("RESET") == "1"
    if "NAME" in command.given:
        name = command.text("NAME")
        places = [index for index, each in enumerate(objects) if _is_called(each, index, name)]
        if not places:
            known = [each.get("name") for each in objects]
            raise bad("no_such_object", value=shown(name), known=listed(known))
    elif command.given.get("CURRENT") == "1":
        places = [int(build["currentObject"])] if _is_index(build.get("currentObject")) else []
        if not places:
            raise forbidden("macro_no_current")
    elif resets:
        places = [index for index, each in enumerate(objects) if each.get("cancelled") is True]
    else:
        raise bad("macro_misses", command=command.name, parameter="NAME, CURRENT, RESET")
    action = "resume" if resets else "cancel"
    return [Operation("object", {"index": index, "action": action}) for index in places]


def _is_called(thing: Any, index: int, name: str) -> bool:
    own = thing.get("name")
    # Klipper's own slicer scripts write names in capitals
    return isinstance(own, str) and own.casefold() == name.casefold()


def _is_index(value: Any) -> bool:
    return type(value) is int and value >= 0


def _has_objects(at: At) -> bool:
    return bool(array(mapping(at.view.card.get("build")).get("objects")))


def _load(command: Command, at: At) -> Sequence[Step]:
    # KlipperScreen tells how fast, which the machine's own macros know better
    command.takes("NAME", "SPEED", "TEMP", "TEMPERATURE")
    name = command.given.get("NAME")
    if name is None:
        raise bad("macro_filament")
    return [Operation("filament", {"action": "load", "name": name})]


def _unload(command: Command, at: At) -> Sequence[Step]:
    command.takes("SPEED", "TEMP", "TEMPERATURE")
    return [Operation("filament", {"action": "unload"})]


ROWS = (
    Row("PAUSE", _asks("printer.print.pause"), "Pause the print"),
    Row("RESUME", _asks("printer.print.resume"), "Go on with the print"),
    Row("CANCEL_PRINT", _asks("printer.print.cancel"), "Cancel the print"),
    Row("SDCARD_PRINT_FILE", _print_file, "Print a file"),
    Row("SDCARD_RESET_FILE", _nothing, "Nothing: no file stays chosen"),
    Row("EXCLUDE_OBJECT", _exclude, "Cancel an object of the print (M486)", _has_objects),
    Row("RESTART", _restart, "Restart the board (M999)"),
    Row("FIRMWARE_RESTART", _restart, "Restart the board (M999)"),
    Row(
        "LOAD_FILAMENT",
        _load,
        "Load a filament of the machine's, by its NAME (M701)",
        gives_way=True,
    ),
    Row("UNLOAD_FILAMENT", _unload, "Unload the filament (M702)", gives_way=True),
)
