"""Logging in at whatever answers: a board by itself, or the computer in front of one.

What answers is told by the JSON of ``rr_connect``; the status says little, as a board answers
anything with 200. Frameworks before 3.5 don't know ``rr_connect``, and some later ones fail at it.
"""

import json
import re
import time
from typing import NamedTuple

from ...rrf.wire.machine import machine_path
from ...rrf.wire.rr import path_of

STANDALONE, SBC = "rr", "dsf"

NOT_KNOWN = (404, 500)
"""How a framework answers ``rr_connect`` that hasn't got it, or fails at it."""

DOWN = (502, 503)
"""How it answers while its control server doesn't."""

_KEY = re.compile(r"[0-9A-Za-z-]{1,64}")


class Refused(Exception):
    """The board, or what answers in its place, can't be used; ``code`` says why.

    ``wrong_password``, ``no_slot``, ``too_old``, ``sbc_too_old``, ``sbc_down``, ``not_rrf``.
    """

    def __init__(self, code):
        super().__init__(code)
        self.code = code


class Busy(Exception):
    """The board had no buffers for the answer."""


class Greeting(NamedTuple):
    """What a board says of itself at a login."""

    board_type: str
    """Empty where it doesn't say it."""
    api_level: int
    protocol: str = STANDALONE
    """The dialect that it speaks (``dialects``)."""


def log_in(get, password):
    """Return greeting and key, ``None`` for a board without keys; ``get(path)`` asks."""
    told = {
        "password": password,
        # what the first client says after power-up becomes the board's clock, without a zone
        "time": time.strftime("%Y-%m-%dT%H:%M:%S"),
        "sessionKey": "yes",
    }
    answer = get(path_of("connect", **told))
    said = _object_of(answer)
    if type(said.get("err")) is int:
        return _log_in_at_computer(get, password, said) if said.get("isEmulated") else _of(said)
    if answer.status in NOT_KNOWN:
        return _log_in_at_computer(get, password, {})
    _look_whether_down(answer)
    raise Refused("not_rrf")


def goodbye(greeting):
    """Return the path by which a session is ended."""
    return path_of("disconnect") if greeting.protocol == STANDALONE else machine_path("disconnect")


def _of(said):
    """Return greeting and key of a board by itself."""
    if said["err"]:
        raise Refused({1: "wrong_password", 2: "no_slot"}.get(said["err"], "not_rrf"))
    level, key = said.get("apiLevel"), said.get("sessionKey")
    if type(level) is not int or level < 1:
        raise Refused("too_old")
    return Greeting(_board_of(said), level), key if type(key) is int and key else None


def _log_in_at_computer(get, password, said):
    """Return greeting and key of a computer in front of a board."""
    if said.get("err"):
        raise Refused("wrong_password")
    answer = get(machine_path("connect", password=password))
    if answer.status == 403:
        raise Refused("wrong_password")
    _look_whether_down(answer)
    key = _object_of(answer).get("sessionKey")
    if isinstance(key, str) and _KEY.fullmatch(key):
        level = said.get("apiLevel")
        return Greeting(_board_of(said), level if type(level) is int else 0, SBC), key
    if answer.status == 404 and "state" in _object_of(get(machine_path("status"))):
        raise Refused("sbc_too_old")
    raise Refused("not_rrf")


def _look_whether_down(answer):
    """Raise what a framework's, or a board's, refusal for now means."""
    if answer.status in DOWN and answer.body.strip() and not answer.body.lstrip().startswith(b"<"):
        raise Refused("sbc_down")
    if answer.status == 503:
        raise Busy


def _board_of(said):
    board = said.get("boardType")
    return board if isinstance(board, str) else ""


def _object_of(answer):
    try:
        told = json.loads(answer.body)
    except (ValueError, RecursionError):
        return {}
    return told if isinstance(told, dict) else {}
