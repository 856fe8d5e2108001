"""``configfile``: a configuration that the model could have been made from."""

from __future__ import annotations

from typing import Any

from ..views.machine import mapping
from ..wire.gcode_words import number as shortly
from .host import startup_error
from .motion import SECONDS, max_accel, max_velocity
from .sections import ACCELERATION, SPEED
from .values import text
from .view import Row, View, one


def _settings(view: View) -> dict[str, dict[str, Any]]:
    """Return the sections by name: the printer's own and one for each object served.

    Clients look for heaters and sensors among them, so that an empty one says something too.
    """
    velocity, accel, z_speed = max_velocity(view), max_accel(view), view.of_axis("Z", "speed")
    printer = {
        # Klipper's names are RRF's in lower case: coreXY
        "kinematics": text(mapping(view.move.get("kinematics")).get("name")).lower() or "none",
        "max_velocity": SPEED if velocity is None else velocity,
        "max_accel": ACCELERATION if accel is None else accel,
        "max_z_velocity": None if z_speed is None else z_speed / SECONDS,
        "max_z_accel": view.of_axis("Z", "acceleration"),
    }
    sections = {"printer": _known(printer)}
    for name, (row, thing) in view.objects.items():
        sections[name] = _known(row.settings(view, thing))
    return sections


def _known(options: Any) -> dict[str, Any]:
    return {name: value for name, value in options.items() if value is not None}


def _as_written(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(map(_as_written, value))
    return str(value) if isinstance(value, (str, bool)) else shortly(value)


def _config(view: View, thing: Any) -> dict[str, dict[str, str]]:
    return {
        section: {name: _as_written(value) for name, value in options.items()}
        for section, options in _settings(view).items()
    }


def _in_lower_case(view: View, thing: Any) -> dict[str, dict[str, Any]]:
    """Return the sections by the names that they have among Klipper's settings."""
    settings: dict[str, dict[str, Any]] = {}
    for name, options in _settings(view).items():
        settings.setdefault(name.lower(), options)
    return settings


def _warnings(view: View, thing: Any) -> list[dict[str, str]]:
    message = startup_error(view)
    return [{"type": "runtime_warning", "message": message}] if message else []


ROWS = (
    Row(
        "configfile",
        one("configfile"),
        {
            "config": _config,
            "settings": _in_lower_case,
            # M500's override file is in no model
            "save_config_pending": lambda view, _: False,
            "save_config_pending_items": lambda view, _: {},
            "warnings": _warnings,
        },
    ),
)
