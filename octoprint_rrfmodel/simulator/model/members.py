"""Which object model members exist in which RepRapFirmware versions.

From the objectModelTable arrays of RRF 3.3, 3.4, 3.5 and 3.6.0-beta.1. A member that isn't listed
is in all of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..firmware import Firmware, Release, is_within

SINCE_34: Release = (3, 4)
SINCE_35: Release = (3, 5)
SINCE_36: Release = (3, 6)
UNTIL_33: Release = (3, 4)
UNTIL_34: Release = (3, 5)
UNTIL_35: Release = (3, 6)

_NEW = {
    SINCE_34: """
        boards[].accelerometer boards[].wifiFirmwareFileName fans[].frequency
        heat.heaters[].avgPwm heat.heaters[].model.coolingExp heat.heaters[].model.coolingRate
        heat.heaters[].model.fanCoolingRate inputs[].inMacro inputs[].macroRestartable
        job.file.thumbnails move.compensation.liveGrid
        move.axes[].percentCurrent move.axes[].percentStstCurrent
        move.extruders[].percentCurrent move.extruders[].percentStstCurrent
        move.kinematics.segmentation move.limitAxes move.noMovesBeforeHoming move.rotation
        move.shaping.amplitudes network.interfaces[].ssid spindles[].canReverse
        state.atxPowerPort state.deferredPowerDown state.macroRestarted state.thisInput
        tools[].feedForward tools[].isRetracted volumes[].partitionSize
    """,
    SINCE_35: """
        boards[].drivers boards[].freeRam fans[].tachoPpr
        heat.heaters[].maxBadReadings heat.heaters[].maxHeatingFaultTime
        heat.heaters[].maxTempExcursion heat.heaters[].monitors[].sensor
        inputs[].active inputs[].inverseTimeMode inputs[].motionSystem inputs[].selectedPlane
        fans[].thermostatic.sensors
        job.lastWarmUpDuration ledStrips limits.ledStrips limits.portsPerHeater
        move.axes[].backlash move.axes[].reducedAcceleration move.backlashFactor
        move.shaping.reductionLimit move.currentMove.extrusionRate
        move.extruders[].filamentDiameter move.keepout
        sensors.analog[].offsetAdj sensors.analog[].slopeAdj sensors.analog[].state
        sensors.analog[].port sensors.analog[].beta sensors.analog[].c sensors.analog[].r25
        sensors.analog[].rRef sensors.endstops[].probe sensors.filamentMonitors[].enableMode
        sensors.filamentMonitors[].status sensors.probes[].diveHeights
        sensors.probes[].isCalibrated sensors.probes[].measuredHeight
        sensors.probes[].scanCoefficients spindles[].idlePwm spindles[].maxPwm
        spindles[].minPwm state.gpOut[].freq state.startupError state.thisActive
        state.messageBox.cancelButton state.messageBox.choices state.messageBox.default
        state.messageBox.max state.messageBox.min seqs.ledStrips
    """,
    SINCE_36: """
        job.file.customInfo move.axes[].printingJerk move.extruders[].printingJerk
        move.shaping.delays
    """,
}

_OLD = {
    UNTIL_33: """
        heat.heaters[].model.gain heat.heaters[].model.timeConstant
        heat.heaters[].model.timeConstantFansOn job.file.firstLayerHeight
        move.shaping.minimumAcceleration
    """,
    UNTIL_34: """
        move.compensation.probeGrid.xMax move.compensation.probeGrid.xMin
        move.compensation.probeGrid.xSpacing move.compensation.probeGrid.yMax
        move.compensation.probeGrid.yMin move.compensation.probeGrid.ySpacing
        directories.scans job.firstLayerDuration job.timesLeft.layer move.workspaceNumber
        scanner seqs.scanner sensors.probes[].speed sensors.probes[].temperatureCoefficient
    """,
    UNTIL_35: """
        move.shaping.durations move.shaping.reductionLimit
    """,
}


def _table() -> dict[str, tuple[Release | None, Release | None]]:
    table: dict[str, tuple[Release | None, Release | None]] = {}
    for since, paths in _NEW.items():
        for path in paths.split():
            table[path] = (since, None)
    for until, paths in _OLD.items():
        for path in paths.split():
            table[path] = (table.get(path, (None, None))[0], until)
    return table


MEMBERS = _table()
"""Path → first release that has the member, first release that has it no longer."""


def exists(path: str, firmware: Firmware) -> bool:
    """Return whether that firmware has the member; unlisted ones always exist."""
    since, until = MEMBERS.get(path, (None, None))
    return is_within(firmware.release, since, until)


def for_firmware(value: Any, firmware: Firmware, path: str = "") -> Any:
    """Return a copy of the model with only the members that this firmware has."""
    if isinstance(value, Mapping):
        below = f"{path}." if path else ""
        return {
            name: for_firmware(member, firmware, below + name)
            for name, member in value.items()
            if exists(below + name, firmware)
        }
    if isinstance(value, list):
        return [for_firmware(element, firmware, path + "[]") for element in value]
    return value
