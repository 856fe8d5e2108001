"""What the end-to-end tests do all the time: connect a board, ask for the model, read the wire."""

import json
import re
import time

from octoprint_rrfmodel.rrf.model.m409 import MARKS

READY_SECONDS = 15
LIVE_SECONDS = 3
SETTLED_SECONDS = 5

INTERVAL = 4
"""Seconds without a line after which OctoPrint counts a timeout; the second one is the end."""

SHORT_TIMEOUTS = {
    "timeout": {
        "communication": INTERVAL,
        "communicationBusy": INTERVAL,
        "temperature": 2,
        "temperatureTargetSet": 2,
    },
    "maxCommunicationTimeouts": {"idle": 1, "printing": 1, "long": 1},
}

PATIENT = {
    "timeout": {
        "communication": 3,
        "communicationBusy": 3,
        "temperature": 1,
        "temperatureTargetSet": 1,
    },
    # a fault that lasts is no reason to give up here
    "maxCommunicationTimeouts": {"idle": 10, "printing": 10, "long": 10},
}
"""Timeouts of OctoPrint that are short and that it gets over."""

RECOVERY_SECONDS = 35
"""From the end of a fault: OctoPrint's timeout, and the plugin's longest wait after failures."""

WRONG = ("malformed", "out_of_buffers", "timeouts")
"""Counters of what went wrong."""

NUMBERED = re.compile(r"(?:N\d+ ?)?(?P<command>.*?)(?:\*\d+)?$")
"""A line as it came in on the wire; group ``command`` is the G-code."""

MOVES_APART = tuple(
    (re.compile(parts, re.MULTILINE), whole)
    for parts, whole in (
        (r"^M120 M83\nG91\n(G1 .*)\nG90\nM121$", r"M120 M83 \1 M121"),
        (r"^M120 G21\nG91\n(G1 .*)\nG90\nM121$", r"M120 G21 G91 \1 M121"),
        (r"^M120 G21\nG90\n(G1 .*)\nM121$", r"M120 G21 G90 \1 M121"),
    )
)
"""What goes out for an extrusion and for jogs, with the line that it was."""


# the plugin over HTTP


def status(server):
    """Return what the plugin says of its state."""
    response = server.get("/plugin/rrfmodel/status")
    assert response.status_code == 200, response.text
    return response.json()


def answer(server, key="", flags=""):
    """Return the whole answer of the model endpoint."""
    response = server.get("/plugin/rrfmodel/model", params={"key": key, "flags": flags})
    assert response.status_code == 200, response.text
    return response.json()


def value(server, key, flags="d99vno"):
    """Return the value that the model endpoint has for a key."""
    return answer(server, key, flags)["result"]


def wait_value(server, key, wanted, seconds, what=None):
    """Return the value once the model has that one; ``wanted`` may be a predicate."""
    fits = wanted if callable(wanted) else lambda found: found == wanted

    def fitting():
        found = value(server, key)
        # in a tuple, for what fits may be false
        return (found,) if fits(found) else None

    return server.wait_for(fitting, seconds, what or f"{key} to be {wanted!r} over HTTP")[0]


def disconnect(server):
    """Guarantee that no port is open and that the plugin has noticed."""
    if not server.state().startswith(("Offline", "Closed")):
        server.disconnect()
        server.wait_disconnected()

    def is_forgotten():
        state = status(server)
        return not (state["connected"] or state["is_rrf"] or state["ready"])

    server.wait_for(is_forgotten, 10, "the plugin to see the end of the connection")


def connect(server, board, seconds=READY_SECONDS):
    """Return the seconds from connecting to ``ready``; another connection ends before."""
    disconnect(server)
    started = time.monotonic()
    server.connect(board.link)
    wait_ready(server, seconds)
    return time.monotonic() - started


def wait_ready(server, seconds=READY_SECONDS):
    """Return once the whole model is known."""
    server.wait_for(lambda: status(server)["ready"], seconds, "the model to be ready")


def restarts(server):
    """Return how many restarts of the board have come to their end, for ``wait_restarted``."""
    return server.log().count("is connected again")


def wait_restarted(server, before):
    """Return once one more restart than before is over, and the model whole again."""
    server.wait_for(lambda: restarts(server) > before, 120, "the end of the restart")
    wait_ready(server, 90)


def wait_for_rrf(server):
    """Return once the printer has said what it is."""
    server.wait_for(lambda: status(server)["is_rrf"], 15, "the firmware to be known")


def wait_polls(server, count=3, seconds=30):
    """Return once so many more polls were answered."""
    before = status(server)["counters"]["replies"]
    server.wait_for(
        lambda: status(server)["counters"]["replies"] >= before + count, seconds, "further replies"
    )


# the model and the board's own


def own_reply(board, key, flags):
    """Return what the board answers on its network to one M409."""
    lines = board.board.execute(f'M409 K"{key}" F"{flags}"', channel="http").splitlines()
    # what earlier commands of that channel have left to say comes first
    return json.loads([line for line in lines if line.startswith("{")][-1])


def own_value(board, key):
    """Return what the board answers to M409 on its network, in as many parts as it needs."""
    items = []
    while True:
        reply = own_reply(board, key, f"d99vnoa{len(items)}")
        if "err" in reply:
            # too long for the board's buffers as a whole
            names = own_reply(board, key, "d2vno")["result"]
            return {name: own_value(board, f"{key}.{name}") for name in names}
        if not isinstance(reply["result"], list):
            return reply["result"]
        items += reply["result"]
        if not reply["next"]:
            return items


def differences(known, own, pattern):
    """Yield a sentence for each place where two values differ in more than live members.

    ``pattern`` is the path of both in the form of the table of marks.
    """
    if "live" in MARKS.get(pattern, ()) and not (
        isinstance(known, (dict, list)) or isinstance(own, (dict, list))
    ):
        return
    if isinstance(known, dict) and isinstance(own, dict):
        for name in sorted({*known, *own}):
            path = f"{pattern}.{name}" if pattern else name
            if name not in known or name not in own:
                yield f"{path}: only {'the board' if name in own else 'the plugin'} has it"
            else:
                yield from differences(known[name], own[name], path)
    elif isinstance(known, list) and isinstance(own, list):
        if len(known) != len(own):
            yield f"{pattern}: {len(known)} elements, the board has {len(own)}"
        for left, right in zip(known, own):
            yield from differences(left, right, f"{pattern}[]")
    elif known != own:
        yield f"{pattern}: {known!r}, the board has {own!r}"


def model_differences(server, board, keys=None):
    """Return where the plugin's model and the board's own differ, live members apart."""
    keys = keys or [name for name in board.board.model if name != "seqs"]
    own = {key: own_value(board, key) for key in keys}
    # the channel that asks: this was the network, and USB is the third
    if "thisInput" in (own.get("state") or ()):
        own["state"]["thisInput"] = 3
    # by one request: a test asks for this again and again
    known = value(server, "")
    return [difference for key in keys for difference in differences(known.get(key), own[key], key)]


def wait_equal(server, board, seconds=SETTLED_SECONDS):
    """Return once the plugin's model is the board's, live members apart."""
    last = []

    def is_equal():
        last[:] = model_differences(server, board)
        return not last

    try:
        server.wait_for(is_equal, seconds, "the plugin's model to be the board's")
    except AssertionError as error:
        raise AssertionError(f"{error}\n" + "\n".join(last[:20])) from None


# the wire


def commands(board):
    """Return the G-codes received on USB, without line numbers and checksums."""
    return commands_of(board.board)


def commands_of(board):
    """As ``commands``, for the board without its port."""
    return [command_of(text) for text in board.received()]


def command_of(text):
    """Return the G-code of a line, without its number and checksum."""
    return NUMBERED.match(text)["command"].strip()


def whole_moves(lines):
    """Return lines with each move that leaves modes as they were as the one line that was queued.

    Its parts come one right behind the other; where the last is still to come they stay apart.
    """
    text = "\n".join(lines)
    for parts, whole in MOVES_APART:
        text = parts.sub(whole, text)
    return text.splitlines()


def is_in_parts(lines):
    """Return whether a move of ``whole_moves`` is still on its way."""
    return "M120 G21" in lines or "M120 M83" in lines


def is_poll(command):
    """Return whether a command is one of the plugin's."""
    return command.startswith(("M409", "M408"))


def polls_without_status(sent):
    """Return the polls that no M105 follows directly; the last one may still be under way."""
    return [
        (number, command, sent[number + 1])
        for number, command in enumerate(sent[:-1])
        # the next connection's first line is behind one that was cut off
        if is_poll(command) and sent[number + 1] not in ("M105", "M110 N0")
    ]


def index_of(sent, command):
    """Return where a command is among those sent, from the end; -1 where it isn't."""
    places = [number for number, found in enumerate(sent) if found == command]
    return places[-1] if places else -1


def assert_status_request_in_front(sent, command):
    place = index_of(sent, command)
    assert place > 0, sent[-20:]
    assert sent[place - 1] == "M105", sent[place - 5 : place + 1]


def sent_until_acknowledged(server, command):
    """Return what went out behind a command until its ``ok`` was read, G-code alone."""
    _, found, behind = server.serial_log().rpartition(f" {command}*")
    # OctoPrint numbers all lines in a print, and otherwise none
    if not found:
        _, found, behind = server.serial_log().rpartition(f" {command}\n")
    assert found, command
    sent = []
    for line in behind.splitlines()[1:]:
        if re.search(r" - (?:Recv: |<<< )ok", line):
            return sent
        if match := re.search(r" - (?:Send: |>>> )(.*)", line):
            sent.append(command_of(match[1]))
    raise AssertionError(f"{command} is not acknowledged")


def assert_quiet(server, board, command):
    """The model wasn't asked for while a command ran, and the status right before it."""
    assert_status_request_in_front(commands(board), command)
    sent = sent_until_acknowledged(server, command)
    assert [found for found in sent if is_poll(found)] == []


def change(board):
    """Change something below several keys, so that they have to be fetched again."""
    board.board.execute(
        'M563 P0 S"Changed"\nM550 P"Changed"\nM220 S77\nM117 Changed\nset global.retries = 9'
    )
