"""Faults that can be switched on at start or at run time, by the same names.

``name`` or ``name:argument``. Some are things real boards do (text without a line end, shortage
of buffers), some are things a serial line does to them, and some (``nesting_bomb``) nobody has
seen and a host must survive anyway.
"""

from __future__ import annotations

import re
from typing import Callable, NamedTuple

UNDER_VOLTAGE = b"Warning: VIN under-voltage event (11.0V)"
"""RRF sends this without a line end (RRF 3.5 Platform.cpp:1396-1411)."""
DEBUG_TEXT = b"Delta probe: 0.012 steps 4411 hypercuboid 0\n"
GARBAGE = b"\x17\x9c#@k2\xf0 qT:\xc1\x7f{[\x02\n"
HARMLESS_ERROR = b"Error: Pop(): stack underflow\n"
HUGE = 64 * 1024


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


class OnReply(NamedTuple):
    """What a fault makes of the bytes of one reply, and which replies it hits."""

    change: Callable[[bytes], bytes]
    layer: int
    """Where several faults are on, those of a lower layer get their hands on a reply first."""
    json_only: bool = False
    takes_count: bool = True
    """Whether the argument is the number of replies; otherwise every n-th one is hit."""


FRAMING, DAMAGE, NOISE, GLUED, ERROR = range(5)
"""Layers: the reply's own ``ok``, its bytes, lines in front of it, text glued to it, errors."""


class Fault(NamedTuple):
    """A row of :data:`FAULTS`."""

    summary: str
    default: str | None = None
    """Argument where none is given."""
    on_reply: OnReply | None = None
    """What it does to replies; what it does to the machine is an incident (:mod:`.device`)."""
    survives_reset: bool = True
    is_event: bool = False
    """Happens once; there is nothing to switch off."""
    ends_after_argument: bool = False
    """Whether the argument is the number of seconds after which it is over."""


FAULTS: dict[str, Fault] = {
    "lost_ok": Fault(
        "every n-th ok is lost (1), or :once",
        "1",
        on_reply=OnReply(_without_ok, FRAMING, takes_count=False),
    ),
    "extra_ok": Fault(
        "an ok too many after the next n replies (all)",
        on_reply=OnReply(lambda data: data + b"ok\n", FRAMING),
    ),
    "glued_before": Fault(
        "text without a line end in front of the next n replies (all)",
        on_reply=OnReply(lambda data: UNDER_VOLTAGE + data, GLUED),
    ),
    "glued_after": Fault(
        "text behind the first line of the next n replies (all)",
        on_reply=OnReply(lambda data: data.replace(b"\n", UNDER_VOLTAGE + b"\n", 1), GLUED),
    ),
    "err_no_buffers": Fault('{"err":-1} for the next n M409 (all), or above a size with :>BYTES'),
    "few_buffers": Fault("below 20 free buffers: 3.5 and later wait, older answer err -1"),
    "truncated": Fault(
        "the middle of a JSON line is its end, n times (all)",
        on_reply=OnReply(_cut, DAMAGE, json_only=True),
    ),
    "nul_bytes": Fault(
        "NUL bytes in the next n replies (all)",
        on_reply=OnReply(lambda data: _inserted(data, b"\x00\x00"), DAMAGE),
    ),
    "bad_utf8": Fault(
        "bytes that aren't UTF-8 in the next n replies (all)",
        on_reply=OnReply(lambda data: _inserted(data, b"\xff\xc3("), DAMAGE),
    ),
    "garbage": Fault(
        "a line of noise in front of the next n replies (1)",
        "1",
        on_reply=OnReply(lambda data: GARBAGE + data, NOISE),
    ),
    "huge_line": Fault(
        "a line of 64 KiB in front of the next n replies (1)",
        "1",
        on_reply=OnReply(lambda data: b"x" * HUGE + b"\n" + data, NOISE),
    ),
    "nesting_bomb": Fault("the next n M409 are answered by 20,000 nested arrays (1)", "1"),
    "nan": Fault("the first temperature in JSON is nan"),
    "exponent": Fault("numbers of M409 in exponential form"),
    "no_reply": Fault("the next n M409 get neither JSON nor ok (all)"),
    "slow": Fault("every reply comes s seconds late (2)", "2"),
    "stall": Fault(
        "USB takes and sends nothing, for s seconds (until cleared)", ends_after_argument=True
    ),
    "reset": Fault("the board restarts after s seconds (0), the port stays", "0", is_event=True),
    "disconnect": Fault("the port vanishes for s seconds (2)", "2", is_event=True),
    "heater_fault": Fault("heater n is in a fault (1)", "1", survives_reset=False),
    "filament_error": Fault("filament monitor n reports (0)", "0", survives_reset=False),
    "driver_error": Fault("driver n of the mainboard reports (0)", "0", survives_reset=False),
    "vin_off": Fault("no motor supply, status off"),
    "halted": Fault("as after M112", survives_reset=False),
    "message_box": Fault("a macro opens a message box of mode n (2)", "2", survives_reset=False),
    "debug_text": Fault(
        "debug lines in the middle of the next n replies (all)",
        on_reply=OnReply(
            lambda data: _inserted(data, DEBUG_TEXT, 0 if len(data) < 80 else None), DAMAGE
        ),
    ),
    "unsolicited": Fault("a temperature line every s seconds that nobody asked for (1)", "1"),
    "error_reply": Fault(
        "a harmless Error: line in front of every n-th reply (5)",
        "5",
        on_reply=OnReply(lambda data: HARMLESS_ERROR + data, ERROR, takes_count=False),
    ),
    "sbc": Fault("a single-board computer answers network and volumes"),
    "baud": Fault("output at the speed of a line with n baud (115200)", "115200"),
    "unread": Fault("replies that the host doesn't fetch for s seconds are lost for good (2)", "2"),
    "net_loss": Fault(
        "nothing gets through the network, for s seconds (until cleared)", ends_after_argument=True
    ),
    "net_refused": Fault(
        "the board takes no connection, for s seconds (until cleared)", ends_after_argument=True
    ),
    "net_busy": Fault(
        "no responder is free: connections are reset after 2 s, for s seconds (until cleared)",
        ends_after_argument=True,
    ),
    "net_slow": Fault("every answer over the network comes s seconds late (2)", "2"),
    "net_503": Fault("the next n requests are answered by 503 (all)"),
    "net_reset": Fault("the connection is reset in the middle of the next n answers (1)", "1"),
    "net_cut": Fault("the next n answers end in the middle, in an orderly way (1)", "1"),
    "net_lost_answer": Fault("the next n requests are carried out and not answered (1)", "1"),
    "net_lost_command": Fault("the next n commands are carried out and not answered (1)", "1"),
    "net_foreign": Fault("the next n answers are somebody else's page (all)"),
    "net_redirect": Fault("the next n answers lead to another place (all)"),
    "net_garbled": Fault("the middle of the next n JSON answers is lost (1)", "1"),
    "net_corrupt": Fault("a byte of the next n uploads is changed on its way (1)", "1"),
    "net_full": Fault("all sessions are taken by others"),
    "net_stale_key": Fault("the board forgets its sessions", is_event=True),
    "net_sbc_down": Fault(
        "SBC: its control server is down, for s seconds (until cleared)", ends_after_argument=True
    ),
    "net_sbc_version": Fault(
        "SBC: its servers are of different versions, for s seconds (until cleared)",
        ends_after_argument=True,
    ),
    "usb_box_stuck": Fault("a blocking M291 from USB stops that channel for good (3.5 and 3.6.0)"),
}
"""Name → fault, in the order of ``--list``."""


def _on_reply() -> dict[str, OnReply]:
    rows = [(name, fault.on_reply) for name, fault in FAULTS.items() if fault.on_reply is not None]
    return dict(sorted(rows, key=lambda row: row[1].layer))


ON_REPLY = _on_reply()
"""Fault → what happens to a reply, applied in this order."""


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
