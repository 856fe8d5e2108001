"""M408: status replies of the time before the object model (RRF 3.5 RepRap.cpp:1613-1856)."""

from __future__ import annotations

from typing import Callable

from ...model.om import quoted
from .m408_full import full_status
from .m408_values import OLD_LETTERS, Values, heater_number, int_list, number, number_list


def _legacy(status: Values, kind: int) -> str:
    """Types 0 and 1, one flat object."""
    heaters = status.heater_order()
    letter = OLD_LETTERS.get(status.letter, status.letter)
    factors = [extruder["factor"] * 100 for extruder in status.extruders]
    fans = [fan.get("requestedValue") or 0.0 for fan in status.fans]
    parts = [
        f'"status":"{letter}"',
        f'"heaters":{number_list([heater["current"] for heater in heaters], 1)}',
        f'"active":{number_list([heater["active"] for heater in heaters], 1)}',
        f'"standby":{number_list([heater["standby"] for heater in heaters], 1)}',
        f'"hstat":{int_list([heater_number(heater["state"]) for heater in heaters])}',
        f'"pos":{number_list(status.user(), 3)}',
        f'"machine":{number_list(status.machine(), 3)}',
        f'"sfactor":{number(status.model["move"]["speedFactor"] * 100, status.factor_decimals)}',
        f'"efactor":{number_list(factors, status.factor_decimals)}',
        f'"babystep":{number(status.babystep, 3)}',
        f'"tool":{status.state["currentTool"]}',
        f'"probe":"{status.probe()}"',
        f'"fanPercent":{_fan_percents(status, fans)}',
        f'"fanRPM":{int_list([fan.get("rpm", -1) for fan in status.fans])}',
        f'"homed":{int_list(status.homed())}',
    ]
    if status.job.is_printing:
        parts.append(f'"fraction_printed":{number(status.fraction(), 4)}')
    parts.append(_message_box_flat(status))
    if kind == 0:
        if status.job.is_printing:
            left = status.model["job"].get("timesLeft") or {}
            parts.append(
                f'"timesLeft":{number_list([left.get("file"), left.get("filament"), 0.0], 1)}'
            )
        return "{" + ",".join(parts) + "}"
    parts += [
        f'"geometry":{quoted(status.geometry)}',
        f'"axes":{status.visible()}',
        f'"totalAxes":{len(status.axes)}',
        f'"axisNames":{quoted(status.axis_names())}',
        f'"volumes":{len(status.model.get("volumes") or ())}',
        f'"numTools":{len(status.tools)}',
        f'"myName":{quoted(str((status.model.get("network") or {}).get("name") or ""))}',
        f'"firmwareName":{quoted(status.mainboard.firmware_name)}',
    ]
    return "{" + ",".join(parts) + "}"


def _fan_percents(status: Values, fans: list[float]) -> str:
    """Return the print's fan with a decimal, then every fan there could be, -1 for none.

    Seen in firmware 3.5; before 3.0 only those there are.
    """
    percents = [value * 100 for value in fans]
    if not status.has_model:
        return number_list(percents, 1)
    most = (status.model.get("limits") or {}).get("fans") or len(fans)
    rest = [round(value) for value in percents] + [-1] * (most - len(fans))
    first = number(percents[0] if percents else 0.0, 1)
    return f"[{','.join([first, *map(str, rest)])}]"


def _message_box_flat(status: Values) -> str:
    box = status.state.get("messageBox")
    if box is None:
        return '"msgBox.mode":-1'
    return (
        f'"msgBox.mode":{box["mode"]},"msgBox.seq":{box["seq"]},'
        f'"msgBox.timeout":{number(box["timeout"] / 1000, 1)},'
        f'"msgBox.controls":{box["axisControls"]},"msgBox.msg":{quoted(box["message"])},'
        f'"msgBox.title":{quoted(box["title"])}'
    )


def _configuration(status: Values) -> str:
    """Type 5."""
    axes, extruders = status.axes, status.extruders
    drives = axes + extruders
    firmware, mainboard = status.firmware, status.mainboard
    idle = status.model["move"]["idle"]
    feeds = [float(drive["speed"]) / 60 for drive in drives]
    jerks = [float(drive["jerk"]) / 60 for drive in drives]
    return (
        f'{{"axisMins":{number_list([axis["min"] for axis in axes], 2)},'
        f'"axisMaxes":{number_list([axis["max"] for axis in axes], 2)},'
        f'"accelerations":{number_list([drive["acceleration"] for drive in drives], 2)},'
        f'"currents":{int_list([drive["current"] for drive in drives])},'
        f'"firmwareElectronics":{quoted(mainboard.electronics)},'
        f'"firmwareName":{quoted(mainboard.firmware_name)},'
        f'"boardName":{quoted(mainboard.short_name)},'
        f'"firmwareVersion":{quoted(firmware.version)},"dwsVersion":"2.1.0",'
        f'"firmwareDate":{quoted(firmware.date)},"sysdir":"0:/sys/",'
        f'"idleCurrentFactor":{number(idle["factor"] * 100, 1)},'
        f'"idleTimeout":{number(idle["timeout"], 1)},'
        f'"minFeedrates":{number_list(jerks, 2)},"maxFeedrates":{number_list(feeds, 2)}}}'
    )


FORMS: dict[int, Callable[[Values, int], str]] = {
    0: _legacy,
    1: _legacy,
    2: full_status,
    3: full_status,
    4: full_status,
    5: lambda status, kind: _configuration(status),
}


def text_of(values: Values, kind: int) -> str:
    """Return the JSON text of ``M408 S<kind>``; an unknown type is answered as 2."""
    if kind not in FORMS:
        kind = 2
    return FORMS[kind](values, kind)
