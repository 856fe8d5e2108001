"""The machine's state, and the channels that commands come from."""

from __future__ import annotations

from .meaning import N_, Table

INPUTS: Table = (
    (
        "inputs[]",
        (
            ("active", "", N_("Whether it may give commands")),
            ("axesRelative", "", N_("Whether axes move relatively (G91)")),
            ("compatibility", "", N_("Firmware whose replies it gives")),
            ("distanceUnit", "", N_("Unit of distances in commands")),
            ("drivesRelative", "", N_("Whether extruders move relatively (M83)")),
            ("feedRate", "mm/s", N_("Speed of the next move")),
            ("inMacro", "", N_("Whether it runs a macro")),
            ("inverseTimeMode", "", N_("Whether speeds are times (G93)")),
            ("lineNumber", "", N_("Line that was read last")),
            ("macroRestartable", "", N_("Whether the macro can begin anew")),
            ("motionSystem", "", N_("Its motion system, by number")),
            ("name", "", N_("Name of the channel")),
            ("selectedPlane", "", N_("Plane of arcs: 0 XY, 1 XZ, 2 YZ")),
            ("stackDepth", "", N_("Saved states and macros under way")),
            ("state", "", N_("State of the channel")),
            ("volumetric", "", N_("Whether extrusion is in mm³")),
        ),
    ),
)

STATE: Table = (
    (
        "state",
        (
            ("atxPower", "", N_("Whether the power supply is on")),
            ("atxPowerPort", "", N_("Pin that switches the power supply")),
            ("beep", "", N_("Sound to be made")),
            ("currentTool", "", N_("Tool now, -1 for none")),
            ("deferredPowerDown", "", N_("Whether power goes off when cool")),
            ("displayMessage", "", N_("Message on the display (M117)")),
            ("gpOut", "", N_("Outputs for general use")),
            ("laserPwm", "0..1", N_("Laser power")),
            ("logFile", "", N_("Log file")),
            ("logLevel", "", N_("What is logged")),
            ("machineMode", "", N_("FFF printer, CNC or laser")),
            ("macroRestarted", "", N_("Whether the macro began anew")),
            ("messageBox", "", N_("Message that is open")),
            ("msUpTime", "ms", N_("Milliseconds of the time since the start")),
            ("nextTool", "", N_("Tool that is being selected, -1 for none")),
            ("powerFailScript", "", N_("Commands for a power failure")),
            ("previousTool", "", N_("Tool before this one, -1 for none")),
            ("restorePoints", "", N_("Saved positions")),
            ("startupError", "", N_("First error of the configuration")),
            ("status", "", N_("What the machine does")),
            ("thisActive", "", N_("Whether this channel may give commands")),
            ("thisInput", "", N_("Channel of this connection, by number")),
            ("time", "", N_("Date and time of the machine")),
            ("upTime", "s", N_("Time since the start")),
        ),
    ),
    (
        "state.beep",
        (
            ("duration", "ms", N_("Length of the sound")),
            ("frequency", "Hz", N_("Pitch of the sound")),
        ),
    ),
    (
        "state.gpOut[]",
        (("freq", "Hz", N_("PWM frequency")), ("pwm", "0..1", N_("Output now"))),
    ),
    (
        "state.messageBox",
        (
            ("axisControls", "", N_("Axes to jog, one bit each")),
            ("cancelButton", "", N_("Whether it can be cancelled")),
            ("choices", "", N_("Answers to choose from")),
            ("default", "", N_("Answer that is proposed")),
            ("max", "", N_("Highest number, or longest text")),
            ("message", "", N_("Text of the message")),
            ("min", "", N_("Lowest number, or shortest text")),
            ("mode", "", N_("Kind of the message, 0 to 7")),
            ("seq", "", N_("Number of the message")),
            ("timeout", "ms", N_("Closes after, 0 never")),
            ("title", "", N_("Title of the message")),
        ),
    ),
    (
        "state.restorePoints[]",
        (
            ("coords", "mm", N_("Position of each axis")),
            ("extruderPos", "mm", N_("Position of the extruder")),
            ("fanPwm", "0..1", N_("Speed of the print fan")),
            ("feedRate", "mm/s", N_("Speed of moves")),
            ("ioBits", "", N_("Output bits of laser and ports")),
            ("laserPwm", "0..1", N_("Laser power")),
            ("toolNumber", "", N_("Tool, -1 for none")),
        ),
    ),
    (
        "state.startupError",
        (
            ("file", "", N_("File with the error")),
            ("line", "", N_("Line with the error")),
            ("message", "", N_("What is wrong")),
        ),
    ),
)
