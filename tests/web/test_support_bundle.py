"""A bundle of a machine: whole, without anything of a person's, and the machine can be replayed."""

import io
import json
import zipfile
from types import SimpleNamespace

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
import pytest

from octoprint_rrfmodel.host.own_log import LogLine
from octoprint_rrfmodel.host.plugin_settings import DEFAULTS
from octoprint_rrfmodel.rrf.views.warnings import warnings_of
from octoprint_rrfmodel.simulator import replay
from octoprint_rrfmodel.web.support_bundle import Heard, SupportBundle
from tests.rrf.simulated import Simulated
from tests.support.hosts import host_of

OWN = ("Vera", "swordfish", "192.168.7.", "barnyard")
"""What is in names, texts, addresses and settings of the machine that is recorded."""

FILES = {
    "README.txt",
    "versions.json",
    "machine.json",
    "model.json",
    "status.json",
    "settings.json",
    "exchanges.txt",
    "console.txt",
    "log.txt",
}


def plugin(**members):
    return SimpleNamespace(bundled=False, version="1.2.3+vera", **members)


def bundle_of(model, tmp_path, protocol="M409"):
    """Return a bundle of a machine whose owner is called Vera."""
    settings = {
        **DEFAULTS,
        "mqtt": {"enabled": True, "topic": "barnyard/Vera"},
        "network": {
            **DEFAULTS["network"],
            "passwords": {"192.168.7.5": "swordfish"},
            "hosts": {"192.168.7.5": "Vera"},
        },
    }
    own = SimpleNamespace(get=lambda path, merged=False: settings[path[0]])
    plugins = SimpleNamespace(enabled_plugins={"octolapse": plugin(), "vera_s_own": plugin()})
    host = host_of(tmp_path, None, own, plugins=lambda: plugins)
    status = {
        "version": "0.2.0",
        "protocol": protocol,
        "link": "serial",
        "doing": {"command": 'M98 P"0:/macros/Vera.g"', "what": "macro", "since": 1.5},
        "simulated_file": "0:/gcodes/Vera.gcode",
        "heater_ages": {"0": 1.5},
        "warnings": [
            {
                "code": "startup_error",
                "text": "Fehler in Vera",
                "level": "warning",
                "values": {"file": "Vera.g", "line": "12", "message": "unknown Vera"},
            }
        ],
    }
    raised = LogLine(
        0.0,
        "ERROR",
        "worker",
        "Could not read %s",
        ("Vera.gcode",),
        "OSError",
        "no Vera",
        ("a:1 f",),
    )
    heard = Heard(
        SimpleNamespace(
            latest=lambda: [
                (2.5, "sent", 'M409 K"network" F"d99vno"'),
                (2.25, "received", '{"key":"network","flags":"d99vno","result":{"name":"Vera"}}'),
                (1.0, "refused", "Error: M409 Vera"),
            ]
        ),
        SimpleNamespace(
            latest=lambda count: [
                {"type": "command", "message": "M587 Sbarnyard Pswordfish", "time": 0.0},
                {"type": "response", "message": "Connected to 192.168.7.5", "time": 0.0},
            ]
        ),
        SimpleNamespace(start=None, stop=None, latest=lambda: [raised]),
    )
    reported = {"FIRMWARE_NAME": "RepRapFirmware for Test", "MACHINE_NAME": "Vera"}
    return SupportBundle(
        host,
        lambda: status,
        lambda: model,
        link=SimpleNamespace(reported=reported),
        octoprint_settings=lambda: [
            {"setting": "serial.x", "now": ["M600", "VERA"], "fulfilled": True, "wanted": []}
        ],
        heard=heard,
    ).archive()


def texts_of(archive):
    with zipfile.ZipFile(io.BytesIO(archive)) as opened:
        return {name: opened.read(name).decode() for name in opened.namelist()}


@pytest.fixture(scope="module")
def recorded():
    made = Simulated("toolchanger", "3.6.4")
    made.run('M550 P"Vera"', 'M563 P1 S"Vera"', 'global barnyard="swordfish"', 'M291 P"Vera" S2')
    made.board.inject("heater_fault")
    made.board.inject("driver_error")
    return made


@pytest.fixture(scope="module")
def archive(recorded, tmp_path_factory):
    return bundle_of(recorded.model(), tmp_path_factory.mktemp("bundle"))


def test_nothing_of_a_person_s_is_in_it(recorded, archive):
    known = json.dumps(recorded.model())
    assert "Vera" in known and "swordfish" in known and "barnyard" in known
    texts = texts_of(archive)
    assert set(texts) == FILES
    for name, text in texts.items():
        assert not [own for own in OWN if own.lower() in text.lower()], name


def test_what_helps_is_in_it(archive):
    texts = texts_of(archive)
    state = json.loads(texts["status.json"])
    assert state["warnings"][0]["code"] == "startup_error" and "text" not in state["warnings"][0]
    assert state["doing"]["what"] == "macro" and state["heater_ages"] == {"0": 1.5}
    assert state["warnings"][0]["values"]["line"] == "12"
    versions = json.loads(texts["versions.json"])
    assert versions["octoprint"] and versions["python"]
    assert versions["plugins"] == {"octolapse": "1.2.3"} and versions["other_plugins"] == 1
    settings = json.loads(texts["settings.json"])
    assert settings["plugin"]["network"]["passwords"] == 1
    assert settings["plugin"]["guard"] == DEFAULTS["guard"]
    assert settings["plugin"]["simulator"] == DEFAULTS["simulator"]
    assert settings["octoprint"][0]["now"][0] == "M600"
    assert 'M409 K"network" F"d99vno"' in texts["exchanges.txt"]
    assert "OSError: no word-" in texts["log.txt"] and "    a:1 f" in texts["log.txt"]
    machine = json.loads(texts["machine.json"])
    assert machine["protocol"] == "M409" and machine["form"] == 1
    assert machine["reported"]["FIRMWARE_NAME"] == "RepRapFirmware for Test"


def test_the_log_the_console_and_the_exchanges_call_a_thing_by_one_name(archive):
    texts = texts_of(archive)
    tool = json.loads(texts["model.json"])["result"]["tools"][1]["name"]
    assert (
        f'"name":"{tool}"' in texts["exchanges.txt"]
        and f"Error: M409 {tool}" in texts["exchanges.txt"]
    )


def followed(board):
    """Return what a follower has of a board."""
    simulated = Simulated()
    simulated.board = board
    return simulated.model()


def test_a_replayed_bundle_has_the_same_model_and_the_same_warnings(recorded, archive):
    board = replay.recording(archive).board()
    shown = json.loads(texts_of(archive)["model.json"])["result"]
    model = followed(board)
    for key in sorted(shown.keys() - {"state", "seqs", "sensors"}):
        assert model[key] == shown[key], key
    clocks = {"time", "upTime", "msUpTime"}
    for name in shown["state"].keys() - clocks:
        assert model["state"][name] == shown["state"][name], name
    found = [each.name for each in warnings_of(model)]
    assert found == [each.name for each in warnings_of(recorded.model())]
    assert "heater_fault_1" in found and "driver_error_0_0" in found


def test_a_machine_without_m409_is_replayed_too(tmp_path):
    old = Simulated("delta", "2.05")
    model = old.model()
    board = replay.recording(bundle_of(model, tmp_path, "M408")).board()
    assert board.firmware.version == "2.05.1"
    again = followed(board)
    assert again["heat"]["heaters"] == model["heat"]["heaters"]
    assert [axis["letter"] for axis in again["move"]["axes"]] == ["X", "Y", "Z"]
