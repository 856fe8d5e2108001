"""What happens to a board on the network in a week."""

from tests.e2e import helpers
from tests.e2e.network import bench

from .network_rig import SLOW
from .scene import Harmed

PASSING = (
    *("net_503:5", "net_reset:4", "net_cut:4", "net_garbled:3", "net_lost_answer:3"),
    *("net_foreign:4", "net_redirect:4", "net_stale_key", "net_slow:1"),
)
"""Faults that are over by themselves, or with the scene."""

GAPS = ("net_loss", "net_refused", "net_busy", "net_full", "net_foreign")
"""Faults for which the board is gone as long as they last."""

DWELLS = 12

JOB = "G28\n" + "G1 X40 Y10 F6000\nG4 S10\nG1 X20 Y10\nG4 S10\n" * DWELLS
"""Some seconds of the clock at that pace."""

PATH = "0:/gcodes/week job.gcode"

COUNT = "set global.retries = global.retries + 1"


def idle(rig):
    """Things change at the machine while answers get lost."""
    rig.fault(rig.random.choice(PASSING))
    for number in range(3):
        rig.at_the_machine(f'M117 "idle {number}"\nM550 P"Week {rig.random.randrange(100)}"')
        rig.at_the_machine(f"M220 S{rig.random.randrange(50, 150)}")
        rig.wait_reachable()
        helpers.wait_polls(rig.server, 2, 90)


def commands(rig):
    """Each command reaches the board once, in order."""
    before, wanted = rig.value("global.retries"), 12
    for _ in range(wanted):
        rig.server.commands(COUNT)
    rig.server.commands('M117 "last"')
    helpers.wait_value(rig.server, "state.displayMessage", "last", 40)
    if rig.value("global.retries") != before + wanted:
        raise Harmed(f"{rig.value('global.retries') - before} of {wanted} commands were run")


def commands_at_a_loss(rig):
    """A command whose answer is lost isn't given again."""
    before, wanted = rig.value("global.retries"), 8
    rig.fault(rig.random.choice(["net_lost_answer:2", "net_reset:2", "net_cut:2"]))
    for _ in range(wanted):
        rig.server.commands(COUNT)
    rig.clear_faults()
    rig.wait_reachable()
    rig.server.commands('M117 "behind"')
    helpers.wait_value(rig.server, "state.displayMessage", "behind", 60)
    if rig.value("global.retries") > before + wanted:
        raise Harmed(f"{rig.value('global.retries') - before} commands were run, {wanted} given")


def job_at_the_machine(rig):
    """A job is begun at the machine, with a gap in it, and ends as it should."""
    _begin_job(rig)
    if rig.random.random() < 0.5:
        rig.fault("net_loss", lasts=rig.random.uniform(2, 6))
    _wait_events(rig, PrintStarted=1, PrintDone=1)


def _begin_job(rig):
    rig.at(SLOW)
    with rig.board.lock:
        rig.board.card.write(PATH, JOB)
        rig.board.volumes_changed(True)
    rig.at_the_machine(f'M32 "{PATH}"')
    rig.server.wait_state("Printing", 40)


def _wait_events(rig, **counts):
    for name, count in counts.items():
        rig.wait(lambda name=name: rig.events(name), 120, f"the event {name}")
        if len(rig.events(name)) != count:
            raise Harmed(f"{name}: {rig.events(name)}")


def own_job(rig):
    """A file of OctoPrint's own is brought to the board, and printed from there."""
    rig.at(SLOW)
    rig.server.upload("week own.gcode", JOB + f"; {rig.random.random()}\n")
    rig.server.select_and_print("week own.gcode")
    _wait_events(rig, PrintStarted=1, PrintDone=1)


def cancelled_job(rig):
    """A job is paused, resumed and cancelled by OctoPrint."""
    _begin_job(rig)
    rig.server.post("/api/job", json={"command": "pause", "action": "pause"})
    rig.server.wait_state("Paused", 40)
    rig.server.post("/api/job", json={"command": "pause", "action": "resume"})
    rig.server.wait_state("Printing", 40)
    rig.server.post("/api/job", json={"command": "cancel"})
    _wait_events(rig, PrintPaused=1, PrintResumed=1, PrintCancelled=1)


def reset(rig):
    """The board is reset while nobody prints."""
    _reset(rig)
    if rig.events("Disconnected"):
        raise Harmed("a reset has ended the connection")


def _reset(rig):
    rig.at(SLOW)
    before = rig.status()["resets"]
    rig.board.reset()
    rig.wait(lambda: rig.status()["resets"] == before + 1, 90, "the reset to be seen")
    helpers.wait_ready(rig.server, 60)


def reset_in_a_job(rig):
    """The board is reset in a print, which ends."""
    _begin_job(rig)
    _reset(rig)
    _wait_events(rig, PrintFailed=1)


def gap(rig):
    """The board can't be reached for some seconds, one way or the other."""
    rig.fault(rig.random.choice(GAPS), lasts=rig.random.uniform(3, 9))
    rig.wait_reachable()
    if rig.events("Disconnected"):
        raise Harmed("a gap has ended the connection")


def again(rig):
    """OctoPrint disconnects, and connects again."""
    rig.connect()


def files(rig):
    """A file is brought, listed and deleted."""
    name = f"week-{rig.random.randrange(1000)}.gcode"
    content = f"; {rig.random.random()}\nG1 X10\n" * 8000
    upload = rig.server.post("/api/files/printer", files={"file": (name, content)})
    assert upload.status_code == 201, upload.text
    listed = lambda: rig.server.get(f"/api/files/printer/{name}").status_code  # noqa: E731
    rig.wait(lambda: listed() == 200, 40, "the file to be listed")
    deleted = rig.server.delete(f"/api/files/printer/{name}")
    assert deleted.status_code == 204, deleted.text
    rig.wait(lambda: listed() == 404, 40, "the file to be gone")


def commanded(rig):
    """The plugin's own commands reach the machine."""
    speed = rig.random.randrange(10) / 10
    response = bench.command(rig.server, "fan", fan=0, speed=speed)
    assert response.status_code == 204, response.text
    helpers.wait_value(rig.server, "fans[0].requestedValue", speed, 40)


SCENES = (
    *(idle, commands, commands_at_a_loss, job_at_the_machine, own_job, cancelled_job),
    *(reset, reset_in_a_job, gap, again, files, commanded),
)
