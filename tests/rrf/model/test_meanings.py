"""Every value of the simulated machines has a meaning, and no meaning is of a thing unknown."""

import json

import pytest

from octoprint_rrfmodel.rrf.model.marks import MARKS
from octoprint_rrfmodel.rrf.model.meanings import MEANINGS, OPEN, Meaning, meaning_of
from octoprint_rrfmodel.rrf.wire.m408_table import CONFIG_FIELDS, LEGACY, STATUS_FIELDS
from octoprint_rrfmodel.simulator.machines import MACHINES

from ..simulated import Simulated

UNITS = {
    "", "°C", "°C/s", "°", "mm", "mm/s", "mm/min", "mm/s²", "s", "ms", "1/s", "Hz", "V", "mA", "%",
    "0..1", "bytes", "bytes/s", "rpm", "steps", "steps/mm", "K", "Ω", "px",
}  # fmt: skip

LONGEST = 64

M408_FIELDS = (*LEGACY, *STATUS_FIELDS, *CONFIG_FIELDS)


def leaves(value, path=""):
    """Yield the pattern of each plain value, and of each list or object with nothing in it."""
    if not isinstance(value, (dict, list)) or not value:
        yield path
        return
    for step, member in value.items() if isinstance(value, dict) else enumerate(value):
        named = isinstance(step, str)
        yield from leaves(member, f"{path}.{step}".lstrip(".") if named else f"{path}[]")


def parents(path):
    """Yield a pattern and those of all objects and lists above it."""
    while path:
        yield path
        path = path[:-2] if path.endswith("[]") else path.rpartition(".")[0]


@pytest.fixture(scope="module")
def captured(shared_dir):
    """The patterns that recordings of real machines have."""
    found = set()
    for path in (shared_dir / "captures").glob("om*.json*"):
        texts = path.read_text(encoding="utf-8")
        for text in texts.splitlines() if path.suffix == ".jsonl" else [texts]:
            reply = json.loads(text)
            found.update(leaves(reply.get("result", reply), reply.get("key") or ""))
    return found


@pytest.mark.parametrize("firmware", ["2.05", "3.4", "3.5.3", "3.6", "3.7"])
@pytest.mark.parametrize("machine", sorted(MACHINES))
def test_every_value_has_a_meaning(machine, firmware):
    model = Simulated(machine, firmware).model()
    named = [path for path in leaves(model) if not path.startswith("m408")]
    assert [path for path in named if meaning_of(path) is None] == []
    assert len(named) > 20


def test_an_open_box_has_a_meaning():
    simulated = Simulated("toolchanger")
    model = simulated.run('M291 P"text" R"title" S6 L0 H5 F2', seconds=1).model()
    assert model["state"]["messageBox"]["mode"] == 6
    assert [path for path in leaves(model) if meaning_of(path) is None] == []


def test_every_member_of_the_marks_has_a_meaning():
    containers = {above for path in MARKS for above in list(parents(path))[1:]}
    missing = [path for path in MARKS if path not in containers and meaning_of(path) is None]
    assert missing == []


def test_what_older_firmware_tells_has_a_meaning():
    paths = [row.path for row in M408_FIELDS if row.path and "{" not in row.path]
    assert [path for path in paths if meaning_of(path) is None] == []


def test_no_meaning_is_of_what_nobody_has(captured):
    known = {*MARKS, *captured, *(row.path for row in M408_FIELDS if row.path)}
    known.update(path for name in MACHINES for path in leaves(Simulated(name, "3.6").model()))
    known = {above for path in known for above in parents(path)}
    assert [path for path in MEANINGS if path not in known] == []
    assert set(OPEN) <= set(MEANINGS)


@pytest.mark.parametrize("path", MEANINGS)
def test_units_and_texts(path):
    unit, text = MEANINGS[path]
    assert unit in UNITS
    assert text[0].isupper() or text[0].isdigit()
    assert not text.endswith(".") and text == text.strip()
    assert len(text) <= LONGEST
    assert "%(" not in text


@pytest.mark.parametrize(
    ("path", "unit"),
    [
        ("heat.heaters[0].current", "°C"),
        ("heat.heaters[].current", "°C"),
        ("tools[10].active[1]", "°C"),
        ("move.kinematics.forwardMatrix[2][1]", ""),
        ("move.axes[12].speed", "mm/min"),
        ("move.currentMove.topSpeed", "mm/s"),
        ("sensors.probes[0].speeds[1]", "mm/min"),
        ("tools[0].retraction.speed", "mm/s"),
        ("fans[0].actualValue", "0..1"),
        ("move.axes[0].percentCurrent", "%"),
        ("move.speedFactor", ""),
        ("state.messageBox.timeout", "ms"),
    ],
)
def test_units_of_what_is_mixed_up_easily(path, unit):
    assert meaning_of(path).unit == unit


@pytest.mark.parametrize("path", ["global.x", "global.list[3].x", "global"])
def test_variables_mean_what_all_of_them_mean(path):
    assert meaning_of(path) == MEANINGS["global"]


@pytest.mark.parametrize(
    "path", ["", ".", "[]", "[0]", "nothing", "heat.heaters[0].nothing", "globally"]
)
def test_nothing_is_said_of_what_is_unknown(path):
    assert meaning_of(path) is None


def test_a_meaning_has_names():
    assert isinstance(meaning_of("state.upTime"), Meaning)
