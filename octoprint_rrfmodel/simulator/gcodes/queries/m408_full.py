"""Types 2, 3 and 4 of M408: what rr_status gives (RRF 3.5 RepRap.cpp:1131-1612)."""

from __future__ import annotations

from typing import Any

from ...model.om import quoted
from .m408_values import Values, heater_number, int_list, number, number_list


def _coords(status: Values) -> str:
    return (
        f'"coords":{{"axesHomed":{int_list(status.homed())},'
        f'"wpl":{(status.model["move"].get("workplaceNumber") or 0) + 1},'
        f'"xyz":{number_list(status.user(), 3)},"machine":{number_list(status.machine(), 3)},'
        f'"extr":{number_list([e["position"] for e in status.extruders], 1)}}}'
    )


def _output(status: Values) -> str:
    parts = []
    beep, text = status.state.get("beep"), status.state.get("displayMessage")
    if beep:
        parts.append(f'"beepDuration":{beep["duration"]},"beepFrequency":{beep["frequency"]}')
    if text:
        parts.append(f'"message":{quoted(text)}')
    box = status.state.get("messageBox")
    if box is not None:
        parts.append(
            f'"msgBox":{{"msg":{quoted(box["message"])},"title":{quoted(box["title"])},'
            f'"mode":{box["mode"]},"seq":{box["seq"]},'
            f'"timeout":{number(box["timeout"] / 1000, 1)},"controls":{box["axisControls"]}}}'
        )
    return f'"output":{{{",".join(parts)}}},' if parts else ""


def _params(status: Values, kind: int) -> str:
    power = status.state.get("atxPower")
    names = ""
    if kind == 3:
        names = '"fanNames":[' + ",".join(quoted(fan["name"]) for fan in status.fans) + "],"
    percents = [(fan.get("requestedValue") or 0.0) * 100 for fan in status.fans]
    return (
        f'"params":{{"atxPower":{-1 if power is None else int(power)},'
        f'"fanPercent":{int_list([round(value) for value in percents])},{names}'
        f'"speedFactor":{number(status.model["move"]["speedFactor"] * 100, 1)},'
        f'"extrFactors":{number_list([e["factor"] * 100 for e in status.extruders], 1)},'
        f'"babystep":{number(status.babystep, 3)}}}'
    )


def _one_heater(status: Values, name: str, index: int) -> str:
    heater = status.thermal.heater(index)
    if heater is None:
        return ""
    return (
        f'"{name}":{{"current":{number(heater["current"], 1)},'
        f'"active":{number(heater["active"], 1)},"standby":{number(heater["standby"], 1)},'
        f'"state":{heater_number(heater["state"])},"heater":{index}}},'
    )


def _temps(status: Values, kind: int) -> str:
    chambers = list(status.heat.get("chamberHeaters") or ()) + [-1, -1]
    heaters = [heater for heater in status.thermal.heaters if heater is not None]
    names = ""
    if kind == 3:
        names = '"names":[' + ",".join('""' for _ in heaters) + "],"
    active = ",".join(number_list(tool["active"], 1) for tool in status.tools)
    standby = ",".join(number_list(tool["standby"], 1) for tool in status.tools)
    heated = {heater.get("sensor") for heater in heaters}
    extra = ",".join(
        f'{{"name":{quoted(sensor["name"])},"temp":{number(sensor["lastReading"], 1)}}}'
        for index, sensor in enumerate(status.model["sensors"].get("analog") or ())
        if sensor is not None and index not in heated and sensor.get("name")
    )
    single = "".join(
        _one_heater(status, name, index)
        for name, index in (
            ("bed", status.bed),
            ("chamber", chambers[0]),
            ("cabinet", chambers[1]),
        )
    )
    return (
        f'"temps":{{{single}'
        f'"current":{number_list([heater["current"] for heater in heaters], 1)},'
        f'"state":{int_list([heater_number(heater["state"]) for heater in heaters])},{names}'
        f'"tools":{{"active":[{active}],"standby":[{standby}]}},"extra":[{extra}]}}'
    )


def full_status(status: Values, kind: int) -> str:
    """Types 2 to 4."""
    current = status.model["move"]["currentMove"]
    parts = [
        f'{{"status":"{status.letter}",{_coords(status)},'
        f'"speeds":{{"requested":{number(current["requestedSpeed"], 1)},'
        f'"top":{number(current["topSpeed"], 1)}}},'
        f'"currentTool":{status.state["currentTool"]},{_output(status)}{_params(status, kind)},'
        f'"sensors":{{"probeValue":{status.probe()},'
        f'"fanRPM":{int_list([fan.get("rpm", -1) for fan in status.fans])}}},'
        f'{_temps(status, kind)},"time":{number(status.up_time, 1)}',
        _spindles(status),
        {2: "", 3: _settings(status) if kind == 3 else "", 4: _printing(status)}[kind],
        "}",
    ]
    return "".join(parts)


def _spindles(status: Values) -> str:
    if status.state.get("machineMode") != "CNC":
        return ""
    shown = ",".join(
        f'{{"current":{spindle["current"]},"active":{spindle["active"]}}}'
        for spindle in status.model.get("spindles") or ()
        if spindle is not None and spindle["state"] != "unconfigured"
    )
    return f',"spindles":[{shown}]'


def _tool(tool: dict[str, Any]) -> str:
    axis_map = ",".join(int_list(axes) for axes in tool.get("axes") or ())
    fans = sum(1 << index for index in tool.get("fans") or ())
    return (
        f'{{"number":{tool["number"]},"name":{quoted(tool["name"])},'
        f'"heaters":{int_list(tool["heaters"])},"drives":{int_list(tool["extruders"])},'
        f'"axisMap":[{axis_map}],"fans":{fans},"filament":"",'
        f'"offsets":{number_list(tool["offsets"], 2)}}}'
    )


def _volts(name: str, values: Any) -> str:
    if not values:
        return ""
    return (
        f',"{name}":{{"min":{number(values.get("min"), 1)},'
        f'"cur":{number(values.get("current"), 1)},"max":{number(values.get("max"), 1)}}}'
    )


def _settings(status: Values) -> str:
    """What type 3 has on top of type 2."""
    volumes = [volume for volume in status.model.get("volumes") or () if volume]
    mounted = sum(1 << i for i, volume in enumerate(volumes) if volume.get("mounted"))
    endstops = status.model["sensors"].get("endstops") or []
    triggered = sum(1 << i for i, e in enumerate(endstops) if e and e.get("triggered"))
    highest = max([h["max"] for h in status.thermal.heaters if h] or [0.0])
    controllable = sum(
        1 << i
        for i, fan in enumerate(status.fans)
        if not (fan["thermostatic"].get("sensors") or fan["thermostatic"].get("heaters"))
    )
    compensation = status.model["move"]["compensation"]["type"]
    probes = status.model["sensors"].get("probes") or []
    board = (status.model.get("boards") or [{}])[0]
    text = (
        f',"coldExtrudeTemp":{number(status.heat["coldExtrudeTemperature"], 1)},'
        f'"coldRetractTemp":{number(status.heat["coldRetractTemperature"], 1)},'
        f'"compensation":{quoted("None" if compensation == "none" else compensation.title())},'
        f'"controllableFans":{controllable},"tempLimit":{number(highest, 1)},'
        f'"endstops":{triggered},"firmwareName":{quoted(status.mainboard.firmware_name)},'
        f'"firmwareVersion":{quoted(status.firmware.version)},'
        f'"geometry":{quoted(status.geometry)},"axes":{status.visible()},'
        f'"totalAxes":{len(status.axes)},"axisNames":{quoted(status.axis_names())},'
        f'"volumes":{len(volumes)},"mountedVolumes":{mounted},'
        f'"mode":{quoted(status.state.get("machineMode") or "FFF")},'
        f'"name":{quoted(str((status.model.get("network") or {}).get("name") or ""))}'
    )
    if probes and probes[0]:
        text += (
            f',"probe":{{"threshold":{probes[0]["threshold"]},'
            f'"height":{number(probes[0]["triggerHeight"], 2)},"type":{probes[0]["type"]}}}'
        )
    text += f',"tools":[{",".join(_tool(tool) for tool in status.tools)}]'
    return text + "".join(
        _volts(name, board.get(member))
        for name, member in (("mcutemp", "mcuTemp"), ("vin", "vIn"), ("v12", "v12"))
    )


def _printing(status: Values) -> str:
    """What type 4 has on top of type 2."""
    job = status.model.get("job") or {}
    left = job.get("timesLeft") or {}
    old = ""
    layer_left = ""
    if not status.firmware.at_least(3, 4):
        height = (job.get("file") or {}).get("firstLayerHeight")
        first = number(job.get("firstLayerDuration"), 1)
        old = f'"firstLayerDuration":{first},"firstLayerHeight":{number(height, 2)},'
        layer_left = ',"layer":0.0'
    return (
        f',"currentLayer":{job.get("layer") or 0},'
        f'"currentLayerTime":{number(job.get("layerTime"), 1)},'
        f'"extrRaw":{number_list([e["rawPosition"] for e in status.extruders], 1)},'
        f'"fractionPrinted":{number(status.fraction() * 100, 1)},'
        f'"filePosition":{int(job.get("filePosition") or 0)},{old}'
        f'"printDuration":{number(job.get("duration"), 1)},'
        f'"warmUpDuration":{number(job.get("warmUpDuration"), 1)},'
        f'"timesLeft":{{"file":{number(left.get("file"), 1)},'
        f'"filament":{number(left.get("filament"), 1)}{layer_left}}}'
    )
