"""The top-level keys, and those whose members are all alike."""

from __future__ import annotations

from .meaning import N_, Table

ROOTS: Table = (
    (
        "",
        (
            ("boards", "", N_("Main board and expansion boards")),
            ("directories", "", N_("Folders on the card")),
            ("fans", "", N_("Fans")),
            ("global", "", N_("Variables of the machine's own macros")),
            ("heat", "", N_("Heaters, beds and chambers")),
            ("inputs", "", N_("Channels that commands come from")),
            ("job", "", N_("The machine's own print job")),
            ("ledStrips", "", N_("LED strips")),
            ("limits", "", N_("What the firmware has room for")),
            ("move", "", N_("Axes, extruders and motion")),
            ("network", "", N_("Network")),
            ("scanner", "", N_("3D scanner")),
            ("sensors", "", N_("Sensors, endstops and probes")),
            ("seqs", "", N_("Counters of changes")),
            ("spindles", "", N_("Spindles")),
            ("state", "", N_("State of the machine")),
            ("tools", "", N_("Tools")),
            ("volumes", "", N_("Cards and other storage")),
        ),
    ),
    (
        "directories",
        (
            ("filaments", "", N_("Folder of the filaments")),
            ("firmware", "", N_("Folder of firmware files")),
            ("gCodes", "", N_("Folder of print files")),
            ("macros", "", N_("Folder of macros")),
            ("menu", "", N_("Folder of the display's menus")),
            ("scans", "", N_("Folder of scans")),
            ("system", "", N_("Folder of the configuration")),
            ("web", "", N_("Folder of the machine's own page")),
        ),
    ),
    (
        "limits",
        (
            (
                "axes axesPlusExtruders bedHeaters boards chamberHeaters drivers driversPerAxis"
                " extruders extrudersPerTool fans gpInPorts gpOutPorts heaters heatersPerTool"
                " ledStrips monitorsPerHeater portsPerHeater restorePoints sensors spindles tools"
                " trackedObjects triggers volumes workplaces zProbeProgramBytes zProbes",
                "",
                N_("Highest number that the firmware has room for"),
            ),
        ),
    ),
    (
        "scanner",
        (
            ("progress", "", N_("Progress of the scan")),
            ("status", "", N_("State of the scanner")),
        ),
    ),
    (
        "seqs",
        (
            (
                "boards directories fans global heat inputs job ledStrips move network scanner"
                " sensors spindles state tools volumes",
                "",
                N_("Counts the changes of this key, those of live values aside"),
            ),
            ("reply", "", N_("Counts the replies to commands")),
            ("volChanges", "", N_("Counts the changes of files on each volume")),
        ),
    ),
)
