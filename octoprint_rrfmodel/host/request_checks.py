"""Requests that OctoPrint's documents refuse and its code doesn't: docs.octoprint.org, api/printer.

Some of them it answers with 500, some go out as G-code that means something else (a speed of
``true`` has the letter of a tool in it), some are accepted and do nothing.
"""

import math
import re
from typing import Callable, NamedTuple

import flask
from flask_babel import gettext
from octoprint.access.permissions import Permissions

from .answers import refusal
from .printer_profile import takes_tool_numbers
from .request_json import json_of

PRINTHEAD, TOOL = "api.printerPrintheadCommand", "api.printerToolCommand"
BED, CHAMBER = "api.printerBedCommand", "api.printerChamberCommand"
CARD_1, CARD_2 = "api.printerSdCommand", "api.printerStorageCommand"
"""Flask's names of OctoPrint's views; the card's is another one in 2.0."""

MALFORMED, CONFLICT = 400, 409

AXES = "xyz"


class Check(NamedTuple):
    """One line of the table."""

    views: tuple[str, ...]
    commands: tuple[str, ...]
    holds: Callable[[dict, object], bool]
    """Whether the request, with the line to the board, is one that the documents allow."""
    status: int
    text: str
    """Which sentence says what is wrong."""


def _is_number(value):
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return is_number and math.isfinite(value)


def _is_speed(value):
    """Return whether a speed is a number, or left out, or switched off."""
    return value is None or isinstance(value, bool) or (_is_number(value) and value >= 0)


def _is_target(value):
    return _is_number(value) and value >= 0


def _number_in(name):
    return lambda data, link: _is_number(data.get(name))


def _target(data, link):
    return _is_target(data.get("target"))


def _jog(data, link):
    given = [data[axis] for axis in AXES if axis in data]
    return bool(given) and all(map(_is_number, given))


def _speed(data, link):
    return _is_speed(data.get("speed"))


def _axes(data, link):
    return isinstance(data.get("axes"), (list, str))


def _tool(data, link):
    return _is_name("tool[0-9]+", data.get("tool"))


def _by_tool(name, pattern, is_right):
    def holds(data, link):
        values = data.get(name)
        return isinstance(values, dict) and all(
            _is_name(pattern, tool) and is_right(value) for tool, value in values.items()
        )

    return holds


def _is_carried(data, link):
    """Return whether OctoPrint takes over the numbers of all tools that are to be heated.

    With one extruder, or one nozzle, it sends the target without a number, which heats another
    tool.
    """
    targets = data.get("targets")
    if not isinstance(targets, dict) or takes_tool_numbers(link.profile()):
        return True
    return all(int(tool[len("tool") :] or 0) == 0 for tool in targets)


def _is_name(pattern, value):
    return isinstance(value, str) and re.fullmatch(pattern, value) is not None


def _is_between_prints(data, link):
    return not link.is_printing()


def _has_card(data, link):
    return link.has_card()


CHECKS = (
    Check((PRINTHEAD,), ("jog",), _jog, MALFORMED, "axes"),
    Check((PRINTHEAD,), ("jog",), _speed, MALFORMED, "speed"),
    Check((PRINTHEAD,), ("home",), _axes, MALFORMED, "home"),
    Check((PRINTHEAD,), ("feedrate",), _number_in("factor"), MALFORMED, "factor"),
    Check((TOOL,), ("flowrate",), _number_in("factor"), MALFORMED, "factor"),
    Check((TOOL,), ("select",), _tool, MALFORMED, "tool"),
    Check(
        (TOOL,), ("target",), _by_tool("targets", "tool[0-9]*", _is_target), MALFORMED, "targets"
    ),
    Check((TOOL,), ("target",), _is_carried, MALFORMED, "one_tool"),
    Check(
        (TOOL,), ("offset",), _by_tool("offsets", "tool[0-9]+", _is_number), MALFORMED, "offsets"
    ),
    Check((TOOL,), ("extrude",), _number_in("amount"), MALFORMED, "amount"),
    Check((TOOL,), ("extrude",), _speed, MALFORMED, "speed"),
    Check((BED, CHAMBER), ("target",), _target, MALFORMED, "target"),
    Check((BED, CHAMBER), ("offset",), _number_in("offset"), MALFORMED, "offset"),
    Check((TOOL,), ("select",), _is_between_prints, CONFLICT, "printing"),
    Check((CARD_1, CARD_2), ("refresh", "release"), _has_card, CONFLICT, "no_card"),
)


class RequestChecks:
    """Answers such requests while ``link`` leads to a board with RepRapFirmware."""

    def __init__(self, link):
        self._link = link

    ##~~ octoprint.server.api.before_request

    def refuse(self):
        """Return an answer for a request that the documents refuse, ``None`` for others."""
        request = flask.request
        link = self._link
        if request.method != "POST" or not link.is_rrf or not link.is_operational:
            return None
        checks = [check for check in CHECKS if request.endpoint in check.views]
        # without the permission OctoPrint's own answer is the right one
        if not checks or not Permissions.CONTROL.can():
            return None
        data = json_of(request)
        if not isinstance(data, dict):
            return None
        for check in checks:
            if data.get("command") in check.commands and not check.holds(data, link):
                return refusal(check.status, _sentence(check.text))
        return None


def _sentence(name):
    return {
        "axes": gettext("A jog needs a number for at least one of x, y and z."),
        "speed": gettext("The speed has to be a number that isn't negative, or false."),
        "home": gettext("The axes to home have to be a list of x, y and z."),
        "factor": gettext("The factor has to be a number."),
        "tool": gettext("The tool has to be called tool0, tool1 and so on."),
        "targets": gettext(
            "The targets have to be numbers that aren't negative, by tool0 and so on."
        ),
        "one_tool": gettext(
            "OctoPrint's printer profile has one extruder, or one nozzle for all: it would heat"
            " another tool. Set the number of extruders in the printer profile, or heat tool0."
        ),
        "offsets": gettext("The offsets have to be numbers, by tool0 and so on."),
        "amount": gettext("The amount has to be a number."),
        "target": gettext("The target has to be a number that isn't negative."),
        "offset": gettext("The offset has to be a number."),
        "printing": gettext("A tool can't be selected during a print. Pause it first."),
        "no_card": gettext("The card has not been initialized. Do that first."),
    }[name]
