"""The card of a board on the network as a root of Moonraker's."""

from tests.support.sliced import PICTURE, sliced

BASE = "/plugin/rrfmodel/server/files"

BOARD = {"machine": "cartesian", "speed": 10}

CONTENT = "; a file\n" + "G4 P10\n" * 30_000


def prepare(board):
    board.card.write("0:/gcodes/deep/sliced.gcode", sliced())


def result(response, status=200):
    assert response.status_code == status, response.text
    return response.json()["result"]


def post(server, method, **params):
    return result(server.post(f"{BASE}/{method}", json=params))


def test_files_are_changed_on_the_card(server, face):
    card = face.board.card
    sent = {"files": {"file": ("new.gcode", CONTENT)}, "data": {"root": "printer", "path": "deep"}}
    item = result(server.post(f"{BASE}/upload", **sent), 201)["item"]
    assert (item["root"], item["path"], item["permissions"]) == ("printer", "deep/new.gcode", "rw")
    assert card.read("0:/gcodes/deep/new.gcode").decode() == CONTENT
    assert server.get(f"{BASE}/printer/deep/new.gcode").text == CONTENT
    moved = post(server, "move", source="printer/deep/new.gcode", dest="printer/other.gcode")
    assert moved["item"]["path"] == "other.gcode"
    assert card.read("0:/gcodes/other.gcode").decode() == CONTENT
    assert post(server, "directory", path="printer/box")["action"] == "create_dir"
    assert card.has_folder("0:/gcodes/box")
    for path in ("printer/other.gcode", "directory?path=printer/box"):
        result(server.delete(f"{BASE}/{path}"))
    assert card.read("0:/gcodes/other.gcode") is None
    assert not card.has_folder("0:/gcodes/box")


def test_what_the_board_knows_of_a_file(server):
    name = "printer/deep/sliced.gcode"

    def found():
        response = server.get(f"{BASE}/metadata", params={"filename": name})
        return response.json().get("result", {}).get("slicer")

    server.wait_for(found, 40, "what the slicer said")
    told = result(server.get(f"{BASE}/metadata", params={"filename": name}))
    assert (told["slicer"], told["estimated_time"], told["filament_total"]) == (
        "PrusaSlicer",
        3723,
        1234.5,
    )
    (picture,) = told["thumbnails"]
    assert server.get(f"{BASE}/printer/deep/{picture['relative_path']}").content == PICTURE
