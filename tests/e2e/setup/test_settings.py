"""OctoPrint's settings for RepRapFirmware: told, set by one button, set back; the profile too."""

import shutil

import pytest
import yaml

from tests.support.basedir import ADMIN, DISABLED_PLUGINS, OPERATOR, is_version_2

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts(
        "settings of the serial line lie in different places", once_for=("machine",)
    ),
    pytest.mark.slow,
]

PROFILE = "/api/printerprofiles/_default"

CODES = ["long_running_commands", "uppercase", "unknown_commands", "external_heatup"]


OWN_COMMANDS = ["G28", "M600", "M1234"]


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(serial={"longRunningCommands": OWN_COMMANDS})


@pytest.fixture
def profile(server):
    """The profile's extruders before the test, and after it."""
    before = extruder(server)
    yield before
    patch_extruder(server, before)


def warnings(server):
    return {found["code"]: found for found in helpers.status(server)["warnings"]}


def command(client, name, **values):
    return client.post("/api/plugin/rrfmodel", json={"command": name, **values})


def stored(server):
    """Return what OctoPrint has in its file, as far as it isn't the default."""
    return yaml.safe_load((server.basedir / "config.yaml").read_text(encoding="utf-8"))


def of_line(server):
    config = stored(server)
    if is_version_2(server.version):
        return config["plugins"]["serial_connector"]
    return config["serial"]


def extruder(server):
    return server.get(PROFILE).json()["extruder"]


def patch_extruder(server, extruder):
    response = server.patch(PROFILE, json={"profile": {"extruder": extruder}})
    assert response.status_code == 200, response.text


def set_long_running(server, commands):
    group = "plugins.serial_connector" if is_version_2(server.version) else "serial"
    server.set_setting(f"{group}.longRunningCommands", commands)


def of_terminal(server):
    name = "Blocklist" if is_version_2(server.version) else "Blacklist"
    return stored(server).get("feature", {}).get(f"autoUppercase{name}")


def test_told_fixed_and_restored(server, board_factory):
    before = stored(server)
    board = board_factory()
    helpers.connect(server, board)
    told = warnings(server)
    assert [code for code in told if code in CODES] == CODES
    assert all(told[code]["fix"] == "fix_settings" and told[code]["text"] for code in CODES)
    # looking changes nothing, and only an administrator may
    with server.client(OPERATOR) as operator:
        assert command(operator, "fix_settings").status_code == 403
    assert of_line(server) == (
        before["plugins"]["serial_connector"] if is_version_2(server.version) else before["serial"]
    )

    assert command(server, "fix_settings").status_code == 204
    assert not set(CODES) & set(warnings(server))
    line = of_line(server)
    assert line["longRunningCommands"][:3] == ["G28", "M600", "M1234"]
    assert {"T", "M98", "M24"} <= set(line["longRunningCommands"])
    assert line["unknownCommandsNeedAck"] is True
    assert line["externalHeatupDetection"] is False
    assert {"M117", "M707", "M409", "M98", "M23"} <= set(of_terminal(server))

    # they take effect, and hold over a restart
    server.restart()
    helpers.connect(server, board)
    assert not set(CODES) & set(warnings(server))
    start = len(board.board.received())
    server.commands('echo "one"', "T-1", 'M118 P1 S"two"')
    server.wait_for(
        lambda: any(text.startswith("M118") for text in helpers.commands(board)[start:]),
        10,
        "the line behind",
    )

    assert command(server, "restore_settings").status_code == 204
    assert set(CODES) <= set(warnings(server))
    line = of_line(server)
    assert line["longRunningCommands"] == ["G28", "M600", "M1234"]
    assert "unknownCommandsNeedAck" not in line
    assert "externalHeatupDetection" not in line
    assert of_terminal(server) is None


def test_what_a_person_changed_since_stays(server, board_factory):
    helpers.connect(server, board_factory())
    command(server, "fix_settings")
    set_long_running(server, [*of_line(server)["longRunningCommands"], "M999"])
    command(server, "restore_settings")
    try:
        assert of_line(server)["longRunningCommands"] == [*OWN_COMMANDS, "M999"]
    finally:
        set_long_running(server, OWN_COMMANDS)


def test_out_of_use(server_factory, board_factory):
    """The plugin manager disables the plugin, at the next start."""
    disabled = [name for name in DISABLED_PLUGINS if name != "pluginmanager"]
    server = server_factory(settings={"plugins": {"_disabled": disabled}})
    helpers.connect(server, board_factory(machine="toolchanger"))
    command(server, "fix_settings")
    command(server, "fix_profile")
    assert "longRunningCommands" in of_line(server)
    assert extruder(server)["count"] == 11
    response = server.post(
        "/api/plugin/pluginmanager", json={"command": "disable", "plugin": "rrfmodel"}
    )
    assert response.status_code == 200, response.text
    server.wait_for(
        lambda: "longRunningCommands" not in of_line(server), 10, "the settings to be as before"
    )
    assert of_terminal(server) is None
    server.wait_for(lambda: extruder(server)["count"] == 1, 5, "the profile to be as before")


def test_nothing_on_other_printers(server_factory):
    server = server_factory(plugins_config={"virtual_printer": {"enabled": True}})
    server.connect("VIRTUAL")
    server.wait_state("Operational")
    assert warnings(server) == {}
    response = server.post("/api/plugin/rrfmodel", json={"command": "recover"})
    assert response.status_code == 409
    assert server.state() == "Operational"


def test_profile(server, board_factory, profile):
    board = board_factory(machine="toolchanger")
    helpers.connect(server, board)
    warning = server.wait_for(lambda: warnings(server).get("profile_tools"), 5, "the warning")
    assert warning["fix"] == "fix_profile"
    with server.client(OPERATOR) as operator:
        assert command(operator, "fix_profile").status_code == 403
    assert command(server, "fix_profile").status_code == 204
    numbers = [tool["number"] for tool in helpers.value(server, "tools") if tool]
    assert extruder(server)["count"] == max(numbers) + 1
    assert len(extruder(server)["offsets"]) == max(numbers) + 1
    if is_version_2(server.version):
        assert warnings(server)["profile_reconnect"]["fix"] == "reconnect"
        assert command(server, "reconnect").status_code == 204
        server.wait_for(
            lambda: "profile_reconnect" not in warnings(server), 45, "the new connection"
        )
        helpers.wait_ready(server)
    assert not {"profile_tools", "profile_reconnect"} & set(warnings(server))
    server.commands(f"T{max(numbers)}")
    helpers.wait_value(server, "state.currentTool", max(numbers), 20)

    assert command(server, "restore_settings").status_code == 204
    assert extruder(server) == profile


def test_nothing_is_set_back_while_something_is_printed(server, board_factory, profile):
    board = board_factory(machine="toolchanger")
    helpers.connect(server, board)
    assert command(server, "fix_profile").status_code == 204
    raised = extruder(server)
    server.upload("streamed.gcode", "G92 X20 Y20 Z1\n" + "G1 X21 F600\nG1 X20 F600\n" * 500)
    server.select_and_print("streamed.gcode")
    server.wait_state("Printing")
    # OctoPrint 1.11 would drop the tool commands of the print
    response = command(server, "restore_settings")
    assert response.status_code == 409
    assert response.json()["error"].endswith(".")
    assert extruder(server) == raised
    server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational", 60)
    assert command(server, "restore_settings").status_code == 204
    assert extruder(server) == profile


def test_no_more_extruders_than_octoprint_takes(server, board_factory, profile):
    board = board_factory(machine="toolchanger")
    with board.board.lock:
        tools = board.board.data["tools"]
        numbers = [tool["number"] for tool in tools if tool]
        tools += [*[None] * (120 - len(tools)), {**tools[-1], "number": 120}]
    helpers.connect(server, board)
    helpers.wait_ready(server)
    assert command(server, "fix_profile").status_code == 204
    assert extruder(server)["count"] == max(numbers) + 1
    server.wait_for(lambda: "profile_tools" not in warnings(server), 5, "the warning to go")
    assert command(server, "restore_settings").status_code == 204


@pytest.mark.parametrize(
    "change",
    [
        pytest.param({"count": 12, "offsets": [[0.0, 0.0]] * 12}, id="count"),
        pytest.param({"offsets": [[0.0, 0.0]] * 10 + [[25.0, 0.0]]}, id="offsets"),
    ],
)
@pytest.mark.parametrize("values", [{}, {"fields": ["extruder.count"]}], ids=["raised", "written"])
def test_profile_that_a_person_changed_since_stays(server, board_factory, profile, change, values):
    helpers.connect(server, board_factory(machine="toolchanger"))
    assert command(server, "fix_profile", **values).status_code == 204
    assert extruder(server)["count"] == 11
    changed = {**extruder(server), **change}
    patch_extruder(server, changed)
    assert command(server, "restore_settings").status_code == 204
    assert extruder(server) == changed


@pytest.mark.parametrize("values", [{}, {"fields": ["extruder.count"]}], ids=["raised", "written"])
def test_profile_raised_twice_goes_back_to_the_first(server, board_factory, profile, values):
    helpers.connect(server, board_factory(machine="idex"))
    command(server, "fix_profile", **values)
    assert extruder(server)["count"] == 3
    helpers.connect(server, board_factory(machine="toolchanger"))
    command(server, "fix_profile")
    assert extruder(server)["count"] == 11
    command(server, "restore_settings")
    assert extruder(server) == profile


def differing(server):
    response = server.get("/plugin/rrfmodel/setup")
    assert response.status_code == 200, response.text
    return [row["field"] for row in response.json()["profile"]]


@pytest.mark.parametrize("machine", ["cnc", "delta", "toolchanger"])
def test_nothing_differs_once_it_is_written(server, board_factory, machine):
    helpers.connect(server, board_factory(machine=machine))
    before = server.get(PROFILE).json()
    fields = differing(server)
    assert fields
    assert command(server, "fix_profile", fields=fields).status_code == 204
    assert differing(server) == []
    assert command(server, "restore_settings").status_code == 204
    assert server.get(PROFILE).json() == before


def test_offsets_that_a_shared_nozzle_has_not_come_back(server, board_factory, profile):
    board = board_factory(machine="idex")
    for tool in helpers.own_value(board, "tools"):
        board.board.execute(f"M563 P{tool['number']} D0 H1", channel="http")
    helpers.connect(server, board)
    patch_extruder(server, {"count": 3, "offsets": [[0.0, 0.0], [18.0, 0.0], [0.0, 7.0]]})
    before = extruder(server)
    assert command(server, "fix_profile", fields=["extruder.sharedNozzle"]).status_code == 204
    assert extruder(server)["sharedNozzle"] is True
    assert extruder(server)["offsets"] == [[0.0, 0.0]]
    command(server, "restore_settings")
    assert extruder(server) == before


def test_file_of_an_older_version_is_taken_back(server, board_factory, profile):
    helpers.connect(server, board_factory(machine="idex"))
    written = server.basedir / "data" / "rrfmodel" / "changed_profiles.json"
    written.parent.mkdir(parents=True, exist_ok=True)
    written.write_text('{"_default": {"old": 1, "new": 3}}', encoding="utf-8")
    patch_extruder(server, {"count": 3, "offsets": [[0.0, 0.0]] * 3})
    command(server, "restore_settings")
    assert extruder(server) == profile
    assert not written.exists()


def test_clean_up_of_the_plugins_data_leaves_what_takes_changes_back(
    server, board_factory, profile
):
    helpers.connect(server, board_factory(machine="idex"))
    before = server.get(PROFILE).json()
    assert command(server, "fix_settings").status_code == 204
    assert command(server, "fix_profile").status_code == 204
    assert extruder(server)["count"] > profile["count"]
    # as the plugin manager does it (its _cleanup_data)
    shutil.rmtree(server.basedir / "data" / "rrfmodel", ignore_errors=True)
    assert command(server, "restore_settings").status_code == 204
    assert server.get(PROFILE).json() == before
    assert list(server.basedir.glob("rrfmodel_*")) == []


def test_unknown_command(server):
    assert command(server, "nonsense").status_code == 400
    with server.client() as nobody:
        assert command(nobody, "fix_settings").status_code in (400, 403)
    with server.session(ADMIN) as session:
        assert command(session, "restore_settings").status_code == 204
