"""Jobs of the board's card."""

from tests.support.basedir import is_version_2

from .companions import IN_REPLIES
from .scene import Harmed, Scene

NAME = "week job.gcode"
PATH = f"0:/gcodes/{NAME}"

CLOCK_SECONDS = 30
"""Of the clock, for a whole job: it has to be seen by a machine that is busy with other things, and
behind a lost answer, which is waited for 10 s, and two spoilt ones, behind which polls back off."""

ENDED = ("PrintDone", "PrintFailed", "PrintCancelled")


def with_job(rig):
    """Put a job on the card that takes some seconds of the clock; return its path in OctoPrint."""
    board = rig.board.board
    dwells = max(4, int(CLOCK_SECONDS * rig.speed / 20))
    with board.lock:
        board.card.write(PATH, "G28\n" + "G1 X40 Y10 F6000\nG4 S10\nG1 X20 Y10\nG4 S10\n" * dwells)
        board.volumes_changed(True)
    location = "printer" if is_version_2(rig.server.version) else "sdcard"

    def listed():
        response = rig.server.get(f"/api/files/{location}")
        files = response.json()["files"] if response.status_code == 200 else []
        return next((f"{location}/{file['path']}" for file in files if _is_job(file)), None)

    return rig.wait(listed, 40, "the job to be listed")


def _is_job(file):
    return file["display"] == NAME and file.get("size")


def wait_begun(rig):
    """Return when OctoPrint shows the job."""
    rig.wait(lambda: rig.server.state().startswith("Printing"), 30, "the job to be shown")


def wait_ended(rig):
    """Return when both say that it is over."""
    rig.wait(lambda: any(rig.events(name) for name in ENDED), 120, "the end of the job")
    rig.wait(lambda: not rig.board.board.job.is_printing, 40, "the end of the board's job")
    rig.server.wait_state("Operational", 40)


def assert_done(rig):
    """The board has printed it to its end."""
    job = rig.board.board.model["job"]
    # firmware before 3.5 doesn't tell how it ended
    ended = job.get("lastFileAborted") or job.get("lastFileCancelled")
    if job["lastFileName"] != PATH or ended:
        raise Harmed(f"the board's job was not done: {job}")


def select(rig, path):
    """Print it, as from OctoPrint's list of files."""
    response = rig.server.post(f"/api/files/{path}", json={"command": "select", "print": True})
    assert response.status_code == 204, response.text


def through(rig):
    select(rig, with_job(rig))
    wait_begun(rig)
    wait_ended(rig)
    assert_done(rig)


def of_the_machine(rig):
    with_job(rig)
    rig.at_the_machine(f'M32 "{PATH}"')
    wait_begun(rig)
    wait_ended(rig)
    assert_done(rig)


def paused(rig):
    select(rig, with_job(rig))
    wait_begun(rig)
    rig.job(command="pause", action="pause")
    rig.server.wait_state("Paused", 40)
    rig.wait(lambda: rig.board.board.job.state == "paused", 20, "the board to pause")
    rig.job(command="pause", action="resume")
    wait_ended(rig)
    assert_done(rig)


def paused_at_the_machine(rig):
    with_job(rig)
    rig.at_the_machine(f'M32 "{PATH}"')
    wait_begun(rig)
    rig.at_the_machine("M25")
    rig.server.wait_state("Paused", 40)
    rig.at_the_machine("M24")
    wait_ended(rig)
    assert_done(rig)


def cancelled(rig):
    select(rig, with_job(rig))
    wait_begun(rig)
    rig.job(command="cancel")
    wait_ended(rig)


DONE = {"PrintStarted": 1, "PrintDone": 1}

SCENES = (
    Scene(
        "card job",
        "a file of the card is printed from OctoPrint",
        "the board prints it to its end, and OctoPrint tells of one print that was done",
        through,
        companions=IN_REPLIES,
        events=DONE,
        prints=True,
    ),
    Scene(
        "card job of the machine",
        "a file of the card is printed at the machine",
        "OctoPrint shows it as one print, and stops nothing",
        of_the_machine,
        companions=IN_REPLIES,
        events=DONE,
        prints=True,
    ),
    Scene(
        "card job paused",
        "a person pauses and resumes a job of the card in OctoPrint",
        "it is paused once, and printed to its end",
        paused,
        events={**DONE, "PrintPaused": 1, "PrintResumed": 1},
        prints=True,
    ),
    Scene(
        "card job paused at the machine",
        "a person pauses and resumes a job of the card at the machine",
        "OctoPrint follows, and it is printed to its end",
        paused_at_the_machine,
        events={**DONE, "PrintPaused": 1, "PrintResumed": 1},
        prints=True,
    ),
    Scene(
        "card job cancelled",
        "a person cancels a job of the card in OctoPrint",
        "the board's job ends, and OctoPrint tells of one print that was cancelled",
        cancelled,
        events={"PrintStarted": 1, "PrintCancelled": 1, "PrintFailed": 1},
        prints=True,
    ),
)
