"""Heaters and fans."""

from __future__ import annotations

from .meaning import N_, Table

FANS: Table = (
    (
        "fans[]",
        (
            ("actualValue", "0..1", N_("Speed now")),
            ("blip", "s", N_("Time at full speed when it starts")),
            ("frequency", "Hz", N_("PWM frequency")),
            ("max", "0..1", N_("Highest speed")),
            ("min", "0..1", N_("Lowest speed")),
            ("name", "", N_("Name of the fan")),
            ("requestedValue", "0..1", N_("Speed that was asked for")),
            ("rpm", "rpm", N_("Measured speed, -1 without a tacho")),
            ("tachoPpr", "", N_("Pulses of the tacho in one turn")),
        ),
    ),
    (
        "fans[].thermostatic",
        (
            ("heaters sensors", "", N_("Sensors that switch the fan, by number")),
            ("highTemperature", "°C", N_("Full speed from here on")),
            ("lowTemperature", "°C", N_("Switched on from here on")),
        ),
    ),
)

HEAT: Table = (
    (
        "heat",
        (
            ("bedHeaters", "", N_("Heater of each bed, -1 for none")),
            ("chamberHeaters", "", N_("Heater of each chamber, -1 for none")),
            ("coldExtrudeTemperature", "°C", N_("No extrusion below")),
            ("coldRetractTemperature", "°C", N_("No retraction below")),
            ("heaters", "", N_("Heaters by number")),
        ),
    ),
    (
        "heat.heaters[]",
        (
            ("active", "°C", N_("Target when active")),
            ("avgPwm", "0..1", N_("Heating power, average")),
            ("current", "°C", N_("Temperature now")),
            ("max", "°C", N_("Highest temperature allowed")),
            ("maxBadReadings", "", N_("Bad readings in a row before a fault")),
            ("maxHeatingFaultTime", "s", N_("Time too far from the target before a fault")),
            ("maxTempExcursion", "°C", N_("Distance from the target before a fault")),
            ("min", "°C", N_("Lowest temperature allowed")),
            ("sensor", "", N_("Its sensor, by number")),
            ("standby", "°C", N_("Target in standby")),
            ("state", "", N_("State of the heater")),
        ),
    ),
    (
        "heat.heaters[].monitors[]",
        (
            ("action", "", N_("What happens: 0 fault, 1 off, 2 off for a while, 3 shutdown")),
            ("condition", "", N_("When it acts")),
            ("limit", "°C", N_("Temperature at which it acts")),
            ("sensor", "", N_("Its sensor, by number")),
        ),
    ),
    (
        "heat.heaters[].model",
        (
            ("coolingExp", "", N_("Exponent of the cooling rate")),
            ("coolingRate", "°C/s", N_("Cooling rate 100 °C above the room's")),
            ("deadTime", "s", N_("Delay before the temperature follows")),
            ("enabled", "", N_("Whether the model is used")),
            ("fanCoolingRate", "°C/s", N_("Further cooling at full fan speed")),
            ("gain", "°C", N_("Rise at full power")),
            ("heatingRate", "°C/s", N_("Heating rate at full power")),
            ("inverted", "", N_("Whether the output is inverted")),
            ("maxPwm", "0..1", N_("Highest power")),
            ("standardVoltage", "V", N_("Supply voltage at the tuning")),
            ("timeConstant", "s", N_("Time constant, fans off")),
            ("timeConstantFansOn", "s", N_("Time constant, fans on")),
        ),
    ),
    (
        "heat.heaters[].model.pid",
        (
            ("d", "", N_("PID: derivative factor")),
            ("i", "", N_("PID: integral factor")),
            ("overridden", "", N_("Whether the factors were set by hand")),
            ("p", "", N_("PID: proportional factor")),
            ("used", "", N_("Whether PID is used")),
        ),
    ),
)
