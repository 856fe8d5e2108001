"""Commands over HTTP: who may, what is malformed, how many, and what OctoPrint would not send."""

import concurrent.futures
import time

import pytest

from octoprint_rrfmodel.rrf.gcode.commands import COMMANDS
from tests.support.basedir import ADMIN, OPERATOR, READER

from .. import helpers
from ..operations import PROFILE, Machine

COMMAND = "/api/plugin/rrfmodel"
NAMES = sorted(command.name for command in COMMANDS)


@pytest.fixture(scope="module")
def server(module_server_factory):
    """One whose printer profile has one extruder and no chamber, as OctoPrint comes."""
    return module_server_factory()


@pytest.fixture
def machine(request, server, board_factory):
    board = board_factory(speed=20, **getattr(request, "param", {}))
    helpers.connect(server, board)
    yield Machine(server, board)
    helpers.disconnect(server)


def board(**options):
    return pytest.mark.parametrize("machine", [options], indirect=True, ids=[str(options)])


def assert_error(response, status):
    assert response.status_code == status, response.text
    error = response.json()["error"]
    assert error[0].isupper() and error.endswith("."), error
    return error


def arrives_alone(machine, before):
    """Assert that nothing has been sent since then but what was waiting for its turn."""
    machine.server.commands('M118 P1 S"through"')
    machine.server.wait_for(
        lambda: 'M118 P1 S"through"' in machine.sent_since(before), 10, "the line behind"
    )
    assert machine.sent_since(before) == ['M118 P1 S"through"']


# who may


@pytest.mark.parametrize("name", NAMES)
def test_who_may_not_is_told_so_first(server, name):
    with server.client(READER) as reader:
        assert_error(reader.post(COMMAND, json={"command": name, "nonsense": 1}), 403)
    with server.client(OPERATOR) as operator:
        assert_error(operator.post(COMMAND, json={"command": name, "nonsense": 1}), 400)


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_sessions_and_nobody_need_a_token(server):
    with server.client() as nobody:
        assert nobody.post(COMMAND, json={"command": "refresh"}).status_code == 400
    with server.session(OPERATOR) as session:
        assert session.post(COMMAND, json={"command": "refresh"}).status_code == 204
        del session.headers["X-CSRF-Token"]
        assert session.post(COMMAND, json={"command": "refresh"}).status_code == 400


# what is malformed

BODIES = ["[]", "5", '"refresh"', "null", "{}", '{"command": []}', '{"command": null}', "{", ""]


@pytest.mark.both_hosts("each reads bodies with its own code")
@pytest.mark.parametrize("body", BODIES)
def test_a_body_that_names_no_command(server, body):
    headers = {"Content-Type": "application/json"}
    assert_error(server.post(COMMAND, data=body, headers=headers), 400)
    with server.client(READER) as reader:
        assert_error(reader.post(COMMAND, data=body, headers=headers), 403)


def test_a_command_that_does_not_exist(server):
    error = assert_error(server.post(COMMAND, json={"command": "explode"}), 400)
    assert "explode" in error and "jog" in error


@pytest.mark.both_hosts("the endpoint is there")
def test_refused_commands_are_not_sent(machine):
    before = len(machine.board.received())
    for request, status in [
        ({"command": "fan", "fan": 9, "speed": 1}, 400),
        ({"command": "macro", "path": "a\nM112"}, 400),
        ({"command": "tool_temperatures", "tool": 0, "active": 400}, 400),
        ({"command": "refresh", "key": "nothing"}, 404),
        ({"command": "jog", "axes": {"X": 1}}, 409),
        ({"command": "extrude", "amounts": 1, "speed": 60}, 409),
        ({"command": "message_box", "action": "ok"}, 409),
    ]:
        assert_error(machine.server.post(COMMAND, json=request), status)
    arrives_alone(machine, before)


# how many


def test_a_flood_is_refused_and_nothing_is_lost(machine):
    before = len(machine.board.received())

    def post(number):
        request = {"command": "fan", "fan": 0, "speed": number / 200}
        with machine.server.client(ADMIN) as client:
            return client.post(COMMAND, json=request)

    started = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(16) as clients:
        responses = list(clients.map(post, range(200)))
    seconds = time.monotonic() - started
    queued = [response for response in responses if response.status_code == 204]
    for response in responses:
        if response not in queued:
            assert "Too many" in assert_error(response, 409)
    assert 30 <= len(queued) <= 30 + 20 * (seconds + 1)
    machine.server.wait_for(
        lambda: len(machine.sent_since(before)) >= len(queued), 20, "all of them on the wire"
    )
    assert len(machine.sent_since(before)) == len(queued)
    # and after a moment there is room again
    machine.server.wait_for(lambda: post(0).status_code == 204, 5, "room for another")
    machine.server.wait_for(
        lambda: len(machine.sent_since(before)) == len(queued) + 1, 10, "that one on the wire"
    )


# refresh


@pytest.mark.parametrize("parameters", [{}, {"key": "move"}, {"key": "move.axes[0].max"}])
def test_refresh_finds_what_no_counter_tells(machine, parameters):
    with machine.board.lock:
        machine.board.data["move"]["axes"][0]["max"] = 333.0
    helpers.wait_polls(machine.server, 2)
    assert helpers.value(machine.server, "move.axes[0].max") == 235
    machine.post("refresh", **parameters)
    helpers.wait_value(machine.server, "move.axes[0].max", 333, 10)


def test_refresh_of_another_key_does_not(machine):
    with machine.board.lock:
        machine.board.data["move"]["axes"][0]["max"] = 333.0
    machine.post("refresh", key="heat.heaters")
    helpers.wait_polls(machine.server, 3)
    assert helpers.value(machine.server, "move.axes[0].max") == 235


# what OctoPrint would not send, or misread


@pytest.mark.both_hosts("each drops tools that it does not know")
@board(machine="toolchanger")
def test_tools_that_the_printer_profile_has_not_got(machine):
    machine.command("select_tool", ["T10"], tool=10)
    helpers.wait_value(machine.server, "state.currentTool", 10, 10)
    machine.command("select_tool", ["T-1"], tool=-1)
    helpers.wait_value(machine.server, "state.currentTool", -1, 10)
    before = len(machine.board.received())
    assert_error(machine.server.post(COMMAND, json={"command": "select_tool", "tool": 2}), 400)
    arrives_alone(machine, before)


@pytest.mark.both_hosts("lines go through the queue of the host")
def test_each_line_has_its_ok(machine):
    """No tool is no command to OctoPrint: an ok that it didn't count would go to another line."""
    for _ in range(3):
        machine.command("select_tool", ["T0"], tool=0)
        machine.command("select_tool", ["T-1"], tool=-1)
    before = len(machine.board.received())
    machine.server.commands("G4 S20", 'M118 P1 S"behind"')
    machine.server.wait_for(lambda: "G4 S20" in machine.sent_since(before), 5, "the command")
    # the board's time goes twenty times as fast
    machine.server.wait_for(
        lambda: 'M118 P1 S"behind"' in machine.sent_since(before), 10, "the line behind it"
    )
    log = machine.board.log[before:]
    (first,) = (entry for entry in log if "G4 S20" in entry.text)
    (second,) = (entry for entry in log if "behind" in entry.text)
    assert second.time - first.time >= 20


@pytest.mark.both_hosts("each drops what it does not know")
@board(machine="corexy")
def test_chamber_that_the_printer_profile_has_not_got(machine):
    machine.command("chamber", ["M120 M141 P0 S50 M121"], active=50)
    heater = machine.board.model["heat"]["heaters"][2]
    assert (heater["state"], heater["active"]) == ("active", 50)
    machine.command("chamber", ["M120 M141 P0 S{-273.15} M121"], state="off")
    assert machine.board.model["heat"]["heaters"][2]["state"] == "off"


@pytest.mark.both_hosts("each reads temperatures from lines")
@board(machine="idex")
def test_second_bed_does_not_show_as_the_first(machine):
    machine.command("bed", ["M120 M140 P1 S55 M121"], index=1, active=55)
    assert machine.board.model["heat"]["heaters"][1]["active"] == 55
    assert machine.server.get("/api/printer/bed").json()["bed"]["target"] == 0
    machine.command("bed", ["M140 P0 S60"], active=60)
    machine.server.wait_for(
        lambda: machine.server.get("/api/printer/bed").json()["bed"]["target"] == 60, 5
    )


@board(machine="manyaxes")
def test_lower_case_axes(machine):
    machine.command("home", ["G28 'a A"], axes=["a", "A"])
    letters = [axis["letter"] for axis in machine.board.model["move"]["axes"]]
    helpers.wait_value(machine.server, f"move.axes[{letters.index('a')}].homed", True, 10)
    machine.command("jog", ["M120 G21 G91 G1 'a12.5 M121"], axes={"a": 12.5})
    machine.server.wait_for(
        lambda: machine.board.model["move"]["axes"][letters.index("a")]["machinePosition"] == 12.5,
        10,
        "the axis to be there",
    )
    assert machine.board.model["move"]["axes"][letters.index("A")]["machinePosition"] == 0


# further commands


def test_heater_fault_is_reset(machine):
    machine.board.inject("heater_fault:1")
    helpers.wait_value(machine.server, "heat.heaters[1].state", "fault", 10)
    machine.command("reset_heater_fault", ["M562 P1"], heater=1)
    assert helpers.wait_value(machine.server, "heat.heaters[1].state", "off", 5) == "off"


def test_power_goes_off(machine):
    machine.command("tool_state", ["M568 P0 A2"], tool=0, state="active")
    machine.command("power", ["M81"], on=False)
    helpers.wait_value(machine.server, "state.atxPower", False, 5)
    assert machine.heater(0)["state"] == "off"


@board(machine="delta")
def test_power_that_the_machine_has_not_got(machine):
    assert_error(machine.server.post(COMMAND, json={"command": "power", "on": True}), 409)


@pytest.mark.both_hosts("each drops tools that it does not know")
def test_profile_with_all_tools_sends_plain_lines(server_factory, board_factory):
    server = server_factory(profile=PROFILE)
    changer = board_factory(machine="toolchanger", speed=20)
    helpers.connect(server, changer)
    machine = Machine(server, changer)
    machine.command("select_tool", ["T10"], tool=10)
    assert helpers.wait_value(server, "state.currentTool", 10, 10) == 10
