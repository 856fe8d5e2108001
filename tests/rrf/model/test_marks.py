"""The built-in marks against the table of the firmware's sources and against recorded replies."""

import json
import re

import pytest

from octoprint_rrfmodel.rrf.model.m409 import answer
from octoprint_rrfmodel.rrf.model.marks import MARKS, SIGNS, TABLE

MARK_OF = {"*": "live", "!": "important", "v": "verbose", "o": "obsolete"}

# heading of the list -> object path; None where the rows are read elsewhere
PATHS = {
    "(root)": "",
    "boards[0]": "boards[]",
    "boards[n]": "boards[]",
    "boards[n] <accelerometer members>": "boards[].accelerometer",
    "boards[n] <closedloop members>": "boards[].closedLoop",
    "boards[n] <mcutemp members>": "boards[].mcuTemp",
    "boards[n] <v12 members>": "boards[].v12",
    "boards[n] <vin members>": "boards[].vIn",
    "boards[n].drivers[] <closedloop members>": "boards[].drivers[].closedLoop",
    "boards[n].drivers[] <closedloop.currentfraction members>":
        "boards[].drivers[].closedLoop.currentFraction",
    "boards[n].drivers[] <closedloop.positionerror members>":
        "boards[].drivers[].closedLoop.positionError",
    "fans[] <fan.thermostatic members>": "fans[].thermostatic",
    "heat.heaters[] <heater.monitors[] members>": "heat.heaters[].monitors[]",
    "heat.heaters[].model <pid members>": "heat.heaters[].model.pid",
    "job <'file' members>": "job.file",
    "job <'file' thumbnails[] members>": "job.file.thumbnails[]",
    "job <parsedfileinfo members>": "job.file",
    "job <parsedfileinfo.thumbnails[] members>": "job.file.thumbnails[]",
    "job <timesleft members>": "job.timesLeft",
    "job.build <objectdirectoryentry root>": "job.build.objects[]",
    "move.keepout[] <keepoutzone.coords[] members>": "move.keepout[].coords[]",
    "move.kinematics (cart/core)": "move.kinematics",
    "move.kinematics (delta)": "move.kinematics",
    "move.kinematics (delta) <tower members>": "move.kinematics.towers[]",
    "move.kinematics <segmentation members>": "move.kinematics.segmentation",
    "network.interfaces[] (eth)": "network.interfaces[]",
    "network.interfaces[] (w5500)": "network.interfaces[]",
    "network.interfaces[] (wifi)": "network.interfaces[]",
    "sensors.analog[] (+)": "sensors.analog[]",
    "sensors.analog[] (thermistor)": "sensors.analog[]",
    "tools[] <tool.retraction members>": "tools[].retraction",
}  # fmt: skip

GRIDS = ("move.compensation.liveGrid", "move.compensation.probeGrid")

# what differs from the list, and why
EXCEPTIONS = {
    "state.atxPower": (set(), "~: live in 3.3 only"),
    "state.nextTool": (set(), "~: live in 3.3 only"),
    "state.previousTool": (set(), "~: live in 3.3 only"),
    "network.interfaces[].type": (set(), "verbose on one kind of Ethernet board only"),
}

# not in the list, and why they are known all the same
FURTHER = {
    "sensors.filamentMonitors[].position": "live on rotating magnet and laser monitors",
    "sensors.filamentMonitors[].totalExtrusion": "live on rotating magnet and laser monitors",
}


@pytest.fixture(scope="module")
def listed(shared_dir):
    """Member path to ``(marks, whether the list says that they vary)``, of all versions."""
    text = (shared_dir / "reference" / "rrf-serial.md").read_text(encoding="utf-8")
    appendix = text[text.index("## Appendix A.") :]
    members = {}
    for heading, row in re.findall(r"^\* `([^`]+)`: (.+)$", appendix, re.MULTILINE):
        path = PATHS.get(heading, heading.replace("[0]", "[]").replace("[n]", "[]"))
        parents = GRIDS if path == "move.compensation.*Grid" else (path,)
        for word in row.split(", "):
            name, signs, vary = read(word)
            for parent in parents:
                whole = f"{parent}.{name}" if parent else name
                before = members.get(whole, (set(), False))
                members[whole] = (before[0] | signs, before[1] or vary)
    return members


# names that end in a letter which is a sign elsewhere
WHOLE_NAMES = {"customInfo", "inMacro"}


def read(word):
    """Return name, marks and ``~`` of a word such as ``modelv~`` or ``heaterso~@3.5``."""
    name = word.strip().partition("@")[0]
    vary = name.endswith("~")
    name = name.rstrip("~")
    signs = set()
    while name and name[-1] in "*!vo" and name not in WHOLE_NAMES:
        signs.add(MARK_OF[name[-1]])
        name = name[:-1]
    return name, signs, vary


def test_list_was_read(listed):
    assert len(listed) > 350
    assert listed["heat.heaters[].current"] == ({"live"}, False)
    assert listed["state.messageBox.mode"] == ({"important"}, True)
    assert listed["job.file.customInfo"] == (set(), False)


def test_every_listed_member_has_its_marks(listed):
    wrong = {}
    for path, (marks, _) in listed.items():
        expected = EXCEPTIONS[path][0] if path in EXCEPTIONS else marks
        if MARKS.get(path) != expected:
            wrong[path] = (MARKS.get(path), expected)
    assert not wrong


def test_every_known_member_is_listed(listed):
    assert set(MARKS) - set(listed) == set(FURTHER)


def test_exceptions_are_those_that_vary(listed):
    for path, (marks, reason) in EXCEPTIONS.items():
        assert listed[path][0] != marks, f"{path} needs no exception"
        assert listed[path][1] is reason.startswith("~"), path


def test_table_names_each_object_and_member_once():
    parents = [parent for parent, _ in TABLE]
    assert len(parents) == len(set(parents))
    for parent, members in TABLE:
        names = [word.rstrip("".join(SIGNS)) for word in members.split()]
        assert len(names) == len(set(names)), parent
        assert not parent or parent.rstrip("[]") in MARKS, f"{parent} has no row in its parent's"


def live_leaves(value, path=""):
    """Yield the pattern of each member of a live reply that is no object or array."""
    if isinstance(value, dict):
        for name, member in value.items():
            yield from live_leaves(member, f"{path}.{name}" if path else name)
    elif isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        for item in value:
            yield from live_leaves(item, path + "[]")
    elif value is not None or not path.endswith("[]"):
        yield path


RECORDED = ["om31_duet2_d99fn.json", "om360b1_duet2wifi_poll_fd99.json"]


def recorded(shared_dir, name):
    with open(shared_dir / "captures" / name, encoding="utf-8") as file:
        return json.load(file)["result"]


@pytest.mark.parametrize("name", RECORDED)
def test_every_member_of_a_recorded_live_reply_is_live(shared_dir, name):
    reply = recorded(shared_dir, name)
    leaves = set(live_leaves(reply))
    assert len(leaves) > 50
    not_live = {path for path in leaves if "live" not in MARKS.get(path, ())}
    assert not_live <= SINCE_THEN.get(name, set())


# live in 3.1, and in 3.3 to 3.6 no more
SINCE_THEN = {
    "om31_duet2_d99fn.json": {
        "state.atxPower",
        "state.nextTool",
        "state.previousTool",
    }
}


@pytest.mark.parametrize("name", RECORDED)
def test_recorded_live_reply_passes_the_f_flag_whole(shared_dir, name):
    reply = recorded(shared_dir, name)
    passed = answer(reply, "", "d99fn")["result"]
    if name in SINCE_THEN:
        for path in SINCE_THEN[name]:
            del reply[path.split(".")[0]][path.split(".")[1]]
    assert passed == reply
