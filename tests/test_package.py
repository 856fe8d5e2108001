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

from tests.support.places import ROOT

# the work is in what the fixtures build, so that one worker does it
pytestmark = [pytest.mark.slow, pytest.mark.timeout(600), pytest.mark.xdist_group("package")]

DATA_FOLDERS = ("static", "templates", "translations")

# OctoPrint installs an archive that mentions it without build isolation; split, or this file did
OLD_HELPER = "octoprint" + "_setuptools"


@pytest.fixture(scope="module")
def repository_zip(tmp_path_factory):
    """Archive of what is committed, as a hosting site makes it."""
    path = tmp_path_factory.mktemp("archive") / "OctoPrint-RRFModel-main.zip"
    prefix = f"--prefix={path.stem}/"
    command = ["git", "archive", "--format=zip", prefix, f"--output={path}", "HEAD"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0 and not (ROOT / ".git").exists():
        pytest.skip("needs the git repository, this is a copy of its files")
    assert done.returncode == 0, done.stderr
    return path


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


@pytest.fixture
def throwaway_python(tmp_path):
    """Interpreter of an environment that has OctoPrint and nothing else, for this test alone."""
    plain = Path(f"{sys.prefix}-plain")
    if not (plain / ".ready").exists():
        message = f"no environment with OctoPrint alone in {plain}: make environments builds it"
        (pytest.fail if os.environ.get("CI") else pytest.skip)(message)
    copy = tmp_path / "environment"
    # the interpreter finds its environment by where it was started, so that a copy is as good
    shutil.copytree(plain, copy, symlinks=True)
    yield str(copy / "bin" / "python")
    shutil.rmtree(copy)


def test_plugin_manager_installs_and_removes(
    repository_zip, source, throwaway_python, server_factory, board_factory
):
    from tests.e2e import helpers
    from tests.support.basedir import ADMIN, DISABLED_PLUGINS
    from tests.support.push import PushListener

    def manage(path, **request):
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
        server.restart()

    def octoprints_own():
        """Return what is stored of the serial line, of the terminal, and the profile."""
        config = yaml.safe_load((server.basedir / "config.yaml").read_text(encoding="utf-8"))
        line = config["plugins"].get("serial_connector") or config["serial"]
        profile = server.get("/api/printerprofiles/_default").json()
        return line, config.get("feature"), profile["extruder"]

    def status():
        return server.get("/plugin/rrfmodel/status")

    server = server_factory(
        python=throwaway_python,
        plugins_config={
            "_disabled": [name for name in DISABLED_PLUGINS if name != "pluginmanager"],
            # nobody listens there: the list of all plugins is of no interest
            "pluginmanager": dict.fromkeys(("repository", "notices"), "http://127.0.0.1:9/"),
        },
    )
    assert status().status_code == 404

    with repository_zip.open("rb") as archive:
        manage("/plugin/pluginmanager/upload_file", files={"file": archive})
    assert status().status_code == 200
    assert status().json()["is_rrf"] is False
    package = "octoprint_rrfmodel/"
    for name in data_files(source):
        if name.startswith(package + "static/"):
            response = server.get("/plugin/rrfmodel/" + name[len(package) :])
            assert response.status_code == 200, name

    # what it changes of OctoPrint's own is gone with it
    before = octoprints_own()
    helpers.connect(server, board_factory(machine="toolchanger"))
    for command in ("fix_settings", "fix_profile"):
        response = server.post("/api/plugin/rrfmodel", json={"command": command})
        assert response.status_code == 204, response.text
    assert all(old != new for old, new in zip(before, octoprints_own()))
    helpers.disconnect(server)

    uninstall = {"command": "uninstall", "plugin": "rrfmodel"}
    manage("/api/plugin/pluginmanager", json=uninstall)
    assert status().status_code == 404
    assert octoprints_own() == before
