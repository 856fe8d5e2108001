"""``configfile``: a configuration that the model could have been made from."""

from __future__ import annotations

from typing import Any

from ..views.machine import mapping
from ..wire.gcode_words import number as shortly
from .host import startup_error
from .motion import max_accel, max_velocity
from .values import text
from .view import Row, View, one


def _settings(view: View) -> dict[str, dict[str, Any]]:
    """Return the sections by name: the printer's own and one for each object served.

    Clients look for heaters and sensors among them, so that an empty one says something too.
    """
    printer = {
        # Klipper's names are RRF's in lower case: coreXY
        "kinematics": text(mapping(view.move.get("kinematics")).get("name")).lower() or None,
        "max_velocity": max_velocity(view),
        "max_accel": max_accel(view),
    }
    sections = {"printer": _known(printer)}
    for name, (row, thing) in view.objects.items():
        sections[name] = _known(row.settings(view, thing))
    return sections


def _known(options: Any) -> dict[str, Any]:
    return {name: value for name, value in options.items() if value is not None}


def _as_written(value: Any) -> str:
    return value if isinstance(value, str) else shortly(value)


def _config(view: View, thing: Any) -> dict[str, dict[str, str]]:
    return {
        section: {name: _as_written(value) for name, value in options.items()}
        for section, options in _settings(view).items()
    }


def _warnings(view: View, thing: Any) -> list[dict[str, str]]:
    message = startup_error(view)
    return [{"type": "runtime_warning", "message": message}] if message else []


ROWS = (
    Row(
        "configfile",
        one("configfile"),
        {
            "config": _config,
            "settings": lambda view, _: _settings(view),
            # M500's override file is in no model
            "save_config_pending": lambda view, _: False,
            "save_config_pending_items": lambda view, _: {},
            "warnings": _warnings,
        },
    ),
)
