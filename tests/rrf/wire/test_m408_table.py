"""Each member of an ``M408`` reply at its place in the object model, in the model's unit."""

import re

import pytest

from octoprint_rrfmodel.rrf.wire.m408 import M408Model
from octoprint_rrfmodel.rrf.wire.m408_table import CONFIG_FIELDS, LEGACY, STATUS_FIELDS

KEPT = "kept below m408"

# row -> members of a reply, path in the model (a step a name or an index), value there
LEGACY_ROWS = {
    "status": ({"status": "P"}, "state.status", "processing"),
    "heaters[]": ({"heaters": [21.4, 21.3]}, "heat.heaters.1.current", 21.3),
    "active[]": ({"active": [60.0, 210.0]}, "heat.heaters.1.active", 210.0),
    "standby[]": ({"standby": [0.0, 150.0]}, "heat.heaters.1.standby", 150.0),
    "hstat[]": ({"hstat": [2, 3]}, "heat.heaters.1.state", "fault"),
    "pos[]": ({"pos": [1.5, 2.5]}, "move.axes.1.userPosition", 2.5),
    "machine[]": ({"machine": [1.5, 3.5]}, "move.axes.1.machinePosition", 3.5),
    "sfactor": ({"sfactor": 150.0}, "move.speedFactor", 1.5),
    "efactor[]": ({"efactor": [95.0, 100.0]}, "move.extruders.0.factor", 0.95),
    "babystep": ({"babystep": 0.04}, "move.axes.2.babystep", 0.04),
    "tool": ({"tool": 2}, "state.currentTool", 2),
    "probe": ({"probe": "1000"}, "sensors.probes.0.value", [1000]),
    "fanPercent[1:]": ({"fanPercent": [30.0, 10.0, 55.0, -1]}, "fans.1.requestedValue", 0.55),
    "fanRPM[]": ({"fanRPM": [-1, 900], "fanPercent": [0, 0, 0]}, "fans.1.rpm", 900),
    "homed[]": ({"homed": [0, 1]}, "move.axes.1.homed", True),
    "fraction_printed": ({"fraction_printed": 0.5}, KEPT, 0.5),
    "msgBox.mode": ({"msgBox.mode": 2}, "state.messageBox.mode", 2),
    "msgBox.seq": ({"msgBox.seq": 7}, "state.messageBox.seq", 7),
    "msgBox.timeout": ({"msgBox.timeout": 5.0}, "state.messageBox.timeout", 5000),
    "msgBox.controls": ({"msgBox.controls": 4}, "state.messageBox.axisControls", 4),
    "msgBox.msg": ({"msgBox.msg": "go?"}, "state.messageBox.message", "go?"),
    "msgBox.title": ({"msgBox.title": "x"}, "state.messageBox.title", "x"),
    "timesLeft[0]": ({"timesLeft": [9.5, 8.5, 0.0]}, "job.timesLeft.file", 9.5),
    "timesLeft[1]": ({"timesLeft": [9.5, 8.5, 0.0]}, "job.timesLeft.filament", 8.5),
    "geometry": ({"geometry": "coreXY"}, "move.kinematics.name", "coreXY"),
    "axes": ({"axes": 3}, KEPT, 3),
    "totalAxes": ({"totalAxes": 4}, KEPT, 4),
    "axisNames[]": ({"axisNames": "XYZ"}, "move.axes.2.letter", "Z"),
    "volumes": ({"volumes": 2}, KEPT, 2),
    "numTools": ({"numTools": 1}, KEPT, 1),
    "myName": ({"myName": "Printer"}, "network.name", "Printer"),
    "firmwareName": ({"firmwareName": "RRF"}, "boards.0.firmwareName", "RRF"),
    "seq": ({"seq": 3}, KEPT, 3),
    "resp": ({"resp": "text"}, KEPT, "text"),
}


def temps(**members):
    return {"temps": members}


HEATER = {"current": 20.5, "active": 60.0, "standby": 40.0, "state": 1, "heater": 2}

STATUS_ROWS = {
    "status": ({"status": "A"}, "state.status", "cancelling"),
    "coords.axesHomed[]": ({"coords": {"axesHomed": [1, 0]}}, "move.axes.1.homed", False),
    "coords.wpl": ({"coords": {"wpl": 1}}, "move.workplaceNumber", 0),
    "coords.xyz[]": ({"coords": {"xyz": [1.0, 2.5]}}, "move.axes.1.userPosition", 2.5),
    "coords.machine[]": ({"coords": {"machine": [1.0, 3.5]}}, "move.axes.1.machinePosition", 3.5),
    "coords.extr[]": ({"coords": {"extr": [391.6]}}, "move.extruders.0.position", 391.6),
    "speeds.requested": ({"speeds": {"requested": 50.0}}, "move.currentMove.requestedSpeed", 50.0),
    "speeds.top": ({"speeds": {"top": 40.0}}, "move.currentMove.topSpeed", 40.0),
    "currentTool": ({"currentTool": -1}, "state.currentTool", -1),
    "output.beepDuration": ({"output": {"beepDuration": 100}}, "state.beep.duration", 100),
    "output.beepFrequency": ({"output": {"beepFrequency": 800}}, "state.beep.frequency", 800),
    "output.message": ({"output": {"message": "hi"}}, "state.displayMessage", "hi"),
    "output.msgBox.mode": ({"output": {"msgBox": {"mode": 3}}}, "state.messageBox.mode", 3),
    "output.msgBox.seq": ({"output": {"msgBox": {"seq": 4}}}, "state.messageBox.seq", 4),
    "output.msgBox.timeout": (
        {"output": {"msgBox": {"timeout": 0}}}, "state.messageBox.timeout", 0),
    "output.msgBox.controls": (
        {"output": {"msgBox": {"controls": 4}}}, "state.messageBox.axisControls", 4),
    "output.msgBox.msg": ({"output": {"msgBox": {"msg": "m"}}}, "state.messageBox.message", "m"),
    "output.msgBox.title": ({"output": {"msgBox": {"title": "t"}}}, "state.messageBox.title", "t"),
    "params.atxPower": ({"params": {"atxPower": 1}}, "state.atxPower", True),
    "params.fanPercent[]": ({"params": {"fanPercent": [0, 30]}}, "fans.1.requestedValue", 0.3),
    "params.fanNames[]": (
        {"params": {"fanPercent": [0], "fanNames": ["Part"]}}, "fans.0.name", "Part"),
    "params.speedFactor": ({"params": {"speedFactor": 50.0}}, "move.speedFactor", 0.5),
    "params.extrFactors[]": ({"params": {"extrFactors": [90.0]}}, "move.extruders.0.factor", 0.9),
    "params.babystep": ({"params": {"babystep": -0.02}}, "move.axes.2.babystep", -0.02),
    "sensors.probeValue": ({"sensors": {"probeValue": 500}}, "sensors.probes.0.value.0", 500),
    "sensors.probeSecondary[0]": (
        {"sensors": {"probeValue": 1, "probeSecondary": [12]}}, "sensors.probes.0.value.1", 12),
    "sensors.fanRPM[]": (
        {"sensors": {"fanRPM": [1200]}, "params": {"fanPercent": [0]}}, "fans.0.rpm", 1200),
    "temps.current[]": (temps(current=[21.4, 2000.0]), "heat.heaters.1.current", 2000.0),
    "temps.state[]": (temps(state=[0, 4]), "heat.heaters.1.state", "tuning"),
    "temps.names": (temps(names=["", "a"]), KEPT, ["", "a"]),
    "temps.bed.heater": (temps(bed=HEATER), "heat.bedHeaters.0", 2),
    "temps.bed.current": (temps(bed=HEATER), "heat.heaters.2.current", 20.5),
    "temps.bed.active": (temps(bed=HEATER), "heat.heaters.2.active", 60.0),
    "temps.bed.standby": (temps(bed=HEATER), "heat.heaters.2.standby", 40.0),
    "temps.bed.state": (temps(bed=HEATER), "heat.heaters.2.state", "standby"),
    "temps.chamber.heater": (temps(chamber=HEATER), "heat.chamberHeaters.0", 2),
    "temps.chamber.current": (temps(chamber=HEATER), "heat.heaters.2.current", 20.5),
    "temps.chamber.active": (temps(chamber=HEATER), "heat.heaters.2.active", 60.0),
    "temps.chamber.standby": (temps(chamber=HEATER), "heat.heaters.2.standby", 40.0),
    "temps.chamber.state": (temps(chamber=HEATER), "heat.heaters.2.state", "standby"),
    "temps.cabinet": (temps(cabinet=HEATER), KEPT, HEATER),
    "temps.heads": (temps(heads={"current": [1.0]}), KEPT, {"current": [1.0]}),
    "temps.tools.active[]": (temps(tools={"active": [[1.0], [210.0]]}), "tools.1.active", [210.0]),
    "temps.tools.standby[]": (temps(tools={"standby": [[1.0], [9.0]]}), "tools.1.standby", [9.0]),
    "temps.extra[].name": (temps(extra=[{"name": "MCU"}]), "sensors.analog.0.name", "MCU"),
    "temps.extra[].temp": (temps(extra=[{"temp": 37.8}]), "sensors.analog.0.lastReading", 37.8),
    "time": ({"time": 1423.0}, "state.upTime", 1423),
    "spindles[].current": ({"spindles": [{"current": 8.0}]}, "spindles.0.current", 8.0),
    "spindles[].active": ({"spindles": [{"active": 9.0}]}, "spindles.0.active", 9.0),
    "laser": ({"laser": 25.0}, "move.currentMove.laserPwm", 0.25),
    "coldExtrudeTemp": ({"coldExtrudeTemp": 160.0}, "heat.coldExtrudeTemperature", 160.0),
    "coldRetractTemp": ({"coldRetractTemp": 90.0}, "heat.coldRetractTemperature", 90.0),
    "compensation": ({"compensation": "Mesh"}, "move.compensation.type", "mesh"),
    "controllableFans": ({"controllableFans": 1}, KEPT, 1),
    "tempLimit": ({"tempLimit": 290.0}, KEPT, 290.0),
    "endstops": ({"endstops": 4092}, KEPT, 4092),
    "firmwareName": ({"firmwareName": "RRF"}, "boards.0.firmwareName", "RRF"),
    "firmwareVersion": ({"firmwareVersion": "3.0"}, "boards.0.firmwareVersion", "3.0"),
    "geometry": ({"geometry": "delta"}, "move.kinematics.name", "delta"),
    "axes": ({"axes": 3}, KEPT, 3),
    "totalAxes": ({"totalAxes": 3}, KEPT, 3),
    "axisNames[]": ({"axisNames": "XYU"}, "move.axes.2.letter", "U"),
    "volumes": ({"volumes": 2}, KEPT, 2),
    "mountedVolumes": ({"mountedVolumes": 1}, KEPT, 1),
    "mode": ({"mode": "FFF"}, "state.machineMode", "FFF"),
    "name": ({"name": "CR-10"}, "network.name", "CR-10"),
    "probe.threshold": ({"probe": {"threshold": 500}}, "sensors.probes.0.threshold", 500),
    "probe.height": ({"probe": {"height": 0.7}}, "sensors.probes.0.triggerHeight", 0.7),
    "probe.type": ({"probe": {"type": 8}}, "sensors.probes.0.type", 8),
    "tools[].number": ({"tools": [{"number": 3}]}, "tools.0.number", 3),
    "tools[].name": ({"tools": [{"name": "a"}]}, "tools.0.name", "a"),
    "tools[].heaters": ({"tools": [{"heaters": [1, 2]}]}, "tools.0.heaters", [1, 2]),
    "tools[].drives": ({"tools": [{"drives": [0]}]}, "tools.0.extruders", [0]),
    "tools[].axisMap": ({"tools": [{"axisMap": [[0], [1]]}]}, "tools.0.axes", [[0], [1]]),
    "tools[].fans": ({"tools": [{"fans": 5}]}, "tools.0.fans", [0, 2]),
    "tools[].filament": ({"tools": [{"filament": "PLA"}]}, "tools.0.filament", "PLA"),
    "tools[].spindle": ({"tools": [{"spindle": -1}]}, "tools.0.spindle", -1),
    "tools[].offsets": ({"tools": [{"offsets": [0.5, 1]}]}, "tools.0.offsets", [0.5, 1]),
    "mcutemp.min": ({"mcutemp": {"min": 17.3}}, "boards.0.mcuTemp.min", 17.3),
    "mcutemp.cur": ({"mcutemp": {"cur": 25.5}}, "boards.0.mcuTemp.current", 25.5),
    "mcutemp.max": ({"mcutemp": {"max": 25.7}}, "boards.0.mcuTemp.max", 25.7),
    "vin.min": ({"vin": {"min": 0.2}}, "boards.0.vIn.min", 0.2),
    "vin.cur": ({"vin": {"cur": 12.0}}, "boards.0.vIn.current", 12.0),
    "vin.max": ({"vin": {"max": 12.3}}, "boards.0.vIn.max", 12.3),
    "v12.min": ({"v12": {"min": 0.2}}, "boards.0.v12.min", 0.2),
    "v12.cur": ({"v12": {"cur": 12.0}}, "boards.0.v12.current", 12.0),
    "v12.max": ({"v12": {"max": 12.3}}, "boards.0.v12.max", 12.3),
    "currentLayer": ({"currentLayer": 36}, "job.layer", 36),
    "currentLayerTime": ({"currentLayerTime": 2.7}, "job.layerTime", 2.7),
    "extrRaw[]": ({"extrRaw": [394.9]}, "move.extruders.0.rawPosition", 394.9),
    "fractionPrinted": ({"fractionPrinted": 28.2}, KEPT, 28.2),
    "filePosition": ({"filePosition": 77}, "job.filePosition", 77),
    "firstLayerDuration": ({"firstLayerDuration": 256.1}, "job.firstLayerDuration", 256.1),
    "firstLayerHeight": ({"firstLayerHeight": 0.2}, "job.file.firstLayerHeight", 0.2),
    "printDuration": ({"printDuration": 528.9}, "job.duration", 528.9),
    "warmUpDuration": ({"warmUpDuration": 28.3}, "job.warmUpDuration", 28.3),
    "timesLeft.file": ({"timesLeft": {"file": 626.4}}, "job.timesLeft.file", 626.4),
    "timesLeft.filament": ({"timesLeft": {"filament": 421.7}}, "job.timesLeft.filament", 421.7),
    "timesLeft.layer": ({"timesLeft": {"layer": 452.0}}, "job.timesLeft.layer", 452.0),
    "seq": ({"seq": 11}, KEPT, 11),
    "resp": ({"resp": "x"}, KEPT, "x"),
}  # fmt: skip

CONFIG_ROWS = {
    "axisMins[]": ({"axisMins": [0.0, -5.0]}, "move.axes.1.min", -5.0),
    "axisMaxes[]": ({"axisMaxes": [326.0, 311.7]}, "move.axes.1.max", 311.7),
    "accelerations[:axes]": (
        {"axisMins": [0, 0], "accelerations": [2000.0, 20.0, 500.0]},
        "move.axes.1.acceleration",
        20.0,
    ),
    "currents[:axes]": (
        {"axisMins": [0, 0], "currents": [1200, 1500, 800]}, "move.axes.1.current", 1500),
    # mm/s here, mm/min in the model
    "minFeedrates[:axes]": (
        {"axisMins": [0, 0], "minFeedrates": [16.67, 0.2, 2.0]}, "move.axes.1.jerk", 12.0),
    "maxFeedrates[:axes]": (
        {"axisMins": [0, 0], "maxFeedrates": [150.0, 60.0, 30.0]}, "move.axes.0.speed", 9000.0),
    "firmwareElectronics": ({"firmwareElectronics": "Duet WiFi"}, "boards.0.name", "Duet WiFi"),
    "firmwareName": ({"firmwareName": "RRF"}, "boards.0.firmwareName", "RRF"),
    "boardName": ({"boardName": "2WiFi"}, "boards.0.shortName", "2WiFi"),
    "firmwareVersion": ({"firmwareVersion": "3.0"}, "boards.0.firmwareVersion", "3.0"),
    "dwsVersion": ({"dwsVersion": "1.23"}, "network.interfaces.0.firmwareVersion", "1.23"),
    "firmwareDate": ({"firmwareDate": "2020-01-03b3"}, "boards.0.firmwareDate", "2020-01-03b3"),
    "sysdir": ({"sysdir": "0:/sys/"}, "directories.system", "0:/sys/"),
    "idleCurrentFactor": ({"idleCurrentFactor": 30.0}, "move.idle.factor", 0.3),
    "idleTimeout": ({"idleTimeout": 30.0}, "move.idle.timeout", 30.0),
}  # fmt: skip

# form -> its rows, what makes a reply one of this form, what is expected of each row
FORMS = {
    "S0, S1": (LEGACY, {"heaters": []}, LEGACY_ROWS),
    "S2 to S4": (STATUS_FIELDS, {}, STATUS_ROWS),
    "S5": (CONFIG_FIELDS, {}, CONFIG_ROWS),
}

# members of the forms as the firmware's documentation of them lists these
DOCUMENTED = {
    "S0, S1": """status heaters active standby hstat pos machine sfactor efactor babystep tool probe
        fanPercent fanRPM homed fraction_printed msgBox.mode msgBox.seq msgBox.timeout
        msgBox.controls msgBox.msg msgBox.title timesLeft geometry axes totalAxes axisNames volumes
        numTools myName firmwareName""",
    "S2 to S4": """status coords.axesHomed coords.wpl coords.xyz coords.machine coords.extr
        speeds.requested speeds.top currentTool output.beepDuration output.beepFrequency
        output.message output.msgBox params.atxPower params.fanPercent params.speedFactor
        params.extrFactors params.babystep sensors.probeValue sensors.probeSecondary sensors.fanRPM
        temps.bed.current temps.bed.active temps.bed.standby temps.bed.state temps.bed.heater
        temps.chamber temps.cabinet temps.current temps.state temps.tools.active
        temps.tools.standby temps.extra.name temps.extra.temp time spindles laser
        coldExtrudeTemp coldRetractTemp compensation controllableFans tempLimit endstops
        params.fanNames temps.names firmwareName firmwareVersion geometry axes totalAxes axisNames
        volumes mountedVolumes mode name probe.threshold probe.height probe.type tools.number
        tools.name tools.heaters tools.drives tools.axisMap tools.fans tools.filament tools.spindle
        tools.offsets mcutemp vin v12 currentLayer currentLayerTime extrRaw fractionPrinted
        filePosition printDuration warmUpDuration timesLeft""",
    "S5": """axisMins axisMaxes accelerations currents firmwareElectronics firmwareName boardName
        firmwareVersion dwsVersion firmwareDate sysdir idleCurrentFactor idleTimeout minFeedrates
        maxFeedrates""",
}

ROWS = [
    pytest.param(form, row.field, id=f"{form}-{row.field}")
    for form, (rows, _, _) in FORMS.items()
    for row in rows
]


def at(model, path):
    for step in path.split("."):
        model = model[int(step)] if isinstance(model, list) else model[step]
    return model


@pytest.mark.parametrize(("form", "field"), ROWS)
def test_member_is_at_its_place_in_the_models_unit(form, field):
    rows, mark, expected = FORMS[form]
    members, path, value = expected[field]
    reply = dict(members) if form == "S5" else {"status": "I", **mark, **members}
    model = M408Model().take(reply)
    if path is KEPT:
        path = "m408." + field
        assert next(row.path for row in rows if row.field == field) is None
    got = at(model, path)
    assert got == value
    assert type(got) is type(value)


@pytest.mark.parametrize("form", FORMS)
def test_every_row_has_a_test_and_every_test_a_row(form):
    rows, _, expected = FORMS[form]
    fields = [row.field for row in rows]
    assert len(fields) == len(set(fields))
    assert set(fields) == set(expected)


@pytest.mark.parametrize("form", FORMS)
def test_every_documented_member_has_a_row(form):
    known = {re.sub(r"\[[^\]]*\]", "", row.field) for row in FORMS[form][0]}
    missing = [
        member
        for member in DOCUMENTED[form].split()
        if not any(field == member or field.startswith(member + ".") for field in known)
    ]
    assert not missing
