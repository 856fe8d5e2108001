"""Sensors, endstops, filament monitors and probes."""

from __future__ import annotations

from .meaning import N_, Table

SENSORS: Table = (
    (
        "sensors",
        (
            ("analog", "", N_("Temperature and other sensors by number")),
            ("endstops", "", N_("Endstop of each axis")),
            ("filamentMonitors", "", N_("Filament monitor of each extruder")),
            ("gpIn", "", N_("Inputs for general use")),
            ("probes", "", N_("Probes")),
        ),
    ),
    (
        "sensors.analog[]",
        (
            ("beta", "K", N_("Thermistor: beta")),
            ("c", "", N_("Thermistor: Steinhart-Hart coefficient C")),
            ("lastReading", "°C", N_("Last reading")),
            ("name", "", N_("Name of the sensor")),
            ("offsetAdj", "°C", N_("Correction that is added")),
            ("port", "", N_("Pin that it is connected to")),
            ("r25", "Ω", N_("Thermistor: resistance at 25 °C")),
            ("rRef", "Ω", N_("Resistor in series")),
            ("slopeAdj", "", N_("Correction of the slope")),
            ("state", "", N_("State of the sensor")),
            ("type", "", N_("Kind of the sensor")),
        ),
    ),
    (
        "sensors.endstops[]",
        (
            ("highEnd", "", N_("Whether it is at the axis' upper end")),
            ("probe", "", N_("Probe that serves as endstop, by number")),
            ("triggered", "", N_("Whether it is triggered")),
            ("type", "", N_("Kind of the endstop")),
        ),
    ),
    (
        "sensors.filamentMonitors[]",
        (
            ("calibrated", "", N_("What was measured in prints")),
            ("enableMode", "", N_("0 off, 1 in the machine's own jobs, 2 always")),
            ("enabled", "", N_("Whether it is in use")),
            ("position", "", N_("Position of the encoder")),
            ("status", "", N_("State of the monitor")),
            ("totalExtrusion", "mm", N_("Filament moved")),
            ("type", "", N_("Kind of the monitor")),
        ),
    ),
    (
        "sensors.filamentMonitors[].configured",
        (
            ("allMoves", "", N_("Whether moves without printing count, too")),
            ("mmPerRev", "mm", N_("Filament for one turn")),
            ("percentMax", "%", N_("Highest movement allowed")),
            ("percentMin", "%", N_("Lowest movement allowed")),
            ("sampleDistance", "mm", N_("Filament between two comparisons")),
        ),
    ),
    ("sensors.gpIn[]", (("value", "", N_("0 or 1")),)),
    (
        "sensors.probes[]",
        (
            ("calibrationTemperature", "°C", N_("Temperature at the calibration")),
            ("deployedByUser", "", N_("Whether a user deployed it")),
            ("disablesHeaters", "", N_("Whether heaters are off when probing")),
            ("diveHeight diveHeights", "mm", N_("Height that probing starts from")),
            ("isCalibrated", "", N_("Whether it is calibrated")),
            ("lastStopHeight", "mm", N_("Height at which it triggered last")),
            ("maxProbeCount", "", N_("Most probings of a point")),
            ("measuredHeight", "mm", N_("Height of a scanning probe")),
            ("offsets", "mm", N_("Distance from the nozzle in X and Y")),
            ("recoveryTime", "s", N_("Wait before probing")),
            ("scanCoefficients", "", N_("Coefficients of a scanning probe")),
            ("speed speeds", "mm/min", N_("Speed of probing: first, then")),
            (
                "temperatureCoefficient temperatureCoefficients",
                "",
                N_("Change of the height with temperature"),
            ),
            ("threshold", "", N_("Value at which it triggers")),
            ("tolerance", "mm", N_("Difference allowed between probings")),
            ("travelSpeed", "mm/min", N_("Speed between points")),
            ("triggerHeight", "mm", N_("Height at which it triggers")),
            ("type", "", N_("Kind of the probe, by number")),
            ("value", "", N_("Value now")),
        ),
    ),
)
