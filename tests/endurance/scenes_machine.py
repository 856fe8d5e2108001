"""The machine while nobody prints: tools, boxes, people, faults alone and in pairs."""

from tests.e2e import helpers

from .companions import IN_REPLIES, WHILE_IDLE
from .scene import Harmed, Scene


def tools(rig):
    for number in [*rig.random.choices([*rig.tools(), -1], k=4), rig.random.choice(rig.tools())]:
        way = rig.random.choice(["plugin", "terminal", "machine"])
        before = rig.received()
        if way == "plugin":
            rig.command("select_tool", tool=number)
        elif way == "terminal":
            rig.server.commands(f"T{number}")
        else:
            rig.at_the_machine(f"T{number}")
        if way != "machine":
            # or it may come behind what somebody does at the machine next
            rig.wait(
                lambda before=before: any(line.startswith("T") for line in rig.commands(before)),
                20,
                "the tool's command",
            )
        rig.wait_value("state.currentTool", number)


def boxes(rig):
    for number, way in enumerate(rig.random.choices(["plugin", "panel", "time"], k=3)):
        text = f"Box {number} of turn {rig.turn}"
        timeout = f" T{15 * rig.speed:.0f}" if way == "time" else ""
        rig.at_the_machine(f'M291 P"{text}" S{1 if way == "time" else 2}{timeout}')
        rig.wait_value("state.messageBox.message", text)
        if way == "plugin":
            rig.command("message_box", action="ok")
        elif way == "panel":
            rig.at_the_machine("M292 P0", channel="aux")
        rig.wait_value("state.messageBox", None)


def people(rig):
    """Lines from the terminal, commands of the plugin, OctoPrint's own operations."""
    rig.home()
    said = [f"M117 turn {rig.turn} line {number}" for number in range(40)]
    for number, text in enumerate(said):
        rig.server.commands(text)
        if number % 10 == 3:
            rig.command("jog", axes={"X": 1 if number % 20 == 3 else -1})
        if number % 10 == 7:
            rig.command("fan", fan=0, speed=round(number / 100, 2))
    rig.wait(lambda: _said(rig)[-1:] == said[-1:], 40, "the last line of a person to come")
    if _said(rig) != said:
        raise Harmed(f"a person's lines are others than were given: {_said(rig)}")
    moved = [line for line in rig.commands(0) if line.startswith("G1 X")]
    if moved != ["G1 X1", "G1 X-1"] * 2:
        raise Harmed(f"a person's jogs came as {moved}")


def _said(rig):
    return [line for line in rig.commands(0) if line.startswith(f"M117 turn {rig.turn} ")]


def heating(rig):
    rig.command("bed", index=0, active=50, state="active")
    rig.wait_value("heat.heaters[0].active", 50)
    rig.wait_value("heat.heaters[0].current", lambda found: found > 48, 40)
    rig.command("bed", index=0, active=0, state="off")
    rig.wait_value("heat.heaters[0].state", "off")


def idle(rig):
    """Things change at the machine, and nobody asks for anything."""
    for number in range(3):
        rig.at_the_machine(f'M117 turn {rig.turn} {number}\nM550 P"Week {rig.turn} {number}"')
        helpers.wait_polls(rig.server, 2, 60)


SCENES = (
    Scene(
        "tools",
        "tools are selected from OctoPrint, from the plugin and at the machine",
        "the model has the tool that was selected last each time",
        tools,
        companions=IN_REPLIES,
    ),
    Scene(
        "boxes",
        "boxes open and are answered here, there, or by time",
        "each is shown, and is gone everywhere when it is answered",
        boxes,
    ),
    Scene(
        "people",
        "somebody types forty lines and jogs meanwhile",
        "each line and each jog reaches the board once and in order",
        people,
        companions=IN_REPLIES,
    ),
    Scene(
        "heating",
        "the bed is heated and switched off",
        "the model follows, and no heater is left on",
        heating,
        companions=IN_REPLIES,
    ),
    Scene(
        "idle with faults",
        "the machine is looked at while line and board fail",
        "the connection stays, and the model is the board's once they are over",
        idle,
        companions=WHILE_IDLE,
    ),
)
