"""The object model as text: numbers, escapes, and the answer to an M409.

Which members a key and its flags select is the business of
:func:`octoprint_rrfmodel.rrf.m409.answer`; here is what the serial line adds: decimals, the cut of
arrays, shortage of buffers, versions.
"""

from __future__ import annotations

import functools
import math
import re
import struct
from collections.abc import Mapping
from typing import Any

from octoprint_rrfmodel.rrf.m409 import answer
from octoprint_rrfmodel.rrf.model.m409 import prepared
from octoprint_rrfmodel.rrf.model.marks import MARKS

from ..firmware import Firmware
from ..text.letters import utf8
from .decimals import decimals_of

OUT_OF_BUFFERS = '{"err":-1}'
RESERVED_BUFFERS = 4
BUFFER_SIZE = 256
DSF_KEYS = ("network", "volumes")
"""Answered by Duet Software Framework in SBC mode (RRF 3.5 GCodes2.cpp:3118)."""

HEATER_MODEL = "heat.heaters[].model"

MOST_KEPT = 8192
"""Texts of numbers and names that are kept."""

_EXPONENT_FROM = 9.2e18
_MOST_DIGITS = 7
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t"}
_UNSAFE = re.compile(r'["\\\x00-\x1f]')
_ARRAY_START = re.compile(r"a(\d*)")
_KEY_STEP = re.compile(r"\.?([^.\[^]+)|\[\s*([-+]?\d*)\]")


# a model has the same names and mostly the same numbers each time
@functools.lru_cache(maxsize=MOST_KEPT)
def number(value: float, decimals: int = 0) -> str:
    """Return a float as RRF prints it, ``null`` for NaN and infinities.

    ``number(1.0, 2)`` is ``1.00``, ``number(0.0, 2)`` is ``0``. At most seven significant digits,
    the float32 rounded half to even (RepRapFirmware.cpp:168, RRFLibraries SafeVsnprintf.cpp).
    """
    if value == 0:
        return "0"
    if not math.isfinite(value):
        return "null"
    try:
        single = struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return "null"
    limit = _MOST_DIGITS
    if single >= 1:
        limit = max(1, _MOST_DIGITS - len(str(int(single))))
    wanted = min(decimals or _MOST_DIGITS, limit)
    if abs(single) > _EXPONENT_FROM:
        return exponential(single, wanted)
    return f"{single:.{wanted}f}"


def exponential(value: float, decimals: int) -> str:
    """Return the exponent form with RRF's unpadded exponent: ``1.0e+19``."""
    mantissa, exponent = f"{value:.{decimals}e}".split("e")
    return f"{mantissa}e{exponent[0]}{int(exponent[1:])}"


@functools.lru_cache(maxsize=MOST_KEPT)
def quoted(text: str) -> str:
    """Return a JSON string with the escapes RRF knows; other control characters become ``?``."""
    return '"' + _UNSAFE.sub(lambda m: _ESCAPES.get(m.group(), "?"), text) + '"'


def encoded(value: Any, node: Any = None, *, exponents: bool = False) -> str:
    """Return a value as the firmware writes it, without blanks.

    ``node`` has the decimals of a number, or of what is in an object or a list, as
    :func:`..decimals.decimals_of` returns them. What has none is written as it is.
    """
    if value is None:
        return "null"
    if value is True:
        return "true"
    if value is False:
        return "false"
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, (int, float)):
        return _encoded_number(value, node, exponents)
    if isinstance(value, Mapping):
        below = node if isinstance(node, Mapping) else {}
        members = (
            f"{quoted(name)}:{encoded(member, below.get(name), exponents=exponents)}"
            for name, member in value.items()
        )
        return "{" + ",".join(members) + "}"
    below = _of_elements(node)
    return "[" + ",".join([encoded(each, below, exponents=exponents) for each in value]) + "]"


def _encoded_number(value: float, node: Any, exponents: bool) -> str:
    decimals = node if isinstance(node, int) else None
    if decimals is None and isinstance(value, int):
        return str(value)
    text = number(value, decimals or 0)
    if not exponents or text in ("0", "null"):
        return text
    # another form of the same value, with as many digits as it has
    digits = text.strip("-").replace(".", "").strip("0")
    return exponential(float(text), max(1, len(digits) - 1))


def _of_elements(node: Any) -> Any:
    """Return the decimals of a list's elements; of a list that a key has opened they are known."""
    return node.get("[]", node) if isinstance(node, Mapping) else node


def _below(decimals: Any, key: str) -> Any:
    """Return the decimals of what a key asks for; a length has none."""
    node = None if key.startswith("#") else decimals
    for step in _KEY_STEP.finditer(key):
        node = node.get(step.group(1) or "[]") if isinstance(node, Mapping) else None
    return node


def _shortened_axes(model: Mapping[str, Any], limit: int) -> Mapping[str, Any]:
    """Return the model with ``move.axes`` cut to ``limit`` elements."""
    move = model.get("move") or {}
    if len(move.get("axes") or ()) <= limit:
        return model
    return {**model, "move": {**move, "axes": move["axes"][:limit]}}


def _key_up_to_leaf(model: Mapping[str, Any], key: str) -> str:
    """Return the key without what follows a leaf, as RRF 3.4 and older read it."""
    value: Any = model
    end = len(key) - len(key.lstrip("#"))
    for step in _KEY_STEP.finditer(key, end):
        if not isinstance(value, (Mapping, list)):
            return key[:end] if value is not None else key
        name, index = step.group(1), step.group(2)
        if name is not None:
            value = value.get(name) if isinstance(value, Mapping) else None
        elif not isinstance(value, list):
            value = None
        elif index:
            at = int(index)
            value = value[at] if 0 <= at < len(value) else None
        else:
            value = next((element for element in value if element is not None), None)
        end = step.end()
    return key if value is None or isinstance(value, (Mapping, list)) else key[:end]


def _cut(parts: list[str], before: int, limit: int) -> int:
    """Return how many of the encoded elements RRF writes before the text reaches the limit."""
    length = before + 1
    for count, part in enumerate(parts):
        if count and length >= limit:
            return count
        length += len(utf8(part)) + (1 if count else 0)
    return len(parts)


def _marks_of(firmware: Firmware) -> dict[str, Any]:
    """Return the marks of that firmware; heater models aren't verbose any more (seen in 3.5)."""
    found: dict[str, Any] = dict(MARKS)
    if firmware.at_least(3, 5):
        found[HEATER_MODEL] = frozenset(MARKS.get(HEATER_MODEL, ())) - {"verbose"}
    return found


class ModelText:
    """Answers M409 for one board: text of the object model under the limits of its firmware."""

    def __init__(self, firmware: Firmware, buffers: int, marks: Mapping[str, Any] | None = None):
        self._firmware = firmware
        self._marks = prepared(_marks_of(firmware) if marks is None else marks)
        self.decimals = decimals_of(firmware.release)
        self.most_bytes = buffers * BUFFER_SIZE
        """What fits in all output buffers together."""
        self.array_bytes = (buffers - RESERVED_BUFFERS) * BUFFER_SIZE // 2
        """From here on no further element of a root array is written (4608 or 2816)."""

    def reply(
        self, model: Mapping[str, Any], key: str, flags: str, *, exponents: bool = False
    ) -> str:
        """Return the JSON text without line end, or ``{"err":-1}`` where it doesn't fit."""
        asked, seen_flags = key, flags
        if self._firmware.leaf_ends_key:
            asked = _key_up_to_leaf(model, key)
        if not self._firmware.has_important_flag:
            seen_flags = flags.replace("i", "")
        part = model
        limit = self._firmware.axes_limit
        if limit is not None and not re.search("[fa]", flags):
            part = _shortened_axes(part, limit)
        if not asked and "d" not in seen_flags:
            # the firmware's default for an empty key, also with f (ObjectModel.cpp:693)
            seen_flags += "d1"
        found = answer(part, asked, seen_flags, self._marks)
        text = self._text(key, flags, found, _below(self.decimals, asked), exponents)
        if len(utf8(text)) > self.most_bytes:
            return OUT_OF_BUFFERS
        return text

    def _text(
        self, key: str, flags: str, found: Mapping[str, Any], node: Any, exponents: bool
    ) -> str:
        head = f'{{"key":{quoted(key)},"flags":{quoted(flags)},"result":'
        result = found["result"]
        if "next" not in found or not isinstance(result, (list, tuple)):
            return head + encoded(result, node, exponents=exponents) + "}"
        below = _of_elements(node)
        parts = [encoded(element, below, exponents=exponents) for element in result]
        count = _cut(parts, len(utf8(head)), self.array_bytes)
        following = found["next"] if count == len(parts) else first_element(flags) + count
        return f'{head}[{",".join(parts[:count])}],"next":{following}}}'


def first_element(flags: str) -> int:
    """Return the ``a`` of the flags, 0 without one; the last one wins."""
    starts = _ARRAY_START.findall(flags)
    return int(starts[-1] or 0) if starts else 0


def dsf_reply(model: Mapping[str, Any], key: str, flags: str) -> str | None:
    """Return what Duet Software Framework answers for its own keys, ``None`` for any other.

    It doesn't echo the flags and writes numbers in its own way.
    """
    if re.split(r"[.\[]", key, maxsplit=1)[0] not in DSF_KEYS:
        return None
    found = answer(model, key, flags)
    return f'{{"key":{quoted(key)},"result":{encoded(found["result"])}}}'
