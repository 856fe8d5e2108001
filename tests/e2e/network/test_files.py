"""The card of a board on the network in OctoPrint's own file list."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN, OPERATOR
from tests.support.browser import new_context, new_page, open_octoprint
from tests.support.sliced import PICTURE, sliced

from . import bench

BOARD = {"machine": "cartesian", "speed": 10}

CONTENT = "; a file\n" + "G1 X1\n" * 3000


def prepare(board):
    board.card.write("0:/gcodes/sliced.gcode", sliced())
    board.card.write("0:/gcodes/a.gcode", "G28\n")
    board.card.write("0:/gcodes/deep/er/b.gcode", "G28\n" * 10)


def listed(server, path=""):
    response = server.get(f"/api/files/printer{path}", headers=bench.NEW)
    return response.json() if response.ok else None


def paths(server):
    found = server.get("/api/files/printer?recursive=true", headers=bench.NEW).json()
    entries, waiting = {}, list(found.get("files", []))
    while waiting:
        entry = waiting.pop()
        entries[entry["path"]] = entry
        waiting.extend(entry.get("children") or [])
    return entries


def wait_paths(server, *wanted):
    server.wait_for(lambda: set(wanted) <= paths(server).keys(), 20, f"{wanted} to be listed")


def upload(server, name, content=CONTENT, **fields):
    return server.post(
        "/api/files/printer", files={"file": (name, content)}, data=fields, headers=bench.NEW
    )


def test_list_has_folders_sizes_and_dates(server):
    wait_paths(server, "a.gcode", "deep/er/b.gcode")
    found = paths(server)["deep/er/b.gcode"]
    assert found["size"] == 40
    assert found["date"] > 1_600_000_000


def test_slicers_data_and_picture(server):
    server.wait_for(
        lambda: "thumbnail" in paths(server)["sliced.gcode"]["refs"], 40, "the picture to be known"
    )
    entry = paths(server)["sliced.gcode"]
    assert entry["gcodeAnalysis"]["estimatedPrintTime"] == 3723
    assert entry["gcodeAnalysis"]["filament"]["tool0"]["length"] == 1234.5
    assert entry["rrf"]["generatedBy"].startswith("PrusaSlicer")
    picture = server.get("/downloads/thumbs/printer/sliced.gcode?size=32x32")
    assert picture.status_code == 200
    assert picture.content == PICTURE


def test_upload_delete_move_and_folders(server, face):
    response = upload(server, "new file.gcode")
    assert response.status_code == 201, response.text
    assert face.board.card.read("0:/gcodes/new file.gcode").decode() == CONTENT
    assert "new file.gcode" in paths(server)

    made = server.post("/api/files/printer", data={"foldername": "box"}, headers=bench.NEW)
    assert made.status_code == 201, made.text
    assert face.board.card.has_folder("0:/gcodes/box")
    wait_paths(server, "box")

    moved = server.post(
        "/api/files/printer/new file.gcode",
        json={"command": "move", "destination": "box"},
        headers=bench.NEW,
    )
    assert moved.ok, moved.text
    wait_paths(server, "box/new file.gcode")
    assert face.board.card.read("0:/gcodes/new file.gcode") is None

    assert server.delete("/api/files/printer/box/new file.gcode").status_code == 204
    assert face.board.card.read("0:/gcodes/box/new file.gcode") is None
    assert server.delete("/api/files/printer/box").status_code == 204
    server.wait_for(lambda: "box" not in paths(server), 20, "the folder to be gone")


def test_what_came_through_broken_is_sent_again_and_else_no_success(server, face):
    face.board.inject("net_corrupt:1")
    assert upload(server, "broken.gcode").status_code == 201
    assert face.board.card.read("0:/gcodes/broken.gcode").decode() == CONTENT
    face.board.inject("net_corrupt:2")
    response = upload(server, "again.gcode")
    assert response.status_code >= 400
    assert face.board.card.read("0:/gcodes/again.gcode") is None


@pytest.mark.parametrize("name", ["x" * 130 + ".gcode"])
def test_names_that_the_card_refuses_are_refused(server, face, name):
    response = upload(server, name)
    assert 400 <= response.status_code < 600
    assert not [path for path in paths(server) if path.startswith("xx")]


def test_file_put_there_by_others_shows(server, face):
    face.board.card.write("0:/gcodes/others.gcode", "G28\n")
    bench.at_panel(face, 'M30 "0:/gcodes/a.gcode"')
    wait_paths(server, "others.gcode")
    assert "a.gcode" not in paths(server)


HEIGHTMAP = "/plugin/rrfmodel/heightmap"


def test_height_map_has_colours_and_a_profile(browser, server, face):
    assert server.get(HEIGHTMAP).status_code == 404
    bench.at_panel(face, "G29 S1")
    context, errors = new_context(browser), []
    page = new_page(context, errors)
    open_octoprint(page, server, ADMIN, "/#tab_plugin_rrfmodel/machine")
    page.locator("[data-test=fold-bed]").click()
    cells = page.locator("[data-test=mesh-cell]")
    expect(cells).to_have_count(110)
    assert cells.first.locator("title").text_content() == "X 15, Y 15: +0.053 mm"
    fills = {cell.get_attribute("fill") for cell in cells.all()}
    assert {fill.rpartition(",")[0] for fill in fills} == {"rgba(47, 134, 214", "rgba(217, 83, 79"}
    profile = page.locator("[data-test=profile] .rrfmodel-profile-line")
    assert profile.get_attribute("d").count("M") == 10
    found = server.get(HEIGHTMAP).json()
    assert (found["file"], found["count"]) == ("0:/sys/heightmap.csv", [11, 10])
    query = server.get("/plugin/rrfmodel/printer/objects/query?bed_mesh").json()["result"]
    assert query["status"]["bed_mesh"]["probed_matrix"] == found["points"]
    bench.at_panel(face, "G29 S2")
    expect(cells).to_have_count(0)
    assert server.get(HEIGHTMAP).status_code == 404
    context.close()
    assert errors == []


BIG = "".join(f"G1 X{number % 100} E0.01 ; {number}\n" for number in range(60_000))


def download(server, name):
    return server.get(f"/downloads/files/printer/{name}")


def test_download_is_the_file_or_a_clear_error(server, face):
    face.board.card.write("0:/gcodes/big file.gcode", BIG)
    with face.board.lock:
        face.board.volumes_changed(True)
    wait_paths(server, "big file.gcode", "sliced.gcode")
    assert download(server, "sliced.gcode").text == sliced()
    face.board.inject("net_cut:3")
    answers = []

    def is_whole():
        answers.append(download(server, "big file.gcode"))
        return answers[-1].text == BIG

    # polls may be what is cut
    server.wait_for(is_whole, 30, "the whole file")
    assert answers[-1].status_code == 200
    assert all("error" in each.json() and each.status_code == 504 for each in answers[:-1])
    assert "attachment" in answers[-1].headers["Content-Disposition"]
    copied = server.post(
        "/api/files/printer/big file.gcode",
        json={"command": "copy", "storage": "local", "destination": "copied.gcode"},
        headers=bench.NEW,
    )
    assert copied.ok, copied.text
    assert server.get("/downloads/files/local/copied.gcode").text == BIG
    assert download(server, "none.gcode").status_code == 404


MACHINE_FILE = "/plugin/rrfmodel/machine_file"


def test_the_machines_own_files(server, face):
    named = {each["name"] for each in server.get(f"{MACHINE_FILE}s?path=0:/sys").json()["entries"]}
    assert {"config.g", "bed.g"} <= named
    before = server.get(f"{MACHINE_FILE}?path=0:/sys/config.g").json()
    changed = {"path": "0:/sys/config.g", "text": "; mine\n", "stamp": before["stamp"]}
    with server.session(ADMIN) as session:
        # a page of somebody else's has no token
        del session.headers["X-CSRF-Token"]
        assert session.put(MACHINE_FILE, json=changed).status_code == 400
    with server.client(OPERATOR) as operator:
        assert operator.put(MACHINE_FILE, json=changed).status_code == 403
        assert operator.get(f"{MACHINE_FILE}?path=0:/sys/config.g").status_code == 403
    assert face.board.card.read("0:/sys/config.g").decode() == before["text"]
    told = server.put(MACHINE_FILE, json=changed)
    assert (told.status_code, told.json()["restart"]) == (200, True), told.text
    assert face.board.card.read("0:/sys/config.g") == b"; mine\n"
    assert face.board.card.read(told.json()["backup"]).decode() == before["text"]
    again = server.put(MACHINE_FILE, json=changed)
    assert again.status_code == 409
    assert "error" in again.json()
