"""What the tests of boards on the network do all the time."""

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

NEW = {"X-OctoPrint-Api-Version": "2.0.0"}

READY_SECONDS = 20

LONG = "G28\nT0\n" + "".join(
    f"G1 X{20 + n % 100} Y{20 + n // 100} Z0.{n % 10} F3000\n" for n in range(20000)
)
"""A print that goes on for longer than any test."""


def ask_to_connect(client, host, **more):
    """Return the response to a request for a connection."""
    request = {
        "command": "connect",
        "connector": "rrfmodel",
        "parameters": {"host": host},
        "printerProfile": "_default",
        **more,
    }
    return client.post("/api/connection", json=request, headers=NEW)


def connect(server, face, seconds=READY_SECONDS):
    """Connect to a board on the network; another connection ends before."""
    helpers.disconnect(server)
    response = ask_to_connect(server, face.url)
    assert response.status_code == 204, response.text
    helpers.wait_ready(server, seconds)
    server.wait_state("Operational", 10)


def at_panel(face, gcode):
    """Let the board do something as if somebody at its panel had said so."""
    return face.board.execute(gcode, channel="aux")


def command(client, name, **parameters):
    """Return the response to one of the plugin's commands."""
    return client.post("/api/plugin/rrfmodel", json={"command": name, **parameters})


def job_state(server):
    """Return the words of OctoPrint's state and the file of its job."""
    job = server.get("/api/job").json()
    return job["state"], (job["job"]["file"]["origin"], job["job"]["file"]["path"])


def board_value(face, key):
    """Return a value of the board's own model."""
    with face.board.lock:
        face.board.advance()
        found = face.board.model
        for part in key.split("."):
            found = found[int(part)] if isinstance(found, list) else found[part]
        return found


def printer(server, part, **request):
    """Ask something of OctoPrint's printer API."""
    response = server.post(f"/api/printer/{part}", json=request)
    assert response.status_code == 204, (part, request, response.text)


def reset_in_a_print(server, face):
    """Return once the board has come back from a reset in a print, and OctoPrint has seen it end.

    What is returned is how often OctoPrint took the connection for gone, and by how many the
    resets have grown.
    """
    at_panel(face, 'M32 "0:/gcodes/long.gcode"')
    server.wait_state("Printing", 30)
    before = helpers.status(server)["resets"]
    with PushListener(server, ADMIN) as push:
        face.board.reset()
        server.wait_state("Operational", 90)
        helpers.wait_ready(server, 60)
        push.wait_for_event("PrintFailed", 30)
        return len(push.events("Disconnected")), helpers.status(server)["resets"] - before


STOP_SECONDS = 3.0


def stop_in_a_heat_up(server, face):
    """Return the state of the heater once the board stands, at once and past the heat-up."""
    server.commands("T0", "M109 S200", *(f"M117 {number}" for number in range(20)))
    helpers.wait_value(server, "heat.heaters[1].active", 200, 20)
    # whoever looks at the model isn't held up by it
    helpers.wait_polls(server, 2)
    assert command(server, "emergency_stop").status_code == 204
    server.wait_for(
        lambda: board_value(face, "state.status") == "halted", STOP_SECONDS, "the board to stand"
    )
    helpers.wait_value(server, "state.status", "halted", 30)
    return board_value(face, "heat.heaters.1.state")


def restart(server):
    """Return once the board that stands was restarted."""
    resets = helpers.status(server)["resets"]
    assert command(server, "recover").status_code == 204
    server.wait_for(lambda: helpers.status(server)["resets"] > resets, 90, "the restart")
