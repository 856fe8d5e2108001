"""Message boxes that the board opens, answered from OctoPrint."""

import pytest

from .. import helpers
from ..operations import PROFILE, Machine

COMMAND = "/api/plugin/rrfmodel"

# what opens the box, the answer, the line without the box's number, what the board has got
OLD_BOXES = [
    ('M291 P"Close me" S1 T0', {"action": "ok"}, "M292 P0", None),
    ('M291 P"Go on?" R"Title" S2', {"action": "ok"}, "M292 P0", None),
    ('M291 P"Go on?" R"Title" S3', {"action": "ok"}, "M292 P0", None),
    ('M291 P"Go on?" R"Title" S3 X1', {"action": "cancel"}, "M292 P1", False),
]
NEW_BOXES = [
    ('M291 P"Which?" S4 K{"left","right"}', {"action": "ok", "value": 1}, "M292 P0 R{1}", 1),
    ('M291 P"Which?" S4 K{"left","right"} J1', {"action": "cancel"}, "M292 P1", False),
    ('M291 P"How many?" S5 L-5 H5', {"action": "ok", "value": -5}, "M292 P0 R{-5}", -5),
    ('M291 P"How much?" S6 L0 H1', {"action": "ok", "value": 0.25}, "M292 P0 R{0.25}", 0.25),
    (
        'M291 P"Name?" S7 L1 H20',
        {"action": "ok", "value": 'it\'s {M112} "ø"'},
        'M292 P0 R{"it\'\'s {M112} ""ø"""}',
        'it\'s {M112} "ø"',
    ),
]
BAD_ANSWERS = [
    {"action": "ok"},
    {"action": "ok", "value": 2},
    {"action": "ok", "value": "left"},
    {"action": "cancel"},
]


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(profile=PROFILE)


@pytest.fixture(scope="module", params=["2.05", "3.4", "3.6", "3.7"])
def machine(request, server, module_board_factory):
    board = module_board_factory(firmware=request.param, speed=5)
    helpers.connect(server, board)
    yield Machine(server, board)
    helpers.disconnect(server)


def has_values(machine):
    return machine.board.firmware.at_least(3, 5)


def opened(machine, gcode):
    """Open a box on the network's channel; return its number once the plugin knows it."""
    machine.board.execute(gcode, channel="http")
    seq = machine.board.boxes.current["seq"]
    helpers.wait_value(machine.server, "state.messageBox.seq", seq, 10)
    return seq


def answered(machine, gcode, answer, line):
    """Return what the board has made of an answer, once the box is gone everywhere."""
    seq = opened(machine, gcode)
    machine.command("message_box", [f"{line} S{seq}" if has_values(machine) else line], **answer)
    machine.server.wait_for(lambda: machine.board.boxes.current is None, 5, "the answer")
    helpers.wait_value(machine.server, "state.messageBox", None, 10)
    assert machine.server.state() == "Operational"
    return machine.board.boxes.answers[-1]


@pytest.mark.both_hosts(
    "lines go through the queue of the host",
    once_for=("machine", "gcode", "answer", "line", "result"),
)
@pytest.mark.parametrize("gcode, answer, line, result", OLD_BOXES, ids=lambda value: str(value))
def test_box_of_any_firmware(machine, gcode, answer, line, result):
    assert answered(machine, gcode, answer, line) == result


@pytest.mark.parametrize("gcode, answer, line, result", NEW_BOXES, ids=lambda value: str(value))
def test_box_that_wants_a_value(machine, gcode, answer, line, result):
    if not has_values(machine):
        machine.board.execute(gcode, channel="http")
        # that firmware refuses it
        assert machine.board.boxes.current is None
        return
    assert answered(machine, gcode, answer, line) == result


def test_which_box_is_meant(machine):
    seq = opened(machine, 'M291 P"Go on?" S2')
    request = {"command": "message_box", "action": "ok", "seq": seq + 1}
    response = machine.server.post(COMMAND, json=request)
    assert response.status_code == 409
    assert str(seq) in response.json()["error"]
    line = f"M292 P0 S{seq}" if has_values(machine) else "M292 P0"
    machine.command("message_box", [line], action="ok", seq=seq)
    helpers.wait_value(machine.server, "state.messageBox", None, 10)
    response = machine.server.post(COMMAND, json={**request, "seq": seq})
    assert response.status_code == 409


def test_second_answer_does_not_reach_the_next_box(machine):
    seq = opened(machine, 'M291 P"Take the probe off" S2')
    machine.board.execute('M291 P"Heat and load?" S3', channel="aux")
    # as the page sends it; before 3.5 the number doesn't go out
    answer = {"command": "message_box", "action": "ok", "seq": seq}
    assert machine.server.post(COMMAND, json=answer).status_code == 204
    response = machine.server.post(COMMAND, json=answer)
    assert response.status_code == 409
    assert response.json()["error"].endswith(".")
    helpers.wait_value(machine.server, "state.messageBox.message", "Heat and load?", 10)
    helpers.wait_polls(machine.server, 2)
    assert machine.board.boxes.current["message"] == "Heat and load?"
    # and that one is answered once somebody has seen it
    answer["seq"] = machine.board.boxes.current["seq"]
    assert machine.server.post(COMMAND, json=answer).status_code == 204
    machine.server.wait_for(lambda: machine.board.boxes.current is None, 5, "the answer")
    helpers.wait_value(machine.server, "state.messageBox", None, 10)


def test_answers_that_do_not_fit(machine):
    if not has_values(machine):
        seq = opened(machine, 'M291 P"Go on?" S2')
        bad = [{"action": "ok", "value": 1}, {"action": "cancel"}]
    else:
        seq = opened(machine, 'M291 P"Which?" S4 K{"left","right"}')
        bad = BAD_ANSWERS
    for answer in bad:
        response = machine.server.post(COMMAND, json={"command": "message_box", **answer})
        assert response.status_code == 400, response.text
    assert machine.board.boxes.current["seq"] == seq
    machine.board.execute("M292" if not has_values(machine) else "M292 R{0}", channel="telnet")
    helpers.wait_value(machine.server, "state.messageBox", None, 10)


@pytest.mark.both_hosts("each has its own code for the card")
def test_a_box_of_the_boards_own_print(server, board_factory):
    """The print waits; the answer goes between OctoPrint's own questions about it."""
    board = board_factory(speed=5)
    with board.board.lock:
        board.board.card.write(
            "0:/gcodes/ask.gcode", 'G4 S2\nM291 P"Colour?" S4 K{"red","blue"}\nG4 S2\n'
        )
    helpers.connect(server, board)
    machine = Machine(server, board)
    machine.command("job", ['M32 "0:/gcodes/ask.gcode"'], action="start", path="ask.gcode")
    seq = helpers.wait_value(server, "state.messageBox.seq", bool, 20) and board.board.boxes.current
    before = len(board.board.received())
    machine.post("message_box", action="ok", value=1)
    server.wait_for(
        lambda: f"M292 P0 R{{1}} S{seq['seq']}" in machine.sent_since(before), 5, "the answer"
    )
    server.wait_for(lambda: not board.board.job.is_printing, 20, "the end of the print")
    assert board.board.boxes.answers == [1]
    helpers.disconnect(server)


@pytest.mark.parametrize("firmware, status", [("3.5.3", 409), ("3.4", 204)])
def test_box_that_waits_on_the_line_itself(server, board_factory, firmware, status):
    board = board_factory(firmware=firmware)
    helpers.connect(server, board)
    machine = Machine(server, board)
    seq = opened(machine, 'M291 P"Go on?" S2')
    usb = board.board.channels["USB"]
    usb.awaits_acknowledgement = True
    helpers.wait_value(server, "inputs[3].state", "awaitingAcknowledgement", 5)
    request = {"command": "message_box", "action": "ok", "seq": seq}
    response = server.post(COMMAND, json=request)
    assert response.status_code == status, response.text
    if status == 409:
        assert "panel" in response.json()["error"]
    usb.awaits_acknowledgement = False
    helpers.disconnect(server)
