"""M122: how the board is, in the parts that every board tells of (seen in firmware)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...clock import Clock
from ...firmware import Firmware
from ...hardware.boards import Mainboard
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...model.tree import ObjectModel
from ...text.command import Command
from ...text.serial_line import Kind, Reply

HEATER_SLOTS = 4
"""Beds and chambers that are told, whether there are that many or not."""

_HEAD = """\
=== Diagnostics ===
{name} version {version} ({date}) running on {electronics}
Board ID: {unique_id}
Used output buffers: 1 of {buffers} (17 max)
=== RTOS ===
Never used RAM 118392, free system stack 204 words
=== Platform ===
Last reset {up_time} ago, cause: power up
Last software reset details not available
Error status: 0x00
{converters}\
Supply voltage: min 23.9, current {voltage:.1f}, max 24.3, under voltage events: 0, \
over voltage events: 0, power good: yes
Heap OK, handles allocated/used 99/9, heap memory allocated/used/recyclable 2048/116/0, gc cycles 0
Events: 0 queued, 0 completed
{platform_drivers}\
Date/time: {date_time}
Slowest loop: 3.21ms; fastest: 0.06ms
=== Storage ===
Free file entries: 20
SD card 0 detected
SD card longest read time 2.1ms, write time 0.0ms, max retries 0
=== Move ===
"""

_MOVE_35 = """\
DMs created 83, segments created 0, maxWait 0ms, bed compensation in use: {compensation}, \
height map offset 0.000, max steps late 0, min interval 0, bad calcs 0, ebfmin 0.00, ebfmax 0.00
no step interrupt scheduled
Moves shaped first try 0, on retry 0, too short 0, wrong shape 0, maybepossible 0
=== DDARing 0 ===
Scheduled moves 0, completed 0, hiccups 0, stepErrors 0, LaErrors 0, Underruns [0, 0, 0], \
CDDA state -1
=== DDARing 1 ===
Scheduled moves 0, completed 0, hiccups 0, stepErrors 0, LaErrors 0, Underruns [0, 0, 0], \
CDDA state -1
"""

_MOVE_36 = """\
Segments created 0, maxWait 0ms, bed comp in use: {compensation}, height map offset 0.000, \
hiccups added 0 (0.00ms), max steps late 0, ebfmin 0.00, ebfmax 0.00
Pos req/act/dcf:{positions}
no step interrupt scheduled
{drivers}\
=== DDARing 0 ===
Scheduled moves 0, completed 0, LaErrors 0, Underruns [0, 0, 0]
=== DDARing 1 ===
Scheduled moves 0, completed 0, LaErrors 0, Underruns [0, 0, 0]
"""

_HEAT = """\
=== Heat ===
Bed heaters {beds}, chamber heaters {chambers}, ordering errs 0
=== GCodes ===
Movement locks held by null, null
"""

_QUEUES = """\
Q0 segments left 0, axes/extruders owned 0x0000000
Code queue 0 is empty
Q1 segments left 0, axes/extruders owned 0x0000000
Code queue 1 is empty
"""

CONVERTERS = "MCU revision 3, ADC conversions started 0, completed 0, timed out 0, errs 0\n"
"""Told up to 3.5."""


class Diagnostics:
    """Tells the state of the board."""

    def __init__(
        self, *, model: ObjectModel, clock: Clock, firmware: Firmware, mainboard: Mainboard
    ):
        self._model = model
        self._clock = clock
        self._firmware = firmware
        self._mainboard = mainboard

    def rows(self) -> Rows:
        return {"M122": Row(self._diagnostics)}

    def _diagnostics(self, channel: Channel, command: Command) -> Outcome:
        """M122: many lines; another part than 1 that isn't there says nothing."""
        if (command.integer("P", 0) or 0) > 1:
            return None
        move = _MOVE_36 if self._firmware.at_least(3, 6) else _MOVE_35
        text = (_HEAD + move + _HEAT).format_map(self._values())
        text += "".join(f"{line}\n" for line in self._inputs(channel))
        text += _QUEUES + "".join(f"{line}\n" for line in self._filament_sensors())
        return Reply(text.rstrip("\n"), Kind.LONG)

    def _values(self) -> dict[str, Any]:
        firmware, mainboard, model = self._firmware, self._mainboard, self._model.data
        minutes, seconds = divmod(int(self._clock.up_time), 60)
        hours, minutes = divmod(minutes, 60)
        board = model["boards"][0] if model.get("boards") else {}
        count = len(board.get("drivers") or ())
        drivers = "".join(f"Driver {index}: ok\n" for index in range(count))
        is_new = firmware.at_least(3, 6)
        heat = model["heat"]
        return {
            "name": mainboard.firmware_name,
            "version": firmware.version,
            "date": firmware.date + firmware.time,
            "electronics": mainboard.electronics,
            "unique_id": mainboard.unique_id,
            "buffers": mainboard.buffers(firmware),
            "up_time": f"{hours:02d}:{minutes:02d}:{seconds:02d}",
            "converters": "" if is_new else CONVERTERS,
            "voltage": (board.get("vIn") or {}).get("current") or 0.0,
            "platform_drivers": "" if is_new else drivers,
            "date_time": self._clock.date_time().replace("T", " "),
            "compensation": model["move"]["compensation"]["type"],
            "positions": " 0.00/0/0.00" * len(model["move"]["axes"]),
            "drivers": drivers,
            "beds": _slots(heat.get("bedHeaters")),
            "chambers": _slots(heat.get("chamberHeaters")),
        }

    def _inputs(self, channel: Channel) -> Iterator[str]:
        for gcode_input in self._model.data["inputs"]:
            if gcode_input is not None:
                name, state = gcode_input["name"], gcode_input["state"]
                doing = 'ready with "M122"' if name == channel.name else state
                yield f"{name} is {doing} in state(s) 0"

    def _filament_sensors(self) -> Iterator[str]:
        monitors = self._model.data["sensors"].get("filamentMonitors")
        if monitors:
            yield "=== Filament sensors ==="
            yield "check 0 clear 6951"
        for index, monitor in enumerate(monitors or ()):
            if monitor is not None:
                is_there = monitor.get("status", "ok") == "ok"
                yield f"Extruder {index} sensor: {'ok' if is_there else 'no filament'}"


def _slots(heaters: list[int] | None) -> str:
    told = [*(heaters or ()), *[-1] * HEATER_SLOTS][:HEATER_SLOTS]
    return " ".join(str(heater) for heater in told)
