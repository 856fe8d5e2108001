"""OctoPrint's printer API as its documents have it: what it tells, and every status."""

import itertools
import re

import pytest

from tests.support.basedir import OPERATOR, READER

from ..printer_bench import Bench
from ..printer_requests import HOME, JOG, MALFORMED, OFFSET, SCRIPT, TARGET, By, name_of, rows

pytestmark = pytest.mark.both_hosts("each has its own code for the serial line")


@pytest.fixture(scope="module")
def bench(module_server_factory, module_board_factory):
    # the board may answer M400 before OctoPrint has queued the M114 that it then waits for
    serial = {"timeout": {"positionLogWait": 1}}
    server = module_server_factory(profile={"heatedChamber": True}, serial=serial)
    # motors that a cancelled print switches off leave no axis homed, and a move is refused then by
    # the plugin or by the firmware, as the polls happen to come
    scripts = {"greeting": SCRIPT, "afterPrintCancelled": ""}
    server.set_setting("scripts.gcode", scripts)
    return Bench(server, module_board_factory(machine="corexy", firmware="3.5.3", speed=20))


@pytest.mark.parametrize(
    "state, path, body, status, wire", [pytest.param(*row, id=name_of(*row)) for row in rows()]
)
def test_request(bench, octoprint_version, state, path, body, status, wire):
    bench.enter(state)
    status_found, wire_found = bench.post(path, body)
    # with a tool just asked for, whose extruder it is is the firmware's to say
    found = status_found, [re.sub("^M221 S", "M221 D0 S", line) for line in wire_found]
    assert found == (By.version(status, octoprint_version), By.version(wire, octoprint_version))


@pytest.mark.parametrize("path", MALFORMED)
def test_malformed(bench, path):
    bench.enter("operational")
    statuses, wire = bench.post_all(path, MALFORMED[path])
    assert statuses == {str(body): 400 for body in MALFORMED[path]}
    assert wire == []


# who may not is told so first, whatever is wrong with the request

FOR_NOBODY = [
    ("printhead", JOG),
    ("printhead", {**HOME, "axes": ["x"]}),
    ("tool", {**TARGET, "targets": {"tool0": -1}}),
    ("bed", {**TARGET, "target": 50}),
    ("chamber", {**TARGET, "target": -1}),
    ("sd", {"command": "release"}),
    ("command", {"command": "M117"}),
]


@pytest.mark.parametrize("path, body", FOR_NOBODY, ids=[path for path, _ in FOR_NOBODY])
def test_without_the_permission(bench, path, body):
    bench.enter("operational")
    with bench.server.client(READER) as reader:
        assert bench.post(path, body, reader) == (403, [])


# what is told

HEATERS = {"bed": 0, "tool0": 1, "chamber": 2}
"""OctoPrint's name of each heater of the machine, and RRF's number of it."""

OFFSETS = {"bed": -3, "tool0": 5, "chamber": 2}

PATHS = {"/tool": ["tool0"], "/bed": ["bed"], "/chamber": ["chamber"]}

FLAGS = {
    "operational": {"operational", "ready", "sdReady"},
    "released": {"operational", "ready"},
    "printing": {"operational", "printing", "sdReady"},
    "paused": By(
        {"operational", "paused", "sdReady"}, {"operational", "printing", "paused", "sdReady"}
    ),
}
"""Which of the state's flags are set; to 2.0 a paused print is one that is printing."""


def assert_as_the_model(bench, told, names):
    """Of the heaters those are told, each as the board's own model has it."""
    assert set(told) & set(HEATERS) == set(names)
    heaters = bench.machine.board.model["heat"]["heaters"]
    for name in names:
        heater = heaters[HEATERS[name]]
        wanted = heater["active"] if heater["state"] == "active" else 0
        assert told[name]["target"] == wanted, name
        assert told[name]["actual"] == pytest.approx(heater["current"], abs=2), name


def is_as_the_model(bench):
    """Whether OctoPrint shows what the board's own model has."""
    try:
        assert_as_the_model(bench, bench.get().json()["temperature"], HEATERS)
    except AssertionError:
        return False
    return True


def set_offsets(bench, offsets):
    bench.enter("operational")
    assert bench.post("tool", {**OFFSET, "offsets": {"tool0": offsets["tool0"]}}) == (204, [])
    for name in ("bed", "chamber"):
        assert bench.post(name, {**OFFSET, "offset": offsets[name]}) == (204, [])


@pytest.fixture
def heated(bench):
    """Each heater is on, and has an offset of its own."""
    set_offsets(bench, OFFSETS)
    bench.heat()
    # OctoPrint asks every five seconds
    bench.server.wait_for(lambda: is_as_the_model(bench), 30, "OctoPrint to know of it")
    yield
    set_offsets(bench, dict.fromkeys(OFFSETS, 0))


@pytest.mark.parametrize("path", PATHS)
def test_heaters_of_one_kind(bench, heated, path):
    answer = bench.get(path)
    assert answer.status_code == 200
    names = PATHS[path]
    assert set(answer.json()) == set(names)
    assert_as_the_model(bench, answer.json(), names)
    assert {name: answer.json()[name]["offset"] for name in names} == {
        name: OFFSETS[name] for name in names
    }


def test_full_state(bench, heated):
    told = bench.get().json()
    assert set(told) == {"temperature", "sd", "state"}
    assert_as_the_model(bench, told["temperature"], HEATERS)
    assert {name: told["temperature"][name]["offset"] for name in HEATERS} == OFFSETS
    # a sensor that no heater uses, by its own name
    assert told["temperature"]["mcu"]["target"] in (None, 0)
    assert told["sd"] == {"ready": True}
    assert told["state"]["text"] == "Operational"


def subsets():
    parts = ("temperature", "sd", "state")
    yield from ("", "nonsense", " sd , state ")
    for count in range(1, 4):
        yield from map(",".join, itertools.combinations(parts, count))


@pytest.mark.both_hosts("each has its own code for the serial line", once_for=("exclude",))
@pytest.mark.parametrize("exclude", subsets())
def test_parts_can_be_left_out(bench, exclude):
    bench.enter("operational")
    answer = bench.get(exclude=exclude)
    assert answer.status_code == 200
    left_out = {part.strip() for part in exclude.split(",")}
    assert set(answer.json()) == {"temperature", "sd", "state"} - left_out


@pytest.mark.both_hosts("each has its own code for the serial line", once_for=("yes",))
@pytest.mark.parametrize("yes", ["true", "yes", "y", "1"])
def test_history_is_told_to_who_wants_it(bench, yes):
    bench.enter("operational")
    assert len(bench.get("/tool", history=yes).json()["history"]) > 5


@pytest.mark.both_hosts("each has its own code for the serial line", once_for=("no",))
@pytest.mark.parametrize("no", ["false", "no", "n", "0", ""])
def test_history_is_not_told_to_others(bench, no):
    bench.enter("operational")
    assert "history" not in bench.get("/tool", history=no, limit=3).json()


@pytest.mark.parametrize("path", ["", *PATHS])
def test_history_has_the_same_heaters(bench, heated, path):
    told = bench.get(path, history="true", limit=3).json()
    names = PATHS.get(path, HEATERS)
    told = told["temperature"] if not path else told
    assert len(told["history"]) == 3
    for entry in told["history"]:
        assert set(entry) & set(HEATERS) == set(names)
        # OctoPrint takes the time for a heater of another kind, against its documents
        assert ("time" in entry) == (not path)
    assert_as_the_model(bench, told["history"][-1], names)


@pytest.mark.parametrize("limit, count", [("1", 1), ("4", 4), ("nonsense", None), ("-1", None)])
def test_history_has_a_limit(bench, limit, count):
    bench.enter("operational")
    everything = bench.get("/bed", history="true").json()["history"]
    limited = bench.get("/bed", history="true", limit=limit).json()["history"]
    assert len(limited) == count or (count is None and len(limited) >= len(everything) > 4)


@pytest.mark.parametrize("state", FLAGS)
def test_flags(bench, octoprint_version, state):
    bench.enter(state)
    flags = bench.get(exclude="temperature,sd").json()["state"]["flags"]
    wanted = By.version(FLAGS[state], octoprint_version)
    assert {name for name in flags if flags[name]} == wanted


@pytest.mark.parametrize(
    "state, is_ready", [("operational", True), ("released", False), ("printing", True)]
)
def test_card(bench, octoprint_version, state, is_ready):
    bench.enter(state)
    assert bench.get("/sd").json() == {"ready": is_ready}
    assert bench.get().json()["sd"] == {"ready": is_ready}
    # the name that it has in 2.0
    assert bench.get("/storage").status_code == By.version(By(404, 200), octoprint_version)


def test_card_that_is_disabled_is_no_part(bench):
    bench.enter("card disabled")
    assert set(bench.get().json()) == {"temperature", "state"}
    assert bench.get("/sd").status_code == 404


@pytest.mark.parametrize(
    "state, names",
    [
        ("no bed", ["tool0", "chamber"]),
        ("no chamber", ["tool0", "bed"]),
        ("no bed, no chamber", ["tool0"]),
    ],
)
def test_heaters_that_the_profile_has_not_are_not_told(bench, state, names):
    bench.enter(state)
    told = bench.get(history="true", limit=2).json()["temperature"]
    assert set(told) & set(HEATERS) == set(names)
    for entry in told["history"]:
        assert set(entry) & set(HEATERS) == set(names)
    for path, (name,) in PATHS.items():
        assert bench.get(path).status_code == (200 if name in names else 409)


@pytest.mark.parametrize(
    "path, status",
    [
        ("", 409),
        ("/tool", 409),
        ("/bed", 409),
        ("/chamber", 409),
        ("/sd", 200),
        ("/error", 200),
        ("/command/custom", 200),
    ],
)
def test_nothing_connected(bench, path, status):
    bench.enter("disconnected")
    answer = bench.get(path)
    assert answer.status_code == status
    if path == "/sd":
        assert answer.json() == {"ready": False}


@pytest.mark.parametrize("path", ["", "/tool", "/bed", "/chamber", "/sd", "/error"])
def test_reading_needs_a_permission(bench, path):
    with bench.server.client() as nobody, bench.server.client(OPERATOR) as operator:
        bench.enter("operational")
        assert nobody.get(f"/api/printer{path}").status_code == 403
        assert operator.get(f"/api/printer{path}").status_code == 200
