"""The machines that can be simulated, and the full object model of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Callable

from .firmware import Firmware
from .hardware import parts
from .hardware.boards import DUET2_WIFI, MB6HC, MB6XD, MINI5PLUS, Mainboard
from .hardware.kinematics import cartesian, core_xy, linear_delta


class UnknownMachine(ValueError):
    """The machine asked for isn't in :data:`MACHINES`; the text names those that are."""


def _none() -> list[Any]:
    return []


@dataclass(frozen=True)
class Machine:
    """What a ``config.g`` would say, as far as a host can see it."""

    summary: str
    board: Mainboard
    axes: Callable[[], list[dict[str, Any]]]
    kinematics: dict[str, Any]
    heaters: Callable[[], list[dict[str, Any]]] = _none
    beds: Sequence[int] = ()
    """Heater of each bed slot."""
    chambers: Sequence[int] = ()
    sensors: Callable[[], Sequence[dict[str, Any] | None]] = _none
    fans: Callable[[], list[dict[str, Any]]] = _none
    extruders: int = 0
    tools: Callable[[], list[dict[str, Any]]] = _none
    tool_boards: Sequence[int] = ()
    """CAN addresses."""
    spindles: int = 0
    mode: str = "FFF"
    has_probe: bool = True
    has_filament_monitor: bool = False
    has_atx: bool = False
    led_strips: tuple[tuple[str, str], ...] = ()
    gp_out: int = 0
    variables: dict[str, Any] = field(default_factory=dict)
    name: str = "Simulated printer"
    accelerations: tuple[float, float] = (20000.0, 20000.0)


def xyz(x: float, y: float, z: float) -> list[dict[str, Any]]:
    return [
        parts.axis("X", ["0.0"], 0.0, x, 18000.0, 3000.0, 80.0),
        parts.axis("Y", ["0.1"], 0.0, y, 18000.0, 3000.0, 80.0),
        parts.axis("Z", ["0.2"], 0.0, z, 900.0, 100.0, 400.0),
    ]


def bed(sensor: int, limit: float = 125.0) -> dict[str, Any]:
    return parts.heater(sensor, limit, heating_rate=0.76, cooling_rate=0.4, dead_time=2.8)


def hotend(sensor: int, limit: float = 290.0) -> dict[str, Any]:
    return parts.heater(sensor, limit, heating_rate=4.545, cooling_rate=0.91, dead_time=2.0)


VARIABLES = {
    "bedOffset": -0.045,
    "lightsOn": True,
    "material": "PLA",
    "nothing": None,
    "retries": 3,
    "speeds": [60, 120.5, "fast"],
}


def _corexy_axes() -> list[dict[str, Any]]:
    axes = xyz(350.0, 350.0, 400.0)
    axes[2]["drivers"] = ["0.2", "0.3", "0.4"]
    return axes


def _idex_axes() -> list[dict[str, Any]]:
    axes = xyz(420.0, 310.0, 340.0)
    axes[0]["max"] = 355.0
    return axes + [parts.axis("U", ["0.3"], 65.0, 420.0, 18000.0, 3000.0, 80.0)]


def _changer_axes() -> list[dict[str, Any]]:
    axes = xyz(330.0, 240.0, 300.0)
    return axes + [parts.axis("C", ["0.3"], -45.0, 360.0, 10000.0, 800.0, 91.02, visible=False)]


def _delta_axes() -> list[dict[str, Any]]:
    axes = xyz(120.0, 120.0, 330.215)
    for index, axis in enumerate(axes):
        axis.update(drivers=[str(index)], speed=15000.0, min=-120.0 if index < 2 else -0.5)
    return axes


def _cnc_axes() -> list[dict[str, Any]]:
    axes = xyz(800.0, 600.0, 120.0)
    for index, axis in enumerate(axes):
        axis["drivers"] = [str(index)]
    axes[2].update(min=-120.0, max=0.0, speed=3000.0)
    return axes


def _many_axes() -> list[dict[str, Any]]:
    axes = xyz(500.0, 400.0, 300.0)
    for index, letter in enumerate("UVWABCDabc"):
        driver = f"{1 + index // 3}.{index % 3}"
        axes.append(parts.axis(letter, [driver], 0.0, 180.0, 6000.0, 500.0, 100.0))
    return axes


def _changer_tools() -> list[dict[str, Any]]:
    offsets = ((0.0, 0.0, 0.0), (0.21, -0.08, 0.05), (-0.14, 0.3, -0.12))
    return [
        parts.tool(number, name, [heater], [heater - 1], [heater - 1], ((0,), (1,)), offset)
        for number, name, heater, offset in (
            (1, "Left", 1, offsets[0]),
            (3, "", 2, offsets[1]),
            (7, 'Nozzle 0.8"', 3, offsets[2]),
            (10, "Prüfkopf", 4, offsets[1]),
        )
    ]


MACHINES: dict[str, Machine] = {
    "cartesian": Machine(
        "cartesian printer, one tool, bed",
        MINI5PLUS,
        axes=lambda: xyz(235.0, 225.0, 250.0),
        kinematics=cartesian(),
        heaters=lambda: [bed(0), hotend(1)],
        beds=(0,),
        sensors=lambda: [
            parts.thermistor("bed", "temp0"),
            parts.thermistor("hotend", "temp1"),
            None,
            parts.mcu_sensor("mcu"),
        ],
        fans=lambda: [parts.fan("Part"), parts.fan("Hotend", [1], 45.0, rpm=0)],
        extruders=1,
        tools=lambda: [parts.tool(0, "E0", [1], [0], [0], ((0,), (1,)), (0, 0, 0))],
        has_filament_monitor=True,
        has_atx=True,
        led_strips=(("led", "NeoPixel_RGB"),),
        gp_out=1,
        variables=VARIABLES,
    ),
    "corexy": Machine(
        "CoreXY printer with a heated chamber",
        MB6HC,
        axes=_corexy_axes,
        kinematics=core_xy(),
        heaters=lambda: [
            bed(0),
            hotend(1, 320.0),
            parts.heater(2, 80.0, heating_rate=0.15, cooling_rate=0.08, dead_time=10.0),
        ],
        beds=(0,),
        chambers=(2,),
        sensors=lambda: [
            parts.thermistor("bed", "temp0"),
            parts.thermistor("hotend", "temp1"),
            parts.thermistor("chamber", "temp2"),
            None,
            parts.mcu_sensor("mcu"),
        ],
        fans=lambda: [
            parts.fan("Part"),
            parts.fan("Hotend", [1], 45.0, rpm=0),
            parts.fan("Chamber", [2], 30.0),
        ],
        extruders=1,
        tools=lambda: [parts.tool(0, "", [1], [0], [0], ((0,), (1,)), (0, 0, 0))],
        has_filament_monitor=True,
        variables={"chamberSoak": 600},
    ),
    "toolchanger": Machine(
        "tool changer, tools 1, 3, 7 and 10",
        MB6HC,
        axes=_changer_axes,
        kinematics=cartesian(4, "coreXY"),
        heaters=lambda: [bed(0)] + [hotend(sensor) for sensor in (1, 2, 3, 4)],
        beds=(0,),
        sensors=lambda: (
            [parts.thermistor("bed", "temp0")]
            + [parts.thermistor("", f"2{index}.temp0") for index in range(4)]
        ),
        fans=lambda: [parts.fan(f"Tool {index}") for index in range(4)],
        extruders=4,
        tools=_changer_tools,
        tool_boards=(20, 21, 22, 23),
        variables=VARIABLES,
    ),
    "delta": Machine(
        "delta printer on a Duet 2",
        DUET2_WIFI,
        axes=_delta_axes,
        kinematics=linear_delta(),
        heaters=lambda: [bed(0), hotend(1)],
        beds=(0,),
        sensors=lambda: [
            parts.thermistor("", "bedtemp"),
            parts.thermistor("", "e0temp"),
        ],
        fans=lambda: [parts.fan(), parts.fan("", [1], 45.0)],
        extruders=1,
        tools=lambda: [parts.tool(0, "", [1], [0], [0], ((0,), (1,)), (0, 0, 0))],
    ),
    "idex": Machine(
        "IDEX printer with two beds",
        MB6HC,
        axes=_idex_axes,
        kinematics=cartesian(4),
        heaters=lambda: [bed(0), bed(1), hotend(2), hotend(3)],
        beds=(0, 1),
        sensors=lambda: [
            parts.thermistor(name, f"temp{index}")
            for index, name in enumerate(("bed left", "bed right", "left", "right"))
        ],
        fans=lambda: [parts.fan("Left"), parts.fan("Right")],
        extruders=2,
        tools=lambda: [
            parts.tool(0, "Left", [2], [0], [0], ((0,), (1,)), (0, 0, 0, 0)),
            parts.tool(1, "Right", [3], [1], [1], ((3,), (1,)), (0, 0.12, -0.03, 0)),
            parts.tool(2, "Copy", [2, 3], [0, 1], [0, 1], ((0, 3), (1,)), (0, 0, 0, 0)),
        ],
    ),
    "cnc": Machine(
        "CNC router, no tools, no bed, one spindle",
        DUET2_WIFI,
        axes=_cnc_axes,
        kinematics=cartesian(),
        spindles=1,
        mode="CNC",
        has_probe=False,
        accelerations=(500.0, 800.0),
    ),
    "manyaxes": Machine(
        "thirteen axes, for arrays that come in pages",
        MB6XD,
        axes=_many_axes,
        kinematics=cartesian(13),
        heaters=lambda: [bed(0), hotend(1)],
        beds=(0,),
        sensors=lambda: [parts.thermistor("bed", "temp0"), parts.thermistor("", "temp1")],
        fans=lambda: [parts.fan()],
        extruders=1,
        tools=lambda: [parts.tool(0, "", [1], [0], [0], ((0,), (1,)), (0,) * 13)],
    ),
}


def machine_called(name: str) -> Machine:
    """Return that machine; :class:`UnknownMachine` names the known ones."""
    try:
        return MACHINES[name]
    except KeyError:
        known = ", ".join(MACHINES)
        raise UnknownMachine(f"unknown machine {name!r}, known are {known}") from None


def mainboard(machine: Machine, firmware: Firmware) -> Mainboard:
    """Return the board: a Duet 2 for firmware for nothing else, none for firmware without it."""
    if firmware.needs_duet2:
        return DUET2_WIFI
    if machine.board.is_duet2 and not firmware.has_duet2:
        return MINI5PLUS
    return machine.board
