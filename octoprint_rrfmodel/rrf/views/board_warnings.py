"""View: what the boards of a machine tell of themselves that a person has to know."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Callable, NamedTuple

from .machine import array, mapping

Model = Mapping[str, Any]

DRIVER_ERRORS = 0b0100_1010_0011_1110
"""Bits of ``boards[].drivers[].status`` that are errors: 1 over temperature, 2 and 3 short to
ground, 4 and 5 short to supply, 9 an external driver's, 11 position not maintained, 14 move
without tuning; Duet3D CANlib, ``StandardDriverStatus::ErrorMask``. Over-temperature warning, open
load, stall and standstill are none."""

OVER_TEMPERATURE_WARNING = 1 << 0
OPEN_LOAD = 1 << 6 | 1 << 7
STANDSTILL = 1 << 16 | 1 << 17
"""The motor stands, or there is no driver: what it says of the load then is noise."""

LEAST_VOLTAGE = 10.0
"""Volts at which the firmware begins to use the drivers (3.5 Platform.cpp,
``driverPowerOnAdcReading``); half a volt less and it calls them unusable."""

HOTTEST_PROCESSOR = 85.0
"""°C up to which the processors are specified (Microchip SAM E70, SAM E54 and SAM C21, industrial
grade). The firmware has no limit of its own; boards in an 85 °C chamber don't last."""


class Found(NamedTuple):
    """One thing that is so."""

    numbers: tuple[int, ...] = ()
    texts: tuple[tuple[str, str], ...] = ()


def _boards(model: Model) -> Iterator[tuple[int, Mapping[str, Any]]]:
    """Yield each board by its CAN address, where it has none by its place."""
    for place, board in enumerate(map(mapping, array(model.get("boards")))):
        address = board.get("canAddress")
        yield (address if type(address) is int else place), board


def _drivers(is_so: Callable[[int], bool]) -> Callable[[Model], Iterator[Found]]:
    def find(model: Model) -> Iterator[Found]:
        for address, board in _boards(model):
            for number, driver in enumerate(array(board.get("drivers"))):
                status = mapping(driver).get("status")
                if type(status) is int and is_so(status):
                    yield Found((address, number))

    return find


driver_errors = _drivers(lambda status: bool(status & DRIVER_ERRORS))
hot_drivers = _drivers(lambda status: bool(status & OVER_TEMPERATURE_WARNING))
open_loads = _drivers(lambda status: bool(status & OPEN_LOAD) and not status & STANDSTILL)


def differing_versions(model: Model) -> Iterator[Found]:
    """Yield each board whose firmware isn't the main board's; builds of a version don't count."""
    boards = list(_boards(model))
    main = _version(boards[0][1]) if boards else ""
    for address, board in boards[1:]:
        version = _version(board)
        if main and version and version != main:
            yield Found((address,), (("version", version), ("main", main)))


def _version(board: Mapping[str, Any]) -> str:
    version = board.get("firmwareVersion")
    words = version.split("+")[0].split() if isinstance(version, str) else []
    return words[0] if words else ""


def low_supplies(model: Model) -> Iterator[Found]:
    """Yield each board whose motor supply was there and has gone down.

    One that never had any is powered by USB, and for the main board the status says it.
    """
    is_off = mapping(model.get("state")).get("status") == "off"
    for place, (address, board) in enumerate(_boards(model)):
        supply = mapping(board.get("vIn"))
        has_had_any = _number(supply.get("max"), 0.0) >= LEAST_VOLTAGE
        is_low = _number(supply.get("current"), LEAST_VOLTAGE) < LEAST_VOLTAGE
        if has_had_any and is_low and (place or not is_off):
            yield Found((address,))


def hot_processors(model: Model) -> Iterator[Found]:
    """Yield each board whose processor is hotter than it is made for."""
    for address, board in _boards(model):
        now = _number(mapping(board.get("mcuTemp")).get("current"), 0.0)
        if now > HOTTEST_PROCESSOR:
            yield Found((address,))


def _number(value: Any, otherwise: float) -> float:
    return float(value) if type(value) in (int, float) else otherwise
