"""The OpenAPI description against a running server: it says what is true, and nothing breaks."""

import json
from pathlib import Path

import hypothesis
import pytest
import schemathesis
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_schema_conformance,
    status_code_conformance,
)

import octoprint_rrfmodel
from octoprint_rrfmodel.rrf.gcode.commands import COMMANDS
from tests.support.basedir import ADMIN

from .. import helpers

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
]

DISRUPTIVE = (
    "emergency_stop",
    "recover",
    "reconnect",
    "fix_settings",
    "restore_settings",
    "fix_profile",
    "network_password",
)
"""Commands that would take the printer away from the others, or write settings each time."""

PATH = Path(octoprint_rrfmodel.__file__).parent / "web" / "openapi.json"


BOARD = {"machine": "toolchanger", "speed": 20}


@pytest.fixture(scope="module")
def api(server):
    description = server.get("/plugin/rrfmodel/openapi.json").json()
    loaded = schemathesis.openapi.from_dict(description)
    loaded.config.update(base_url=server.url)
    loaded.config.generation.update(modes=[GenerationMode.POSITIVE, GenerationMode.NEGATIVE])
    # as what is disruptive among the commands
    return loaded.exclude(path_regex=r"/printer/(firmware_)?restart$")


MOONRAKERS = tuple(
    f"/plugin/rrfmodel/{part}/" for part in ("printer", "server", "machine", "access")
)

FOR_EVERYBODY = ("/plugin/rrfmodel/access/info",)

schema = schemathesis.pytest.from_fixture("api")


@schema.parametrize()
@hypothesis.settings(
    max_examples=8,
    deadline=None,
    suppress_health_check=list(hypothesis.HealthCheck),
    phases=[hypothesis.Phase.explicit, hypothesis.Phase.generate],
)
def test_answers_as_described(case, server):
    body = case.body if isinstance(case.body, dict) else {}
    hypothesis.assume(body.get("command") not in DISRUPTIVE)
    response = case.call(headers={"X-Api-Key": ADMIN.api_key}, timeout=30)
    assert response.status_code < 500
    # Tornado hands on no body that isn't what its header says, and answers with nothing more
    hypothesis.assume(response.status_code != 400 or response.content)
    case.validate_response(response, checks=CHECKS)


@pytest.mark.both_hosts("each tells by its own code who somebody is")
@pytest.mark.parametrize("way", ["nobody", "guest key"])
def test_answers_as_described_to_strangers(server, way):
    described = json.loads(PATH.read_text(encoding="utf-8"))
    headers = {} if way == "nobody" else {"X-Api-Key": "nonsense"}
    closed = {path: each for path, each in described["paths"].items() if path not in FOR_EVERYBODY}
    for path, operations in closed.items():
        for method, operation in operations.items():
            with server.client() as client:
                response = client.request(method.upper(), path, json={}, headers=headers)
            assert str(response.status_code) in operation["responses"], (method, path)
            assert response.status_code in (400, 403)
            assert set(response.json()) == {"error"}


def test_served_as_it_is_in_the_package(server):
    described = json.loads(PATH.read_text(encoding="utf-8"))
    served = server.get("/plugin/rrfmodel/openapi.json").json()
    assert served["openapi"].startswith("3.1")
    assert served["info"]["version"] == helpers.status(server)["version"]
    assert served["paths"] == described["paths"]
    assert served["components"] == described["components"]


def test_every_command_is_described_with_its_parameters():
    schemas = json.loads(PATH.read_text(encoding="utf-8"))["components"]["schemas"]
    own = {"reconnect", "fix_settings", "restore_settings", "fix_profile", "wizard_done"}
    own.add("network_password")
    described = {
        name[len("Command_") :]: (set(found["properties"]), set(found["required"]))
        for name, found in schemas.items()
        if name.startswith("Command_")
    }
    assert set(described) == {row.name for row in COMMANDS} | own
    for row in COMMANDS:
        names = {"command", *(parameter.name for parameter in row.parameters)}
        required = {"command", *(each.name for each in row.parameters if each.is_required)}
        assert described[row.name] == (names, required), row.name


def test_every_route_is_described(server):
    described = json.loads(PATH.read_text(encoding="utf-8"))["paths"]
    # OctoPrint 2.0 can't be imported from any side
    import octoprint.filemanager  # noqa: F401

    from octoprint_rrfmodel.web.endpoints import Endpoints

    rules = {
        "/plugin/rrfmodel" + rule
        for name in dir(Endpoints)
        for rule, _ in getattr(getattr(Endpoints, name), "_blueprint_rules", {}).get(name, ())
    }
    tornados = {
        "/plugin/rrfmodel/model/live",
        "/plugin/rrfmodel/files",
        "/plugin/rrfmodel/thumbnail",
        "/plugin/rrfmodel/heightmap",
        "/plugin/rrfmodel/bundle",
        "/plugin/rrfmodel/machine_files",
        "/plugin/rrfmodel/machine_file",
    }
    # one rule for all of Moonraker's methods, whose table has their paths; each is asked above
    moonrakers = {path for path in described if path.startswith(MOONRAKERS)}
    rules.remove("/plugin/rrfmodel/<path:path>")
    assert rules | tornados | {"/api/plugin/rrfmodel"} == set(described) - moonrakers
