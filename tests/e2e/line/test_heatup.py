"""Commands that block the line for longer than OctoPrint would ever wait without a sign of life."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line", once_for=("firmware",)),
    pytest.mark.slow,
]

HEATING_SECONDS = 18
"""More than twice what OctoPrint waits in all."""

FIRMWARE = ("3.5.1", "3.5.3")


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(serial=helpers.SHORT_TIMEOUTS)


def cold_bed(board):
    """Make the bed so slow that it takes that long to 60 °C; return the heater."""
    heater = board.board.data["heat"]["heaters"][0]
    with board.board.lock:
        rate = heater["model"]["heatingRate"]
        # the wait ends 2.5 °C below
        heater["current"] = 57.5 - rate * HEATING_SECONDS
    return heater


def wait_through(server, board, command, is_over, seconds):
    """Return the reasons for not polling that the plugin gave while a command ran."""
    server.wait_for(lambda: command in helpers.commands(board), 20, f"{command} to arrive")
    reasons = set()

    def is_through():
        assert server.state().startswith(("Operational", "Printing", "Finishing")), server.state()
        if is_over():
            return True
        reasons.add(helpers.status(server)["blocked"])
        return False

    server.wait_for(is_through, seconds, f"the end of {command}")
    return reasons


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_heating_in_a_print(server, board_factory, firmware):
    board = board_factory(firmware=firmware)
    helpers.connect(server, board)
    heater = cold_bed(board)
    moves = [f"G1 F{6000 + number}" for number in range(300)]
    name = f"heat-{firmware}.gcode"
    server.upload(name, "\n".join([*moves[:20], "M190 S60", *moves[20:]]) + "\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print(name)
        reasons = wait_through(
            server, board, "M190 S60", lambda: heater["current"] >= 57.5, HEATING_SECONDS + 15
        )
        # by name the printer is at the temperature; whatever comes now comes after the wait
        prints.wait_done(server, push, 30)
        assert push.events("Disconnected") == push.events("Error") == []
    assert "heating" in reasons
    assert reasons <= {None, "heating", "long_command"}
    helpers.assert_quiet(server, board, "M190 S60")
    sent = helpers.commands(board)
    assert [command for command in sent if command.startswith("G1 F")] == moves
    helpers.wait_polls(server, 2)
    helpers.wait_equal(server, board)


@pytest.mark.parametrize("firmware", FIRMWARE)
def test_heating_by_a_command(server, board_factory, firmware):
    board = board_factory(firmware=firmware)
    helpers.connect(server, board)
    heater = cold_bed(board)
    with PushListener(server, ADMIN) as push:
        server.commands("M190 S60", "M117 done")
        reasons = wait_through(
            server, board, "M190 S60", lambda: heater["current"] >= 57.5, HEATING_SECONDS + 15
        )
        server.wait_for(lambda: "M117 done" in helpers.commands(board), 10, "the next command")
        assert push.events("Disconnected") == push.events("Error") == []
    assert "heating" in reasons
    helpers.assert_quiet(server, board, "M190 S60")
    helpers.wait_polls(server, 2)
    helpers.wait_equal(server, board)


def klipper(server, name):
    response = server.get(f"/plugin/rrfmodel/printer/objects/query?{name}")
    return response.json()["result"]["status"][name]


def test_row_22_heating_is_seen_everywhere(server, board_factory):
    """What OctoPrint shows of a heat-up is in the model, and nothing old is shown as if now."""
    board = board_factory(firmware="3.5.3")
    helpers.connect(server, board)
    heater = cold_bed(board)
    server.commands("M190 S60", "M117 done")
    server.wait_for(lambda: "M190 S60" in helpers.commands(board), 20, "M190 to arrive")
    doing = server.wait_for(lambda: helpers.status(server)["doing"], 5, "what is done")
    assert (doing["command"], doing["what"]) == ("M190 S60", "heating")
    begun = heater["current"]
    server.wait_for(lambda: heater["current"] > begun + 1, 20, "some heat")

    def is_shown():
        own = server.get("/api/printer").json()["temperature"]["bed"]
        bed = helpers.value(server, "heat.heaters[0]")
        return (
            bed["current"] > begun + 1
            and abs(bed["current"] - own["actual"]) < 1
            and (bed["active"], own["target"]) == (60, 60)
            and abs(klipper(server, "heater_bed")["temperature"] - own["actual"]) < 1
        )

    server.wait_for(is_shown, 5, "the temperature in model, OctoPrint and Klipper's objects")
    state = helpers.status(server)
    assert state["doing"]["what"] == "heating", "all of that while the command runs"
    assert klipper(server, "idle_timeout")["state"] == "Printing"
    metrics = server.get("/plugin/rrfmodel/metrics").text
    assert 'rrf_status{status="idle"} 0' in metrics
    assert 'rrf_status{status="busy"} 1' in metrics
    told = server.get("/plugin/rrfmodel/history").json()
    (bed,) = [each["values"] for each in told["series"] if each["id"] == "heater0.current"]
    assert None not in bed[-2:]
    assert bed[-1] > begun + 1
    # right behind it the line isn't said to be dead
    seen = []

    def is_over():
        state = helpers.status(server)
        seen.append((state["stale"], state["blocked"]))
        return state["doing"] is None and not state["stale"]

    server.wait_for(is_over, 40, "fresh news behind the command")
    assert (True, None) not in seen
    server.wait_for(lambda: "M117 done" in helpers.commands(board), 10, "the next command")
