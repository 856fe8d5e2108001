"""Axes, extruders and how they move."""

from __future__ import annotations

from .meaning import N_, Table

_GRID = (
    ("axes", "", N_("The two axes of the grid")),
    ("maxs xMax yMax", "mm", N_("Where the grid ends")),
    ("mins xMin yMin", "mm", N_("Where the grid begins")),
    ("radius", "mm", N_("Radius of a round grid, -1 for none")),
    ("spacings xSpacing ySpacing", "mm", N_("Distance of the points")),
)

_DEVIATION = (
    ("deviation", "mm", N_("Deviation, root mean square")),
    ("mean", "mm", N_("Mean error")),
)

_MOTOR = (
    ("acceleration", "mm/s²", N_("Highest acceleration")),
    ("current", "mA", N_("Motor current, peak")),
    ("jerk", "mm/min", N_("Highest sudden change of speed")),
    ("percentCurrent", "%", N_("Motor current now, of the set one")),
    ("percentStstCurrent", "%", N_("Motor current at standstill")),
    ("printingJerk", "mm/min", N_("Highest sudden change of speed in prints")),
    ("speed", "mm/min", N_("Highest speed")),
    ("stepsPerMm", "steps/mm", N_("Steps for one millimetre")),
)

_MICROSTEPPING = (
    ("interpolated", "", N_("Whether the driver interpolates")),
    ("value", "", N_("Microsteps in a full step")),
)

MOVE: Table = (
    (
        "move",
        (
            ("axes", "", N_("Axes")),
            ("backlashFactor", "", N_("Moves of how many times the backlash make it up")),
            ("compensation", "", N_("Mesh and skew")),
            ("currentMove", "", N_("The move under way")),
            ("extruders", "", N_("Extruders")),
            ("keepout", "", N_("Zones that must not be entered")),
            ("kinematics", "", N_("Geometry of the machine")),
            ("limitAxes", "", N_("Whether axes stay within their limits")),
            ("noMovesBeforeHoming", "", N_("Whether axes must be homed first")),
            ("printingAcceleration", "mm/s²", N_("Highest acceleration in printing moves")),
            ("queue", "", N_("Queues of moves")),
            ("rotation", "", N_("Rotation of the coordinates")),
            ("shaping", "", N_("Input shaping")),
            ("speedFactor", "", N_("Speed factor; 1 is 100 %")),
            ("travelAcceleration", "mm/s²", N_("Highest acceleration in travel moves")),
            ("virtualEPos", "mm", N_("Position of the extruder that the file sees")),
            ("workplaceNumber", "", N_("Coordinate system; 0 is G54")),
            ("workspaceNumber", "", N_("Coordinate system; 1 is G54")),
        ),
    ),
    (
        "move.axes[]",
        (
            *_MOTOR,
            ("babystep", "mm", N_("Baby step offset")),
            ("backlash", "mm", N_("Backlash that is made up for")),
            ("drivers", "", N_("Its motor drivers: board and number")),
            ("homed", "", N_("Whether it is homed")),
            ("letter", "", N_("Letter of the axis")),
            ("machinePosition", "mm", N_("Position of the machine")),
            ("max", "mm", N_("Upper limit")),
            ("maxProbed", "", N_("Whether the upper limit was probed")),
            ("min", "mm", N_("Lower limit")),
            ("minProbed", "", N_("Whether the lower limit was probed")),
            ("reducedAcceleration", "mm/s²", N_("Highest acceleration in probing moves")),
            ("userPosition", "mm", N_("Position that the user sees")),
            ("visible", "", N_("Whether the axis is shown")),
            ("workplaceOffsets", "mm", N_("Offset in each coordinate system")),
        ),
    ),
    ("move.axes[].microstepping", _MICROSTEPPING),
    (
        "move.calibration",
        (("numFactors", "", N_("Values that the last calibration found")),),
    ),
    ("move.calibration.final", _DEVIATION),
    ("move.calibration.initial", _DEVIATION),
    (
        "move.compensation",
        (
            ("fadeHeight", "mm", N_("Height at which the mesh ends")),
            ("file", "", N_("File of the mesh")),
            ("liveGrid", "", N_("Grid of the mesh in use")),
            ("meshDeviation", "", N_("How uneven the bed is")),
            ("probeGrid", "", N_("Grid of the next probing")),
            ("type", "", N_("Kind of the compensation")),
        ),
    ),
    ("move.compensation.liveGrid", _GRID),
    ("move.compensation.probeGrid", _GRID),
    ("move.compensation.meshDeviation", _DEVIATION),
    (
        "move.compensation.skew",
        (
            ("compensateXY", "", N_("Whether X is corrected, not Y")),
            ("tanXY tanXZ tanYZ", "", N_("Tangent of the skew between the two axes")),
        ),
    ),
    (
        "move.currentMove",
        (
            ("acceleration", "mm/s²", N_("Acceleration of this move")),
            ("deceleration", "mm/s²", N_("Deceleration of this move")),
            ("extrusionRate", "mm/s", N_("Filament speed of this move")),
            ("laserPwm", "0..1", N_("Laser power of this move")),
            ("requestedSpeed", "mm/s", N_("Speed that was asked for")),
            ("topSpeed", "mm/s", N_("Highest speed of this move")),
        ),
    ),
    (
        "move.extruders[]",
        (
            *_MOTOR,
            ("driver", "", N_("Its motor driver: board and number")),
            ("factor", "", N_("Extrusion factor; 1 is 100 %")),
            ("filament", "", N_("Filament that is loaded")),
            ("filamentDiameter", "mm", N_("Diameter of the filament")),
            ("position", "mm", N_("Filament moved")),
            ("pressureAdvance", "s", N_("Pressure advance")),
            ("rawPosition", "mm", N_("Filament, without the extrusion factor")),
        ),
    ),
    ("move.extruders[].microstepping", _MICROSTEPPING),
    (
        "move.extruders[].nonlinear",
        (
            ("a b", "", N_("Coefficient of nonlinear extrusion")),
            ("upperLimit", "0..1", N_("Most that is added")),
        ),
    ),
    (
        "move.idle",
        (
            ("factor", "0..1", N_("Motor current when idle")),
            ("timeout", "s", N_("Idle from here on")),
        ),
    ),
    ("move.keepout[]", (("active", "", N_("Whether the zone is in use")),)),
    (
        "move.keepout[].coords[]",
        (("max", "mm", N_("Upper limit")), ("min", "mm", N_("Lower limit"))),
    ),
    (
        "move.kinematics",
        (
            ("deltaRadius", "mm", N_("Delta radius")),
            ("forwardMatrix", "", N_("From motors to axes")),
            ("homedHeight", "mm", N_("Height of the nozzle when homed")),
            ("inverseMatrix", "", N_("From axes to motors")),
            ("name", "", N_("Kind of the geometry")),
            ("printRadius", "mm", N_("Radius of the print area")),
            ("segmentation", "", N_("How moves are cut in segments")),
            ("xTilt yTilt", "", N_("Tilt of the bed, millimetres a millimetre")),
        ),
    ),
    (
        "move.kinematics.segmentation",
        (
            ("minSegLength", "mm", N_("Shortest segment")),
            ("segmentsPerSec", "1/s", N_("Segments a second")),
        ),
    ),
    (
        "move.kinematics.tiltCorrection",
        (
            ("correctionFactor", "", N_("Part of the error that is corrected at once")),
            ("lastCorrections", "mm", N_("Last correction at each screw")),
            ("maxCorrection", "mm", N_("Most that is corrected")),
            ("screwPitch", "mm", N_("Pitch of the levelling screws")),
            ("screwX screwY", "mm", N_("Position of each screw")),
        ),
    ),
    (
        "move.kinematics.towers[]",
        (
            ("angleCorrection", "°", N_("Correction of the tower's angle")),
            ("diagonal", "mm", N_("Length of the rod")),
            ("endstopAdjustment", "mm", N_("Correction of the endstop")),
            ("xPos yPos", "mm", N_("Position of the tower")),
        ),
    ),
    (
        "move.queue[]",
        (
            ("gracePeriod", "s", N_("Wait for more moves before starting")),
            ("length", "", N_("Moves that the queue can hold")),
        ),
    ),
    (
        "move.rotation",
        (
            ("angle", "°", N_("Angle of the rotation")),
            ("centre", "mm", N_("Centre of the rotation")),
        ),
    ),
    (
        "move.shaping",
        (
            ("amplitudes", "", N_("Amplitudes of the impulses")),
            ("damping", "", N_("Damping of the ringing")),
            ("delays", "s", N_("Delays of the impulses")),
            ("durations", "s", N_("Durations of the impulses")),
            ("frequency", "Hz", N_("Frequency of the ringing")),
            ("minAcceleration minimumAcceleration", "mm/s²", N_("No acceleration falls below")),
            ("reductionLimit", "0..1", N_("Most that acceleration is reduced to")),
            ("type", "", N_("Kind of the shaper")),
        ),
    ),
)
