"""What a user gets: the built archives, and an installation through OctoPrint's plugin manager."""

import configparser
import email
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest
import yaml

from octoprint_rrfmodel.host import updates
from tests.support.places import ROOT

# the work is in what the fixtures build, so that one worker does it
pytestmark = [pytest.mark.slow, pytest.mark.timeout(600), pytest.mark.xdist_group("package")]

DATA_FOLDERS = ("static", "templates", "translations")

FIRST = "f8c1a00"
"""The last commit that was called 0.1.0 and had the first layout of modules and files."""

SET_IN_0_1_0 = {
    "hide_polls": False,
    "layer_progress": False,
    "prompts": True,
    "wizard_seen": True,
    "operations": {"jog": False, "flow_rate": False, "probes": False},
    "replies": {"mounted": False, "position": False},
    "guard": {"heater_fault": False, "reset": False},
    "mqtt": {"enabled": False, "topic": "shop/duet"},
    "sidebar": {"fans": False, "data": False},
    "simulator": {
        "enabled": True,
        "machine": "toolchanger",
        "firmware": "3.4.6",
        "speed": 2.0,
        "faults": ["lost_ok:50"],
    },
}
"""Settings of 0.1.0, none as it was when nobody had changed it."""

# OctoPrint installs an archive that mentions it without build isolation; split, or this file did
OLD_HELPER = "octoprint" + "_setuptools"


def archived(folder, commit, name):
    """Return an archive of what was committed, as a hosting site makes it."""
    path = folder / f"OctoPrint-RRFModel-{name}.zip"
    prefix = f"--prefix={path.stem}/"
    command = ["git", "archive", "--format=zip", prefix, f"--output={path}", commit]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0 and not (ROOT / ".git").exists():
        pytest.skip("needs the git repository, this is a copy of its files")
    assert done.returncode == 0, done.stderr
    return path


@pytest.fixture(scope="module")
def repository_zip(tmp_path_factory):
    """Archive of the branch that a user installs."""
    return archived(tmp_path_factory.mktemp("archive"), "HEAD", "main")


@pytest.fixture(scope="module")
def first_zip(tmp_path_factory):
    """Archive of 0.1.0."""
    git = ["git", "cat-file", "-e", f"{FIRST}^{{commit}}"]
    if subprocess.run(git, cwd=ROOT, capture_output=True).returncode != 0:
        pytest.skip("needs the whole history, this is a part of it")
    return archived(tmp_path_factory.mktemp("first"), FIRST, "0.1.0")


@pytest.fixture(scope="module")
def source(repository_zip, tmp_path_factory):
    """Folder with what is committed."""
    folder = tmp_path_factory.mktemp("source")
    with zipfile.ZipFile(repository_zip) as archive:
        archive.extractall(folder)
    return folder / repository_zip.stem


@pytest.fixture(scope="module")
def dist(source, tmp_path_factory):
    """Folder with the source distribution and the wheel built from it."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--outdir", str(folder), str(source)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture(scope="module")
def wheel(dist):
    """The open wheel."""
    (path,) = dist.glob("*.whl")
    with zipfile.ZipFile(path) as archive:
        yield archive


def read_from(wheel, name):
    (path,) = (path for path in wheel.namelist() if path.endswith(f".dist-info/{name}"))
    return wheel.read(path).decode()


def data_files(source):
    """Return the paths, relative to the repository, of all files that aren't Python."""
    package = source / "octoprint_rrfmodel"
    paths = [path for folder in DATA_FOLDERS for path in (package / folder).rglob("*")]
    return {path.relative_to(source).as_posix() for path in paths if path.is_file()}


def test_metadata(wheel):
    metadata = email.message_from_string(read_from(wheel, "METADATA"))
    assert metadata["Name"] == "OctoPrint-RRFModel"
    assert metadata["License-Expression"] == "AGPL-3.0-or-later"
    assert metadata["Requires-Python"] == "<4,>=3.9"
    assert metadata["Requires-Dist"] is None
    # OctoPrint tells it in its list of plugins, by that label
    assert f"Homepage, {updates.URL}" in metadata.get_all("Project-URL")
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert "GNU AFFERO GENERAL PUBLIC LICENSE" in read_from(wheel, "licenses/LICENSE")


def test_entry_point(wheel):
    entry_points = configparser.ConfigParser()
    entry_points.read_string(read_from(wheel, "entry_points.txt"))
    assert dict(entry_points["octoprint.plugin"]) == {"rrfmodel": "octoprint_rrfmodel"}


def test_archives_have_all_files(source, dist, wheel):
    (path,) = dist.glob("*.tar.gz")
    with tarfile.open(path) as archive:
        in_source = {name.partition("/")[2] for name in archive.getnames()}
    in_wheel = set(wheel.namelist())
    modules = {
        path.relative_to(source).as_posix()
        for path in (source / "octoprint_rrfmodel").rglob("*.py")
    }
    wanted = modules | data_files(source)
    assert wanted - in_source == set()
    assert wanted - in_wheel == set()
    # nothing else lands beside other plugins in the environment
    assert {name.partition("/")[0].partition("-")[0] for name in in_wheel} == {"octoprint_rrfmodel"}


def test_old_helper_is_not_mentioned(source):
    mentions = [
        path.relative_to(source).as_posix()
        for path in source.rglob("*")
        if path.is_file() and OLD_HELPER.encode() in path.read_bytes()
    ]
    assert mentions == []


@pytest.fixture(scope="module")
def throwaway_python(tmp_path_factory):
    """Interpreter of an environment that has OctoPrint and nothing else.

    It is for these tests alone, each of which leaves it without the plugin.
    """
    plain = Path(f"{sys.prefix}-plain")
    if not (plain / ".ready").exists():
        message = f"no environment with OctoPrint alone in {plain}: make environments builds it"
        (pytest.fail if os.environ.get("CI") else pytest.skip)(message)
    copy = tmp_path_factory.mktemp("plain") / "environment"
    # the interpreter finds its environment by where it was started, so that a copy is as good
    shutil.copytree(plain, copy, symlinks=True)
    yield str(copy / "bin" / "python")
    shutil.rmtree(copy)


def octoprints_own(server):
    """Return what is stored of the serial line, of the terminal, and the profile."""
    config = yaml.safe_load((server.basedir / "config.yaml").read_text(encoding="utf-8"))
    line = config["plugins"].get("serial_connector") or config["serial"]
    profile = server.get("/api/printerprofiles/_default").json()
    return line, config.get("feature"), profile["extruder"]


def change_octoprints_own(server, board):
    """Have the plugin change all that it may of OctoPrint's own."""
    from tests.e2e import helpers

    helpers.connect(server, board)
    for command in ("fix_settings", "fix_profile"):
        response = server.post("/api/plugin/rrfmodel", json={"command": command})
        assert response.status_code == 204, response.text
    helpers.disconnect(server)


def managing(**plugins_config):
    """Return settings of plugins with which the plugin manager can be used, and asks nobody."""
    from tests.support.basedir import DISABLED_PLUGINS

    return {
        "_disabled": [name for name in DISABLED_PLUGINS if name != "pluginmanager"],
        # nobody listens there: the list of all plugins is of no interest
        "pluginmanager": dict.fromkeys(("repository", "notices"), "http://127.0.0.1:9/"),
        **plugins_config,
    }


def manage(server, path, **request):
    """Have the plugin manager do something, to its end."""
    from tests.support.basedir import ADMIN
    from tests.support.push import PushListener

    with PushListener(server, ADMIN) as push:
        response = server.post(path, **request)
        assert response.ok, response.text
        result = push.wait_for_plugin(
            lambda data: data.get("type") == "result",
            timeout=300,
            what=f"the result of {path}",
            plugin="pluginmanager",
        )
    assert result["result"], result


UNINSTALL = {"command": "uninstall", "plugin": "rrfmodel"}


def test_plugin_manager_installs_and_removes(
    repository_zip, source, throwaway_python, server_factory, board_factory
):
    def status():
        return server.get("/plugin/rrfmodel/status")

    server = server_factory(
        python=throwaway_python,
        plugins_config=managing(),
    )
    assert status().status_code == 404

    with repository_zip.open("rb") as archive:
        manage(server, "/plugin/pluginmanager/upload_file", files={"file": archive})
    server.restart()
    assert status().status_code == 200
    assert status().json()["is_rrf"] is False
    package = "octoprint_rrfmodel/"
    for name in data_files(source):
        if name.startswith(package + "static/"):
            response = server.get("/plugin/rrfmodel/" + name[len(package) :])
            assert response.status_code == 200, name

    # what it changes of OctoPrint's own is gone with it
    before = octoprints_own(server)
    change_octoprints_own(server, board_factory(machine="toolchanger"))
    assert all(old != new for old, new in zip(before, octoprints_own(server)))

    manage(server, "/api/plugin/pluginmanager", json=UNINSTALL)
    server.restart()
    assert status().status_code == 404
    assert octoprints_own(server) == before


def pip_install(python, archive):
    """Install an archive over what there is, as OctoPrint's Software Update does."""
    command = [python, "-m", "pip", "install", "--no-deps", str(archive)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def installed_version(server):
    return server.get("/plugin/rrfmodel/status").json()["version"]


def is_within(wanted, found):
    """Return whether ``found`` has all that ``wanted`` has."""
    if not isinstance(wanted, dict):
        return wanted == found
    return all(name in found and is_within(each, found[name]) for name, each in wanted.items())


def test_an_upgrade_keeps_what_was_set_and_can_take_back_what_was_changed(
    first_zip, dist, wheel, throwaway_python, server_factory, board_factory
):
    pip_install(throwaway_python, first_zip)
    server = server_factory(python=throwaway_python, plugins_config=managing(rrfmodel=SET_IN_0_1_0))
    assert installed_version(server) == "0.1.0"
    before = octoprints_own(server)
    change_octoprints_own(server, board_factory(machine="toolchanger"))
    changed = octoprints_own(server)
    assert all(old != new for old, new in zip(before, changed))

    server.stop()
    # one OctoPrint is given the one, one the other
    (archive,) = dist.glob("*.tar.gz" if server.version.startswith("1.") else "*.whl")
    pip_install(throwaway_python, archive)
    server.start()
    version = email.message_from_string(read_from(wheel, "METADATA"))["Version"]
    assert installed_version(server) == version
    settings = server.get("/api/settings").json()["plugins"]["rrfmodel"]
    assert is_within(SET_IN_0_1_0, settings)
    stored = yaml.safe_load((server.basedir / "config.yaml").read_text(encoding="utf-8"))
    assert is_within(SET_IN_0_1_0, stored["plugins"]["rrfmodel"])
    assert octoprints_own(server) == changed
    # nothing of the old one is left where the new one is
    package = (
        Path(throwaway_python).parents[1].glob("lib/python3*/site-packages/octoprint_rrfmodel")
    )
    (folder,) = package
    there = {
        path.relative_to(folder.parent).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and path.suffix != ".pyc"
    }
    assert there == {name for name in wheel.namelist() if name.startswith("octoprint_rrfmodel/")}

    manage(server, "/api/plugin/pluginmanager", json=UNINSTALL)
    assert octoprints_own(server) == before
