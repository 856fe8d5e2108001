"""Heaters, sensors and thermostatic fans in simulated time."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from ..clock import Clock, Condition
from ..firmware import Firmware
from ..hardware.parts import ROOM
from ..model.tree import ObjectModel
from ..text.command import BareError, GCodeError
from .power import Power

CLOSE_ENOUGH = 1.4
"""Distance in °C from the target at which a wait ends (seen in firmware)."""
HEATING_STATES = ("active", "standby", "tuning")
FAULT_PWM = 0.0
STEP = 0.1
"""Shortest step of simulated time in which temperatures change."""
LOW = 40.0
"""Nobody waits for lower targets (RRF 3.5 Heat.cpp, TEMPERATURE_LOW_SO_DONT_CARE)."""
OFF_BELOW = -273.0
"""Targets at or below switch a heater off (RRF 3.5 Tool.cpp:788, NEARLY_ABS_ZERO)."""


def check_range(heater: dict[str, Any], value: float) -> None:
    """Raise the error of a temperature that this heater may not have."""
    if not float(heater["min"]) < value < float(heater["max"]):
        raise GCodeError("Requested temperature out of range")


class HeatWait:
    """A condition that heaters have come to their targets."""

    def __init__(self, condition: Condition):
        self._condition = condition

    def __call__(self) -> bool:
        return self._condition()


class Thermal:
    """Moves ``heat.heaters[].current`` towards what state and targets ask for."""

    def __init__(self, *, model: ObjectModel, power: Power, clock: Clock, firmware: Firmware):
        self._model = model
        self._firmware = firmware
        self._power = power
        self._clock = clock
        self.restart()

    def restart(self) -> None:
        self._stepped_at = self._clock.now
        self.cold_extrusion_allowed = False
        self._cancelled_waits = 0
        self.standby_tools: dict[int, int] = {}
        """Number of the tool that has put a heater to standby, by the heater's."""
        self.tuned: dict[int, float] = {}
        """Temperature at which a heater is tuned."""

    @property
    def heaters(self) -> list[dict[str, Any] | None]:
        return self._model.data.get("heat", {}).get("heaters") or []

    def heater(self, index: int) -> dict[str, Any] | None:
        """Return that heater; ``None`` where there is none."""
        return self.heaters[index] if 0 <= index < len(self.heaters) else None

    @staticmethod
    def target(heater: dict[str, Any]) -> float:
        """Return what the heater is regulated to, 0 while it is off (RRF 3.5 GCodes.cpp:4811)."""
        state = heater.get("state")
        if state in ("active", "standby"):
            return float(heater[state])
        return 0.0

    def follow(self, now: float) -> None:
        """Let temperatures go on to now, in steps that aren't too short."""
        seconds = now - self._stepped_at
        if seconds >= STEP:
            self.step(seconds)
            self._stepped_at = now

    def step(self, seconds: float) -> None:
        """Let every heater, sensor and thermostatic fan go on for that long."""
        for index, heater in enumerate(self.heaters):
            if heater is not None:
                self._heat(heater, seconds, self.tuned.get(index, 0.0))
        self._read_sensors()
        for fan in self._model.data.get("fans") or ():
            if fan is not None:
                self._blow(fan)

    def _heat(self, heater: dict[str, Any], seconds: float, tuned: float) -> None:
        current = float(heater["current"])
        if not -50.0 < current < 1000.0:
            return  # an open circuit reads 2000 °C or absolute zero and stays there
        model = heater.get("model") or {}
        heating = float(model.get("heatingRate") or 1.0)
        cooling = float(model.get("coolingRate") or 0.3) / 100
        heater_on = heater.get("state") in HEATING_STATES and self._power.is_on
        wanted = tuned if heater.get("state") == "tuning" else self.target(heater)
        target = wanted if heater_on else 0.0
        if current < target:
            full = heating - cooling * (current - ROOM)
            firmware = self._firmware
            near = (target + firmware.heats_beyond - current) / firmware.heats_within
            rate = min(full, near)
            new = min(target, current + rate * seconds)
            pwm = round(min(1.0, 1.0 - (full - rate) / heating), 3)
        else:
            floor = max(ROOM, target)
            new = max(floor, ROOM + (current - ROOM) * math.exp(-4 * cooling * seconds))
            if current < ROOM:
                new = min(ROOM, current + 0.1 * seconds)
            pwm = self._holding(target, heating, cooling) if new <= target else 0.0
        heater["current"] = new
        if "avgPwm" in heater:
            heater["avgPwm"] = pwm

    @staticmethod
    def _holding(target: float, heating: float, cooling: float) -> float:
        """Return the power that holds a temperature."""
        return round(min(1.0, max(0.0, (target - ROOM) * cooling / heating)), 3)

    def _read_sensors(self) -> None:
        sensors = self._model.data.get("sensors", {}).get("analog") or []
        for heater in self.heaters:
            if heater is None:
                continue
            index = heater.get("sensor", -1)
            if 0 <= index < len(sensors) and sensors[index] is not None:
                sensors[index]["lastReading"] = heater["current"]

    def _blow(self, fan: dict[str, Any]) -> None:
        thermostatic = fan.get("thermostatic") or {}
        watched = thermostatic.get("sensors") or thermostatic.get("heaters") or []
        wanted = float(fan.get("requestedValue") or 0.0)
        if watched:
            limit = float(thermostatic.get("lowTemperature") or 45.0)
            sensors = self._model.data["sensors"].get("analog") or []
            readings = [
                sensors[i]["lastReading"] for i in watched if i < len(sensors) and sensors[i]
            ]
            wanted = wanted if any(reading > limit for reading in readings) else 0.0
        actual = min(float(fan.get("max") or 1.0), wanted)
        fan["actualValue"] = max(float(fan.get("min") or 0.0), actual) if actual > 0 else 0.0
        if fan.get("rpm", -1) >= 0:
            fan["rpm"] = int(7200 * fan["actualValue"])

    def check_fault(self, index: int) -> None:
        """Raise the error of a heater that can't be switched on (seen in firmware)."""
        heater = self.heater(index)
        if heater is not None and heater["state"] == "fault":
            raise BareError(f"Can't turn heater {index} on while in fault state")

    def set_state(self, index: int, state: str) -> None:
        """Set a heater's state, unless it is in a fault."""
        heater = self.heater(index)
        if heater is not None and heater["state"] not in ("fault", "offline"):
            heater["state"] = state
            self.standby_tools.pop(index, None)

    def set_target(self, index: int, name: str, value: float) -> None:
        """Store an active or standby temperature; at or below -273 the heater goes off."""
        heater = self.heater(index)
        if heater is None:
            return
        if value <= OFF_BELOW:
            heater[name] = 0.0
            self.set_state(index, "off")
        else:
            heater[name] = float(value)

    def all_off(self) -> None:
        for index in range(len(self.heaters)):
            self.set_state(index, "off")

    def is_at_target(self, index: int, may_cool: bool = True) -> bool:
        """Return whether a wait for that heater is over."""
        heater = self.heater(index)
        if heater is None or heater["state"] in ("off", "fault", "offline"):
            return True
        target = self.target(heater)
        if target < LOW and heater["current"] <= 45.0:
            return True
        if not may_cool and heater["current"] >= target:
            return True
        return abs(float(heater["current"]) - target) <= CLOSE_ENOUGH

    def are_at_target(self, indexes: Iterable[int], may_cool: bool = True) -> bool:
        return all(self.is_at_target(index, may_cool) for index in indexes)

    def awaited(self, indexes: Iterable[int], may_cool: bool = True) -> Condition:
        """Return the condition that the heaters are there, or that M108 has cancelled waiting."""
        waiting, before = list(indexes), self._cancelled_waits
        return HeatWait(
            lambda: self.are_at_target(waiting, may_cool) or self._cancelled_waits != before
        )

    def cancel_waits(self) -> None:
        """End all waits that have begun."""
        self._cancelled_waits += 1

    def can_extrude(self, tool: dict[str, Any]) -> bool:
        """Return whether every heater of the tool is warm enough."""
        limit = float(self._model.data["heat"].get("coldExtrudeTemperature") or 0.0)
        if self.cold_extrusion_allowed:
            return True
        for index in tool.get("heaters") or ():
            heater = self.heater(index)
            if heater is None or heater["state"] == "fault" or heater["current"] < limit:
                return False
        return True

    def report(self) -> str:
        """Return ``T:21.3 /0.0 T0:21.3 /0.0 B:60.0 /60.0`` (RRF 3.5 GCodes.cpp:4811-4861)."""
        current = self._model.current_tool()
        found: list[str] = []
        if current is not None and current.get("heaters"):
            found.append("T:" + self._pairs(current["heaters"]))
        for tool in self._model.tools():
            if tool.get("heaters"):
                found.append(f"T{tool['number']}:" + self._pairs(tool["heaters"]))
        heat = self._model.data.get("heat") or {}
        for letter, slots in (("B", heat.get("bedHeaters")), ("C", heat.get("chamberHeaters"))):
            for slot, index in enumerate(slots or ()):
                if self.heater(index) is None:
                    break  # the list ends at the first slot without a heater
                found.append(f"{letter}{slot or ''}:" + self._pairs([index]))
        return " ".join(found)

    def _pairs(self, indexes: Iterable[int]) -> str:
        heaters = [self.heater(index) for index in indexes]
        return " ".join(
            f"{heater['current']:.1f} /{self.target(heater):.1f}"
            for heater in heaters
            if heater is not None
        )
