"""What is wrong with a machine, by its model: one example and one counter-example a row."""

import pytest

from octoprint_rrfmodel.rrf.alerts import (
    CONDITIONS,
    GUARDS,
    RESET,
    Alert,
    alerts,
    faults,
    is_resumable,
    loses_boxes,
)


def filament(status, tool=0, **monitor):
    return {
        "state": {"currentTool": tool},
        "tools": [{"number": 0, "extruders": [0]}, {"number": 1, "extruders": [1]}],
        "sensors": {"filamentMonitors": [{"status": status, **monitor}, None]},
    }


def drivers(*statuses, **board):
    return {"boards": [{"drivers": [{"status": status} for status in statuses], **board}]}


def usb(state, version, name="USB"):
    return {
        "boards": [{"firmwareVersion": version}],
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


@pytest.mark.parametrize("model, found", FOUND)
def test_faults(model, found):
    assert [alert.name for alert in faults(model)] == found


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
    assert [alert.name for alert in alerts(model)] == found
    assert faults(model) == []
    assert alerts(usb("executing", version)) == []
    assert alerts(usb("awaitingAcknowledgement", version, name="HTTP")) == []


def test_filament_is_nobodys_concern_while_nothing_is_printed():
    model = filament("noFilament", enableMode=1)
    assert alerts(model) == []
    assert alerts(model, is_printing=True) == [Alert("filament_error", (0,))]


def test_what_may_go_on():
    assert not is_resumable(RESET)
    assert not is_resumable(Alert("halted"))
    assert is_resumable(Alert("heater_fault", (1,)))


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
