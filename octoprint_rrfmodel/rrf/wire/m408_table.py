"""The members of an ``M408`` reply and where each belongs in the object model, one row each.

Sources: RepRapFirmware 3.5 RepRap.cpp:1131-1612 (S2..S4), :1613-1698 (S5), :1699-1856 (S0, S1),
:2391-2421 (status letters), and replies recorded from 1.21 to 3.0.
"""

from __future__ import annotations

from typing import Any, Callable, NamedTuple

STATUS = {
    "C": "starting",
    "F": "updating",
    "H": "halted",
    "O": "off",
    "D": "pausing",
    "R": "resuming",
    "S": "paused",
    "A": "cancelling",
    "M": "simulating",
    "P": "processing",
    "T": "changingTool",
    "B": "busy",
    "I": "idle",
}
"""Status letter of S2 and above to ``state.status``."""

LEGACY_STATUS = {**STATUS, "A": "paused", "S": "halted"}
"""The same for S0 and S1, which give two letters another meaning."""

HEATER_STATES = ("off", "standby", "active", "fault", "tuning", "offline")
"""Number of ``hstat`` and ``temps.state`` to ``heat.heaters[].state``."""


class Row(NamedTuple):
    """One member of a reply."""

    field: str
    """As it is called there; ``[]`` spreads an array over the ``[]`` of ``path``."""
    path: str | None
    """Where it belongs in the model; ``None`` keeps it below ``m408`` as it came."""
    convert: Callable[[Any], Any] = lambda value: value
    """From the reply's unit to the model's; may raise ``TypeError`` and the like on nonsense."""


def _fraction(percent: float) -> float:
    return round(percent / 100, 4)


def _fan_fraction(percent: float) -> float | None:
    """-1 stands for a fan that isn't there."""
    return None if percent < 0 else _fraction(percent)


def _milliseconds(seconds: float) -> int:
    """What is told in seconds here is told in milliseconds by M409."""
    return round(seconds * 1000)


def _per_minute(per_second: float) -> float:
    return round(per_second * 60, 3)


def _heater_state(number: int) -> str:
    return HEATER_STATES[number] if 0 <= number < len(HEATER_STATES) else "unknown"


def _bits(bitmap: int) -> list[int]:
    return [bit for bit in range(32) if bitmap >> bit & 1]


def _probe_values(text: str) -> list[int]:
    """``"1000"``, or ``"1000 (12)"`` with the secondary value in brackets."""
    return [int(word.strip("()")) for word in text.split()]


def _atx_power(number: int) -> bool | None:
    return None if number < 0 else bool(number)


LEGACY = (
    Row("status", "state.status", lambda letter: LEGACY_STATUS.get(letter, letter)),
    Row("heaters[]", "heat.heaters[].current"),
    Row("active[]", "heat.heaters[].active"),
    Row("standby[]", "heat.heaters[].standby"),
    Row("hstat[]", "heat.heaters[].state", _heater_state),
    Row("pos[]", "move.axes[].userPosition"),
    Row("machine[]", "move.axes[].machinePosition"),
    Row("sfactor", "move.speedFactor", _fraction),
    Row("efactor[]", "move.extruders[].factor", _fraction),
    Row("babystep", "move.axes[2].babystep"),
    Row("tool", "state.currentTool"),
    Row("probe", "sensors.probes[0].value", _probe_values),
    # the first is the fan of the current tool, which is one of those that follow
    Row("fanPercent[1:]", "fans[].requestedValue", _fan_fraction),
    Row("fanRPM[]", "fans[].rpm"),
    Row("homed[]", "move.axes[].homed", bool),
    Row("fraction_printed", None),
    Row("msgBox.mode", "state.messageBox.mode"),
    Row("msgBox.seq", "state.messageBox.seq"),
    Row("msgBox.timeout", "state.messageBox.timeout", _milliseconds),
    Row("msgBox.controls", "state.messageBox.axisControls"),
    Row("msgBox.msg", "state.messageBox.message"),
    Row("msgBox.title", "state.messageBox.title"),
    Row("timesLeft[0]", "job.timesLeft.file"),
    Row("timesLeft[1]", "job.timesLeft.filament"),
    Row("geometry", "move.kinematics.name"),
    Row("axes", None),
    Row("totalAxes", None),
    Row("axisNames[]", "move.axes[].letter"),
    Row("volumes", None),
    Row("numTools", None),
    Row("myName", "network.name"),
    Row("firmwareName", "boards[0].firmwareName"),
    Row("seq", None),
    Row("resp", None),
)
"""S0 and S1."""

STATUS_FIELDS = (
    Row("status", "state.status", lambda letter: STATUS.get(letter, letter)),
    Row("coords.axesHomed[]", "move.axes[].homed", bool),
    Row("coords.wpl", "move.workplaceNumber", lambda number: number - 1),
    Row("coords.xyz[]", "move.axes[].userPosition"),
    Row("coords.machine[]", "move.axes[].machinePosition"),
    Row("coords.extr[]", "move.extruders[].position"),
    Row("speeds.requested", "move.currentMove.requestedSpeed"),
    Row("speeds.top", "move.currentMove.topSpeed"),
    Row("currentTool", "state.currentTool"),
    Row("output.beepDuration", "state.beep.duration"),
    Row("output.beepFrequency", "state.beep.frequency"),
    Row("output.message", "state.displayMessage"),
    Row("output.msgBox.mode", "state.messageBox.mode"),
    Row("output.msgBox.seq", "state.messageBox.seq"),
    Row("output.msgBox.timeout", "state.messageBox.timeout", _milliseconds),
    Row("output.msgBox.controls", "state.messageBox.axisControls"),
    Row("output.msgBox.msg", "state.messageBox.message"),
    Row("output.msgBox.title", "state.messageBox.title"),
    Row("params.atxPower", "state.atxPower", _atx_power),
    Row("params.fanPercent[]", "fans[].requestedValue", _fan_fraction),
    Row("params.fanNames[]", "fans[].name"),
    Row("params.speedFactor", "move.speedFactor", _fraction),
    Row("params.extrFactors[]", "move.extruders[].factor", _fraction),
    Row("params.babystep", "move.axes[2].babystep"),
    Row("sensors.probeValue", "sensors.probes[0].value[0]"),
    Row("sensors.probeSecondary[0]", "sensors.probes[0].value[1]"),
    Row("sensors.fanRPM[]", "fans[].rpm"),
    Row("temps.current[]", "heat.heaters[].current"),
    Row("temps.state[]", "heat.heaters[].state", _heater_state),
    Row("temps.names", None),
    Row("temps.bed.heater", "heat.bedHeaters[0]"),
    Row("temps.bed.current", "heat.heaters[{temps.bed.heater}].current"),
    Row("temps.bed.active", "heat.heaters[{temps.bed.heater}].active"),
    Row("temps.bed.standby", "heat.heaters[{temps.bed.heater}].standby"),
    Row("temps.bed.state", "heat.heaters[{temps.bed.heater}].state", _heater_state),
    Row("temps.chamber.heater", "heat.chamberHeaters[0]"),
    Row("temps.chamber.current", "heat.heaters[{temps.chamber.heater}].current"),
    Row("temps.chamber.active", "heat.heaters[{temps.chamber.heater}].active"),
    Row("temps.chamber.standby", "heat.heaters[{temps.chamber.heater}].standby"),
    Row("temps.chamber.state", "heat.heaters[{temps.chamber.heater}].state", _heater_state),
    Row("temps.cabinet", None),
    Row("temps.heads", None),
    Row("temps.tools.active[]", "tools[].active"),
    Row("temps.tools.standby[]", "tools[].standby"),
    Row("temps.extra[].name", "sensors.analog[].name"),
    Row("temps.extra[].temp", "sensors.analog[].lastReading"),
    Row("time", "state.upTime", int),
    Row("spindles[].current", "spindles[].current"),
    Row("spindles[].active", "spindles[].active"),
    Row("laser", "move.currentMove.laserPwm", _fraction),
    Row("coldExtrudeTemp", "heat.coldExtrudeTemperature"),
    Row("coldRetractTemp", "heat.coldRetractTemperature"),
    # "None" and "Mesh" here
    Row("compensation", "move.compensation.type", lambda name: name.lower()),
    Row("controllableFans", None),
    Row("tempLimit", None),
    Row("endstops", None),
    Row("firmwareName", "boards[0].firmwareName"),
    Row("firmwareVersion", "boards[0].firmwareVersion"),
    Row("geometry", "move.kinematics.name"),
    Row("axes", None),
    Row("totalAxes", None),
    Row("axisNames[]", "move.axes[].letter"),
    Row("volumes", None),
    Row("mountedVolumes", None),
    Row("mode", "state.machineMode"),
    Row("name", "network.name"),
    Row("probe.threshold", "sensors.probes[0].threshold"),
    Row("probe.height", "sensors.probes[0].triggerHeight"),
    Row("probe.type", "sensors.probes[0].type"),
    Row("tools[].number", "tools[].number"),
    Row("tools[].name", "tools[].name"),
    Row("tools[].heaters", "tools[].heaters"),
    Row("tools[].drives", "tools[].extruders"),
    Row("tools[].axisMap", "tools[].axes"),
    Row("tools[].fans", "tools[].fans", _bits),
    Row("tools[].filament", "tools[].filament"),
    Row("tools[].spindle", "tools[].spindle"),
    Row("tools[].offsets", "tools[].offsets"),
    Row("mcutemp.min", "boards[0].mcuTemp.min"),
    Row("mcutemp.cur", "boards[0].mcuTemp.current"),
    Row("mcutemp.max", "boards[0].mcuTemp.max"),
    Row("vin.min", "boards[0].vIn.min"),
    Row("vin.cur", "boards[0].vIn.current"),
    Row("vin.max", "boards[0].vIn.max"),
    Row("v12.min", "boards[0].v12.min"),
    Row("v12.cur", "boards[0].v12.current"),
    Row("v12.max", "boards[0].v12.max"),
    Row("currentLayer", "job.layer"),
    Row("currentLayerTime", "job.layerTime"),
    Row("extrRaw[]", "move.extruders[].rawPosition"),
    Row("fractionPrinted", None),
    Row("filePosition", "job.filePosition"),
    Row("firstLayerDuration", "job.firstLayerDuration"),
    Row("firstLayerHeight", "job.file.firstLayerHeight"),
    Row("printDuration", "job.duration"),
    Row("warmUpDuration", "job.warmUpDuration"),
    Row("timesLeft.file", "job.timesLeft.file"),
    Row("timesLeft.filament", "job.timesLeft.filament"),
    Row("timesLeft.layer", "job.timesLeft.layer"),
    Row("seq", None),
    Row("resp", None),
)
"""S2, S3 and S4."""

CONFIG_FIELDS = (
    Row("axisMins[]", "move.axes[].min"),
    Row("axisMaxes[]", "move.axes[].max"),
    # one entry a drive, and only the first of them are axes for certain
    Row("accelerations[:axes]", "move.axes[].acceleration"),
    Row("currents[:axes]", "move.axes[].current"),
    Row("minFeedrates[:axes]", "move.axes[].jerk", _per_minute),
    Row("maxFeedrates[:axes]", "move.axes[].speed", _per_minute),
    Row("firmwareElectronics", "boards[0].name"),
    Row("firmwareName", "boards[0].firmwareName"),
    Row("boardName", "boards[0].shortName"),
    Row("firmwareVersion", "boards[0].firmwareVersion"),
    Row("dwsVersion", "network.interfaces[0].firmwareVersion"),
    Row("firmwareDate", "boards[0].firmwareDate"),
    Row("sysdir", "directories.system"),
    Row("idleCurrentFactor", "move.idle.factor", _fraction),
    Row("idleTimeout", "move.idle.timeout"),
)
"""S5."""
