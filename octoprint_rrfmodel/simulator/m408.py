"""The status replies of M408, types 0 to 5 (RRF 3.5 RepRap.cpp:1131-1856)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Sequence

from .om import quoted

if TYPE_CHECKING:
    from .board import Board

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


def _number(value: Any, decimals: int) -> str:
    value = float(value or 0.0)
    return f"{value:.{decimals}f}" if math.isfinite(value) else "nan"


def _list(values: Sequence[Any], decimals: int) -> str:
    return "[" + ",".join(_number(value, decimals) for value in values) + "]"


def _ints(values: Sequence[Any]) -> str:
    return "[" + ",".join(str(int(value)) for value in values) + "]"


def _heater_number(state: Any) -> int:
    return HEATER_STATES.index(state) if state in HEATER_STATES else 0


class Status:
    """The values that the status types have in common, from the object model."""

    def __init__(self, board: Board):
        self.board = board
        self.model = board.data
        self.axes = board.motion.axes
        self.extruders = board.motion.extruders
        self.heat = self.model["heat"]
        self.state = self.model["state"]
        self.fans = [fan for fan in self.model.get("fans") or () if fan is not None]
        self.tools = [tool for tool in self.model.get("tools") or () if tool is not None]

    @property
    def letter(self) -> str:
        return LETTERS.get(self.state["status"], "I")

    @property
    def bed(self) -> int:
        slots = self.heat.get("bedHeaters") or [-1]
        return slots[0] if slots else -1

    def heater_order(self) -> List[Dict[str, Any]]:
        """Return the heaters with the bed first, as S0 and S1 list them."""
        bed = self.board.thermal.heater(self.bed)
        others = [h for h in self.board.thermal.heaters if h is not None and h is not bed]
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

    def machine(self) -> List[float]:
        return [axis["machinePosition"] for axis in self.axes]

    def user(self) -> List[float]:
        return [axis["userPosition"] for axis in self.axes]

    def homed(self) -> List[bool]:
        return [bool(axis["homed"]) for axis in self.axes]

    def fraction(self) -> float:
        return self.board.job.fraction_printed()

    def names(self) -> str:
        return "".join(axis["letter"] for axis in self.axes)

    def visible(self) -> int:
        return sum(1 for axis in self.axes if axis.get("visible", True))


def _legacy(status: Status, kind: int) -> str:
    """Types 0 and 1, one flat object."""
    heaters = status.heater_order()
    letter = OLD_LETTERS.get(status.letter, status.letter)
    fans = [fan.get("requestedValue") or 0.0 for fan in status.fans]
    parts = [
        f'"status":"{letter}"',
        f'"heaters":{_list([heater["current"] for heater in heaters], 1)}',
        f'"active":{_list([heater["active"] for heater in heaters], 1)}',
        f'"standby":{_list([heater["standby"] for heater in heaters], 1)}',
        f'"hstat":{_ints([_heater_number(heater["state"]) for heater in heaters])}',
        f'"pos":{_list(status.user(), 3)}',
        f'"machine":{_list(status.machine(), 3)}',
        f'"sfactor":{_number(status.model["move"]["speedFactor"] * 100, 2)}',
        f'"efactor":{_list([e["factor"] * 100 for e in status.extruders], 2)}',
        f'"babystep":{_number(status.babystep, 3)}',
        f'"tool":{status.state["currentTool"]}',
        f'"probe":"{status.probe()}"',
        f'"fanPercent":{_list([value * 100 for value in fans], 1)}',
        f'"fanRPM":{_ints([fan.get("rpm", -1) for fan in status.fans])}',
        f'"homed":{_ints(status.homed())}',
    ]
    if status.board.job.is_printing:
        parts.append(f'"fraction_printed":{_number(status.fraction(), 4)}')
    parts.append(_message_box_flat(status))
    if kind == 0:
        if status.board.job.is_printing:
            left = status.model["job"].get("timesLeft") or {}
            parts.append(f'"timesLeft":{_list([left.get("file"), left.get("filament"), 0.0], 1)}')
        return "{" + ",".join(parts) + "}"
    parts += [
        f'"geometry":{quoted(status.geometry)}',
        f'"axes":{status.visible()}',
        f'"totalAxes":{len(status.axes)}',
        f'"axisNames":{quoted(status.names())}',
        f'"volumes":{len(status.model.get("volumes") or ())}',
        f'"numTools":{len(status.tools)}',
        f'"myName":{quoted(str((status.model.get("network") or {}).get("name") or ""))}',
        f'"firmwareName":{quoted(status.board.mainboard.firmware_name)}',
    ]
    return "{" + ",".join(parts) + "}"


def _message_box_flat(status: Status) -> str:
    box = status.state.get("messageBox")
    if box is None:
        return '"msgBox.mode":-1'
    return (
        f'"msgBox.mode":{box["mode"]},"msgBox.seq":{box["seq"]},'
        f'"msgBox.timeout":{_number(box["timeout"] / 1000, 1)},'
        f'"msgBox.controls":{box["axisControls"]},"msgBox.msg":{quoted(box["message"])},'
        f'"msgBox.title":{quoted(box["title"])}'
    )


def _coords(status: Status) -> str:
    return (
        f'"coords":{{"axesHomed":{_ints(status.homed())},'
        f'"wpl":{(status.model["move"].get("workplaceNumber") or 0) + 1},'
        f'"xyz":{_list(status.user(), 3)},"machine":{_list(status.machine(), 3)},'
        f'"extr":{_list([e["position"] for e in status.extruders], 1)}}}'
    )


def _output(status: Status) -> str:
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
            f'"timeout":{_number(box["timeout"] / 1000, 1)},"controls":{box["axisControls"]}}}'
        )
    return f'"output":{{{",".join(parts)}}},' if parts else ""


def _params(status: Status, kind: int) -> str:
    power = status.state.get("atxPower")
    names = ""
    if kind == 3:
        names = '"fanNames":[' + ",".join(quoted(fan["name"]) for fan in status.fans) + "],"
    percents = [(fan.get("requestedValue") or 0.0) * 100 for fan in status.fans]
    return (
        f'"params":{{"atxPower":{-1 if power is None else int(power)},'
        f'"fanPercent":{_ints([round(value) for value in percents])},{names}'
        f'"speedFactor":{_number(status.model["move"]["speedFactor"] * 100, 1)},'
        f'"extrFactors":{_list([e["factor"] * 100 for e in status.extruders], 1)},'
        f'"babystep":{_number(status.babystep, 3)}}}'
    )


def _one_heater(status: Status, name: str, index: int) -> str:
    heater = status.board.thermal.heater(index)
    if heater is None:
        return ""
    return (
        f'"{name}":{{"current":{_number(heater["current"], 1)},'
        f'"active":{_number(heater["active"], 1)},"standby":{_number(heater["standby"], 1)},'
        f'"state":{_heater_number(heater["state"])},"heater":{index}}},'
    )


def _temps(status: Status, kind: int) -> str:
    chambers = list(status.heat.get("chamberHeaters") or ()) + [-1, -1]
    heaters = [heater for heater in status.board.thermal.heaters if heater is not None]
    names = ""
    if kind == 3:
        names = '"names":[' + ",".join('""' for _ in heaters) + "],"
    active = ",".join(_list(tool["active"], 1) for tool in status.tools)
    standby = ",".join(_list(tool["standby"], 1) for tool in status.tools)
    heated = {heater.get("sensor") for heater in heaters}
    extra = ",".join(
        f'{{"name":{quoted(sensor["name"])},"temp":{_number(sensor["lastReading"], 1)}}}'
        for index, sensor in enumerate(status.model["sensors"].get("analog") or ())
        if sensor is not None and index not in heated and sensor.get("name")
    )
    return (
        f'"temps":{{{_one_heater(status, "bed", status.bed)}'
        f'{_one_heater(status, "chamber", chambers[0])}{_one_heater(status, "cabinet", chambers[1])}'
        f'"current":{_list([heater["current"] for heater in heaters], 1)},'
        f'"state":{_ints([_heater_number(heater["state"]) for heater in heaters])},{names}'
        f'"tools":{{"active":[{active}],"standby":[{standby}]}},"extra":[{extra}]}}'
    )


def _status(status: Status, kind: int) -> str:
    """Types 2 to 4."""
    current = status.model["move"]["currentMove"]
    parts = [
        f'{{"status":"{status.letter}",{_coords(status)},'
        f'"speeds":{{"requested":{_number(current["requestedSpeed"], 1)},'
        f'"top":{_number(current["topSpeed"], 1)}}},'
        f'"currentTool":{status.state["currentTool"]},{_output(status)}{_params(status, kind)},'
        f'"sensors":{{"probeValue":{status.probe()},'
        f'"fanRPM":{_ints([fan.get("rpm", -1) for fan in status.fans])}}},'
        f'{_temps(status, kind)},"time":{_number(status.board.up_time, 1)}',
        _spindles(status),
        {2: "", 3: _settings(status) if kind == 3 else "", 4: _printing(status)}[kind],
        "}",
    ]
    return "".join(parts)


def _spindles(status: Status) -> str:
    if status.state.get("machineMode") != "CNC":
        return ""
    shown = ",".join(
        f'{{"current":{spindle["current"]},"active":{spindle["active"]}}}'
        for spindle in status.model.get("spindles") or ()
        if spindle is not None and spindle["state"] != "unconfigured"
    )
    return f',"spindles":[{shown}]'


def _tool(tool: Dict[str, Any]) -> str:
    axis_map = ",".join(_ints(axes) for axes in tool.get("axes") or ())
    fans = sum(1 << index for index in tool.get("fans") or ())
    return (
        f'{{"number":{tool["number"]},"name":{quoted(tool["name"])},'
        f'"heaters":{_ints(tool["heaters"])},"drives":{_ints(tool["extruders"])},'
        f'"axisMap":[{axis_map}],"fans":{fans},"filament":"",'
        f'"offsets":{_list(tool["offsets"], 2)}}}'
    )


def _volts(name: str, values: Any) -> str:
    if not values:
        return ""
    return (
        f',"{name}":{{"min":{_number(values["min"], 1)},"cur":{_number(values["current"], 1)},'
        f'"max":{_number(values["max"], 1)}}}'
    )


def _settings(status: Status) -> str:
    """What type 3 has on top of type 2."""
    volumes = [volume for volume in status.model.get("volumes") or () if volume]
    mounted = sum(1 << i for i, volume in enumerate(volumes) if volume.get("mounted"))
    endstops = status.model["sensors"].get("endstops") or []
    triggered = sum(1 << i for i, e in enumerate(endstops) if e and e.get("triggered"))
    highest = max([h["max"] for h in status.board.thermal.heaters if h] or [0.0])
    controllable = sum(
        1 << i
        for i, fan in enumerate(status.fans)
        if not (fan["thermostatic"].get("sensors") or fan["thermostatic"].get("heaters"))
    )
    compensation = status.model["move"]["compensation"]["type"]
    probes = status.model["sensors"].get("probes") or []
    board = (status.model.get("boards") or [{}])[0]
    text = (
        f',"coldExtrudeTemp":{_number(status.heat["coldExtrudeTemperature"], 1)},'
        f'"coldRetractTemp":{_number(status.heat["coldRetractTemperature"], 1)},'
        f'"compensation":{quoted("None" if compensation == "none" else compensation.title())},'
        f'"controllableFans":{controllable},"tempLimit":{_number(highest, 1)},'
        f'"endstops":{triggered},"firmwareName":{quoted(status.board.mainboard.firmware_name)},'
        f'"firmwareVersion":{quoted(status.board.firmware.version)},'
        f'"geometry":{quoted(status.geometry)},"axes":{status.visible()},'
        f'"totalAxes":{len(status.axes)},"axisNames":{quoted(status.names())},'
        f'"volumes":{len(volumes)},"mountedVolumes":{mounted},'
        f'"mode":{quoted(status.state.get("machineMode") or "FFF")},'
        f'"name":{quoted(str((status.model.get("network") or {}).get("name") or ""))}'
    )
    if probes and probes[0]:
        text += (
            f',"probe":{{"threshold":{probes[0]["threshold"]},'
            f'"height":{_number(probes[0]["triggerHeight"], 2)},"type":{probes[0]["type"]}}}'
        )
    text += f',"tools":[{",".join(_tool(tool) for tool in status.tools)}]'
    return text + "".join(
        _volts(name, board.get(member))
        for name, member in (("mcutemp", "mcuTemp"), ("vin", "vIn"), ("v12", "v12"))
    )


def _printing(status: Status) -> str:
    """What type 4 has on top of type 2."""
    job = status.model.get("job") or {}
    left = job.get("timesLeft") or {}
    old = ""
    layer_left = ""
    if not status.board.firmware.at_least(3, 4):
        height = (job.get("file") or {}).get("firstLayerHeight")
        first = _number(job.get("firstLayerDuration"), 1)
        old = f'"firstLayerDuration":{first},"firstLayerHeight":{_number(height, 2)},'
        layer_left = ',"layer":0.0'
    return (
        f',"currentLayer":{job.get("layer") or 0},'
        f'"currentLayerTime":{_number(job.get("layerTime"), 1)},'
        f'"extrRaw":{_list([e["rawPosition"] for e in status.extruders], 1)},'
        f'"fractionPrinted":{_number(status.fraction() * 100, 1)},'
        f'"filePosition":{int(job.get("filePosition") or 0)},{old}'
        f'"printDuration":{_number(job.get("duration"), 1)},'
        f'"warmUpDuration":{_number(job.get("warmUpDuration"), 1)},'
        f'"timesLeft":{{"file":{_number(left.get("file"), 1)},'
        f'"filament":{_number(left.get("filament"), 1)}{layer_left}}}'
    )


def _configuration(status: Status) -> str:
    """Type 5."""
    axes, extruders = status.axes, status.extruders
    drives = axes + extruders
    firmware, mainboard = status.board.firmware, status.board.mainboard
    idle = status.model["move"]["idle"]
    feeds = [float(drive["speed"]) / 60 for drive in drives]
    jerks = [float(drive["jerk"]) / 60 for drive in drives]
    return (
        f'{{"axisMins":{_list([axis["min"] for axis in axes], 2)},'
        f'"axisMaxes":{_list([axis["max"] for axis in axes], 2)},'
        f'"accelerations":{_list([drive["acceleration"] for drive in drives], 2)},'
        f'"currents":{_ints([drive["current"] for drive in drives])},'
        f'"firmwareElectronics":{quoted(mainboard.electronics)},'
        f'"firmwareName":{quoted(mainboard.firmware_name)},'
        f'"boardName":{quoted(mainboard.short_name)},'
        f'"firmwareVersion":{quoted(firmware.version)},"dwsVersion":"2.1.0",'
        f'"firmwareDate":{quoted(firmware.date)},"sysdir":"0:/sys/",'
        f'"idleCurrentFactor":{_number(idle["factor"] * 100, 1)},'
        f'"idleTimeout":{_number(idle["timeout"], 1)},'
        f'"minFeedrates":{_list(jerks, 2)},"maxFeedrates":{_list(feeds, 2)}}}'
    )


FORMS: Dict[int, Callable[[Status, int], str]] = {
    0: _legacy,
    1: _legacy,
    2: _status,
    3: _status,
    4: _status,
    5: lambda status, kind: _configuration(status),
}


def reply(board: Board, kind: int) -> str:
    """Return the JSON text of ``M408 S<kind>``; an unknown type is answered as 2."""
    if kind not in FORMS:
        kind = 2
    return FORMS[kind](Status(board), kind)
