"""Things that happen to a machine: heater, filament and driver faults, lost power, boxes.

Texts: RRF 3.4 and later go through the event system (``- Event notification -``), 3.3 prints an
error (RRF 3.3 LocalHeater.cpp:743); only a print from the card is paused (RRF 3.5
GCodes3.cpp:1520-1573).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..core import Core

OVER_TEMPERATURE = 0x02
"""Bit of ``boards[].drivers[].status``."""
ALERT_MODE = 1
BOX_TITLE = "Simulated"
BOX_MESSAGE = "Is the simulated bed clear?"


def _event(board: Core, text: str, pauses: bool = True, opens_box: bool = True) -> None:
    """Announce a fault as that firmware does, and pause a print from the card."""
    prints = board.job.is_printing and pauses
    if not board.firmware.has_events:
        board.message(f"Error: {text}\n")
    else:
        title = "Printing paused" if prints else "Event notification"
        board.message(f"- {title} -\n{text}\n")
        if opens_box:
            board.boxes.open(text, title, ALERT_MODE, timeout=0.0)
    if prints:
        board.job.pause_for_fault()


def _index(argument: str | None) -> int:
    return int(float(argument or 0))


def heater_fault(board: Core, argument: str | None) -> None:
    index = _index(argument)
    heater = board.thermal.heater(index)
    if heater is None:
        return
    target = board.thermal.target(heater)
    heater["state"] = "fault"
    excursion = float(heater.get("maxTempExcursion") or 15.0)
    _event(
        board,
        f"Heater {index} fault: temperature excursion exceeded {excursion:.1f}°C "
        f"(target {target:.1f}°C, sensor {heater['current']:.1f}°C)",
    )


def end_heater_faults(board: Core) -> None:
    for heater in board.thermal.heaters:
        if heater is not None and heater["state"] == "fault":
            heater["state"] = "off"


def _monitors(board: Core) -> list[Any]:
    return board.data["sensors"].get("filamentMonitors") or []


def filament_error(board: Core, argument: str | None) -> None:
    """With M591 S1 this is only in the model unless the board itself prints."""
    index = _index(argument)
    monitors = _monitors(board)
    if index < len(monitors) and monitors[index] is not None and "status" in monitors[index]:
        monitors[index]["status"] = "tooLittleMovement"
    if board.job.is_printing:
        _event(board, f"Filament error on extruder {index}: tooLittleMovement", opens_box=False)


def filament_back(board: Core) -> None:
    for monitor in _monitors(board):
        if monitor is not None and "status" in monitor:
            monitor["status"] = "ok"


def driver_error(board: Core, argument: str | None) -> None:
    index = _index(argument)
    drivers = board.data["boards"][0].get("drivers") or []
    if index < len(drivers):
        drivers[index]["status"] |= OVER_TEMPERATURE
    _event(board, f"Driver {index} error: over temperature shutdown", opens_box=False)


def driver_well(board: Core) -> None:
    for driver in board.data["boards"][0].get("drivers") or []:
        driver["status"] &= ~OVER_TEMPERATURE


def power_lost(board: Core, argument: str | None) -> None:
    board.has_power = False
    board.data["boards"][0]["vIn"]["current"] = 0.2
    board.motors_lost()


def power_back(board: Core) -> None:
    board.has_power = True
    board.data["boards"][0]["vIn"]["current"] = 24.1


def halt(board: Core, argument: str | None) -> None:
    board.halt()


def end_halt(board: Core) -> None:
    board.is_halted = False


def open_box(board: Core, argument: str | None) -> None:
    mode = min(_index(argument), board.firmware.box_modes)
    board.boxes.open(BOX_MESSAGE, BOX_TITLE, mode, timeout=0.0 if mode > 1 else 30.0)


def close_box(board: Core) -> None:
    board.boxes.close_all()
