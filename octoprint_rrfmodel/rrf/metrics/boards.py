"""Metrics of boards, volumes and network interfaces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..views.board_warnings import DRIVER_ERRORS, OPEN_LOAD, OVER_TEMPERATURE_WARNING
from ..views.machine import array
from ..views.state_words import BOARDS
from .metric import GAUGE, Metric, Model, Sample, Sources, at, each, indexed, infos, reading, states

DRIVER_CONDITIONS = (
    ("error", DRIVER_ERRORS),
    ("over_temperature_warning", OVER_TEMPERATURE_WARNING),
    ("open_load", OPEN_LOAD),
    ("stall", 1 << 8),
)
"""What bits of ``boards[].drivers[].status`` say (Duet3D CANlib, StandardDriverStatus)."""

_volumes = indexed("volumes")
_interfaces = indexed("network.interfaces")


def _boards(model: Model) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for place, board in indexed("boards")(model):
        address = board.get("canAddress")
        yield str(address) if type(address) is int else place, board


def _driver_conditions(sources: Sources) -> Iterator[Sample]:
    for label, board in _boards(sources.model):
        drivers = [at(driver, "status") for driver in array(board.get("drivers"))]
        known = [status for status in drivers if type(status) is int]
        if known:
            for condition, bits in DRIVER_CONDITIONS:
                yield (label, condition), sum(1 for status in known if status & bits)


def _signals(sources: Sources) -> Iterator[Sample]:
    for index, interface in _interfaces(sources.model):
        rssi = interface.get("rssi")
        yield (index,), interface.get("signal") if rssi is None else rssi


METRICS = (
    Metric(
        "rrf_board_info",
        GAUGE,
        "A board and its firmware.",
        ("board", "name", "short_name", "firmware_name", "firmware_version", "firmware_date"),
        infos(_boards, "name", "shortName", "firmwareName", "firmwareVersion", "firmwareDate"),
    ),
    Metric(
        "rrf_board_state",
        GAUGE,
        "State of a board on the CAN bus: 1 for the word that holds.",
        ("board", "state"),
        states(_boards, BOARDS, "state"),
    ),
    Metric(
        "rrf_board_mcu_temperature_celsius",
        GAUGE,
        "Temperature of a board's processor.",
        ("board",),
        each(_boards, "mcuTemp.current", reading),
    ),
    Metric(
        "rrf_board_vin_volts",
        GAUGE,
        "Supply voltage of a board.",
        ("board",),
        each(_boards, "vIn.current"),
    ),
    Metric(
        "rrf_board_vin_min_volts",
        GAUGE,
        "Lowest supply voltage since the board's reset.",
        ("board",),
        each(_boards, "vIn.min"),
    ),
    Metric(
        "rrf_board_vin_max_volts",
        GAUGE,
        "Highest supply voltage since the board's reset.",
        ("board",),
        each(_boards, "vIn.max"),
    ),
    Metric(
        "rrf_board_v12_volts",
        GAUGE,
        "Voltage of a board's 12 V rail.",
        ("board",),
        each(_boards, "v12.current"),
    ),
    Metric(
        "rrf_board_free_memory_bytes",
        GAUGE,
        "Free memory of a board.",
        ("board",),
        each(_boards, "freeRam"),
    ),
    Metric(
        "rrf_board_drivers",
        GAUGE,
        "Motor drivers of a board that report a condition.",
        ("board", "condition"),
        _driver_conditions,
    ),
    Metric(
        "rrf_volume_info", GAUGE, "Path of a volume.", ("volume", "path"), infos(_volumes, "path")
    ),
    Metric(
        "rrf_volume_mounted",
        GAUGE,
        "Whether a volume is mounted.",
        ("volume",),
        each(_volumes, "mounted"),
    ),
    Metric(
        "rrf_volume_size_bytes",
        GAUGE,
        "Capacity of a volume.",
        ("volume",),
        each(_volumes, "capacity"),
    ),
    Metric(
        "rrf_volume_free_bytes",
        GAUGE,
        "Free space of a volume.",
        ("volume",),
        each(_volumes, "freeSpace"),
    ),
    Metric(
        "rrf_network_info",
        GAUGE,
        "Type of a network interface.",
        ("interface", "type"),
        infos(_interfaces, "type"),
    ),
    Metric(
        "rrf_network_signal_dbm",
        GAUGE,
        "Wi-Fi signal of a network interface.",
        ("interface",),
        _signals,
    ),
)
