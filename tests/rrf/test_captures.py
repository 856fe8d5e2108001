"""Everything recorded goes in, and comes out as it was."""

import json

import pytest

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.follow.poll408 import StatusPlan
from octoprint_rrfmodel.rrf.model.m409 import AXES_SHOWN
from octoprint_rrfmodel.rrf.model.merge import patched, paths, replaced
from octoprint_rrfmodel.rrf.model.store import ModelStore
from octoprint_rrfmodel.rrf.views.temperatures import temperatures
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.rrf.wire.m408 import M408Model
from octoprint_rrfmodel.rrf.wire.reply import (
    MalformedReply,
    ModelReply,
    StatusReply,
    decode,
    decode_page,
)

from .board import SEQS, Board, following, serve
from .independent import differing, overlaid, same
from .strategies import compact

# file -> how it is fed
ENVELOPE = "an answer to M409"
M408 = "an answer to M408"
FULL = "a whole model, on a board"
PATCH = "a patch of a whole model"
SESSION = "a whole model and patches"
CONSOLE = "a console, line by line"
FILE = "an answer to M36"
FOLDER = "a page of a folder's list"
CORRUPT = "a spoilt answer"

FILES = {
    "m408_1_s0_rrf30_duet2.json": M408,
    "m408_2_s1_rrf30_duet2.json": M408,
    "m408_3_s1_rrf30_duet2.json": M408,
    "m408_4_s2_rrf30_duet2.json": M408,
    "m408_5_s3_rrf30_duet2.json": M408,
    "m408_6_s4_rrf30_duet2.json": M408,
    "m408_7_s5_rrf30_duet2.json": M408,
    "m408_panelpi_01_I.json": M408,
    "m408_panelpi_04_P.json": M408,
    "m408_panelpi_06_fileinfo.json": FILE,
    "m408_panelpi_07_corrupt.json": CORRUPT,
    "m408_panelpi_08_fileinfo.json": FILE,
    "om31_duet2_d99fn.json": ENVELOPE,
    "om31_duet2_job_d99vn.json": ENVELOPE,
    "om31_duet2_move_d99vn.json": ENVELOPE,
    "om31_duet2_state_d99vn.json": ENVELOPE,
    "om342_mini5plus_full_idle.json": FULL,
    "om345_mb6hc_sbc_job_session.jsonl": SESSION,
    "om345_mini5plus_patch_01_boards.json": PATCH,
    "om345_mini5plus_patch_04_job.json": PATCH,
    "om345_mini5plus_patch_05_messages.json": PATCH,
    "om345_mini5plus_patch_06_move_coreXY.json": PATCH,
    "om34_virgin_dsf.json": FULL,
    "om35b1_mini5plus_full_idle.json": FULL,
    "om360b1_duet2wifi_full_idle.json": FULL,
    "om360b1_duet2wifi_poll_fd99.json": ENVELOPE,
    "om_dsf130_default.json": FULL,
    "rrconfig_2051_duetwifi_delta.json": M408,
    "rrfileinfo_31_duet2.json": FILE,
    "rrfilelist_30_duet2_macros.json": FOLDER,
    "rrstatus1_2051_duetwifi_delta.json": M408,
    "rrstatus1_30_duet2_idle.json": M408,
    "rrstatus1_30_duet2_messagebox.json": M408,
    "rrstatus3_30_duet2.json": M408,
    "serial_reppanel_rrf30_m408_usb.log": CONSOLE,
    "serial_serialom_rrf346_m115.log": CONSOLE,
}


def fed_as(*kinds):
    return pytest.mark.parametrize("name", [name for name, kind in FILES.items() if kind in kinds])


@pytest.fixture(scope="module")
def captures(shared_dir):
    return shared_dir / "captures"


def text_of(captures, name):
    with open(captures / name, encoding="utf-8", newline="") as file:
        return file.read()


def line_of(captures, name):
    """Return a reply on one line as the board sends it; some were spread over lines later."""
    text = text_of(captures, name).strip("\n")
    return compact(json.loads(text)) if "\n" in text else text


def model_of(captures, name):
    value = json.loads(text_of(captures, name))
    return value.get("result", value)


def test_every_recording_is_fed(captures):
    files = {path.name for path in captures.iterdir() if path.is_file()}
    assert files - {"README.md"} == set(FILES)


@fed_as(ENVELOPE)
@pytest.mark.parametrize("around", ["{}", "{}\n", "ok {}", "{}ok\n", "Warning: x{}"])
def test_model_reply_is_read_and_merged(captures, name, around):
    line = line_of(captures, name)
    found = find_reply(around.replace("{}", line))
    assert found.rest == around.replace("{}", "").strip()
    reply = decode(found.reply)
    envelope = json.loads(line)
    assert reply == ModelReply(envelope["key"], envelope["flags"], envelope["result"], 0)
    store = ModelStore()
    if reply.key:
        store.replace(reply.key, reply.result)
        assert same(store.model, {reply.key: envelope["result"]})
    else:
        store.patch(reply.result)
        assert same(store.model, envelope["result"])
    assert (
        store.replace(reply.key or "seqs", reply.result if reply.key else reply.result["seqs"])
        == {}
    )


@fed_as(FULL)
@pytest.mark.parametrize("room", [10240, 6656, 5000], ids=lambda room: f"{room} bytes")
def test_whole_model_is_followed_on_a_board(captures, name, room):
    """Also with so little room that keys have to be split; only root arrays must fit."""
    model = model_of(captures, name)
    model["seqs"] = {**dict.fromkeys(SEQS, 0), **model.get("seqs", {})}
    if not isinstance(model.get("state"), dict):
        model["state"] = {"upTime": 1}
    assert len(model["move"]["axes"]) < AXES_SHOWN
    board = Board(model, room=room)
    follower = following(board, most=600)
    assert same(follower.store.model, model)
    model["state"]["upTime"] = 10**6
    model["state"]["status"] = "processing"
    board.bump("state")
    serve(follower, board, 40)
    assert same(follower.store.model, board.model)


@fed_as(PATCH)
def test_patch_is_laid_over_a_whole_model(captures, name):
    base = model_of(captures, "om35b1_mini5plus_full_idle.json")
    patch = json.loads(text_of(captures, name))
    merged, changes = patched(base, patch)
    assert same(merged, overlaid(base, patch))
    assert sorted(paths(changes)) == sorted(differing(base, merged))
    assert patched(merged, patch)[1] is None


def test_session_is_what_a_plain_merge_gives(captures):
    lines = text_of(captures, "om345_mb6hc_sbc_job_session.jsonl").splitlines()
    assert len(lines) == 301
    model = json.loads(lines[0])
    plain = json.loads(lines[0])
    statuses = []
    for line in lines[1:]:
        before = model
        model, changes = patched(model, json.loads(line))
        plain = overlaid(plain, json.loads(line))
        assert same(model, plain)
        assert sorted(paths(changes)) == sorted(differing(before, model))
        status = model["state"]["status"]
        if statuses[-1:] != [status]:
            statuses.append(status)
    assert statuses == ["idle", "processing", "paused", "busy", "idle"]
    assert replaced(model, plain)[1] is None


@fed_as(M408)
def test_m408_reply_is_read_and_nothing_of_it_lost(captures, name):
    line = line_of(captures, name)
    found = find_reply(line + "ok\n")
    assert found == (line, "ok", None)
    fields = json.loads(line)
    assert decode(found.reply) == StatusReply(fields)
    model = M408Model().take(decode(found.reply).fields)
    known = set(leaves(model))
    lost = {leaf for leaf in leaves(fields) if leaf not in known and leaf not in CONVERTED}
    assert not lost


# a probe's value as text, and a reading that is none
CONVERTED = {"1000", 2000.0}


def leaves(value):
    """Yield texts and numbers that are as good as names; percents and letters are converted."""
    if isinstance(value, (dict, list)):
        for item in value.values() if isinstance(value, dict) else value:
            yield from leaves(item)
    elif isinstance(value, str) and len(value) > 3:
        yield value.lower()
    elif isinstance(value, (int, float)) and value > 40 and value % 10:
        yield float(value)


STATES = {
    "m408_1_s0_rrf30_duet2.json": ("off", [21.4, 21.3]),
    "m408_2_s1_rrf30_duet2.json": ("off", [21.6, 21.3]),
    "m408_3_s1_rrf30_duet2.json": ("off", [21.4, 21.2]),
    "m408_5_s3_rrf30_duet2.json": ("off", [21.5, 21.2]),
    "m408_panelpi_01_I.json": ("idle", [23.1, 23.5, *[2000.0] * 6]),
    "m408_panelpi_04_P.json": ("processing", [190.0, 70.0, *[2000.0] * 6]),
    "rrstatus1_30_duet2_messagebox.json": ("busy", [20.6, 20.7]),
    "rrstatus3_30_duet2.json": ("idle", [20.5, 20.3]),
}


@pytest.mark.parametrize("name", STATES)
def test_m408_reply_tells_state_and_temperatures(captures, name):
    model = M408Model().take(json.loads(line_of(captures, name)))
    state, readings = STATES[name]
    assert model["state"]["status"] == state
    assert [heater["current"] for heater in model["heat"]["heaters"]] == readings


def test_bed_of_a_recorded_print_is_the_second_heater(captures):
    model = M408Model().take(json.loads(line_of(captures, "m408_panelpi_04_P.json")))
    assert model["heat"]["bedHeaters"] == [1]
    shown = temperatures(model)
    assert shown.bed == (70.0, 70.0)
    assert shown.tools == {0: (190.0, 190.0)}
    assert model["job"]["layer"] == 36
    assert model["job"]["timesLeft"] == {"file": 626.4, "filament": 421.7, "layer": 452.0}


def test_recorded_message_box_is_one_of_the_model(captures):
    model = M408Model().take(json.loads(line_of(captures, "rrstatus1_30_duet2_messagebox.json")))
    box = model["state"]["messageBox"]
    assert (box["mode"], box["seq"], box["timeout"], box["axisControls"]) == (2, 1, 0, 4)
    assert box["title"] == "Manual bed probing"
    model = M408Model().take(json.loads(line_of(captures, "rrstatus1_30_duet2_idle.json")))
    assert model["state"]["messageBox"] is None


def test_forms_of_one_board_make_one_model(captures):
    plan = StatusPlan()
    store = ModelStore()
    files = {2: 4, 3: 5, 5: 7, 4: 6, 1: 2, 0: 1}
    for form, number in files.items():
        assert plan.next_request().form == form
        name = next(name for name in FILES if name.startswith(f"m408_{number}_"))
        for update in plan.take(StatusReply(json.loads(line_of(captures, name)))):
            store.replace(update.path, update.value)
    assert plan.ready
    axes = store.model["move"]["axes"]
    assert [axis["letter"] for axis in axes] == ["X", "Y", "Z"]
    assert [axis["max"] for axis in axes] == [326.0, 326.0, 311.7]
    assert [axis["speed"] for axis in axes] == [9000.0, 9000.0, 3600.0]
    assert store.model["tools"][0]["name"] == "PrimeExtruder"
    assert [fan["requestedValue"] for fan in store.model["fans"]] == [0.0, 0.3, 0.0]


@fed_as(FOLDER)
def test_recorded_list_is_read(captures, name):
    line = line_of(captures, name)
    assert find_reply(line + "\n") == (line, "", None)
    page = decode_page(line)
    assert (page.folder, page.first, page.next, page.error) == ("0:/macros", 0, 0, 0)
    assert page.entries[0] == ("01-Test_IR_PD_Homing", False, 641, "2019-03-12T11:49:22")
    assert len(page.entries) == len(json.loads(line)["files"])


@fed_as(FILE)
def test_answer_about_a_file_is_known_as_one(captures, name):
    line = line_of(captures, name)
    found = find_reply(line + "\n")
    assert found == (line, "", None)
    # others than the plugin ask, too
    assert found.is_of_a_file


def test_row_24_recorded_job_has_its_name_and_size(captures):
    model = M408Model()
    model.take(json.loads(line_of(captures, "m408_panelpi_04_P.json")))
    job = model.take_file(json.loads(line_of(captures, "m408_panelpi_08_fileinfo.json")))["job"]
    assert (job["file"]["fileName"], job["file"]["size"]) == ("current file", 35498176)
    # the status of 2.x has no position of its own
    assert job["filePosition"] == round(0.282 * 35498176)


@fed_as(CORRUPT)
@pytest.mark.parametrize("behind", ["", "ok", "Warning: x"])
def test_spoilt_reply_is_counted_and_harmless(captures, name, behind):
    line = line_of(captures, name)
    found = find_reply(line + behind + "\n")
    assert found == (line, behind, None)
    with pytest.raises(MalformedReply):
        decode(found.reply)
    follower = Follower()
    follower.not_supported()
    good = json.loads(line_of(captures, "m408_panelpi_04_P.json"))
    follower.take(compact(good))
    before = follower.store.model
    with pytest.raises(MalformedReply):
        follower.take(found.reply)
    assert follower.store.model is before
    assert follower.counters["malformed"] == 1
    good["time"] += 1
    assert follower.take(compact(good)).changes


def test_console_of_m408_is_read_line_by_line(captures):
    model = M408Model()
    forms = []
    for line in text_of(captures, "serial_reppanel_rrf30_m408_usb.log").splitlines(keepends=True):
        found = find_reply(line)
        if found is None:
            assert not line.startswith('{"')
            continue
        assert found.rest == ""
        fields = decode(found.reply).fields
        forms.append("status" if "status" in fields else "config")
        result = model.take(fields)
    assert forms == ["status"] * 6 + ["config"]
    assert result["state"]["status"] == "off"
    assert result["move"]["axes"][2]["max"] == 311.7


def test_console_without_replies_has_none(captures):
    lines = text_of(captures, "serial_serialom_rrf346_m115.log").splitlines(keepends=True)
    assert len(lines) >= 3
    assert [find_reply(line) for line in lines] == [None] * len(lines)
