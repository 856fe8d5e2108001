"""``webhooks``, ``idle_timeout``, ``mcu``, ``gcode``, and what Moonraker calls info."""

import pytest

from octoprint_rrfmodel.rrf.klipper import Kept, names, printer_info, server_info

from . import HOST, changed, get, model_of, whole, world

LINE_LOST = HOST._replace(is_connected=False)
INCOMPLETE = HOST._replace(is_ready=False)
NO_MODEL = HOST._replace(has_protocol=False, is_ready=False)

STATES = [
    pytest.param("idle", HOST, "ready", "Printer is ready", id="idle"),
    pytest.param("busy", HOST, "ready", "Printer is ready", id="busy"),
    pytest.param("processing", HOST, "ready", "Printer is ready", id="printing"),
    pytest.param("something new", HOST, "ready", "Printer is ready", id="unknown word"),
    pytest.param("starting", HOST, "startup", "Printer is not ready", id="starting"),
    pytest.param("updating", HOST, "startup", "Printer is not ready", id="updating"),
    pytest.param("idle", INCOMPLETE, "startup", "Printer is not ready", id="not complete"),
    pytest.param("halted", HOST, "shutdown", "Emergency stop", id="halted"),
    pytest.param("halted", INCOMPLETE, "shutdown", "Emergency stop", id="halted, not complete"),
    pytest.param("off", HOST, "shutdown", "Power is off", id="off"),
    pytest.param("idle", LINE_LOST, "shutdown", "Printer not connected", id="line lost"),
    pytest.param("idle", NO_MODEL, "error", "Printer is not ready", id="no protocol"),
]


@pytest.mark.parametrize(("status", "host", "state", "message"), STATES)
def test_webhooks(status, host, state, message):
    at = world({"state": {"status": status}}, host)
    assert whole(at, "webhooks") == {"state": state, "state_message": message}
    info = printer_info(at, "1.2.3", "octopi")
    assert (info["state"], info["state_message"]) == (state, message)


def test_nothing_known_is_no_error_yet():
    assert get(world({}, INCOMPLETE), "webhooks", "state") == "startup"


@pytest.mark.parametrize(
    ("error", "message"),
    [
        ({"file": "config.g", "line": 12, "message": "bad M950"}, "config.g line 12: bad M950"),
        ({"file": "config.g", "line": None, "message": "bad"}, "config.g: bad"),
        ({"message": "bad"}, "bad"),
        (None, "Printer is ready"),
        ({}, "Printer is ready"),
        ("x", "Printer is ready"),
    ],
)
def test_startup_error_is_told_and_the_printer_is_ready(error, message):
    at = world({"state": {"status": "idle", "startupError": error}})
    assert whole(at, "webhooks") == {"state": "ready", "state_message": message}
    warnings = get(at, "configfile", "warnings")
    is_told = message != "Printer is ready"
    assert warnings == ([{"type": "runtime_warning", "message": message}] if is_told else [])


def rested(*moments):
    """Return what is kept after the board had these statuses at these times."""
    kept = Kept()
    for status, now in moments:
        kept.observe({"state": {"status": status}}, HOST, now)
    return kept.snapshot


IDLE_STATES = [
    pytest.param([("idle", 0)], "idle", 0, "Ready", id="idle at once"),
    pytest.param([("idle", 0), ("idle", 300)], "idle", 599, "Ready", id="idle for 599 s"),
    pytest.param([("idle", 0), ("idle", 300)], "idle", 600, "Idle", id="idle for 600 s"),
    pytest.param([("idle", 0), ("busy", 9)], "idle", 605, "Ready", id="busy meanwhile"),
    pytest.param([("paused", 0)], "paused", 5000, "Ready", id="paused for long"),
    pytest.param([("paused", 0), ("idle", 100)], "idle", 650, "Ready", id="was paused"),
    *(
        pytest.param([(status, 0)], status, 5000, "Printing", id=status)
        for status in (
            "processing",
            "simulating",
            "changingTool",
            "busy",
            "pausing",
            "resuming",
            "cancelling",
        )
    ),
    *(
        pytest.param([(status, 0)], status, 1, "Idle", id=status)
        for status in ("halted", "off", "starting", "updating", "something new")
    ),
]


@pytest.mark.parametrize(("moments", "status", "now", "state"), IDLE_STATES)
def test_idle_timeout_state(moments, status, now, state):
    at = world({"state": {"status": status}}, kept=rested(*moments), now=now)
    assert get(at, "idle_timeout", "state") == state


@pytest.mark.parametrize(
    ("moments", "status", "seconds"),
    [
        pytest.param([("idle", 0)], "idle", 0.0, id="idle"),
        pytest.param([("idle", 0), ("busy", 10)], "busy", 90.0, id="busy"),
        pytest.param([("busy", 10), ("processing", 50)], "processing", 90.0, id="still printing"),
        pytest.param([("busy", 10), ("idle", 50)], "busy", 0.0, id="begins now"),
        pytest.param([("busy", 10)], "paused", 0.0, id="paused"),
        pytest.param([("busy", 10), ("halted", 20)], "halted", 0.0, id="halted"),
    ],
)
def test_printing_time_counts_from_the_last_change_into_printing(moments, status, seconds):
    at = world({"state": {"status": status}}, kept=rested(*moments), now=100)
    assert get(at, "idle_timeout", "printing_time") == seconds


def test_idle_timeout_is_klippers_default():
    assert get(world(), "idle_timeout", "idle_timeout") == 600


def test_mainboard_is_mcu_and_the_others_have_their_address():
    at = world(model_of("toolchanger"))
    boards = [name for name in names(at) if name.partition(" ")[0] == "mcu"]
    assert boards == ["mcu", "mcu 20", "mcu 21", "mcu 22", "mcu 23"]
    mcu = whole(at, "mcu")
    assert mcu["mcu_version"] == "3.5.3"
    assert mcu["mcu_constants"] == {"MCU": "MB6HC"}
    assert set(mcu["last_stats"].values()) == {None}
    assert whole(at, "mcu 20")["mcu_constants"] != mcu["mcu_constants"]


def test_boards_without_addresses_have_their_place():
    at = world({"boards": [{"firmwareVersion": "3.3"}, None, {"canAddress": None}]})
    assert get(at, "mcu", "mcu_version") == "3.3"
    assert whole(at, "mcu 2")["mcu_version"] is None
    assert whole(at, "mcu 2")["mcu_constants"] == {"MCU": None}


def test_gcode_has_a_dictionary_of_commands():
    commands = get(world(), "gcode", "commands")
    assert commands["M112"]["help"]
    assert all(set(command) == {"help"} for command in commands.values())


@pytest.mark.parametrize(
    ("host", "status", "connected", "state"),
    [
        pytest.param(HOST, "idle", True, "ready", id="ready"),
        pytest.param(HOST, "halted", True, "shutdown", id="halted"),
        pytest.param(INCOMPLETE, "idle", True, "startup", id="not complete"),
        pytest.param(NO_MODEL, "idle", True, "error", id="no protocol"),
        pytest.param(LINE_LOST, "idle", False, "disconnected", id="line lost"),
    ],
)
def test_server_info(host, status, connected, state):
    info = server_info(world({"state": {"status": status}}, host), 2, "0.1.0")
    assert info == {
        "klippy_connected": connected,
        "klippy_state": state,
        "components": [],
        "failed_components": [],
        "registered_directories": ["gcodes", "printer"],
        "warnings": [],
        "websocket_count": 2,
        "moonraker_version": "rrfmodel-0.1.0",
        "missing_klippy_requirements": [],
        "api_version": [1, 5, 0],
        "api_version_string": "1.5.0",
    }


def test_printer_info_has_all_that_clients_read():
    info = printer_info(world(model_of()), "0.1.0", "octopi")
    assert info["hostname"] == "octopi"
    assert info["software_version"] == "rrfmodel-0.1.0"
    assert "3.5.3" in info["cpu_info"]
    assert [info[name] for name in ("klipper_path", "python_path", "log_file", "config_file")] == [
        ""
    ] * 4
    assert {"process_id", "user_id", "group_id"} <= set(info)


def test_printer_info_without_a_board():
    assert printer_info(world(), "v", "h")["cpu_info"] == ""


def test_version_of_a_board_may_be_missing():
    model = changed(model_of(), **{"boards[0].firmwareVersion": None})
    assert get(world(model), "mcu", "mcu_version") is None


def test_a_machine_that_the_line_waits_for_is_not_idle():
    model = {"state": {"status": "idle"}}
    assert get(world(model, HOST), "idle_timeout", "state") != "Printing"
    at_work = world(model, HOST._replace(is_at_work=True))
    assert get(at_work, "idle_timeout", "state") == "Printing"
