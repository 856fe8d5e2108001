"""What is wrong with a machine, by its model: one example and one counter-example a row."""

import pytest

from octoprint_rrfmodel.rrf.views.warnings import (
    ADVICE,
    CONDITIONS,
    FAULT,
    GUARDS,
    LEVELS,
    POSITION_LOST,
    RESET,
    WARNING,
    MachineWarning,
    faults,
    is_resumable,
    is_unhomed,
    loses_boxes,
    warnings_of,
)


def filament(status, tool=0, **monitor):
    return {
        "state": {"currentTool": tool},
        "tools": [{"number": 0, "extruders": [0]}, {"number": 1, "extruders": [1]}],
        "sensors": {"filamentMonitors": [{"status": status, **monitor}, None]},
    }


def drivers(*statuses, **board):
    return {"boards": [{"drivers": [{"status": status} for status in statuses], **board}]}


def usb(state, version, name="USB", number=None):
    return {
        "boards": [{"firmwareVersion": version}],
        "state": {"thisInput": number},
        "inputs": [{"name": "HTTP", "state": "idle"}, None, {"name": name, "state": state}],
    }


FOUND = [
    ({"state": {"status": "halted"}}, ["halted"]),
    ({"state": {"status": "off"}}, ["off"]),
    ({"state": {"status": "idle"}}, []),
    ({"heat": {"heaters": [{"state": "off"}, {"state": "fault"}, None]}}, ["heater_fault_1"]),
    ({"heat": {"heaters": [{"state": "active"}]}}, []),
    (filament("noFilament", enableMode=1), ["filament_error_0"]),
    (filament("tooLittleMovement", enableMode=2), ["filament_error_0"]),
    (filament("sensorError", enabled=True), ["filament_error_0"]),
    (filament("noFilament", enableMode=0), []),
    (filament("noFilament", enabled=False), []),
    (filament("noFilament"), []),
    (filament("noFilament", tool=-1, enableMode=1), ["filament_error_0"]),
    # what another tool is fed with matters when that one prints
    (filament("noFilament", tool=1, enableMode=1), []),
    *((filament(word, enableMode=1), []) for word in ("ok", "noDataReceived", "noMonitor", None)),
    *((drivers(0, 1 << bit), ["driver_error_0_1"]) for bit in (1, 2, 3, 4, 5, 9, 11, 14)),
    # over-temperature warning, open load, stall, standstill
    *((drivers(1 << bit), []) for bit in (0, 6, 7, 8, 10, 12, 16, 20)),
    (drivers(2, canAddress=121), ["driver_error_121_0"]),
    ({"state": None, "heat": [], "sensors": {"filamentMonitors": {}}, "boards": [None]}, []),
    (
        {"sensors": {"filamentMonitors": [{"status": [], "enableMode": 1}]}},
        ["filament_error_0"],
    ),
    ({}, []),
]

HOT = {"mcuTemp": {"current": 85.1, "max": 85.1}}
LOW = {"vIn": {"current": 9.9, "max": 24.1}}
ERROR = {"file": "config.g", "line": 12, "message": "in file macro <b>M950</b>"}


def boards(*boards, status="idle"):
    return {"state": {"status": status}, "boards": list(boards)}


def versions(*numbers):
    return boards(
        *(
            {"firmwareVersion": number, "canAddress": address}
            for number, address in zip(numbers, (0, 121, 20))
        )
    )


KNOWN = [
    # model, while OctoPrint prints, names
    ({"state": {"startupError": ERROR}}, False, ["startup_error"]),
    ({"state": {"startupError": None}}, False, []),
    (versions("3.5.3", "3.4.6", "3.5.3"), False, ["versions_differ_121"]),
    (versions("3.5.3", "3.5.3-rc.1"), False, ["versions_differ_121"]),
    (versions("3.5.3", "3.5.3+1", "3.5.3 (2024-09-30)"), False, []),
    (versions("3.5.3", None, ""), False, []),
    (versions(None, "3.5.3"), False, []),
    (boards({}, LOW), False, ["supply_voltage_1"]),
    (boards(LOW), False, ["supply_voltage_0"]),
    # the status says it already
    (boards(LOW, {**LOW, "canAddress": 20}, status="off"), False, ["off", "supply_voltage_20"]),
    # powered by USB, or not measured
    (boards({"vIn": {"current": 0.2, "max": 0.3}}, {"vIn": None}), False, []),
    (boards({"vIn": {"current": 10.0, "max": 24}}), False, []),
    (boards({"vIn": {"current": 1, "max": None}}), False, []),
    (boards(HOT, {**HOT, "canAddress": 20}), False, ["mcu_temperature_0", "mcu_temperature_20"]),
    (boards({"mcuTemp": {"current": 85.0}}, {"mcuTemp": None}), False, []),
    (drivers(0, 1), False, ["driver_warning_0_1"]),
    (drivers(1 << 6, 1 << 7), False, []),
    (drivers(1 << 6, 1 << 7), True, ["open_load_0_0", "open_load_0_1"]),
    # it stands still, or isn't there
    (drivers(1 << 6 | 1 << 16, 1 << 7 | 1 << 17), True, []),
    (drivers(1 << 8, 1 << 10, 1 << 16), True, []),
    (filament("ok", enableMode=1), True, ["filament_monitor_mode_0"]),
    (filament("ok", enableMode=1), False, []),
    (filament("ok", enableMode=2), True, []),
    (filament("ok", enabled=True), True, []),
    (filament("ok", tool=1, enableMode=1), True, []),
]


@pytest.mark.parametrize("model, is_printing, names", KNOWN)
def test_what_stops_no_print(model, is_printing, names):
    assert [each.name for each in warnings_of(model, is_printing)] == names
    assert [each.code for each in faults(model)] == [name for name in names if name == "off"]


def test_what_is_told_with_a_warning():
    (error,) = warnings_of({"state": {"startupError": ERROR}})
    assert error.values == {**ERROR, "line": "12"}
    (differs,) = warnings_of(versions("3.5.3", "3.4.6"))
    assert differs.values == {"number": "121", "version": "3.4.6", "main": "3.5.3"}
    (driver,) = warnings_of(drivers(0, 2, canAddress=121))
    assert driver.values == {"number": "121.1"}


def test_levels():
    assert {level for code, level in LEVELS.items() if code in GUARDS} == {FAULT}
    assert LEVELS["startup_error"] == WARNING
    assert LEVELS["filament_monitor_mode"] == ADVICE


@pytest.mark.parametrize("model, found", FOUND)
def test_faults(model, found):
    assert [each.name for each in faults(model)] == found


@pytest.mark.parametrize(
    "version, found",
    [
        ("3.4.6", []),
        ("3.5.0-rc.1", ["message_box_unanswerable"]),
        ("3.5.4", ["message_box_unanswerable"]),
        ("3.6.0", ["message_box_unanswerable"]),
        ("3.6.1", []),
        ("2.05.1", []),
        ("", []),
    ],
)
def test_message_box(version, found):
    model = usb("awaitingAcknowledgement", version)
    assert [each.name for each in warnings_of(model)] == found
    assert faults(model) == []
    assert warnings_of(usb("executing", version)) == []
    assert warnings_of(usb("awaitingAcknowledgement", version, name="HTTP")) == []
    # OctoPrint on a serial port of the board
    waiting = warnings_of(usb("awaitingAcknowledgement", version, name="Aux", number=2))
    assert waiting == warnings_of(model)


def test_filament_is_nobodys_concern_while_nothing_is_printed():
    model = filament("noFilament", enableMode=1)
    assert warnings_of(model) == []
    assert MachineWarning("filament_error", (0,)) in warnings_of(model, is_printing=True)


def test_what_may_go_on():
    assert not is_resumable(RESET)
    assert not is_resumable(MachineWarning("halted"))
    assert is_resumable(MachineWarning("heater_fault", (1,)))
    assert is_resumable(POSITION_LOST)


@pytest.mark.parametrize(
    ("axes", "unhomed"),
    [
        (None, False),
        ([], False),
        ([None, {"letter": 5, "homed": False}], False),
        ([{"letter": "X"}, {"letter": "Y", "homed": True}], False),
        ([{"letter": "X", "homed": True}, {"letter": "Z", "homed": False}], True),
        # a rotary axis or a coupler need not be
        ([{"letter": "Z", "homed": True}, {"letter": "C", "homed": False}], False),
    ],
)
def test_position_that_is_not_known(axes, unhomed):
    assert is_unhomed({"move": {"axes": axes}}) is unhomed


def test_table():
    assert len({row.code for row in CONDITIONS}) == len(CONDITIONS)
    assert all(row.reason.endswith(".") for row in CONDITIONS)
    assert set(GUARDS) == {
        "halted",
        "off",
        "heater_fault",
        "filament_error",
        "driver_error",
        "reset",
    }


@pytest.mark.parametrize("version, loses", [((3, 4, 6), False), ((3, 5, 0), True)])
def test_loses_boxes(version, loses):
    assert loses_boxes(version) is loses


@pytest.mark.parametrize(
    "heaters, found",
    [
        ([{"state": "off"}, {"state": "off"}], []),
        ([{"state": "off"}, {"state": "fault"}], ["heater_fault_1"]),
        # where the model says nothing of it, the box does
        ([{"state": "off"}], ["heater_fault_1"]),
        ([{"state": "off"}, {}], ["heater_fault_1"]),
    ],
)
def test_box_that_outlasts_a_heaters_fault_is_none(heaters, found):
    box = {"mode": 1, "seq": 1, "message": "Heater 1 fault: temperature rising too slowly"}
    model = {"heat": {"heaters": heaters}, "state": {"messageBox": box}}
    assert [fault.name for fault in faults(model)] == found
