"""What OctoPrint's own Software Update makes of the plugin's answer to its hook."""

import pytest

pytest.importorskip("octoprint")

from octoprint.plugins.softwareupdate import SoftwareUpdatePlugin, updaters
from octoprint.plugins.softwareupdate.version_checks import github_release

from octoprint_rrfmodel.host.updates import CANDIDATES, STABLE, update_check


class NoSettings:
    def global_get(self, path, **kwargs):
        return None


def populated(version, **chosen):
    """Return the check as OctoPrint completes it, with what a user has chosen in its settings."""
    plugin = SoftwareUpdatePlugin()
    plugin._settings = NoSettings()
    (check,) = update_check("rrfmodel", "RepRapFirmware Model", version).values()
    return plugin._populated_check("rrfmodel", {**check, **chosen})


def release(tag, branch="main", is_candidate=False):
    return {
        "name": f"Version {tag}",
        "tag_name": tag,
        "html_url": f"https://example.com/{tag}",
        "draft": False,
        "prerelease": is_candidate,
        "published_at": "2026-12-01T00:00:00Z",
        "target_commitish": branch,
    }


RELEASES = [
    release("0.2.0"),
    release("0.3.0rc1", "rc", is_candidate=True),
    release("0.3.0rc2", is_candidate=True),
    release("0.4.0.dev1", "try", is_candidate=True),
]


@pytest.fixture
def asked(monkeypatch):
    """The addresses that are asked for releases; what answers has those of the test."""
    addresses = []

    class Answer:
        status_code = 200
        headers = {}

        def raise_for_status(self):
            pass

        def json(self):
            return RELEASES

    def get(address, **kwargs):
        addresses.append(address)
        return Answer()

    monkeypatch.setattr(github_release.requests, "get", get)
    return addresses


CANDIDATES_CHOSEN = {"prerelease": True, "prerelease_channel": CANDIDATES["branch"]}


@pytest.mark.parametrize(
    ("version", "chosen", "newest"),
    [
        ("0.1.0", {}, "0.2.0"),
        ("0.2.0", {}, None),
        ("0.2.0", CANDIDATES_CHOSEN, "0.3.0rc2"),
        ("0.3.0rc2", CANDIDATES_CHOSEN, None),
        # who has had enough of candidates goes back to the last stable one
        ("0.3.0rc2", {"prerelease": False, "prerelease_channel": STABLE["branch"]}, "0.2.0"),
    ],
)
def test_releases_of_the_chosen_channel_are_offered(version, chosen, newest, asked):
    check = populated(version, **chosen)
    information, is_current = github_release.get_latest("rrfmodel", check)
    assert is_current is (newest is None), information
    assert information["local"]["value"] == version
    assert newest is None or information["remote"]["value"] == newest
    (address,) = asked
    assert address.endswith("/repos/OctoPrint-RRFModel/OctoPrint-RRFModel/releases")


def test_the_archive_of_the_tag_is_what_is_installed(monkeypatch):
    installed = []

    class Pip:
        def execute(self, *args, **kwargs):
            installed.append(args)
            return 0, [], []

    class Prepared:
        def __init__(self, path, log=None):
            self.path, self.args = path, []

        def __enter__(self):
            return self

        def __exit__(self, *exc_info):
            pass

    monkeypatch.setattr(updaters.pip, "_get_pip_caller", lambda command=None: Pip())
    monkeypatch.setattr(updaters.pip, "prepare_install", Prepared, raising=False)
    check = populated("0.1.0")
    updaters.pip.perform_update("rrfmodel", check, "0.2.0")
    assert any(each.endswith("/OctoPrint-RRFModel/archive/0.2.0.zip") for each in installed[0])


def test_both_channels_are_told_by_name():
    check = populated("0.2.0")
    assert check["displayName"] == "RepRapFirmware Model"
    assert check["displayVersion"] == "0.2.0"
    names = [each["name"] for each in (check["stable_branch"], *check["prerelease_branches"])]
    assert names == ["Stable", "Release candidates"]
