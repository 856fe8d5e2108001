"""Boards, network, storage and LED strips."""

from __future__ import annotations

from .meaning import N_, Table

BOARDS: Table = (
    (
        "boards[]",
        (
            ("accelerometer", "", N_("Accelerometer of the board, if it has one")),
            ("canAddress", "", N_("Address on the CAN bus; 0 is the main board")),
            ("closedLoop", "", N_("Recording of closed-loop data, if the board can")),
            ("directDisplay", "", N_("Display that is wired to the board")),
            ("firmwareDate", "", N_("Date of the firmware")),
            ("firmwareFileName", "", N_("File to update the firmware from")),
            ("firmwareName", "", N_("Name of the firmware")),
            ("firmwareVersion", "", N_("Version of the firmware")),
            ("freeRam", "bytes", N_("Memory that was never used")),
            ("iapFileNameSBC iapFileNameSD", "", N_("File of the program that updates firmware")),
            ("inductiveSensor", "", N_("Inductive sensor of the board, if it has one")),
            ("maxHeaters", "", N_("Heaters that the board can control")),
            ("maxMotors", "", N_("Motors that the board can control")),
            ("mcuTemp", "", N_("Temperature of the processor")),
            ("name", "", N_("Name of the board")),
            ("shortName", "", N_("Short name of the board")),
            ("state", "", N_("State of the board")),
            ("supports12864 supportsDirectDisplay", "", N_("Whether a display can be connected")),
            ("uniqueId", "", N_("Serial number of the processor")),
            ("v12", "", N_("12 V supply, if the board measures it")),
            ("vIn", "", N_("Supply voltage, if the board measures it")),
            ("wifiFirmwareFileName", "", N_("File to update the WiFi module from")),
        ),
    ),
    (
        "boards[].accelerometer",
        (
            ("orientation", "", N_("How the accelerometer is mounted")),
            ("points", "", N_("Samples of the last recording")),
            ("runs", "", N_("Recordings since the start")),
        ),
    ),
    (
        "boards[].closedLoop",
        (
            ("points", "", N_("Samples of the last recording")),
            ("runs", "", N_("Recordings since the start")),
        ),
    ),
    ("boards[].drivers[]", (("status", "", N_("Status bits of the motor driver")),)),
    (
        "boards[].drivers[].closedLoop.currentFraction",
        (
            ("avg", "0..1", N_("Motor current, average")),
            ("max", "0..1", N_("Motor current, highest")),
        ),
    ),
    (
        "boards[].drivers[].closedLoop.positionError",
        (
            ("max", "steps", N_("Position error, highest")),
            ("rms", "steps", N_("Position error, root mean square")),
        ),
    ),
    (
        "boards[].mcuTemp",
        (
            ("current", "°C", N_("Temperature of the processor now")),
            ("max", "°C", N_("Highest temperature since the start")),
            ("min", "°C", N_("Lowest temperature since the start")),
        ),
    ),
    *(
        (
            supply,
            (
                ("current", "V", N_("Voltage now")),
                ("max", "V", N_("Highest voltage since the start")),
                ("min", "V", N_("Lowest voltage since the start")),
            ),
        )
        for supply in ("boards[].v12", "boards[].vIn")
    ),
)

LED_STRIPS: Table = (
    (
        "ledStrips[]",
        (
            ("board", "", N_("Board that the strip is wired to")),
            ("pin", "", N_("Pin that it is connected to")),
            ("stopMovement", "", N_("Whether motion must stop to write to it")),
            ("type", "", N_("Kind of the strip")),
        ),
    ),
)

NETWORK: Table = (
    (
        "network",
        (
            ("corsSite", "", N_("Site that may ask the machine from a browser")),
            ("hostname", "", N_("Name in the network")),
            ("interfaces", "", N_("Network adapters")),
            ("name", "", N_("Name of the machine")),
        ),
    ),
    (
        "network.interfaces[]",
        (
            ("actualIP", "", N_("Address now")),
            ("firmwareVersion", "", N_("Version of the WiFi module")),
            ("gateway", "", N_("Address of the gateway")),
            ("mac", "", N_("Hardware address")),
            ("ssid", "", N_("Name of the WiFi network")),
            ("state", "", N_("State of the connection")),
            ("subnet", "", N_("Network mask")),
            ("type", "", N_("Kind of the adapter")),
        ),
    ),
)

VOLUMES: Table = (
    (
        "volumes[]",
        (
            ("capacity", "bytes", N_("Size of the card")),
            ("freeSpace", "bytes", N_("Free space")),
            ("mounted", "", N_("Whether it is in use")),
            ("openFiles", "", N_("Whether files on it are open")),
            ("partitionSize", "bytes", N_("Size of the partition")),
            ("path", "", N_("Where it is in paths")),
            ("speed", "bytes/s", N_("Speed of the interface")),
        ),
    ),
)
