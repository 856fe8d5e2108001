"""Prints that OctoPrint streams."""

from tests.e2e import helpers

from .companions import IN_REPLIES, ON_A_PRINT
from .printing import Streamed
from .scene import Harmed, Scene

DONE = {"PrintStarted": 1, "PrintDone": 1}
PAUSED_ONCE = {**DONE, "PrintPaused": 1, "PrintResumed": 1}
CANCELLED = {"PrintStarted": 1, "PrintCancelled": 1, "PrintFailed": 1}

OK_AT_THE_PANEL = "M292 P0"


def size(rig):
    """Return how many moves a print has."""
    return rig.random.randrange(300, 900)


def through(rig):
    Streamed(rig, size(rig)).start().wait_done()


def with_people(rig):
    """Somebody sets fans and writes messages meanwhile."""
    print_ = Streamed(rig, size(rig)).start()
    said = []
    for number in range(6):
        print_.wait_part((number + 1) / 8)
        text = f"M117 turn {rig.turn} person {number}"
        rig.server.commands(text)
        said.append(text)
        rig.command("fan", fan=0, speed=round(0.1 + number / 100, 2))
    print_.wait_done()
    came = [line for line in rig.commands(0) if "person" in line]
    if came != said:
        raise Harmed(f"a person's lines are others than were given: {came} for {said}")


def paused_by_a_person(rig):
    print_ = Streamed(rig, size(rig)).start()
    print_.wait_part(0.3)
    rig.job(command="pause", action="pause")
    rig.server.wait_state("Paused", 30)
    count = len(print_.arrived())
    helpers.wait_polls(rig.server, 3)
    # what lay in the queues may still come, the rest of the file may not
    if len(print_.arrived()) > count + 40:
        raise Harmed("the print goes on while it is paused")
    rig.job(command="pause", action="resume")
    print_.wait_done()


def cancelled_by_a_person(rig):
    print_ = Streamed(rig, 1500).start()
    print_.wait_part(0.1)
    rig.job(command="cancel")
    rig.server.wait_state("Operational", 40)
    print_.assert_beginning()


def tools_changed(rig):
    """Half of the lines are tool changes and temperatures."""
    tools = rig.tools()
    extra = [(place / 40, f"T{rig.random.choice(tools)}") for place in range(1, 39)]
    extra += [(place / 20 + 0.01, f"M104 T{tools[0]} S{40 + place}") for place in range(1, 19)]
    Streamed(rig, 300, extra).start().wait_done()
    rig.server.commands("M104 S0")


def box_meanwhile(rig):
    """The board asks by another channel; one answer comes from OctoPrint, one from there."""
    print_ = Streamed(rig, size(rig)).start()
    print_.wait_part(0.2)
    for answer in ("OctoPrint", "panel"):
        rig.at_the_machine(f'M291 P"From the {answer}?" S2')
        rig.wait_value("state.messageBox.message", f"From the {answer}?")
        if answer == "panel":
            rig.at_the_machine(OK_AT_THE_PANEL, channel="aux")
        else:
            rig.command("message_box", action="ok")
        rig.wait_value("state.messageBox", None)
    print_.wait_done()


ASK = 'M98 P"0:/macros/ask.g"'


def box_of_a_macro(rig):
    """A macro of the file asks, and holds the line until somebody answers."""
    board = rig.board.board
    text = f"Is turn {rig.turn} clear?"
    firmware = board.firmware
    # what opens a box over this line and can't be answered is stuck until a reset
    answerable = not firmware.at_least(3, 5) or firmware.at_least(3, 6, 1)
    macro = f'M291 P"{text}" R"Question" S3\nG4 P10\n' if answerable else f"G4 S{8 * rig.speed}\n"
    with board.lock:
        board.card.write("0:/macros/ask.g", macro)
    print_ = Streamed(rig, 400, [(0.5, ASK)]).start()
    rig.wait(lambda: ASK in rig.commands(0), 60, "the macro to begin")
    if answerable:
        rig.wait_value("state.messageBox.message", text)
        rig.command("message_box", action="ok")
        rig.wait(lambda: not board.boxes.current, 20, "the answer to the box")
    else:
        board.message(f"- Question -\n{text}\nSend M292 to continue or M292 P1 to cancel\n")
        rig.wait(lambda: _told(rig, "box_waits"), 20, "the notice that somebody has to go there")
    print_.wait_done()
    helpers.wait_polls(rig.server, 2)


def _told(rig, code):
    return [told for told in rig.push.of_plugin() if told.get("code") == code]


GUARDED = (("heater_fault", "heater_fault_1"), ("driver_error", "driver_error_0_0"))


def guarded(rig):
    """A heater or a driver fails, is mended, and somebody resumes."""
    print_ = Streamed(rig, 900).start()
    print_.wait_part(0.1)
    # before 3.5 the model has no drivers: nobody could tell when it is over
    rows = GUARDED if rig.board.board.firmware.at_least(3, 5) else GUARDED[:1]
    fault, code = rig.random.choice(rows)
    rig.board.board.inject(fault)
    rig.server.wait_state("Paused", 40)
    rig.wait(lambda: {code, "print_paused"} <= set(rig.codes()), 20, "the warning and its cause")
    refused = rig.server.post("/api/job", json={"command": "pause", "action": "resume"})
    if refused.status_code != 409:
        raise Harmed(f"a print goes on with a {fault}")
    rig.board.board.clear(fault)
    rig.wait(lambda: code not in rig.codes(), 30, "the end of the fault")
    rig.job(command="pause", action="resume")
    print_.wait_done()


def reset_meanwhile(rig):
    """The board restarts in a print: the guard pauses, somebody cancels."""
    # a reset in a command that takes long shows when the patience with that is over, in minutes
    print_ = Streamed(rig, 2500, kinds=()).start()
    rig.at(10)
    rig.wait_value("state.upTime", lambda seconds: seconds > 60)
    rig.board.board.inject("reset")
    rig.wait(lambda: rig.server.state().startswith("Paus"), 60, "the pause after the reset")
    rig.server.wait_state("Paused", 60)
    rig.wait(lambda: "reset" in rig.codes(), 20, "the warning of the reset")
    rig.job(command="cancel")
    rig.server.wait_state("Operational", 60)
    print_.assert_in_order()


def unplugged_meanwhile(rig):
    """The port vanishes in a print: OctoPrint ends it, and it stays ended."""
    print_ = Streamed(rig, 2500).start()
    print_.wait_part(0.05)
    rig.board.board.unplug(2 * rig.speed)
    rig.server.wait_disconnected(60)
    print_.assert_in_order()
    helpers.disconnect(rig.server)
    rig.connect()


SCENES = (
    Scene(
        "print",
        "a file is streamed to its end",
        "each line reaches the board once and in order, and the print is neither paused nor ended",
        through,
        companions=ON_A_PRINT,
        events=DONE,
        prints=True,
    ),
    Scene(
        "print with people",
        "a file is streamed while somebody types and sets a fan",
        "the file's lines and the person's come once each, in the order in which they were given",
        with_people,
        companions=IN_REPLIES,
        events=DONE,
        prints=True,
    ),
    Scene(
        "print paused",
        "a person pauses and resumes",
        "it is paused and resumed once, nothing is sent while it is paused, no line is lost",
        paused_by_a_person,
        companions=IN_REPLIES,
        events=PAUSED_ONCE,
        prints=True,
    ),
    Scene(
        "print cancelled",
        "a person cancels",
        "what has come is the beginning of the file, and nothing follows",
        cancelled_by_a_person,
        companions=IN_REPLIES,
        events=CANCELLED,
        prints=True,
    ),
    Scene(
        "print with tools",
        "a file with many tool changes and temperatures",
        "each line reaches the board once and in order",
        tools_changed,
        companions=IN_REPLIES,
        events=DONE,
        prints=True,
    ),
    Scene(
        "print and boxes",
        "the board asks twice during a print, and is answered from both sides",
        "the print is not paused, each box gets its answer, each line comes once and in order",
        box_meanwhile,
        events=DONE,
        prints=True,
    ),
    Scene(
        "print and a macro's box",
        "a macro of the file asks and waits",
        "the print waits for the answer, however it comes, and goes on without losing a line",
        box_of_a_macro,
        events=DONE,
        prints=True,
    ),
    Scene(
        "print guarded",
        "a heater or driver fails during a print",
        "it is paused once, can't be resumed before it is mended, and then no line is lost",
        guarded,
        events=PAUSED_ONCE,
        prints=True,
    ),
    Scene(
        "reset in a print",
        "the board restarts during a print, a person cancels",
        "it is paused once and stays so until it is cancelled; no line comes twice or out of order",
        reset_meanwhile,
        events={**CANCELLED, "PrintPaused": 1},
        breaks_line=True,
        prints=True,
    ),
    Scene(
        "unplugged in a print",
        "the port vanishes during a print",
        "the print ends once, no line comes twice, and the connection can be made anew",
        unplugged_meanwhile,
        events={
            "PrintStarted": 1,
            "PrintFailed": 1,
            "PrintCancelled": (0, 1),
            "Disconnected": 1,
            "Error": (0, 1),
            "Connected": 1,
        },
        breaks_line=True,
        prints=True,
    ),
)
