"""A message box of the machine in OctoPrint's own dialog for prompts, and its answer."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

PROMPTS = "action_command_prompt"
ENDPOINT = f"/api/plugin/{PROMPTS}"
ON = {"rrfmodel": {"prompts": True}}
MACRO = 'M98 P"0:/macros/Ask first"'
"""Opens a box with OK and Cancel and homes if the answer is OK."""

SHOWN = {"action": "show", "text": "Question: Is the bed clear?", "choices": ["OK", "Cancel"]}
CLOSED = {"action": "close"}


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(plugins_config=ON)


@pytest.fixture
def connect(server, board_factory):
    """Function that returns a connected board."""

    def start(**options):
        board = board_factory(**{"machine": "cartesian", "firmware": "3.5.3", **options})
        helpers.connect(server, board)
        return board

    yield start
    helpers.disconnect(server)


def pushed(push):
    return push.of_plugin(PROMPTS)


def wait_shown(server, push):
    server.wait_for(lambda: SHOWN in pushed(push), 10, "the dialog")
    prompt = server.get(ENDPOINT).json()
    assert (prompt["text"], prompt["choices"]) == (SHOWN["text"], SHOWN["choices"])


def press(server, choice):
    response = server.post(ENDPOINT, json={"command": "select", "choice": choice})
    assert response.status_code in (200, 204), response.text


@pytest.mark.both_hosts(
    "each has its own dialog for prompts", once_for=("firmware", "choice", "command", "answer")
)
@pytest.mark.parametrize(
    "firmware, choice, command, answer",
    [
        ("3.5.3", 0, "M292 P0 S1", None),
        ("3.5.3", 1, "M292 P1 S1", False),
        ("3.4", 0, "M292 P0", None),
        ("2.05", 1, "M292 P1", False),
    ],
)
def test_dialog_answers(server, connect, firmware, choice, command, answer):
    board = connect(firmware=firmware)
    with PushListener(server, ADMIN) as push:
        board.board.execute(MACRO)
        wait_shown(server, push)
        press(server, choice)
        server.wait_for(lambda: board.board.boxes.answers == [answer], 10, "the answer")
        helpers.wait_value(server, "state.messageBox", None, 10)
        server.wait_for(lambda: pushed(push)[-1] == CLOSED, 10, "the dialog to close")
        assert pushed(push).count(SHOWN) == 1
    sent = helpers.commands(board)
    assert [line for line in sent if line.startswith("M292")] == [command]
    assert not [line for line in sent if line.startswith("M876")]
    assert not server.get(ENDPOINT).json()


def test_choices(server, connect):
    board = connect()
    with PushListener(server, ADMIN) as push:
        board.board.execute('M291 P"Which?" R"Filament" S4 K{"PLA","ABS"} J1')
        shown = push.wait_for_plugin(lambda found: found["action"] == "show", 10, "it", PROMPTS)
        assert shown["choices"] == ["PLA", "ABS", "Cancel"]
        press(server, 1)
        server.wait_for(lambda: board.board.boxes.answers == [1], 10, "the answer")


@pytest.mark.both_hosts("each has its own dialog for prompts")
def test_closes_when_answered_elsewhere(server, connect):
    board = connect()
    with PushListener(server, ADMIN) as push:
        board.board.execute(MACRO)
        wait_shown(server, push)
        board.board.execute("M292 P1", channel="aux")
        server.wait_for(lambda: pushed(push)[-1] == CLOSED, 10, "the dialog to close")
    assert server.post(ENDPOINT, json={"command": "select", "choice": 0}).status_code == 409
    assert not [line for line in helpers.commands(board) if line.startswith(("M292", "M876"))]


def test_closes_with_the_connection(server, connect):
    board = connect()
    with PushListener(server, ADMIN) as push:
        board.board.execute(MACRO)
        wait_shown(server, push)
        helpers.disconnect(server)
        server.wait_for(lambda: pushed(push)[-1] == CLOSED, 10, "the dialog to close")
        assert pushed(push).count(CLOSED) == 1


def test_off_by_default(server_factory, board_factory):
    server = server_factory()
    board = board_factory(machine="cartesian")
    helpers.connect(server, board)
    with PushListener(server, ADMIN) as push:
        board.board.execute(MACRO)
        helpers.wait_value(server, "state.messageBox", lambda box: box is not None, 10)
        helpers.wait_polls(server, 2)
        assert pushed(push) == []
