"""A support bundle of a real server is another server's machine."""

import io
import json
import re
import zipfile

import pytest

from octoprint_rrfmodel.simulator import replay
from octoprint_rrfmodel.simulator.pty import PtyBoard
from tests.support.basedir import OPERATOR

from .. import helpers

BUNDLE = "/plugin/rrfmodel/bundle"

BOARD = {"machine": "idex", "firmware": "3.6.4", "faults": ["heater_fault"], "speed": 20}

OWN = ("Vera", "swordfish")

CLOCKS = ("time", "upTime", "msUpTime", "thisInput")


def prepare(board):
    board.execute('M550 P"Vera"\nM563 P0 S"Vera\'s tool"\nglobal pin="swordfish"')
    board.execute('M117 "Ask Vera for the swordfish"')


def downloaded(server):
    response = server.get(BUNDLE)
    assert response.status_code == 200, response.text
    assert response.headers["Content-Type"] == "application/zip"
    assert response.headers["Cache-Control"] == "no-store"
    assert re.fullmatch(
        r'attachment; filename="rrfmodel-bundle-\d{8}-\d{6}\.zip"',
        response.headers["Content-Disposition"],
    )
    return response.content


def texts_of(archive):
    with zipfile.ZipFile(io.BytesIO(archive)) as opened:
        return {name: opened.read(name).decode() for name in opened.namelist()}


def warnings_of(server):
    return [(each["code"], each["level"]) for each in helpers.status(server)["warnings"]]


@pytest.mark.both_hosts("settings and plugins are each host's own")
def test_downloaded_and_nothing_of_a_person_s_is_in_it(server):
    helpers.wait_ready(server)
    server.commands('M118 P1 S"Hello Vera"')
    helpers.wait_polls(server, 2)
    texts = texts_of(downloaded(server))
    assert len(texts) == 9
    for name, text in texts.items():
        assert not [own for own in OWN if own.lower() in text.lower()], name
    exchanges = texts["exchanges.txt"].splitlines()
    assert any(' sent     M409 K"" F"d99fin"' in line for line in exchanges)
    assert any(' received {"key":"","flags":"d99fin"' in line for line in exchanges)
    settings = json.loads(texts["settings.json"])
    assert settings["plugin"]["guard"]["heater_fault"] is True
    assert {row["setting"].rpartition(".")[2] for row in settings["octoprint"]} >= {
        "longRunningCommands"
    }
    assert json.loads(texts["machine.json"])["reported"]["FIRMWARE_VERSION"] == "3.6.4"
    assert server.client(OPERATOR).get(BUNDLE).status_code == 403


def test_the_settings_lead_to_it(server):
    page = server.get("/").text
    assert re.search(r'<a [^>]*href="plugin/rrfmodel/bundle" download', page)


def test_the_replayed_machine_is_known_as_the_recorded_one(server, server_factory, ports_dir):
    helpers.wait_ready(server)
    server.wait_for(lambda: ("heater_fault_1", "fault") in warnings_of(server), 30, "the fault")
    helpers.wait_polls(server, 2)
    recorded = warnings_of(server)
    archive = downloaded(server)
    shown = json.loads(texts_of(archive)["model.json"])["result"]
    other = server_factory()
    with PtyBoard(replay.recording(archive).board(), ports_dir / "replayed") as board:
        helpers.connect(other, board)
        helpers.wait_ready(other)
        other.wait_for(lambda: warnings_of(other) == recorded, 30, "the same warnings")
        for key in ("boards", "tools", "network", "global", "fans", "limits", "directories"):
            assert helpers.value(other, key) == shown[key], key
        state = {name: shown["state"][name] for name in shown["state"].keys() - set(CLOCKS)}

        def is_equal():
            # what tells of a fault is asked for twice before it counts
            return state == {
                name: value
                for name, value in helpers.value(other, "state").items()
                if name in state
            }

        other.wait_for(is_equal, 30, "the same state")
        assert helpers.status(other)["firmware"] == helpers.status(server)["firmware"]
        helpers.disconnect(other)


def test_without_a_machine_it_is_there_too(server_factory):
    texts = texts_of(downloaded(server_factory()))
    assert json.loads(texts["model.json"])["result"] == {}
    assert json.loads(texts["machine.json"])["protocol"] is None
