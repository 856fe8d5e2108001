"""The description of the endpoints agrees with itself and with the table of commands."""

import json

from octoprint_rrfmodel.rrf.gcode.commands import COMMANDS
from tests.support.places import ROOT

DESCRIPTION = ROOT / "octoprint_rrfmodel" / "web" / "openapi.json"


def nodes(value):
    if isinstance(value, dict):
        yield value
        for each in value.values():
            yield from nodes(each)
    elif isinstance(value, list):
        for each in value:
            yield from nodes(each)


def test_every_command_can_be_chosen():
    described = json.loads(DESCRIPTION.read_text("utf-8"))
    (choice,) = [node for node in nodes(described) if "discriminator" in node]
    mapping = choice["discriminator"]["mapping"]
    assert {row.name for row in COMMANDS} <= mapping.keys()
    assert sorted(mapping.values()) == sorted(each["$ref"] for each in choice["oneOf"])
    schemas = described["components"]["schemas"]
    assert {path.rpartition("/")[2] for path in mapping.values()} <= schemas.keys()
