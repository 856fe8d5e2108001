"""Things that happen to a machine: heater, filament and driver faults, boxes."""

from __future__ import annotations

from typing import Any

from ..firmware import Firmware
from ..line.switches import Incident
from ..model.tree import ObjectModel
from .boxes import MessageBoxes
from .events import Events
from .job import Job
from .thermal import Thermal

OVER_TEMPERATURE = 0x02
"""Bit of ``boards[].drivers[].status``."""
ALWAYS = 2
"""``enableMode`` of a filament monitor that looks whoever prints (M591 S2)."""
FILAMENT_ERRORS = {"simple": "noFilament"}
"""Type of a filament monitor → what it reports, where that isn't ``tooLittleMovement``."""
BOX_TITLE = "Simulated"
BOX_MESSAGE = "Is the simulated bed clear?"


def _index(argument: str | None) -> int:
    return int(float(argument or 0))


class HeaterFault:
    """A heater of the machine that the firmware gives up on."""

    def __init__(self, thermal: Thermal, events: Events):
        self._thermal = thermal
        self._events = events

    def incidents(self) -> dict[str, Incident]:
        return {"heater_fault": Incident(self._start, self._stop)}

    def _start(self, argument: str | None) -> None:
        index = _index(argument)
        heater = self._thermal.heater(index)
        if heater is None:
            return
        target = self._thermal.target(heater)
        heater["state"] = "fault"
        excursion = float(heater.get("maxTempExcursion") or 15.0)
        self._events.announce(
            f"Heater {index} fault: temperature excursion exceeded {excursion:.1f}°C "
            f"(target {target:.1f}°C, sensor {heater['current']:.1f}°C)",
        )

    def _stop(self) -> None:
        for heater in self._thermal.heaters:
            if heater is not None and heater["state"] == "fault":
                heater["state"] = "off"


class DriveFaults:
    """What goes wrong with motors and filament."""

    def __init__(self, model: ObjectModel, job: Job, events: Events):
        self._model = model
        self._job = job
        self._events = events

    def incidents(self) -> dict[str, Incident]:
        return {
            "filament_error": Incident(self._filament_error, self._filament_back),
            "driver_error": Incident(self._driver_error, self._driver_well),
        }

    def _monitors(self) -> list[Any]:
        return self._model.data["sensors"].get("filamentMonitors") or []

    def _filament_error(self, argument: str | None) -> None:
        """With M591 S1 this is only in the model unless the board itself prints."""
        index = _index(argument)
        monitors = self._monitors()
        monitor = (monitors[index] if index < len(monitors) else None) or {}
        status = FILAMENT_ERRORS.get(monitor.get("type", ""), "tooLittleMovement")
        if "status" in monitor:
            monitor["status"] = status
        if self._job.is_printing or monitor.get("enableMode") == ALWAYS:
            text = f"Filament error on extruder {index}: {status}"
            self._events.announce(text, opens_box=False)

    def _filament_back(self) -> None:
        for monitor in self._monitors():
            if monitor is not None and "status" in monitor:
                monitor["status"] = "ok"

    def _drivers(self) -> list[dict[str, Any]]:
        return self._model.data["boards"][0].get("drivers") or []

    def _driver_error(self, argument: str | None) -> None:
        index = _index(argument)
        drivers = self._drivers()
        if index < len(drivers):
            drivers[index]["status"] |= OVER_TEMPERATURE
        self._events.announce(f"Driver {index} error: over temperature shutdown", opens_box=False)

    def _driver_well(self) -> None:
        for driver in self._drivers():
            driver["status"] &= ~OVER_TEMPERATURE


class UnaskedBox:
    """A message box that nobody at the host has asked for."""

    def __init__(self, firmware: Firmware, boxes: MessageBoxes):
        self._firmware = firmware
        self._boxes = boxes

    def incidents(self) -> dict[str, Incident]:
        return {"message_box": Incident(self._open, self._boxes.close_all)}

    def _open(self, argument: str | None) -> None:
        mode = min(_index(argument), self._firmware.box_modes)
        self._boxes.open(BOX_MESSAGE, BOX_TITLE, mode, timeout=0.0 if mode > 1 else 30.0)
