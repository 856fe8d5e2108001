"""The board's card in OctoPrint: its files, the prints from it, and what can't be done with it."""

import time

import pytest
from octoprint.util.files import get_dos_filename

from tests.support.basedir import ADMIN, OPERATOR, READER, is_version_2
from tests.support.push import PushListener

from .. import helpers

pytestmark = pytest.mark.both_hosts("each has its own code for the card")

FILES = {
    "square.gcode": "0:/gcodes/square.gcode",
    "Two layers.gcode": "0:/gcodes/Two layers.gcode",
    "Prüfkörper ø20.gcode": "0:/gcodes/Prüfkörper ø20.gcode",
    "Spare parts/clip (L).gcode": "0:/gcodes/Spare parts/clip (L).gcode",
    "Spare parts/ver 2/clip.gcode": "0:/gcodes/Spare parts/ver 2/clip.gcode",
}
LISTED = len(FILES)
LISTED_SECONDS = 15
PRINT_SECONDS = 60

BY_PROTOCOL = pytest.mark.parametrize("firmware", ["3.5.3", "2.05"])
"""What is known of the job comes by ``M409``, or by ``M408`` and ``M36``."""


@pytest.fixture(scope="module")
def location(octoprint_version):
    return "printer" if is_version_2(octoprint_version) else "sdcard"


@pytest.fixture
def files(server, location):
    """Function that returns what OctoPrint has on the card, by the name that a person sees."""

    def get():
        response = server.get(f"/api/files/{location}")
        # 2.0 has no such storage before the card is there
        listed = response.json()["files"] if response.status_code == 200 else []
        return {file["display"]: file for file in listed}

    return get


@pytest.fixture
def connected(server, board_factory, files):
    """Function that returns a board whose files OctoPrint has listed, with their sizes."""

    def connect(count=LISTED, prepare=lambda card: None, **options):
        board = board_factory(**{"speed": 5.0, **options})
        with board.board.lock:
            prepare(board.board.card)
        helpers.connect(server, board)
        server.wait_for(
            lambda: len(files()) == count and all(file.get("size") for file in files().values()),
            LISTED_SECONDS,
            "the card's files",
        )
        return board

    return connect


@pytest.fixture
def select(server, location, files):
    """Function that selects a file, or prints it, by the name that a person sees."""

    def act(name, start=False):
        path = files()[name]["path"]
        command = {"command": "select", "print": start}
        response = server.post(f"/api/files/{location}/{path}", json=command)
        assert response.status_code == 204, response.text
        server.wait_for(
            lambda: server.job()["job"]["file"]["path"] == path, 10, f"{name} to be selected"
        )

    return act


def do(server, **command):
    response = server.post("/api/job", json=command)
    assert response.status_code == 204, response.text


def wait_printing(server, seconds=PRINT_SECONDS):
    server.wait_for(
        lambda: server.state().startswith("Printing") and server.job()["progress"]["filepos"],
        seconds,
        "a print that goes on",
    )


def wait_job_gone(server, board):
    server.wait_for(lambda: not board.board.job.is_printing, 20, "the end of the board's job")


def assert_no_harm(board):
    sent = helpers.commands(board)
    assert "M112" not in sent
    assert not helpers.polls_without_status(sent)


# listing


@pytest.mark.both_hosts("each has its own code for the card", once_for=("firmware",))
@pytest.mark.parametrize("firmware", ["2.05", "3.3", "3.4", "3.5.3", "3.6", "3.7"])
def test_card_is_listed(server, connected, files, firmware):
    board = connected(firmware=firmware)
    assert server.get("/api/printer").json()["sd"] == {"ready": True}
    listed = files()
    assert set(listed) == set(FILES)
    for name, path in FILES.items():
        assert listed[name]["size"] == len(board.board.card.read(path))
        date = time.mktime(time.strptime(board.board.card.date(path), "%Y-%m-%dT%H:%M:%S"))
        assert listed[name]["date"] == date
        assert listed[name]["type"] == "machinecode"
    assert_no_harm(board)


def test_names_are_left_alone_by_octoprint(connected, files, octoprint_version):
    connected()
    kept = "allowlisted" if is_version_2(octoprint_version) else "whitelisted"
    for file in files().values():
        name = file["path"]
        assert name == name.lower() == file["name"]
        options = {f"{kept}_extensions": ["gco", "g"]}
        assert get_dos_filename(name, extension="gco", **options) == name


def test_many_files_and_odd_names(server, connected, select, location, files):
    names = [f"part {number:03d}.gcode" for number in range(150)]
    names += ["Bob's cube.gcode", "日本語.gcode", "a;b.gcode", "x" * 60 + ".gcode"]

    def prepare(card):
        for name in names:
            card.write(f"0:/gcodes/many/{name}", "G4 P10\n")

    board = connected(count=len(FILES) + len(names), prepare=prepare)
    assert {f"many/{name}" for name in names} < set(files())
    assert any(" R1" in line or " R2" in line for line in helpers.commands(board))
    for name in names[-4:]:
        select(f"many/{name}")
        assert board.board.job.path == f"0:/gcodes/many/{name}"


def test_change_on_the_card_shows(server, connected, files):
    board = connected()
    board.board.execute('M30 "0:/gcodes/square.gcode"', channel="http")
    rest = set(FILES) - {"square.gcode"}
    assert server.wait_for(lambda: set(files()) == rest, 10, "the file to be gone")


def test_release_and_init(server, connected, files, location):
    board = connected()
    assert server.post("/api/printer/sd", json={"command": "release"}).status_code == 204
    server.wait_for(
        lambda: server.get("/api/printer").json()["sd"] == {"ready": False}, 5, "no card"
    )
    server.wait_for(lambda: not board.board.card.is_mounted, 5, "the card to be released")
    assert files() == {}
    assert server.post("/api/printer/sd", json={"command": "init"}).status_code == 204
    server.wait_for(lambda: set(files()) == set(FILES), 10, "the files to be back")
    before = len(board.board.received())
    assert server.post("/api/printer/sd", json={"command": "refresh"}).status_code == 204
    server.wait_for(
        lambda: "M20" in helpers.commands(board)[before:], 10, "OctoPrint to ask for the list"
    )
    helpers.wait_polls(server, 2)
    assert set(files()) == set(FILES)


def test_aliases_stay_over_connections(server, connected, files):
    connected()
    before = {name: file["path"] for name, file in files().items()}
    connected()
    assert {name: file["path"] for name, file in files().items()} == before


# printing


@pytest.mark.parametrize("name", FILES)
def test_file_is_selected(server, connected, select, files, name):
    board = connected()
    select(name)
    file = server.job()["job"]["file"]
    assert (file["display"], file["size"]) == (name, files()[name]["size"])
    assert helpers.commands(board).count(f'M23 "{FILES[name]}"') == 1
    assert board.board.job.path == FILES[name]


MILLED = "G28\n" + "G1 X40 Y0 F1200\nG1 X40 Y40\nG1 X0 Y40\nG1 X0 Y0\n" * 60
"""A job of a router: M140 fails where there is no bed, and what fails ends a job."""


def for_machine(machine):
    """Return what puts a job on the card that the machine can run to its end."""

    def prepare(card):
        if machine == "cnc":
            card.write("0:/gcodes/square.gcode", MILLED)
            card.write("0:/sys/pause.g", "G91\nG1 Z5 F900\nG90\n")
            card.write("0:/sys/resume.g", "G4 P500\n")

    return prepare


@pytest.mark.both_hosts("each has its own code for the card", once_for=("machine", "firmware"))
@pytest.mark.parametrize(
    "machine, firmware",
    [("cartesian", "2.05"), ("cnc", "3.3"), ("cartesian", "3.5.3"), ("toolchanger", "3.7")],
)
def test_print_pause_resume_cancel(server, connected, select, machine, firmware):
    board = connected(prepare=for_machine(machine), machine=machine, firmware=firmware)
    job = board.board.job
    select("square.gcode", start=True)
    wait_printing(server)
    progress = server.job()["progress"]
    assert 0 < progress["filepos"] <= job.position
    do(server, command="pause", action="pause")
    server.wait_state("Paused", 30)
    assert job.state == "paused"
    helpers.wait_polls(server, 3)
    assert server.state() == "Paused"
    do(server, command="pause", action="resume")
    server.wait_state("Printing", 30)
    assert job.state == "printing"
    helpers.wait_polls(server, 3)
    assert server.state().startswith("Printing")
    do(server, command="cancel")
    server.wait_state("Operational", 30)
    assert not job.is_printing
    helpers.wait_polls(server, 3)
    assert server.state() == "Operational"
    sent = helpers.commands(board)
    assert sent[-1] != "M26 S0"
    assert "M400 M0" in sent
    assert sent.count("M400 M0") == 1
    assert_no_harm(board)


def test_cancel_of_a_paused_print(server, connected, select):
    board = connected()
    select("square.gcode", start=True)
    wait_printing(server)
    do(server, command="pause", action="pause")
    server.wait_state("Paused", 30)
    # until the model says paused
    helpers.wait_value(server, "state.status", "paused", 5)
    do(server, command="cancel")
    server.wait_state("Operational", 30)
    wait_job_gone(server, board)
    assert_no_harm(board)


def test_pause_that_is_put_off_is_waited_for(server, connected, select):
    board = connected()
    select("square.gcode", start=True)
    wait_printing(server)
    # M25 and M0 are refused while the job is already pausing; the model says when it has paused
    board.board.execute("M25", channel="http")
    do(server, command="cancel")
    server.wait_state("Operational", 30)
    wait_job_gone(server, board)
    helpers.wait_polls(server, 3)
    assert server.state() == "Operational"
    assert_no_harm(board)


@pytest.mark.both_hosts("each has its own code for the card", once_for=("firmware",))
@BY_PROTOCOL
def test_print_to_its_end_and_another(server, connected, select, firmware):
    board = connected(firmware=firmware)
    with PushListener(server, ADMIN) as push:
        for name in ("Two layers.gcode", "Prüfkörper ø20.gcode"):
            done = len(push.events("PrintDone"))
            select(name, start=True)
            wait_printing(server)
            assert board.board.job.path == FILES[name]
            server.wait_for(lambda done=done: len(push.events("PrintDone")) > done, 120, "the end")
            server.wait_state("Operational")
        assert push.events("PrintFailed") == push.events("PrintCancelled") == []
    assert_no_harm(board)


@pytest.mark.both_hosts("each has its own code for the card", once_for=("firmware",))
@BY_PROTOCOL
def test_job_of_the_machine_is_shown(server, connected, select, firmware):
    board = connected(firmware=firmware)
    select("square.gcode")
    name = "Spare parts/ver 2/clip.gcode"
    with PushListener(server, ADMIN) as push:
        board.board.execute(f'M32 "{FILES[name]}"', channel="http")
        wait_printing(server)
        file = server.job()["job"]["file"]
        assert (file["display"], file["size"]) == (name, len(board.board.card.read(FILES[name])))
        board.board.execute("M25", channel="http")
        server.wait_state("Paused", 30)
        board.board.execute("M24", channel="http")
        server.wait_state("Printing", 30)
        server.wait_state("Operational", 120)
        assert push.count("PrintDone", 1) == push.count("PrintStarted", 1) == 1
        assert push.events("PrintFailed") == []
    assert_no_harm(board)


@pytest.mark.both_hosts("each has its own code for the card", once_for=("firmware",))
@BY_PROTOCOL
def test_job_that_goes_on_when_octoprint_connects(server, board_factory, firmware):
    board = board_factory(speed=5.0, firmware=firmware)
    board.board.execute(f'M32 "{FILES["square.gcode"]}"', channel="http")
    helpers.connect(server, board)
    wait_printing(server)
    assert server.job()["job"]["file"]["display"] == "square.gcode"
    do(server, command="cancel")
    server.wait_state("Operational", 30)
    wait_job_gone(server, board)


@pytest.mark.parametrize("name", ["square.gcode", "Spare parts/ver 2/clip.gcode"])
def test_job_that_begins_before_octoprint_has_the_list(server, board_factory, files, name):
    board = board_factory()
    for number in range(8):
        board.board.card.write(f"0:/gcodes/folder {number}/some.gcode", "G4 S1\n")
    board.board.card.write(FILES[name], "G4 S1\n" * 60)
    helpers.connect(server, board)
    helpers.wait_ready(server)
    # known before the list of all folders is, and that a moment before OctoPrint has asked for it
    board.board.execute(f'M32 "{FILES[name]}"', channel="http")
    server.wait_state("Printing", 30)
    assert server.job()["job"]["file"]["display"] == name
    assert "Something crashed" not in server.log()


@pytest.mark.both_hosts("each has its own code for the card", once_for=("firmware",))
@BY_PROTOCOL
def test_job_paused_and_cancelled_at_the_machine(server, connected, select, firmware):
    board = connected(firmware=firmware)
    select("square.gcode", start=True)
    wait_printing(server)
    board.board.execute("M25", channel="http")
    server.wait_state("Paused", 30)
    before = len(board.board.received())
    board.board.execute("M0", channel="http")
    wait_job_gone(server, board)
    server.wait_state("Operational", 40)
    sent = helpers.commands(board)[before:]
    assert not [line for line in sent if line.startswith("M25") or "M0" in line.split()]
    assert_no_harm(board)
    # and the next print is one
    select("square.gcode", start=True)
    wait_printing(server)


def test_job_cancelled_at_the_machine(server, connected, select):
    board = connected()
    select("square.gcode", start=True)
    wait_printing(server)
    board.board.execute("M25", channel="http")
    server.wait_for(lambda: board.board.job.state == "paused", 20, "the pause")
    board.board.execute("M0", channel="http")
    wait_job_gone(server, board)
    server.wait_state("Operational", 40)
    assert_no_harm(board)


OF_A_SCRIPT = {"M84", "M104", "M106", "M108", "M140", "M400", "M118"}
"""What OctoPrint's own scripts and its cancelling send; M118 is of the one before a print."""


@pytest.fixture
def started_by_script(server):
    """A script of OctoPrint's that runs before each print."""
    for script in ('M118 P0 S"before"', ""):
        server.post("/api/settings", json={"scripts": {"gcode": {"beforePrintStarted": script}}})
        if script:
            yield


@pytest.mark.both_hosts("each has its own code for the card", once_for=("firmware",))
@BY_PROTOCOL
def test_row_5_job_of_the_machine_gets_none_of_octoprints_scripts(
    server, connected, select, started_by_script, firmware
):
    board = connected(firmware=firmware)
    board.board.execute(f'M32 "{FILES["Two layers.gcode"]}"', channel="http")
    with PushListener(server, ADMIN) as push:
        wait_printing(server)
        board.board.execute("M25", channel="http")
        server.wait_for(lambda: board.board.job.state == "paused", 20, "the pause")
        board.board.execute("M0", channel="http")
        wait_job_gone(server, board)
        # into this one would go what OctoPrint has to say about the end of the other
        board.board.execute(f'M32 "{FILES["square.gcode"]}"', channel="http")
        push.wait_for_event("PrintCancelled", 40)
        wait_printing(server)
        assert server.job()["job"]["file"]["display"] == "square.gcode"
        do(server, command="cancel")
        server.wait_state("Operational", 40)
        wait_job_gone(server, board)
        helpers.wait_polls(server, 3)
        assert push.count("PrintCancelled", 2) == 2
        assert push.events("PrintDone") == []
    sent = helpers.commands(board)
    assert [line for line in sent if line.split()[0] in OF_A_SCRIPT and line != "M400 M0"] == []
    # and a print of OctoPrint's own has them
    select("square.gcode", start=True)
    wait_printing(server)
    do(server, command="cancel")
    server.wait_state("Operational", 40)
    sent = helpers.commands(board)[len(sent) :]
    assert {line.split()[0] for line in sent} >= OF_A_SCRIPT
    assert_no_harm(board)


def say_done_first(board):
    """Let the board say of each print first that it is done, as the firmware does."""
    output, said = board.board.job._output, [""]
    text = output.text

    def say(line, *arguments, **options):
        if line.startswith("Cancelled printing file") and not said[0].startswith("Done printing"):
            text("Done printing file\n")
        said[0] = line
        return text(line, *arguments, **options)

    output.text = say


@pytest.mark.parametrize("where", ["octoprint", "octoprint, paused", "machine"])
def test_row_18_print_that_is_cancelled_has_no_other_end(server, connected, select, where):
    board = connected()
    say_done_first(board)
    with PushListener(server, ADMIN) as push:
        select("square.gcode", start=True)
        wait_printing(server)
        if where == "machine":
            # too fast for OctoPrint to have seen the pause
            board.board.execute("M25", channel="http")
            server.wait_for(lambda: board.board.job.state == "paused", 20, "the pause")
            board.board.execute("M0", channel="http")
        else:
            if "paused" in where:
                do(server, command="pause", action="pause")
                server.wait_state("Paused", 30)
            do(server, command="cancel")
        server.wait_state("Operational", 40)
        wait_job_gone(server, board)
        helpers.wait_polls(server, 4)
        assert server.state() == "Operational"
        assert push.count("PrintCancelled", 1) == 1
        assert push.events("PrintDone") == []
    assert_no_harm(board)


# deleting and uploading


@pytest.mark.parametrize("name", ["Spare parts/clip (L).gcode", "Prüfkörper ø20.gcode"])
def test_delete(server, connected, files, location, name):
    board = connected()
    response = server.delete(f"/api/files/{location}/{files()[name]['path']}")
    assert response.status_code == 204, response.text
    server.wait_for(lambda: set(files()) == set(FILES) - {name}, 10, "the file to be gone")
    assert board.board.card.read(FILES[name]) is None
    assert f'M30 "{FILES[name]}"' in helpers.commands(board)


def test_upload_is_refused(server, connected, location):
    board = connected()
    upload = {"file": ("new.gcode", "G28\n")}
    response = server.client(OPERATOR).post(f"/api/files/{location}", files=upload)
    assert response.status_code == 409
    assert "web interface" in response.json()["error"]
    response = server.client(READER).post(f"/api/files/{location}", files=upload)
    assert response.status_code == 403
    server.upload("local.gcode", "G28\n")
    assert not any(command.startswith("M28") for command in helpers.commands(board))


def test_copy_to_the_printer_is_refused(server, connected, location, octoprint_version):
    if not is_version_2(octoprint_version):
        pytest.skip("1.11 has no such command")
    connected()
    server.upload("local.gcode", "G28\n")
    for command in (
        {"command": "copy", "storage": "printer", "destination": "new.gcode"},
        {"command": "uploadSd"},
    ):
        assert server.post("/api/files/local/local.gcode", json=command).status_code == 409


# the rest


def test_typed_names_stay_as_typed(server, connected):
    board = connected()
    server.commands("M36 square.gco", "M23 Two layers.gcode")
    server.wait_for(
        lambda: server.job()["job"]["file"]["display"] == "Two layers.gcode", 10, "the selection"
    )
    sent = helpers.commands(board)
    assert "M36 square.gco" in sent
    assert "M23 Two layers.gcode" in sent


def test_position_of_a_machine_with_many_axes(server, connected):
    connected(machine="manyaxes")
    with PushListener(server, ADMIN) as push:
        server.commands("M114")
        position = push.wait_for_event("PositionUpdate")
    assert all(isinstance(position[axis], float) for axis in "xyze")


def test_card_is_left_alone_while_a_print_is_streamed(server, connected, files):
    board = connected()
    # far more than is looked at
    server.upload("stream.gcode", "G92 X20 Y20 Z1\n" + "G1 X21 F600\nG1 X20 F600\n" * 2500)
    server.select_and_print("stream.gcode")
    server.wait_state("Printing")
    before = len(board.board.received())
    board.board.execute('M30 "0:/gcodes/square.gcode"', channel="http")
    helpers.wait_polls(server, 2)
    sent = helpers.commands(board)[before:]
    assert server.state() == "Printing"
    assert not any(command.startswith("M20") for command in sent)
    do(server, command="cancel")
    server.wait_state("Operational", 60)
    server.wait_for(lambda: "square.gcode" not in files(), 15, "the list afterwards")


def test_other_firmware_is_left_alone(module_server_factory, location):
    server = module_server_factory(
        plugins_config={"virtual_printer": {"enabled": True}},
        serial={"capabilities": {}},
    )
    server.connect("VIRTUAL")
    server.wait_state("Operational")
    server.wait_for(
        lambda: server.get("/api/printer").json()["sd"] == {"ready": True}, 10, "the card"
    )
    response = server.post(f"/api/files/{location}", files={"file": ("new.gcode", "G28\n")})
    assert response.status_code == 201, response.text
    assert not any(line.startswith(("M409", "M20 S3")) for line in server.sent())
