"""The values that the types of M408 have in common, and how M408 prints numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from ...clock import Clock
from ...device.job import Job
from ...device.motion import Motion
from ...device.thermal import Thermal
from ...firmware import Firmware
from ...hardware.boards import Mainboard
from ...model.tree import ObjectModel

LETTERS = {
    "starting": "C",
    "updating": "F",
    "halted": "H",
    "off": "O",
    "pausing": "D",
    "resuming": "R",
    "paused": "S",
    "cancelling": "A",
    "simulating": "M",
    "processing": "P",
    "changingTool": "T",
    "busy": "B",
    "idle": "I",
}
"""Status → letter, in the order of precedence (RRF 3.5 RepRap.cpp:2391)."""

OLD_LETTERS = {"S": "A", "H": "S"}
"""What S0 and S1 make of a letter: paused is A, halted is S."""

HEATER_STATES = ("off", "standby", "active", "fault", "tuning", "offline")
"""Number → state."""


def number(value: Any, decimals: int) -> str:
    value = float(value or 0.0)
    return f"{value:.{decimals}f}" if math.isfinite(value) else "nan"


def number_list(values: Sequence[Any], decimals: int) -> str:
    return "[" + ",".join(number(value, decimals) for value in values) + "]"


def int_list(values: Sequence[Any]) -> str:
    return "[" + ",".join(str(int(value)) for value in values) + "]"


def heater_number(state: Any) -> int:
    return HEATER_STATES.index(state) if state in HEATER_STATES else 0


class Names(NamedTuple):
    """What board and firmware call themselves."""

    firmware: Firmware
    """Version and date."""
    mainboard: Mainboard
    """Names of the electronics."""


class Values:
    """The values that the status types have in common, as they are at the moment."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        motion: Motion,
        thermal: Thermal,
        job: Job,
        clock: Clock,
        names: Names,
    ):
        self.model = model.data
        self.thermal = thermal
        self.job = job
        self.up_time = clock.up_time
        self.firmware, self.mainboard = names
        self.axes = motion.axes
        self.extruders = motion.extruders
        self.heat = self.model["heat"]
        self.state = self.model["state"]
        self.fans = [fan for fan in self.model.get("fans") or () if fan is not None]
        self.tools = [tool for tool in self.model.get("tools") or () if tool is not None]

    @property
    def has_model(self) -> bool:
        """Whether the firmware has an object model."""
        return self.firmware.has_model

    @property
    def factor_decimals(self) -> int:
        """Decimals of factors in percent (2 in a reply of 3.0, 1 seen in firmware 3.5)."""
        return 1 if self.firmware.at_least(3, 5) else 2

    @property
    def letter(self) -> str:
        return LETTERS.get(self.state["status"], "I")

    @property
    def bed(self) -> int:
        slots = self.heat.get("bedHeaters") or [-1]
        return slots[0] if slots else -1

    def heater_order(self) -> list[dict[str, Any]]:
        """Return the heaters with the bed first, as S0 and S1 list them."""
        bed = self.thermal.heater(self.bed)
        others = [h for h in self.thermal.heaters if h is not None and h is not bed]
        return ([bed] if bed is not None else []) + others

    def probe(self) -> int:
        probes = self.model["sensors"].get("probes") or []
        return int((probes[0].get("value") or [0])[0]) if probes and probes[0] else 1000

    @property
    def babystep(self) -> float:
        return float(self.axes[2]["babystep"]) if len(self.axes) > 2 else 0.0

    @property
    def geometry(self) -> str:
        return str((self.model["move"].get("kinematics") or {}).get("name") or "unknown")

    def machine(self) -> list[float]:
        return [axis["machinePosition"] for axis in self.axes]

    def user(self) -> list[float]:
        return [axis["userPosition"] for axis in self.axes]

    def homed(self) -> list[bool]:
        return [bool(axis["homed"]) for axis in self.axes]

    def fraction(self) -> float:
        return self.job.fraction_printed()

    def axis_names(self) -> str:
        return "".join(axis["letter"] for axis in self.axes)

    def visible(self) -> int:
        return sum(1 for axis in self.axes if axis.get("visible", True))
