"""Faults that can be switched on at start or at run time, by the same names.

``name`` or ``name:argument``. Some are things real boards do (text without a line end, shortage
of buffers), some are things a serial line does to them, and some (``nesting_bomb``) nobody has
seen and a host must survive anyway.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Callable, NamedTuple

from .device import incidents
from .model.om import OUT_OF_BUFFERS

if TYPE_CHECKING:
    from .core import Core

UNDER_VOLTAGE = b"Warning: VIN under-voltage event (11.0V)"
"""RRF sends this without a line end (RRF 3.5 Platform.cpp:1396-1411)."""
DEBUG_TEXT = b"Delta probe: 0.012 steps 4411 hypercuboid 0\n"
GARBAGE = b"\x17\x9c#@k2\xf0 qT:\xc1\x7f{[\x02\n"
HARMLESS_ERROR = b"Error: Pop(): stack underflow\n"
HUGE = 64 * 1024
NESTING = 20000
_READING = re.compile(r'("(?:current|heaters)":\[?)-?\d+(?:\.\d+)?')
"""The first temperature of a reply; the group is what stands in front of it."""


class UnknownFault(ValueError):
    """The fault asked for isn't in :data:`FAULTS`, or its argument can't be read."""


def _inserted(data: bytes, extra: bytes, at: int | None = None) -> bytes:
    at = len(data) // 2 if at is None else at
    return data[:at] + extra + data[at:]


def _without_ok(data: bytes) -> bytes:
    if data.endswith(b"ok\n"):
        return data[:-3]
    return data[3:] if data.startswith(b"ok ") else data


def _cut(data: bytes) -> bytes:
    line, end, rest = data.partition(b"\n")
    return line[: len(line) // 2] + end + rest


def _is_json(data: bytes) -> bool:
    return data.startswith(b"{")


class OnReply(NamedTuple):
    """What a fault makes of the bytes of one reply, and which replies it hits."""

    change: Callable[[bytes], bytes]
    json_only: bool = False
    takes_count: bool = True
    """Whether the argument is the number of replies; otherwise every n-th one is hit."""


ON_REPLY: dict[str, OnReply] = {
    "lost_ok": OnReply(_without_ok, takes_count=False),
    "extra_ok": OnReply(lambda data: data + b"ok\n"),
    "truncated": OnReply(_cut, json_only=True),
    "nul_bytes": OnReply(lambda data: _inserted(data, b"\x00\x00")),
    "bad_utf8": OnReply(lambda data: _inserted(data, b"\xff\xc3(")),
    "debug_text": OnReply(lambda data: _inserted(data, DEBUG_TEXT, 0 if len(data) < 80 else None)),
    "garbage": OnReply(lambda data: GARBAGE + data),
    "huge_line": OnReply(lambda data: b"x" * HUGE + b"\n" + data),
    "glued_after": OnReply(lambda data: data.replace(b"\n", UNDER_VOLTAGE + b"\n", 1)),
    "glued_before": OnReply(lambda data: UNDER_VOLTAGE + data),
    "error_reply": OnReply(lambda data: HARMLESS_ERROR + data, takes_count=False),
}
"""Fault → what happens to a reply, applied in this order."""


class Fault(NamedTuple):
    """A row of :data:`FAULTS`."""

    summary: str
    default: str | None = None
    """Argument where none is given."""
    start: Callable[[Core, str | None], None] | None = None
    stop: Callable[[Core], None] | None = None
    survives_reset: bool = True
    is_event: bool = False
    """Happens once; there is nothing to switch off."""


FAULTS: dict[str, Fault] = {
    "lost_ok": Fault("every n-th ok is lost (1), or :once", "1"),
    "extra_ok": Fault("an ok too many after the next n replies (all)"),
    "glued_before": Fault("text without a line end in front of the next n replies (all)"),
    "glued_after": Fault("text behind the first line of the next n replies (all)"),
    "err_no_buffers": Fault('{"err":-1} for the next n M409 (all), or above a size with :>BYTES'),
    "few_buffers": Fault("below 20 free buffers: 3.5 and later wait, older answer err -1"),
    "truncated": Fault("the middle of a JSON line is its end, n times (all)"),
    "nul_bytes": Fault("NUL bytes in the next n replies (all)"),
    "bad_utf8": Fault("bytes that aren't UTF-8 in the next n replies (all)"),
    "garbage": Fault("a line of noise in front of the next n replies (1)", "1"),
    "huge_line": Fault("a line of 64 KiB in front of the next n replies (1)", "1"),
    "nesting_bomb": Fault("the next n M409 are answered by 20,000 nested arrays (1)", "1"),
    "nan": Fault("the first temperature in JSON is nan"),
    "exponent": Fault("numbers of M409 in exponential form"),
    "no_reply": Fault("the next n M409 get neither JSON nor ok (all)"),
    "slow": Fault("every reply comes s seconds late (2)", "2"),
    "stall": Fault("USB takes and sends nothing, for s seconds (until cleared)"),
    "reset": Fault(
        "the board restarts after s seconds (0), the port stays",
        "0",
        start=lambda board, after: board.after_seconds(after, board.reset),
        is_event=True,
    ),
    "disconnect": Fault(
        "the port vanishes for s seconds (2)",
        "2",
        start=lambda board, seconds: board.unplug(float(seconds or 0)),
        is_event=True,
    ),
    "heater_fault": Fault(
        "heater n is in a fault (1)",
        "1",
        incidents.heater_fault,
        incidents.end_heater_faults,
        False,
    ),
    "filament_error": Fault(
        "filament monitor n reports (0)",
        "0",
        incidents.filament_error,
        incidents.filament_back,
        False,
    ),
    "driver_error": Fault(
        "driver n of the mainboard reports (0)",
        "0",
        incidents.driver_error,
        incidents.driver_well,
        survives_reset=False,
    ),
    "vin_off": Fault(
        "no motor supply, status off", None, incidents.power_lost, incidents.power_back
    ),
    "halted": Fault("as after M112", None, incidents.halt, incidents.end_halt, False),
    "message_box": Fault(
        "a macro opens a message box of mode n (2)",
        "2",
        incidents.open_box,
        incidents.close_box,
        False,
    ),
    "debug_text": Fault("debug lines in the middle of the next n replies (all)"),
    "unsolicited": Fault("a temperature line every s seconds that nobody asked for (1)", "1"),
    "error_reply": Fault("a harmless Error: line in front of every n-th reply (5)", "5"),
    "sbc": Fault("a single-board computer answers network and volumes"),
    "baud": Fault("output at the speed of a line with n baud (115200)", "115200"),
    "usb_box_stuck": Fault("a blocking M291 from USB stops that channel for good (3.5 and 3.6.0)"),
}
"""Name → fault, in the order of ``--list``."""


def parse_fault(text: str) -> tuple[str, str | None]:
    """Return name and argument of ``name[:argument]``; :class:`UnknownFault` says what's wrong."""
    name, _, given = text.partition(":")
    fault = FAULTS.get(name)
    if fault is None:
        raise UnknownFault(f"unknown fault {name!r}, known are {', '.join(FAULTS)}")
    argument = given.strip() or fault.default
    if argument is not None and not re.fullmatch(r">?\d+(\.\d+)?|once", argument):
        raise UnknownFault(f"fault {name!r} takes a number, not {argument!r}")
    return name, argument


class Faults:
    """The faults that are on, with what is left of their counts."""

    def __init__(self, board: Core):
        self._board = board
        self._on: dict[str, str | None] = {}
        self._seen: dict[str, int] = {}
        self._report_at = 0.0

    def inject(self, text: str) -> None:
        name, argument = parse_fault(text)
        fault = FAULTS[name]
        if not fault.is_event:
            self._on[name] = argument
            self._seen[name] = 0
        if fault.start is not None:
            fault.start(self._board, argument)
        if name == "stall" and argument is not None:
            self._board.after_seconds(argument, lambda: self.clear("stall"))

    def clear(self, name: str) -> None:
        name, _ = parse_fault(name)
        if name in self._on:
            del self._on[name]
            stop = FAULTS[name].stop
            if stop is not None:
                stop(self._board)

    def after_reset(self) -> None:
        """Forget what a restart puts right, and let the rest strike again."""
        for name, argument in list(self._on.items()):
            fault = FAULTS[name]
            if not fault.survives_reset:
                del self._on[name]
            elif fault.start is not None:
                fault.start(self._board, argument)

    def names(self) -> list[str]:
        return list(self._on)

    def is_on(self, name: str) -> bool:
        return name in self._on

    def number(self, name: str, otherwise: float = 0.0) -> float:
        """Return the argument of a fault that is on, ``otherwise`` while it is off."""
        argument = self._on.get(name)
        return otherwise if argument is None else float(argument)

    def take(self, name: str) -> bool:
        """Return whether the fault strikes now, and count it; it ends with its count."""
        if name not in self._on:
            return False
        argument = self._on[name]
        if argument is None:
            return True
        left = int(float(argument)) - 1
        if left > 0:
            self._on[name] = str(left)
        else:
            self.clear(name)
        return left >= 0

    def _strikes(self, name: str, row: OnReply, data: bytes) -> bool:
        if row.json_only and not _is_json(data):
            return False
        if row.takes_count:
            return self.take(name)
        argument = self._on[name] or "1"
        if argument == "once":
            self.clear(name)
            return True
        self._seen[name] += 1
        return self._seen[name] % max(1, int(float(argument))) == 0

    def on_reply(self, data: bytes) -> bytes:
        """Return the bytes of a reply as the host gets them."""
        if not self._on:
            return data
        for name, row in ON_REPLY.items():
            if name in self._on and self._strikes(name, row, data):
                data = row.change(data)
        return data

    def model_text(self, text: str) -> str:
        """Return the JSON text of M409 or M408 as the faults leave it."""
        if not self._on:
            return text
        argument = self._on.get("err_no_buffers")
        if argument is not None and argument.startswith(">"):
            if len(text) > float(argument[1:]):
                return OUT_OF_BUFFERS
        elif self.take("err_no_buffers"):
            return OUT_OF_BUFFERS
        if self.take("nesting_bomb"):
            head = text.partition('"result":')[0]
            return f'{head}"result":{"[" * NESTING}{"]" * NESTING}}}'
        if self.is_on("nan"):
            return _READING.sub(lambda match: match.group(1) + "nan", text, count=1)
        return text

    def tick(self) -> None:
        """Send what comes by the clock."""
        if self.is_on("unsolicited") and self._board.now >= self._report_at:
            self._report_at = self._board.now + max(0.05, self.number("unsolicited", 1.0))
            self._board.report_temperatures()
