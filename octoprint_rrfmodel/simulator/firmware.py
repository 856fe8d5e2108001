"""What differs between RepRapFirmware versions on the serial line, as data."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any


class UnknownFirmware(ValueError):
    """The version asked for isn't in :data:`VERSIONS`; the text names those that are."""


Release = tuple[int, ...]
"""The numbers of a version, as far as they matter."""


def is_within(release: Release, since: Release | None, until: Release | None) -> bool:
    """Return whether a release is one of those from ``since`` on and before ``until``."""
    return (since is None or release >= since) and (until is None or release < until)


@dataclass(frozen=True)
class Firmware:
    """One firmware version. Every field is a difference some host can observe.

    The defaults are those of the newest; an older one is written as what differs from the next.
    """

    version: str
    """As ``M115`` and ``boards[0].firmwareVersion`` spell it."""
    release: tuple[int, ...]
    """For comparisons with the versions of the object model's members."""
    date: str
    time: str = ""
    """Appended to the date in ``M115`` only."""
    m115_date_twice: bool = False
    """RRF 3.3 GCodes2.cpp:1659 prints FIRMWARE_DATE a second time."""
    has_model: bool = True
    """M409 exists (3.1 and later)."""
    has_m568: bool = True
    """M568 sets temperatures (3.3 and later), before only G10 does."""
    line_length: int = 256
    """Input line buffer including the terminating NUL (201 in 3.3)."""
    has_crc: bool = True
    """Five digits after ``*`` are a CRC16 (3.4 StringParser.cpp:284), before always XOR."""
    report_interval: float = 2.0
    """Seconds between temperature lines while USB is blocked."""
    report_follows_request: bool = True
    """3.5.2 and later: only after M105 does the report go to USB (3.5 GCodes.cpp:4865)."""
    waits_for_buffers: bool = True
    """3.5 and later retry M409 silently below 20 free buffers."""
    duet2_buffers: int = 26
    """Output buffers of a Duet 2 (24 in 3.3)."""
    has_important_flag: bool = True
    """Flag ``i`` (3.4 and later)."""
    axes_limit: int | None = 9
    """``move.axes`` elements without ``f`` or ``a`` (3.5 Move.cpp:69)."""
    leaf_ends_key: bool = False
    """Up to 3.4 whatever follows a number, text or boolean in the key is ignored."""
    error_column: bool = True
    """3.5 and later put the column in front of a syntax error (GCodeException.cpp:60)."""
    move_error_names_next: bool = True
    """3.5 and later name the next command of the line where a move fails, before ``G0/G1``."""
    has_events: bool = True
    """3.4 and later print faults through the event system."""
    has_cancelling: bool = True
    """Status ``cancelling`` (3.4 and later)."""
    box_modes: int = 7
    """Highest M291 mode; 4 to 7 came with 3.5."""
    usb_box_opens: bool = True
    """Whether M291 from USB makes a box in the model that M292 from USB can close (#1141)."""
    exponent: bool = False
    """Whether numbers may come in exponential form. No version read does it."""
    names_line: bool = True
    """3.6.2 and later put ``"line":n`` into JSON replies to numbered commands (RRF #1178)."""
    looks_at_usb: bool = True
    """3.6.3 and later act on M112, M108 and a bare M122 before they are queued."""
    api_level: int = 2
    """``apiLevel`` of rr_connect; 0 is none. From 2 on sessions have keys (3.5)."""
    tells_full_input: bool = True
    """3.4.5 and later answer an rr_gcode that doesn't fit with ``err``, before it is just lost."""
    fills_queue_at_once: bool = False
    """Up to 3.5 a move that begins makes room for the next at once (3.6 Move.cpp, MoveLoop)."""
    heats_beyond: float = 5.0
    """Degrees behind the target that a heater aims at when it comes near (seen in firmware)."""
    heats_within: float = 5.6
    """Seconds in which it nears them (seen in firmware: 3.5 is much slower)."""
    has_duet2: bool = True
    """Whether it runs on a Duet 2 (not 3.7 and later)."""
    needs_duet2: bool = False
    """Whether only a Duet 2 runs it."""

    def at_least(self, *release: int) -> bool:
        return self.release >= release


# the dates of 3.6.1 and later stand for those of real builds
_CHANGES: tuple[tuple[str, str, str, dict[str, Any]], ...] = (
    ("3.7", "3.7.0", "2026-10-05 10:00:00", {"has_duet2": False}),
    ("3.6.4", "3.6.4", "2026-07-20 10:00:00", {"has_duet2": True}),
    ("3.6.3", "3.6.3", "2026-04-13 10:00:00", {}),
    ("3.6.2", "3.6.2", "2025-12-08 10:00:00", {"looks_at_usb": False}),
    ("3.6.1", "3.6.1", "2025-09-08 10:00:00", {"names_line": False}),
    ("3.6", "3.6.0", "2025-04-24 11:38:13", {"usb_box_opens": False}),
    (
        "3.5.3",
        "3.5.3",
        "2024-10-01 14:21:40",
        {"fills_queue_at_once": True, "heats_beyond": 10.0, "heats_within": 13.3},
    ),
    (
        "3.5.1",
        "3.5.1",
        "2024-04-19 14:30:54",
        {"report_interval": 1.0, "report_follows_request": False},
    ),
    (
        "3.4",
        "3.4.6",
        "2023-07-21 14:08:28",
        {
            "waits_for_buffers": False,
            "api_level": 1,
            "axes_limit": None,
            "leaf_ends_key": True,
            "error_column": False,
            "move_error_names_next": False,
            "box_modes": 3,
            "usb_box_opens": True,
        },
    ),
    (
        "3.3",
        "3.3",
        "2021-06-15 21:46:11",
        {
            "m115_date_twice": True,
            "tells_full_input": False,
            "line_length": 201,
            "has_crc": False,
            "duet2_buffers": 24,
            "has_important_flag": False,
            "has_events": False,
            "has_cancelling": False,
        },
    ),
    (
        "2.05",
        "2.05.1",
        "2020-02-09b1",
        {
            "m115_date_twice": False,
            "has_model": False,
            "api_level": 0,
            "has_m568": False,
            "needs_duet2": True,
        },
    ),
)
"""Name, version, build, and what differs from the row above, the next newer one."""


def _release(version: str) -> tuple[int, ...]:
    numbers = [int(number) for number in version.split(".")]
    return tuple([*numbers, 0, 0][:3])


def _versions() -> dict[str, Firmware]:
    found: dict[str, Firmware] = {}
    newer = Firmware("", (), "")
    for name, version, build, changes in _CHANGES:
        date, blank, time = build.partition(" ")
        newer = replace(
            newer,
            version=version,
            release=_release(version),
            date=date,
            time=blank + time,
            **changes,
        )
        found[name] = newer
    return dict(reversed(list(found.items())))


VERSIONS = _versions()
"""The versions that can be asked for by name, the oldest first."""

ALIASES = {
    "2.05.1": "2.05",
    "3.3.0": "3.3",
    "3.4.0": "3.4",
    "3.4.6": "3.4",
    "3.5": "3.5.3",
    "3.6.0": "3.6",
    "3.7.0": "3.7",
}


def firmware_called(version: str) -> Firmware:
    """Return the firmware of that version; :class:`UnknownFirmware` names the known ones."""
    try:
        return VERSIONS[ALIASES.get(version, version)]
    except KeyError:
        known = ", ".join(VERSIONS)
        raise UnknownFirmware(f"unknown firmware {version!r}, known are {known}") from None
