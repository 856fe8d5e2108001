"""Which members of the object model are live, important, verbose or obsolete.

``TABLE`` is read like the firmware's own ``objectModelTable`` arrays: one row an object, its
members behind it, each with its marks as suffix signs. Where the firmware's versions differ the
row follows 3.5, since an older or newer board simply lacks the member.

Source: RepRapFirmware 3.3 to 3.6.0-beta.1, the objectModelTable arrays of RepRap.cpp,
Platform.cpp, Move.cpp, Heat.cpp, Heater.cpp, Tool.cpp, Fan.cpp, PrintMonitor.cpp,
GCodeBuffer.cpp, MassStorage.cpp, EndstopsManager.cpp and the files they include.
"""

from __future__ import annotations

from collections.abc import Mapping

SIGNS = {"*": "live", "!": "important", "+": "verbose", "-": "obsolete"}
"""Suffix sign in ``TABLE`` to the mark it stands for."""

TABLE: tuple[tuple[str, str], ...] = (
    (
        "",
        "boards* directories fans* global heat* inputs* job* ledStrips limits move* network"
        " scanner sensors* seqs* spindles* state* tools* volumes",
    ),
    (
        "boards[]",
        "accelerometer canAddress closedLoop directDisplay drivers* firmwareDate"
        " firmwareFileName firmwareName firmwareVersion freeRam* iapFileNameSBC iapFileNameSD"
        " inductiveSensor maxHeaters+ maxMotors+ mcuTemp* name shortName state"
        " supportsDirectDisplay+ uniqueId v12* vIn* wifiFirmwareFileName",
    ),
    ("boards[].accelerometer", "orientation points runs"),
    ("boards[].closedLoop", "points runs"),
    ("boards[].drivers[]", "closedLoop* status*"),
    ("boards[].drivers[].closedLoop", "currentFraction* positionError*"),
    ("boards[].drivers[].closedLoop.currentFraction", "avg* max*"),
    ("boards[].drivers[].closedLoop.positionError", "max* rms*"),
    ("boards[].mcuTemp", "current* max min"),
    ("boards[].v12", "current* max min"),
    ("boards[].vIn", "current* max min"),
    ("directories", "filaments+ firmware+ gCodes+ macros+ menu+ scans+ system web+"),
    (
        "fans[]",
        "actualValue* blip frequency max min name requestedValue* rpm* tachoPpr thermostatic",
    ),
    ("fans[].thermostatic", "heaters- highTemperature lowTemperature sensors"),
    (
        "heat",
        "bedHeaters chamberHeaters coldExtrudeTemperature coldRetractTemperature heaters*",
    ),
    (
        "heat.heaters[]",
        "active* avgPwm* current* max maxBadReadings maxHeatingFaultTime maxTempExcursion min"
        " model+ monitors sensor standby* state*",
    ),
    ("heat.heaters[].monitors[]", "action condition limit sensor"),
    (
        "heat.heaters[].model",
        "coolingExp coolingRate deadTime enabled fanCoolingRate gain heatingRate inverted"
        " maxPwm pid standardVoltage timeConstant timeConstantFansOn",
    ),
    ("heat.heaters[].model.pid", "d i overridden p used"),
    (
        "inputs[]",
        "active* axesRelative compatibility distanceUnit drivesRelative feedRate* inMacro*"
        " inverseTimeMode lineNumber* macroRestartable motionSystem* name selectedPlane"
        " stackDepth state* volumetric",
    ),
    (
        "job",
        "build* duration* file filePosition* firstLayerDuration- lastDuration lastFileName"
        " lastWarmUpDuration layer* layerTime* pauseDuration* rawExtrusion* timesLeft*"
        " warmUpDuration*",
    ),
    ("job.build", "currentObject* m486Names m486Numbers objects"),
    ("job.build.objects[]", "cancelled name x y"),
    (
        "job.file",
        "customInfo filament fileName firstLayerHeight generatedBy height lastModified"
        " layerHeight numLayers printTime simulatedTime size thumbnails",
    ),
    ("job.file.thumbnails[]", "format height offset size width"),
    ("job.timesLeft", "filament* file* layer- slicer*"),
    ("ledStrips[]", "board pin stopMovement type"),
    (
        "limits",
        "axes+ axesPlusExtruders+ bedHeaters+ boards+ chamberHeaters+ drivers+ driversPerAxis+"
        " extruders+ extrudersPerTool+ fans+ gpInPorts+ gpOutPorts+ heaters+ heatersPerTool+"
        " ledStrips+ monitorsPerHeater+ portsPerHeater+ restorePoints+ sensors+ spindles+"
        " tools+ trackedObjects+ triggers+ volumes+ workplaces+ zProbeProgramBytes+ zProbes+",
    ),
    (
        "move",
        "axes* backlashFactor calibration compensation currentMove* extruders* idle keepout"
        " kinematics limitAxes noMovesBeforeHoming printingAcceleration queue rotation shaping"
        " speedFactor travelAcceleration virtualEPos* workplaceNumber workspaceNumber-",
    ),
    (
        "move.axes[]",
        "acceleration babystep backlash current drivers homed jerk letter machinePosition* max"
        " maxProbed microstepping min minProbed percentCurrent percentStstCurrent printingJerk"
        " reducedAcceleration speed stepsPerMm userPosition* visible workplaceOffsets",
    ),
    ("move.axes[].microstepping", "interpolated value"),
    ("move.calibration", "final initial numFactors"),
    ("move.calibration.final", "deviation mean"),
    ("move.calibration.initial", "deviation mean"),
    ("move.compensation", "fadeHeight file liveGrid meshDeviation probeGrid skew type"),
    (
        "move.compensation.liveGrid",
        "axes maxs mins radius spacings xMax- xMin- xSpacing- yMax- yMin- ySpacing-",
    ),
    (
        "move.compensation.probeGrid",
        "axes maxs mins radius spacings xMax- xMin- xSpacing- yMax- yMin- ySpacing-",
    ),
    ("move.compensation.meshDeviation", "deviation mean"),
    ("move.compensation.skew", "compensateXY tanXY tanXZ tanYZ"),
    (
        "move.currentMove",
        "acceleration* deceleration* extrusionRate* laserPwm* requestedSpeed* topSpeed*",
    ),
    (
        "move.extruders[]",
        "acceleration current driver factor filament filamentDiameter jerk microstepping"
        " nonlinear percentCurrent percentStstCurrent position* pressureAdvance printingJerk"
        " rawPosition* speed stepsPerMm",
    ),
    ("move.extruders[].microstepping", "interpolated value"),
    ("move.extruders[].nonlinear", "a b upperLimit"),
    ("move.idle", "factor timeout"),
    ("move.keepout[]", "active coords"),
    ("move.keepout[].coords[]", "max min"),
    (
        "move.kinematics",
        "deltaRadius forwardMatrix homedHeight inverseMatrix name printRadius segmentation"
        " towers xTilt yTilt",
    ),
    ("move.kinematics.segmentation", "minSegLength segmentsPerSec"),
    ("move.kinematics.towers[]", "angleCorrection diagonal endstopAdjustment xPos yPos"),
    ("move.queue[]", "gracePeriod length"),
    ("move.rotation", "angle centre"),
    (
        "move.shaping",
        "amplitudes damping delays durations frequency minAcceleration minimumAcceleration"
        " reductionLimit type",
    ),
    ("network", "corsSite hostname interfaces name"),
    ("network.interfaces[]", "actualIP firmwareVersion gateway mac ssid state subnet type"),
    ("sensors", "analog* endstops* filamentMonitors* gpIn* probes*"),
    (
        "sensors.analog[]",
        "beta c lastReading* name offsetAdj port r25 rRef slopeAdj state type",
    ),
    ("sensors.endstops[]", "highEnd probe triggered* type"),
    ("sensors.filamentMonitors[]", "enableMode enabled- position* status* totalExtrusion* type"),
    ("sensors.gpIn[]", "value*"),
    (
        "sensors.probes[]",
        "calibrationTemperature deployedByUser disablesHeaters diveHeight- diveHeights"
        " isCalibrated lastStopHeight maxProbeCount measuredHeight* offsets recoveryTime"
        " scanCoefficients speed- speeds temperatureCoefficient- temperatureCoefficients"
        " threshold tolerance travelSpeed triggerHeight type value*",
    ),
    (
        "seqs",
        "boards* directories* fans* global* heat* inputs* job* ledStrips* move* network* reply*"
        " scanner* sensors* spindles* state* tools* volChanges* volumes*",
    ),
    (
        "spindles[]",
        "active canReverse current* frequency+ idlePwm+ max+ maxPwm+ min+ minPwm+ state*",
    ),
    (
        "state",
        "atxPower atxPowerPort beep currentTool* deferredPowerDown displayMessage gpOut*"
        " laserPwm* logFile logLevel machineMode macroRestarted messageBox! msUpTime* nextTool"
        " powerFailScript previousTool restorePoints startupError status* thisActive thisInput+"
        " time* upTime*",
    ),
    ("state.beep", "duration frequency"),
    ("state.gpOut[]", "freq pwm*"),
    (
        "state.messageBox",
        "axisControls! cancelButton! choices! default! max! message! min! mode! seq! timeout!"
        " title!",
    ),
    (
        "state.restorePoints[]",
        "coords extruderPos fanPwm feedRate ioBits laserPwm toolNumber",
    ),
    ("state.startupError", "file line message"),
    (
        "tools[]",
        "active* axes extruders fans feedForward filamentExtruder heaters isRetracted* mix name"
        " number offsets offsetsProbed retraction spindle spindleRpm standby* state*",
    ),
    ("tools[].retraction", "extraRestart length speed unretractSpeed zHop"),
    ("volumes[]", "capacity freeSpace mounted openFiles partitionSize path+ speed"),
)


def _read(table: tuple[tuple[str, str], ...]) -> dict[str, frozenset[str]]:
    """Return the mapping from member path (``heat.heaters[].current``) to its marks."""
    marks = {}
    for parent, members in table:
        for word in members.split():
            name = word.rstrip("".join(SIGNS))
            path = f"{parent}.{name}" if parent else name
            marks[path] = frozenset(SIGNS[sign] for sign in word[len(name) :])
    return marks


MARKS: Mapping[str, frozenset[str]] = _read(TABLE)
"""Path pattern (``[]`` for any element) to a set out of live, important, verbose, obsolete."""
