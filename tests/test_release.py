"""What is said of the plugin in several places agrees, and has the form that others want."""

import ast
import datetime
import json
import re
from importlib import metadata

import pytest

from octoprint_rrfmodel.host import updates
from tests.support.places import ROOT

yaml = pytest.importorskip("yaml")

try:
    import tomllib
except ImportError:
    import tomli as tomllib

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
ENTRY = ROOT / "extras" / "rrfmodel.md"
SCREENSHOTS = ROOT / "extras" / "screenshots"

REQUIRED = {
    "layout",
    "id",
    "title",
    "description",
    "license",
    "date",
    "homepage",
    "source",
    "archive",
}
"""Fields that OctoPrint's plugin repository insists on; one of the authors' besides."""

OPTIONAL = {
    "author",
    "authors",
    "attributes",
    "privacypolicy",
    "follow_dependency_links",
    "tags",
    "screenshots",
    "featuredimage",
    "compatibility",
}

ATTRIBUTES = {"cloud", "commercial", "free-tier", "ai-developed"}
SYSTEMS = {"windows", "linux", "macos", "freebsd", "posix", "nix"}
IMAGES = "/assets/img/plugins/rrfmodel/"


def literal_of(name):
    """Return what the package's own file has for OctoPrint under that name."""
    tree = ast.parse((ROOT / "octoprint_rrfmodel" / "__init__.py").read_text("utf-8"))
    (found,) = (
        node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign) and node.targets[0].id == name
    )
    return found


@pytest.fixture(scope="module")
def entry():
    """The fields of the plugin repository's entry, and the text below them."""
    _, fields, text = ENTRY.read_text("utf-8").split("---\n", 2)
    return yaml.safe_load(fields), text


def test_pypi_knows_the_classifiers():
    classifiers = pytest.importorskip("trove_classifiers")
    assert set(PROJECT["classifiers"]) - classifiers.classifiers == set()
    assert len(set(PROJECT["classifiers"])) == len(PROJECT["classifiers"])
    # PyPI refuses them beside a licence expression
    assert not [each for each in PROJECT["classifiers"] if each.startswith("License ::")]


def test_the_repository_is_the_same_everywhere(entry):
    fields, _ = entry
    assert set(PROJECT["urls"]) >= {"Repository", "Homepage", "Documentation", "Changelog"}
    assert PROJECT["urls"]["Repository"] == updates.URL == fields["source"]
    for address in (*PROJECT["urls"].values(), fields["homepage"], fields["archive"]):
        assert address == updates.URL or address.startswith(f"{updates.URL}/"), address


def test_the_version_is_the_same_everywhere():
    version = PROJECT["version"]
    openapi = json.loads((ROOT / "octoprint_rrfmodel" / "web" / "openapi.json").read_text("utf-8"))
    assert openapi["info"]["version"] == version
    assert f'"version": "{version}"' in (ROOT / "docs" / "integrations.md").read_text("utf-8")


def test_the_changelog_begins_with_what_is_unreleased_and_then_this_release():
    headings = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    assert headings[0] == "[Unreleased]"
    version, _, date = headings[1].partition(" - ")
    assert version == f"[{PROJECT['version']}]"
    datetime.date.fromisoformat(date)


def test_the_entry_has_the_fields_that_the_plugin_repository_requires(entry):
    fields, text = entry
    assert REQUIRED - set(fields) == set()
    assert set(fields) - REQUIRED - OPTIONAL == set()
    assert fields["layout"] == "plugin"
    assert "author" in fields or fields["authors"]
    assert isinstance(fields["date"], datetime.date)
    assert all(fields[name].startswith("https://") for name in ("homepage", "source", "archive"))
    assert set(fields["attributes"]) <= ATTRIBUTES
    assert set(fields["compatibility"]["os"]) <= SYSTEMS
    assert all(isinstance(each, str) for each in fields["compatibility"]["octoprint"])
    assert len(text.strip().splitlines()) > 10


def test_the_entry_says_what_the_package_says(entry):
    fields, _ = entry
    entry_point = PROJECT["entry-points"]["octoprint.plugin"]
    assert fields["id"] in entry_point and ENTRY.stem == fields["id"]
    assert fields["title"] == literal_of("__plugin_name__")
    assert fields["license"] == PROJECT["license"]
    assert fields["authors"] == [each["name"] for each in PROJECT["authors"]]
    python = fields["compatibility"]["python"]
    assert python == PROJECT["requires-python"] == literal_of("__plugin_pythoncompat__")


def test_the_entrys_pictures_are_there(entry):
    fields, _ = entry
    pictures = [each["url"] for each in fields["screenshots"]]
    assert fields["featuredimage"] in pictures
    for each in pictures:
        assert each.startswith(IMAGES)
        assert (SCREENSHOTS / each[len(IMAGES) :]).is_file()
    assert all(each["alt"] and each["caption"] for each in fields["screenshots"])


ALLOWED = re.compile(
    r"(?<![a-z])(agpl|gpl|lgpl|gnu (affero|lesser|library)? ?general public|mit|bsd|apache"
    r"|psf|python software|isc|mpl|mozilla public)",
    re.IGNORECASE,
)
"""Licences that may stand beside the AGPL."""


def licence_of(distribution):
    """Return all that a distribution says of its licence."""
    about = metadata.metadata(distribution)
    said = [about.get("License-Expression"), about.get("License")]
    classifiers = about.get_all("Classifier") or []
    said += [each for each in classifiers if each.startswith("License ::")]
    return "\n".join(each for each in said if each)


def imported():
    """Return the outer names of all that the plugin imports, wherever in it that stands."""
    names = set()
    for path in (ROOT / "octoprint_rrfmodel").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Import):
                names |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and not node.level:
                names.add(node.module.partition(".")[0])
    return names


def test_what_the_plugin_uses_comes_with_octoprint_under_a_licence_that_fits():
    pytest.importorskip("octoprint")
    if not hasattr(metadata, "packages_distributions"):
        pytest.skip("Python 3.9 doesn't tell which distribution a module is of")
    assert PROJECT["dependencies"] == []
    brought = metadata.packages_distributions()
    used = {name: brought[name] for name in imported() if name in brought}
    used.pop("octoprint_rrfmodel", None)
    assert {"octoprint", "flask", "tornado"} <= set(used)
    refused = {
        distribution: licence_of(distribution)[:100]
        for distributions in used.values()
        for distribution in distributions
        if not ALLOWED.search(licence_of(distribution))
    }
    assert refused == {}


WORKFLOWS = ROOT / ".github" / "workflows"


def test_the_workflows_run_what_there_is_on_all_pythons_that_are_named():
    workflow = yaml.safe_load((WORKFLOWS / "checks.yml").read_text("utf-8"))
    text = "\n".join(path.read_text("utf-8") for path in WORKFLOWS.glob("*.yml"))
    targets = set(re.findall(r"^([\w.-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    assert set(re.findall(r"\bmake ([\w.-]+)", text)) <= targets
    pythons = {"3.9", *workflow["jobs"]["everything"]["strategy"]["matrix"]["python"]}
    prefix = "Programming Language :: Python :: 3."
    named = {each.rpartition(" ")[2] for each in PROJECT["classifiers"] if each.startswith(prefix)}
    assert pythons == named
    # what somebody else may change must not run here
    assert all(re.search(r"@[0-9a-f]{40} # v", use) for use in re.findall(r"uses: \w.*", text))


def test_forms_ask_for_the_support_bundle():
    forms = ROOT / ".github" / "ISSUE_TEMPLATE"
    for name in ("bug", "firmware"):
        form = yaml.safe_load((forms / f"{name}.yml").read_text("utf-8"))
        (bundle,) = (part for part in form["body"] if part.get("id") == "bundle")
        assert bundle["attributes"]["label"] == "Support bundle"
        assert bundle["validations"]["required"]


TOOLS = {"ruff", "mypy", "lint-imports", "codespell", "djlint"}


def test_the_hooks_before_a_commit_are_those_of_lint():
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text("utf-8"))
    entries = " ".join(hook["entry"] for repo in hooks["repos"] for hook in repo["hooks"])
    lint = (
        (ROOT / "Makefile").read_text("utf-8").partition("\nlint: ")[2].partition("\nformat: ")[0]
    )
    for each in (*TOOLS, "lint-page"):
        assert each in entries and each in lint, each
