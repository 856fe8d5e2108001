"""What may be told of a machine: words and members that are the firmware's, not a person's.

All else is replaced (``anonymiser``): a list of what is secret would never be complete.
"""

from __future__ import annotations

import re

from ..model.marks import TABLE


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


WORDS = _words(
    """
    a about above absolute actual accelerometer accepted access active add additional adjust
    after again aborted all allowed already an and angle another answer any are as at attempt
    attempting auto available axes axis babystep back bad baud be because bed been before being
    below between board boards both box buffer buffers bus busy by byte bytes calibration can
    cancel cancelled cannot can't card center centre chamber change changed channel check
    checksum choose close closed code cold cold-extrude command commands complete completed
    computer config configuration configured connect connected connection connections continue
    control controller cooling could count crc created current currently cut data date dead
    debug default delete deleted delta density deployed detected deviation did didn't different
    digits directory disabled disconnected display distance do does doesn't done down drive
    driver drivers due duration during emergency empty enabled encoder end endstop endstops
    enough entry error errors ethernet event exceeded excursion execute executed exist exists
    expansion expected expired expression extra extrude extruder extruders extrusion factor
    failed failure fan fans fault faults feed feedrate few filament file files filling find
    finished firmware first flash flow folder for found free frequency from full function g-code
    gcode general get global ground grid had halt halted has have heat heated heater heaters
    heating height high home homed homing host idle if illegal in inactive incorrect index
    infinite info initial input insert inside insufficient integer internal interrupted into
    invalid io is isn't it its job kinematics known last layer layers length less level limit
    limits line lines list listed load loaded local locked log long loop lost low lower machine
    machines macro macros main many map maximum max may mb memory mesh message microstepping
    minimum min mismatch missing mm mode model monitor more motion motor motors mount mounted
    move movement moves moving multiple must name need needed needs negative network new next no
    not none noisy nor notification now nozzle null number object of off offset ok old on once
    one only open opened operation or order other out output outside over over-temperature
    overheat parameter parameters parse part password path pause paused per period phase pid pin
    pins please plus point points port position positive possible power pressure press print
    printed printer printing probe probed probing problem processing program protocol pulled pwm
    queue range raw reached read reading reads ready received recovery relative reload remaining
    remote removed replied reply report request required reset response restart restarted
    restore result resume resumed resuming retract retraction retry return returned rising run
    running same save saved sbc scan sd second seconds select selected send sending sensor
    sensors sent sequence serial server service set setting settings setup short should shorted
    shut shutdown shutting single size skipped slow so socket software some source space speed
    spindle stall stalled standard standby start started startup state status step steps still
    stop stopped stopping string success successful supply supported swap switch syntax system
    taken target temperature test text than that the their them then there thermistor these they
    this threshold through time timed timeout to too tool tools total travel trigger triggered
    true trying tuning two type under under-voltage unexpected unit unknown unload unloaded
    unmount until up update upload uploaded use used user using usb value values variable
    version via voltage volume wait waiting warning was were what when where which while whole
    wifi will with within without work write written wrong x y z yes zero you your vin
    short-to-ground excessive false autocalibration calibrated sleep webserver http telnet aux
    daemon queue2 file2 autopause lcd msg cool bang-bang bang gain temp reporting compensation
    axis/extruder event- heatup busy: echo recv resend not-a-number overflow underflow nan inf
    firmware_name firmware_version electronics firmware_date reprapfirmware duet begin not_sd
    sd-card prusaslicer superslicer orcaslicer bambustudio cura cura_steamengine simplify3d
    ideamaker slic3r kisslicer kiri:moto fusion freecad estlcam pathpilot marlin reprap
    timeouterror oserror valueerror typeerror keyerror indexerror runtimeerror attributeerror
    connectionreseterror connectionrefusederror connectionerror jsondecodeerror serialexception
    errno refused host's unreachable route resource temporarily unavailable permission denied
    """
)
"""Words of the firmware's and the plugin's own sentences, in lower case."""

_NUMBER = r"[-+]?\d{1,3}(?:\.\d{1,3})?(?:%|°C|mm|ms|s|min|C|V|A|Hz|K)?"
_VERSION = r"v?\d{1,2}\.\d{1,2}(?:\.\d{1,2})?(?:[-.+]?(?:alpha|beta|rc|b|a|dev)[-.]?\d{0,2})?"
_G_CODE = r"[GMT]-?\d{1,3}(?:\.\d)?"
_LETTERED = r"[A-Z](?:\d{1,2}:)?:?[-+]?\d{1,4}(?:\.\d{1,4})?"
_DRIVER = r"\d{1,3}\.\d{1,2}"

WORD = re.compile(
    "|".join((_NUMBER, _VERSION, _G_CODE, _LETTERED, _DRIVER, r"[A-Z]", r"\W+")), re.ASCII
)
"""What is told of a sentence besides ``WORDS``: short numbers with their units, versions, codes,
parameters and temperatures, single capitals, and what has no letter or digit in it."""

ADDRESS = re.compile(
    r"(?<![\w.])\d{1,3}(?:\.\d{1,3}){3}(?![\w])"
    r"|(?<![0-9A-Fa-f:])(?:[0-9A-Fa-f]{1,4}:){2,7}:?[0-9A-Fa-f]{1,4}(?![0-9A-Fa-f:])"
    r"|(?<![0-9A-Fa-f])[0-9A-Fa-f]{2}(?:[-:][0-9A-Fa-f]{2}){5}(?![0-9A-Fa-f])",
    re.ASCII,
)
"""An address of a network: IPv4, IPv6 or that of a device."""

SHAPE = re.compile(r"(?=.{1,60}\Z)[\w!^+(][\w .,+\-/()!^*]*", re.ASCII)
"""What a word of the firmware's looks like where only the firmware writes."""

DATE = re.compile(r"\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d(?::\d\d)?)?(?:b\d{1,2})?", re.ASCII)

MEMBER = re.compile(r"[A-Za-z_]\w{0,39}|\d{1,3}", re.ASCII)
"""What a member of the firmware's is called, or a number in such a place."""

KEPT = _words(
    """
    boards.bootloaderFileName boards.drivers.closedLoop boards.firmwareDate
    boards.firmwareFileName boards.firmwareName boards.firmwareVersion boards.iapFileNameSBC
    boards.iapFileNameSD boards.name boards.shortName boards.state boards.wifiFirmwareFileName
    boards.directDisplay.typeName heat.heaters.state heat.heaters.monitors.condition
    heat.heaters.type inputs.name inputs.state inputs.compatibility inputs.distanceUnit
    job.file.lastModified job.file.thumbnails.format ledStrips.type move.axes.letter
    move.axes.drivers move.extruders.driver move.kinematics.name move.compensation.type
    move.compensation.probeGrid.axes move.shaping.type network.interfaces.type
    network.interfaces.state network.interfaces.activeProtocols
    network.interfaces.firmwareVersion sensors.analog.type sensors.analog.port
    sensors.analog.state sensors.endstops.type sensors.filamentMonitors.type
    sensors.filamentMonitors.status spindles.state spindles.type state.status state.machineMode
    state.logLevel state.dsfVersion state.time state.atxPowerPort tools.state messages.time
    messages.type sbc.dsf.version sbc.dsf.buildDateTime status geometry firmwareName
    firmwareVersion firmwareDate date files.date files.type lastModified mode axisNames version
    protocol blocked link firmware.name firmware.version firmware.electronics firmware.date
    warnings.code warnings.level warnings.kind warnings.fix doing.what FIRMWARE_NAME
    FIRMWARE_VERSION ELECTRONICS FIRMWARE_DATE PROTOCOL_VERSION MACHINE_TYPE
    """
)
"""Members, by their names without places in lists, in which only the firmware or the plugin
writes."""

PATHS = _words(
    """
    directories.filaments directories.firmware directories.gCodes directories.macros
    directories.menu directories.scans directories.system directories.web job.file.fileName
    job.lastFileName state.logFile state.startupError.file move.compensation.file volumes.path
    dir fileName files files.name thumbnail.fileName simulated_file
    """
)
"""Members with a path of a file or a folder."""

TEXTS = _words(
    """
    state.displayMessage state.messageBox.message state.messageBox.title
    state.messageBox.choices state.startupError.message messages.content job.file.generatedBy
    generatedBy message msgBox.msg msgBox.title resp
    """
)
"""Members with sentences, of the firmware's or of a person's."""

PEOPLES = ("global", "plugins", "job.file.customInfo", "customInfo", "data", "sbc.data")
"""Below these a person has named everything, and every value is somebody's own."""

KINDS = {
    "uniqueId": "id",
    "id": "id",
    "serial": "id",
    "mac": "address",
    "actualIP": "address",
    "configuredIP": "address",
    "gateway": "address",
    "subnet": "address",
    "dnsServer": "address",
    "hostname": "host",
    "ssid": "network",
    "name": "name",
    "myName": "name",
    "filament": "filament",
}
"""What a text is called that is replaced, by its member; others are ``text``."""

MEMBERS = frozenset(
    name
    for path in (*KEPT, *PATHS, *TEXTS, *(f"{row} {members}" for row, members in TABLE))
    for name in re.findall(r"\w+", path)
) | frozenset(("key", "flags", "result", "next", "err", "line"))
"""Members known to be the firmware's, for replies that can't be read."""
