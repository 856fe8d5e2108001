"""Tools and spindles."""

from __future__ import annotations

from .meaning import N_, Table

SPINDLES: Table = (
    (
        "spindles[]",
        (
            ("active", "rpm", N_("Speed that was asked for")),
            ("canReverse", "", N_("Whether it can turn backwards")),
            ("current", "rpm", N_("Speed now")),
            ("frequency", "Hz", N_("PWM frequency")),
            ("idlePwm", "0..1", N_("Output when stopped")),
            ("max", "rpm", N_("Highest speed")),
            ("maxPwm", "0..1", N_("Output at the highest speed")),
            ("min", "rpm", N_("Lowest speed")),
            ("minPwm", "0..1", N_("Output at the lowest speed")),
            ("state", "", N_("State of the spindle")),
        ),
    ),
)

TOOLS: Table = (
    (
        "tools[]",
        (
            ("active", "°C", N_("Targets when active, one a heater")),
            ("axes", "", N_("Axes that take part in X and Y moves")),
            ("extruders", "", N_("Its extruders, by number")),
            ("fans", "", N_("Its fans, by number")),
            (
                "feedForward temperatureFeedForward",
                "",
                N_("Heating in advance for extrusion, one a heater"),
            ),
            ("filament", "", N_("Filament that is loaded")),
            ("filamentExtruder", "", N_("Extruder whose filament is the tool's")),
            ("heaters", "", N_("Its heaters, by number")),
            ("isRetracted", "", N_("Whether the filament is retracted")),
            ("mix", "", N_("Share of each extruder")),
            ("name", "", N_("Name of the tool")),
            ("number", "", N_("Number of the tool")),
            ("offsets", "mm", N_("Offset of each axis")),
            ("offsetsProbed", "", N_("Axes whose offset was probed, one bit each")),
            ("spindle", "", N_("Its spindle, -1 for none")),
            ("spindleRpm", "rpm", N_("Speed of its spindle")),
            ("standby", "°C", N_("Targets in standby, one a heater")),
            ("state", "", N_("State of the tool")),
        ),
    ),
    (
        "tools[].retraction",
        (
            ("extraRestart", "mm", N_("Filament that is added when it comes back")),
            ("length", "mm", N_("Filament that is retracted")),
            ("speed", "mm/s", N_("Speed of the retraction")),
            ("unretractSpeed", "mm/s", N_("Speed when it comes back")),
            ("zHop", "mm", N_("Lift while retracted")),
        ),
    ),
)
