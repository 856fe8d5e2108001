"""The parts an object model is put together from, each with the members of all versions.

Member order is the firmware's, which is that of strcmp.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

ABS_ZERO = -273.15
ROOM = 21.3
"""Temperature in °C of everything that nobody heats."""


def monitor(limit: float | None, sensor: int = -1) -> dict[str, Any]:
    """Return a heater monitor; without a limit a disabled one."""
    return {
        "action": None if limit is None else 0,
        "condition": "disabled" if limit is None else "tooHigh",
        "limit": limit,
        "sensor": sensor,
    }


def heater(
    sensor: int,
    limit: float,
    heating_rate: float,
    cooling_rate: float,
    dead_time: float = 3.0,
    cold: float = ROOM,
) -> dict[str, Any]:
    """Return a switched-off heater; rates in K/s at full power and K/s per 100 K above ambient."""
    return {
        "active": 0.0,
        "avgPwm": 0.0,
        "current": cold,
        "max": limit,
        "maxBadReadings": 3,
        "maxHeatingFaultTime": 5.0,
        "maxTempExcursion": 15.0,
        "min": -273.1,
        "model": {
            "coolingExp": 1.35,
            "coolingRate": cooling_rate,
            "deadTime": dead_time,
            "enabled": True,
            "fanCoolingRate": 0.0,
            "gain": round(heating_rate / cooling_rate * 100, 1),
            "heatingRate": heating_rate,
            "inverted": False,
            "maxPwm": 1.0,
            "pid": {"d": 0.241, "i": 0.0028, "overridden": False, "p": 0.05917, "used": True},
            "standardVoltage": 24.0,
            "timeConstant": round(100 / cooling_rate, 1),
            "timeConstantFansOn": round(100 / cooling_rate, 1),
        },
        "monitors": [monitor(limit, sensor), monitor(None), monitor(None)],
        "sensor": sensor,
        "standby": 0.0,
        "state": "off",
    }


def thermistor(name: str, port: str) -> dict[str, Any]:
    return {
        "beta": 4725.0,
        "c": 7.06e-8,
        "lastReading": ROOM,
        "name": name,
        "offsetAdj": 0.0,
        "port": port,
        "r25": 100000.0,
        "rRef": 2200.0,
        "slopeAdj": 0.0,
        "state": "ok",
        "type": "thermistor",
    }


def mcu_sensor(name: str) -> dict[str, Any]:
    return {
        "lastReading": 34.2,
        "name": name,
        "offsetAdj": 0.0,
        "port": "",
        "slopeAdj": 0.0,
        "state": "ok",
        "type": "mcutemp",
    }


def fan(
    name: str = "", sensors: Sequence[int] = (), limit: float | None = None, rpm: int = -1
) -> dict[str, Any]:
    """Return a fan; with sensors a thermostatic one that starts at ``limit`` °C."""
    return {
        "actualValue": 0.0,
        "blip": 0.1,
        "frequency": 500,
        "max": 1.0,
        "min": 0.1,
        "name": name,
        "requestedValue": 1.0 if sensors else 0.0,
        "rpm": rpm,
        "tachoPpr": 2.0,
        "thermostatic": {
            "heaters": list(sensors),
            "highTemperature": limit,
            "lowTemperature": limit,
            "sensors": list(sensors),
        },
    }


def microstepping(value: int = 16) -> dict[str, Any]:
    return {"interpolated": True, "value": value}


def axis(
    letter: str,
    drivers: Sequence[str],
    low: float,
    high: float,
    speed: float,
    acceleration: float,
    steps: float,
    current: int = 1200,
    visible: bool = True,
) -> dict[str, Any]:
    """Return an axis that isn't homed; speed in mm/min, acceleration in mm/s²."""
    return {
        "acceleration": acceleration,
        "babystep": 0.0,
        "backlash": 0.0,
        "current": current,
        "drivers": list(drivers),
        "homed": False,
        "jerk": 600.0 if speed > 2000 else 24.0,
        "letter": letter,
        "machinePosition": 0.0,
        "max": high,
        "maxProbed": False,
        "microstepping": microstepping(),
        "min": low,
        "minProbed": False,
        "percentCurrent": 100,
        "percentStstCurrent": 71,
        "printingJerk": 600.0 if speed > 2000 else 24.0,
        "reducedAcceleration": acceleration,
        "speed": speed,
        "stepsPerMm": steps,
        "userPosition": 0.0,
        "visible": visible,
        "workplaceOffsets": [0.0] * 9,
    }


def extruder(driver: str, steps: float = 690.0, advance: float = 0.045) -> dict[str, Any]:
    return {
        "acceleration": 3000.0,
        "current": 800,
        "driver": driver,
        "factor": 1.0,
        "filament": "",
        "filamentDiameter": 1.75,
        "jerk": 300.0,
        "microstepping": microstepping(),
        "nonlinear": {"a": 0.0, "b": 0.0, "upperLimit": 0.2},
        "percentCurrent": 100,
        "percentStstCurrent": 71,
        "position": 0.0,
        "pressureAdvance": advance,
        "printingJerk": 300.0,
        "rawPosition": 0.0,
        "speed": 3600.0,
        "stepsPerMm": steps,
    }


def tool(
    number: int,
    name: str,
    heaters: Sequence[int],
    extruders: Sequence[int],
    fans: Sequence[int],
    axes: Sequence[Sequence[int]],
    offsets: Sequence[float],
) -> dict[str, Any]:
    return {
        "active": [0.0] * len(heaters),
        "axes": [list(mapped) for mapped in axes],
        "extruders": list(extruders),
        "fans": list(fans),
        "feedForward": [0.0] * len(heaters),
        "filamentExtruder": extruders[0] if extruders else -1,
        "heaters": list(heaters),
        "isRetracted": False,
        "mix": [1.0] + [0.0] * (len(extruders) - 1) if extruders else [],
        "name": name,
        "number": number,
        "offsets": [float(offset) for offset in offsets],
        "offsetsProbed": 0,
        "retraction": {
            "extraRestart": 0.0,
            "length": 2.0,
            "speed": 1000.0 / 60,
            "unretractSpeed": 1000.0 / 60,
            "zHop": 0.0,
        },
        "spindle": -1,
        "spindleRpm": 0,
        "standby": [0.0] * len(heaters),
        "state": "off",
    }


def spindle(configured: bool = False) -> dict[str, Any]:
    return {
        "active": 0,
        "canReverse": configured,
        "current": 0,
        "frequency": 500 if configured else 0,
        "idlePwm": 0.0,
        "max": 24000 if configured else 10000,
        "maxPwm": 1.0,
        "min": 60,
        "minPwm": 0.0,
        "state": "stopped" if configured else "unconfigured",
    }


def endstop(high_end: bool = False) -> dict[str, Any]:
    return {"highEnd": high_end, "probe": None, "triggered": False, "type": "inputPin"}


def probe() -> dict[str, Any]:
    return {
        "calibrationTemperature": 25.0,
        "deployedByUser": False,
        "disablesHeaters": False,
        "diveHeights": [5.0, 2.0],
        "isCalibrated": None,
        "lastStopHeight": 0.0,
        "maxProbeCount": 3,
        "measuredHeight": None,
        "offsets": [-21.0, 4.5, -1.35],
        "recoveryTime": 0.4,
        "scanCoefficients": None,
        "speed": 240.0,
        "speeds": [480.0, 240.0],
        "temperatureCoefficient": 0.0,
        "temperatureCoefficients": [0.0, 0.0],
        "threshold": 500,
        "tolerance": 0.02,
        "travelSpeed": 9000.0,
        "triggerHeight": 1.35,
        "type": 8,
        "value": [0],
    }


def filament_monitor() -> dict[str, Any]:
    return {
        "configured": {
            "allMoves": False,
            "mmPerRev": 25.8,
            "percentMax": 130,
            "percentMin": 70,
            "sampleDistance": 3.0,
        },
        "enableMode": 1,
        "enabled": True,
        "status": "ok",
        "type": "rotatingMagnet",
    }
