"""Layers and progress of a print from the card, and of one that is streamed, for others."""

from pathlib import Path

import pytest

from octoprint_rrfmodel.integrations.layer_progress import MESSAGE
from tests.support import plugins
from tests.support.basedir import ADMIN, READER
from tests.support.push import PushListener

from .. import helpers

pytestmark = pytest.mark.slow

HERE = Path(plugins.__file__).parent
LISTENER = HERE / "eventlistener.py"
STAND_IN = HERE / "DisplayLayerProgress.py"

LAYERS = 8


MOVES_A_LAYER = 60
"""More than the board reads ahead."""


def tower():
    """Return a print with a slicer's comments that takes some seconds a layer, without heating."""
    lines = ["G90", "M83", "M106 S102"]
    for layer in range(LAYERS):
        lines += [";LAYER_CHANGE", f"G1 Z{0.25 * (layer + 1)} F900"]
        lines += [f"G1 X{50 + n % 2} F1200" for n in range(MOVES_A_LAYER)]
    return "\n".join([*lines, "; layer_height = 0.25", ""])


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(plugin_files=(LISTENER,))


@pytest.fixture
def connect(board_factory):
    """Function that returns a homed board with a file on its card."""

    def start(server):
        board = board_factory(machine="cartesian")
        with board.board.lock:
            board.board.card.write("0:/gcodes/tower.gcode", tower())
        helpers.connect(server, board)
        server.commands("G28")
        helpers.wait_value(server, "move.axes[].homed", [True] * 3, 30)
        return board

    return start


def events(server):
    """Return names and payloads of the events that a plugin of this server has heard."""
    return server.get("/api/plugin/eventlistener").json()["events"]


def wait_payload(push, what, **members):
    return push.wait_for_plugin(
        lambda found: all(found[name] == value for name, value in members.items()),
        60,
        what,
        MESSAGE,
    )


def test_print_from_the_card(server, connect):
    board = connect(server)
    before = len(events(server))
    with PushListener(server, READER) as push, PushListener(server, None) as nobody:
        board.board.execute('M32 "tower.gcode"')
        wait_payload(push, "the first layers", currentLayer="2")
        over = wait_payload(push, "the end", printerState="operational")
        payloads = push.of_plugin(MESSAGE)
        assert nobody.of_plugin(MESSAGE) == []
    layers = [int(found["currentLayer"]) for found in payloads if found["currentLayer"] != "-"]
    assert layers == sorted(layers)
    # what the file tells comes a moment after the first layer
    assert {found["totalLayer"] for found in payloads} - {"-"} == {str(LAYERS)}
    assert {found["currentFilename"] for found in payloads} - {"-"} == {"tower.gcode"}
    assert {"40%"} <= {found["fanspeed"] for found in payloads}
    assert {"1200"} <= {found["feedrate"] for found in payloads}
    middle = next(
        found
        for found in payloads
        if found["currentLayer"] != "-" and LAYERS // 2 <= int(found["currentLayer"]) < LAYERS
    )
    layer = int(middle["currentLayer"])
    assert 25 < int(middle["progress"]) < 100
    assert middle["lastLayerDurationInSeconds"] >= 1
    assert float(middle["currentHeight"]) == pytest.approx(0.25 * layer, abs=0.3)
    assert over["progress"] == "0"

    heard = events(server)[before:]
    assert {name for name, _ in heard} >= {
        "DisplayLayerProgress_layerChanged",
        "DisplayLayerProgress_progressChanged",
        "DisplayLayerProgress_heightChanged",
        "DisplayLayerProgress_printerStateChanged",
    }
    for name, payload in heard:
        assert name == f"DisplayLayerProgress_{payload['updateReason']}"
        assert payload["currentFilename"] == "-"


@pytest.mark.both_hosts("each streams and pauses with its own code")
def test_print_that_octoprint_streams(server, connect):
    connect(server)
    server.upload("streamed.gcode", tower())
    with PushListener(server, ADMIN) as push:
        server.select_and_print("streamed.gcode")
        wait_payload(push, "the print", printerState="printing", currentFilename="streamed.gcode")
        found = push.wait_for_plugin(
            lambda found: int(found["progress"]) > 20 and float(found["currentHeight"]) > 0,
            60,
            "progress and height",
            MESSAGE,
        )
        assert (found["currentLayer"], found["totalLayer"]) == ("-", "-")
        server.post("/api/job", json={"command": "pause", "action": "pause"})
        wait_payload(push, "the pause", printerState="paused")
        server.post("/api/job", json={"command": "cancel"})
        wait_payload(push, "the end", printerState="operational", progress="0")
    server.wait_state("Operational", 40)


def test_it_is_a_setting(server, connect):
    board = connect(server)
    server.set_setting("plugins.rrfmodel.layer_progress", False)
    try:
        with PushListener(server, ADMIN) as push:
            board.board.execute('M32 "tower.gcode"')
            helpers.wait_value(server, "job.layer", lambda layer: (layer or 0) >= 3, 60)
            assert push.of_plugin(MESSAGE) == []
    finally:
        server.set_setting("plugins.rrfmodel.layer_progress", True)


def test_silent_where_the_plugin_itself_is(server_factory, connect):
    server = server_factory(plugin_files=(LISTENER, STAND_IN))
    board = connect(server)
    with PushListener(server, ADMIN) as push:
        board.board.execute('M32 "tower.gcode"')
        helpers.wait_value(server, "job.layer", lambda layer: (layer or 0) >= 3, 60)
        assert push.of_plugin(MESSAGE) == []
    assert events(server) == []
