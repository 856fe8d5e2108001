"""Folders of the card over HTTP: what the board says, asked as seldom as can be."""

import concurrent.futures

import pytest

from .. import helpers

pytestmark = pytest.mark.both_hosts("each has its own code for the card")

FILES = "/plugin/rrfmodel/files"
THUMBNAIL = "/plugin/rrfmodel/thumbnail"


BOARD = {}


def listed(server, path):
    response = server.get(FILES, params={"path": path})
    assert response.status_code == 200, response.text
    return response.json()


def names(server, path):
    return [entry["name"] for entry in listed(server, path)["entries"]]


def asked(board, path):
    return [line for line in helpers.commands(board) if f'M20 S3 P"{path}"' in line]


def test_a_folder_is_listed_with_folders_first(server, board):
    board.board.card.write("0:/macros/Tools/Wipe", "M400\n", "2024-05-06T07:08:09")
    board.board.volumes_changed(True)
    helpers.wait_polls(server, 3)
    answer = listed(server, "0:/macros/")
    assert answer["path"] == "0:/macros"
    assert [entry["folder"] for entry in answer["entries"]] == sorted(
        (entry["folder"] for entry in answer["entries"]), reverse=True
    )
    assert answer["entries"][0] == {
        "name": "Tools",
        "folder": True,
        "size": 0,
        "date": "2024-10-01T12:00:00",
    }
    assert listed(server, "0:/macros/Tools")["entries"] == [
        {"name": "Wipe", "folder": False, "size": 5, "date": "2024-05-06T07:08:09"}
    ]


def test_a_folder_of_several_pages_and_strange_names(server, board):
    wanted = [f"Kühler {number:03} <b>.g" for number in range(120)]
    for name in wanted:
        board.board.card.write(f"0:/macros/many/{name}", "M400\n")
    assert names(server, "0:/macros/many") == wanted


def test_who_asks_at_the_same_time_shares_one_question(server, board):
    board.board.card.write("0:/macros/shared/One", "M400\n")
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(lambda _: names(server, "0:/macros/shared"), range(8)))
    assert answers == [["One"]] * 8
    assert len(asked(board, "0:/macros/shared")) == 1


def test_a_list_is_kept_until_the_card_changes(server, board):
    board.board.card.write("0:/macros/kept/One", "M400\n")
    assert names(server, "0:/macros/kept") == ["One"]
    board.board.card.write("0:/macros/kept/Two", "M400\n")
    assert names(server, "0:/macros/kept") == ["One"]
    board.board.volumes_changed(True)
    server.wait_for(
        lambda: names(server, "0:/macros/kept") == ["One", "Two"], 15, "the list to be new"
    )
    assert len(asked(board, "0:/macros/kept")) == 2


@pytest.mark.both_hosts("each has its own code for the card", once_for=("path",))
@pytest.mark.parametrize(
    "path", ["", " ", "0:/macros;M112", '0:/"x', "0:/a\nM112", "0:/a\u2028b", "0:/" + "x" * 120]
)
def test_a_path_that_cannot_be_sent_is_refused(server, board, path):
    before = helpers.commands(board)
    response = server.get(FILES, params={"path": path})
    assert response.status_code == 400, response.text
    assert response.json()["error"]
    assert not [line for line in helpers.commands(board)[len(before) :] if "112" in line]


def test_no_such_folder(server):
    response = server.get(FILES, params={"path": "0:/nowhere"})
    assert response.status_code == 404
    assert response.json()["error"]


def test_lack_of_buffers_is_gone_over(server, board):
    board.board.card.write("0:/macros/full/One", "M400\n")
    # questions and the model take turns, so that one of two in a row is for the folder
    board.board.faults.inject("err_no_buffers:2")
    statuses = []

    def is_answered():
        statuses.append(server.get(FILES, params={"path": "0:/macros/full"}).status_code)
        return statuses[-1] != 409

    # 409 where the model's poll met the lack first
    server.wait_for(is_answered, 30, "the board to have room")
    assert statuses[-1] == 200
    assert names(server, "0:/macros/full") == ["One"]


def test_the_card_is_left_alone_while_octoprint_streams_a_print(server, board):
    server.upload("streamed.gcode", "G92 X20 Y20 Z1\n" + "G1 X21 F600\nG1 X20 F600\n" * 500)
    server.select_and_print("streamed.gcode")
    server.wait_state("Printing")
    helpers.wait_polls(server, 1)
    before = len(board.board.received())
    for endpoint, path in ((FILES, "0:/macros"), (THUMBNAIL, "0:/gcodes/square.gcode")):
        response = server.get(endpoint, params={"path": path})
        assert response.status_code == 409
        assert "OctoPrint" in response.json()["error"]
    assert server.state() == "Printing"
    sent = helpers.commands(board)[before:]
    assert not [line for line in sent if line.startswith(("M20", "M36"))]
    server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational", 60)
    assert server.get(FILES, params={"path": "0:/macros"}).status_code == 200


def test_folders_of_one_machine_are_not_those_of_the_next(server_factory, board_factory):
    server = server_factory()
    for name in ("First", "Second"):
        board = board_factory()
        board.board.card.write(f"0:/macros/own/{name}", "M400\n")
        helpers.connect(server, board)
        # within the time that a folder is kept, and with the same count of changes
        assert names(server, "0:/macros/own") == [name]


def test_a_card_of_old_firmware_is_not_read(server_factory, board_factory):
    server = server_factory()
    helpers.connect(server, board_factory(firmware="2.05"), 30)
    response = server.get(FILES, params={"path": "0:/macros"})
    assert response.status_code == 409
    assert "3.1" in response.json()["error"]


def test_no_card(server, board):
    board.board.execute("M22", channel="http")
    try:
        (refused,) = server.wait_for(
            lambda: [
                answer
                for answer in [server.get(FILES, params={"path": "0:/macros"})]
                if answer.status_code == 409
            ],
            15,
            "the card to be missed",
        )
        assert refused.json()["error"].endswith(".")
    finally:
        board.board.execute("M21", channel="http")
