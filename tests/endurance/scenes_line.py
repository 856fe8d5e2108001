"""The connection: resets, unplugging, reconnecting, other machines, nights."""

from tests.e2e import helpers
from tests.support.waiting import within

from .companions import ON_A_NEW_LINE
from .rig import MACHINES
from .scene import Harmed, Scene


def reset(rig):
    """The port stays, everything else begins anew."""
    rig.at(10)
    rig.wait_value("state.upTime", lambda seconds: seconds > 100)
    before = rig.status()["resets"]
    rig.board.board.inject("reset")
    rig.wait(lambda: rig.status()["resets"] > before, 40, "the reset to show")
    rig.at_the_machine(f'M550 P"Reset {rig.turn}"')
    helpers.wait_polls(rig.server, 2)
    if rig.status()["resets"] != before + 1:
        raise Harmed(f"{rig.status()['resets'] - before} resets were seen for one")


def unplugged(rig):
    rig.board.board.unplug(rig.random.uniform(0.5, 3) * rig.speed)
    rig.server.wait_disconnected(60)
    rig.connect()


def power_cycled(rig):
    """The supply is gone for a moment: USB enumerates anew."""
    rig.at(1)
    rig.board.board.power_cycle()
    rig.server.wait_disconnected(60)
    rig.connect()


def reconnected(rig):
    for _ in range(3):
        rig.disconnect()
        rig.connect()


def reconnected_at_once(rig):
    """Before the model was known."""
    for _ in range(3):
        rig.disconnect()
        rig.server.connect(rig.board.link)
        rig.server.wait_state("Operational", 60)


def another_machine(rig):
    rig.another_board(*MACHINES[rig.random.randrange(len(MACHINES))])


def emergency(rig):
    rig.command("emergency_stop")
    rig.server.wait_disconnected(60)
    rig.wait(lambda: rig.board.board.is_halted, 20, "the board to stop")
    rig.at(20)
    rig.wait(lambda: "halted" in rig.codes(), 20, "the offer to restart")
    rig.command("recover")
    rig.wait(lambda: not rig.board.board.is_halted, 40, "the restart")
    rig.server.wait_state("Operational", 60)


NIGHT_SECONDS = 5
NIGHT = 10
"""A night goes by so much faster than a day."""


def night(rig):
    """Nothing happens for hours."""
    began = rig.hours
    rig.at(rig.speed * NIGHT)
    wanted = NIGHT_SECONDS * rig.speed * NIGHT / 3600
    rig.wait(lambda: rig.hours - began >= wanted, within(NIGHT_SECONDS * 3), "the morning")
    rig.at(None)
    helpers.wait_polls(rig.server, 2)


BOTH = {"Disconnected": 1, "Connected": 1}

SCENES = (
    Scene(
        "reset",
        "the board restarts, its port stays",
        "one reset is seen, and the model begins anew",
        reset,
        breaks_line=True,
    ),
    Scene(
        "unplugged",
        "the port vanishes and comes back",
        "OctoPrint notices, and connects again",
        unplugged,
        events={**BOTH, "Error": (0, 1)},
        breaks_line=True,
    ),
    Scene(
        "power cycled",
        "the board loses its supply for a moment",
        "OctoPrint notices, and connects again",
        power_cycled,
        events={**BOTH, "Error": (0, 1)},
        breaks_line=True,
    ),
    Scene(
        "reconnected",
        "OctoPrint disconnects and connects three times",
        "the whole model is there each time",
        reconnected,
        companions=ON_A_NEW_LINE,
        events={"Disconnected": 3, "Connected": 3},
        breaks_line=True,
    ),
    Scene(
        "reconnected at once",
        "OctoPrint disconnects before the model is known, three times",
        "the whole model is there in the end",
        reconnected_at_once,
        events={"Disconnected": 3, "Connected": 3},
        breaks_line=True,
    ),
    Scene(
        "another machine",
        "another machine with another firmware is plugged in",
        "nothing of the one before is left in the model",
        another_machine,
        events=BOTH,
        breaks_line=True,
    ),
    Scene(
        "emergency stop",
        "a person stops the machine, and lets it restart",
        "the board stops, and is there again with its model after the restart",
        emergency,
        events={"Disconnected": (1, 6), "Connected": (1, 2), "Error": (0, 1)},
        breaks_line=True,
    ),
    Scene(
        "night",
        "nothing happens for hours",
        "nothing happens",
        night,
    ),
)
