"""Where OctoPrint looks for newer releases of the plugin, and where from it takes them."""

REPOSITORY = ("OctoPrint-RRFModel", "OctoPrint-RRFModel")
"""Owner and name on GitHub; ``pyproject.toml`` has the same address."""

URL = "https://github.com/{}/{}".format(*REPOSITORY)

STABLE = {"name": "Stable", "branch": "main", "commitish": ["main"]}

CANDIDATES = {"name": "Release candidates", "branch": "rc", "commitish": ["rc", "main"]}
"""Releases that are marked as such on GitHub, from either branch, and all stable ones."""


def update_check(identifier, name, version):
    """Return what OctoPrint's Software Update is to look for, by the plugin's ``identifier``.

    The form is that of its hook ``octoprint.plugin.softwareupdate.check_config``. ``version`` is
    the one that is installed; a release's tag is its version. OctoPrint keeps what this returns
    for whoever asks later, so that the names are in nobody's language.
    """
    owner, repository = REPOSITORY
    return {
        identifier: {
            "displayName": name,
            "displayVersion": version,
            "type": "github_release",
            "user": owner,
            "repo": repository,
            "current": version,
            "stable_branch": STABLE,
            "prerelease_branches": [CANDIDATES],
            "pip": f"{URL}/archive/{{target_version}}.zip",
        }
    }
