"""Files of a board over HTTP (rrf-network.md 1 and 5)."""

from __future__ import annotations

import contextlib
import json
import socket
import zlib

import pytest

from octoprint_rrfmodel.simulator.network.rr import http_server
from tests.simulator.http_bench import everything, http_bench, said_to
from tests.support.waiting import wait_for

CONTENT = b"G28\nG1 X1\n"


@pytest.fixture
def bench():
    with http_bench() as bench:
        bench.log_in()
        yield bench


def names(bench, folder="0:/gcodes", **more):
    return [entry["name"] for entry in bench.get("filelist", dir=folder, **more).json["files"]]


def test_an_upload_with_checksum_and_date(bench):
    crc = f"{zlib.crc32(CONTENT):x}"
    changes = bench.ask("seqs.volChanges[0]")
    answer = bench.post(CONTENT, name="0:/gcodes/new/a.g", time="2026-11-29T12:00:01", crc32=crc)
    assert answer.json == {"err": 0}
    listed = bench.get("filelist", dir="0:/gcodes/new").json["files"]
    assert listed == [{"type": "f", "name": "a.g", "size": 10, "date": "2026-11-29T12:00:00"}]
    assert bench.get("download", name="gcodes/new/a.g").body == CONTENT
    assert bench.ask("seqs.volChanges[0]") == changes + 1


def test_a_wrong_checksum_leaves_the_old_file_and_tells_everybody(bench):
    bench.post(CONTENT, name="0:/gcodes/a.g")
    assert bench.post(b"other", name="0:/gcodes/a.g", crc32="1").json == {"err": 1}
    assert bench.get("download", name="0:/gcodes/a.g").body == CONTENT
    assert "a.g.part" not in names(bench)
    text = "Error: Uploaded file CRC is different (d9583520 vs. expected 00000001)\n"
    assert bench.get("reply").body.decode() == text
    assert text.encode() in bench.board.transmit()


def beginning(bench, name, size):
    """Begin an upload; return its connection, over which the rest can be sent."""
    client = socket.create_connection(("127.0.0.1", bench.port), timeout=20)
    before = uploads(bench)
    head = f"POST /rr_upload?name={name} HTTP/1.1\r\nX-Session-Key: {bench.key}\r\n"
    client.sendall(f"{head}Content-Length: {size}\r\n\r\n".encode() + CONTENT)
    wait_for(lambda: uploads(bench) > before, what="the beginning of the upload")
    return client


def uploads(bench):
    with bench.board.lock:
        return bench.face.sessions.find("127.0.0.1", bench.key).uploads


def test_an_unfinished_file_is_seen_and_gone_with_its_connection(bench):
    with beginning(bench, "0:/gcodes/long.g", 20) as client:
        assert {"long.g.part"} <= {*names(bench)}
        assert bench.get("disconnect").json == {"err": 1}
        client.sendall(CONTENT)
        assert json.loads(everything(client).body) == {"err": 0}
    assert "long.g.part" not in names(bench)
    with beginning(bench, "0:/gcodes/lost.g", 20):
        pass
    wait_for(lambda: "lost.g.part" not in names(bench), what="the end of the upload")
    assert "lost.g" not in names(bench)


def test_two_uploads_to_one_name_are_both_well_and_one_file_is_lost(bench):
    first = beginning(bench, "0:/gcodes/same.g", 20)
    second = beginning(bench, "0:/gcodes/same.g", 20)
    for client in (first, second):
        with client:
            client.sendall(CONTENT)
            assert json.loads(everything(client).body) == {"err": 0}
    assert bench.get("download", name="0:/gcodes/same.g").status == 404


def test_the_file_that_is_printed_cannot_be_replaced_but_err_is_0(bench):
    bench.board.execute('M32 "square.gcode"')
    name = "0:/gcodes/square.gcode"
    before = bench.get("download", name=name).body
    assert bench.post(b"G28\n", name=name).json == {"err": 0}
    assert bench.get("download", name=name).body == before
    assert "Failed to rename" in bench.get("reply").body.decode()
    assert bench.get("delete", name=name).json == {"err": 1}
    assert f"Cannot delete file {name} because it is open" in bench.get("reply").body.decode()


def test_long_lists_come_in_pages(bench):
    for number in range(150):
        bench.board.card.store(f"0:/many/part_{number:03}.gcode", b"", "2026-01-01T00:00:00")
    found, first, pages = [], 0, 0
    while True:
        page = bench.get("filelist", dir="0:/many", first=first).json
        found += [entry["name"] for entry in page["files"]]
        pages, first = pages + 1, page["next"]
        if not first:
            break
    assert found == [f"part_{number:03}.gcode" for number in range(150)]
    assert 2 <= pages <= 3
    assert bench.get("filelist", dir="0:/many", max=2).json["next"] == 2


def test_names_with_a_dot_in_front_are_hidden(bench):
    bench.board.card.store("0:/gcodes/.hidden", b"", "2026-01-01T00:00:00")
    assert ".hidden" not in names(bench)
    assert bench.get("download", name="0:/gcodes/.hidden").status == 200


def test_names_in_any_language(bench):
    bench.post(CONTENT, name="0:/gcodes/Prüf teil 你.g")
    assert "Prüf teil 你.g" in names(bench)
    assert bench.get("fileinfo", name="Prüf teil 你.g").json["size"] == 10


@pytest.mark.parametrize(
    "name", ["0:/gcodes/a:b.g", "0:/gcodes/a*.g", "1:/a.g", "0:/gcodes", "0:/"]
)
def test_names_that_cannot_be(bench, name):
    assert bench.post(CONTENT, name=name).status == 500
    move = {"old": "0:/gcodes/square.gcode", "new": name, "deleteexisting": "yes"}
    assert name.startswith("1:") or bench.get("move", **move).json == {"err": 1}
    assert bench.get("mkdir", dir=name).json == {"err": 1}


def test_folders_are_marked_only_where_that_is_asked(bench):
    plain = bench.get("files", dir="0:/gcodes").json["files"]
    marked = bench.get("files", dir="0:/gcodes", flagDirs=1).json["files"]
    assert "Empty" in plain
    assert "*Empty" in marked


def test_folders_move_with_what_is_in_them(bench):
    move = {"old": "0:/gcodes/Spare parts", "new": "0:/other/place"}
    assert bench.get("move", **move, deleteexisting="no").json == {"err": 0}
    assert names(bench, "0:/other/place") == ["ver 2", "clip (L).gcode"]
    assert names(bench, "0:/other/place/ver 2") == ["clip.gcode"]
    assert bench.get("filelist", dir="0:/gcodes/Spare parts").json["err"] == 2


def test_a_move_to_another_card_stays_on_its_own(bench):
    bench.post(CONTENT, name="0:/gcodes/a.g")
    move = {"old": "0:/gcodes/a.g", "new": "1:/gcodes/b.g", "deleteexisting": "no"}
    assert bench.get("move", **move).json == {"err": 0}
    assert "b.g" in names(bench)


def test_a_folder_is_deleted_with_all_that_is_in_it_where_that_is_asked(bench):
    assert bench.get("delete", name="0:/gcodes/Spare parts").json == {"err": 1}
    why = "Error: Failed to delete 0:/gcodes/Spare parts because it is a folder and not empty\n"
    assert bench.get("reply").body.decode() == why
    answer = bench.get("delete", name="0:/gcodes/Spare parts", recursive="yes")
    assert answer.json == {"err": 0}
    assert "Spare parts" not in names(bench)


def test_information_about_what_is_printed(bench):
    assert bench.get("fileinfo").json == {"err": 1, "fileName": ""}
    bench.board.execute('M32 "square.gcode"')
    bench.wait(1)
    found = bench.get("fileinfo").json
    assert found["fileName"] == "0:/gcodes/square.gcode"
    assert found["printDuration"] >= 0


INFORMATION = {
    "3.5.3": ["err", "fileName", "size", "lastModified", "height", "layerHeight", "numLayers"],
    "3.4": ["err", "fileName", "size", "lastModified", "height", "layerHeight", "numLayers"],
    "3.3": ["err", "size", "lastModified", "height", "firstLayerHeight", "layerHeight"],
}


@pytest.mark.parametrize(("firmware", "members"), INFORMATION.items(), ids=INFORMATION)
def test_information_in_each_form(firmware, members):
    with http_bench("cartesian", firmware) as bench:
        found = bench.get("fileinfo", name="square.gcode").json
        assert list(found)[: len(members)] == members
        bench.post(CONTENT, name="0:/gcodes/a.g")
        assert ("thumbnails" in bench.get("fileinfo", name="a.g").json) == (firmware == "3.5.3")


def test_a_picture_comes_in_pieces(bench):
    picture = "QUJD" * 1500
    lines = "".join(f"; {picture[start : start + 78]}\n" for start in range(0, 6000, 78))
    text = f"; thumbnail begin 48x32 {len(picture)}\n{lines}; thumbnail end\nG28\n"
    bench.post(text.encode(), name="0:/gcodes/t.g")
    (thumbnail,) = bench.get("fileinfo", name="t.g").json["thumbnails"]
    assert (thumbnail["width"], thumbnail["height"]) == (48, 32)
    data, following = "", thumbnail["offset"]
    while following:
        piece = bench.get("thumbnail", name="t.g", offset=following).json
        assert piece["err"] == 0 and len(piece["data"]) <= 2600
        data, following = data + piece["data"], piece["next"]
    assert data == picture


def test_a_card_that_is_out(bench):
    bench.board.receive(b"M22\n")
    assert bench.get("filelist", dir="0:/gcodes").json["err"] == 1
    assert bench.get("download", name="0:/sys/config.g").status == 404
    assert bench.post(CONTENT, name="0:/gcodes/a.g").status == 500


def test_what_comes_behind_a_request_is_not_read(bench):
    one = f"GET /rr_gcode?gcode=M115 HTTP/1.1\r\nX-Session-Key: {bench.key}\r\n\r\n".encode()
    said = said_to(bench.port, one + one)
    assert said.data.count(b"HTTP/1.1 200 OK") == 1
    assert bench.get("reply").body.count(b"FIRMWARE_NAME") == 1


def test_a_request_that_stalls_is_reset(bench):
    """The only test that pays for the firmware's two seconds."""
    with socket.create_connection(("127.0.0.1", bench.port), timeout=20) as client:
        client.sendall(b"GET /rr_model")
        said = everything(client)
    assert (said.data, said.is_reset) == (b"", True)


RESPONDERS = {"cartesian": 4, "delta": 3, "toolchanger": 6}


@pytest.mark.parametrize(("machine", "most"), RESPONDERS.items(), ids=RESPONDERS)
def test_so_many_requests_are_in_work_at_once(monkeypatch, machine, most):
    """One more finds no responder, and is reset."""
    monkeypatch.setattr(http_server, "FIND_RESPONDER_SECONDS", 0.1)
    with http_bench(machine) as bench, contextlib.ExitStack() as clients:
        bench.log_in()
        for number in range(most):
            clients.enter_context(beginning(bench, f"0:/gcodes/{number}.g", 20))
        said = bench.get("model", key="state.status")
        assert (said.data, said.is_reset) == (b"", True)


def test_an_upload_that_stalls_is_reset_and_gone(bench, monkeypatch):
    monkeypatch.setattr(http_server, "UPLOAD_SECONDS", 0.1)
    with beginning(bench, "0:/gcodes/stalls.g", 20) as client:
        said = everything(client)
    assert (said.data, said.is_reset) == (b"", True)
    assert "stalls.g.part" not in names(bench)


def test_before_32_every_page_may_ask():
    with http_bench("delta", "2.05") as bench:
        assert "Access-Control-Allow-Origin: *" in bench.get("status").head
