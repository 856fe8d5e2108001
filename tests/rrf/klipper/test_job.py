"""``virtual_sdcard``, ``print_stats`` and their like: one row a field and case."""

import pytest

from octoprint_rrfmodel.rrf.klipper import Accumulated, Kept, World, names

from . import HOST, changed, get, host, whole, world

PATH = "0:/gcodes/sub/part.gcode"

PRINTING = {
    "state": {"status": "processing", "upTime": 500, "displayMessage": "Layer 3"},
    "job": {
        "build": {"currentObject": -1, "objects": []},
        "file": {"fileName": PATH, "size": 1000, "numLayers": 50},
        "filePosition": 250,
        "duration": 60,
        "pauseDuration": 10,
        "warmUpDuration": 20,
        "rawExtrusion": 12.5,
        "layer": 3,
        "lastFileName": None,
        "lastDuration": None,
    },
}
OVER = {
    "state": {"status": "idle", "upTime": 600, "displayMessage": ""},
    "job": {
        "build": None,
        "file": {"fileName": None, "size": 0, "numLayers": 0},
        "filePosition": 0,
        "duration": None,
        "pauseDuration": None,
        "rawExtrusion": None,
        "layer": None,
        "lastFileName": PATH,
        "lastDuration": 55,
    },
}

# object, field, what is changed of a print under way, the value
RUNNING = [
    ("virtual_sdcard", "progress", {}, 0.25),
    ("virtual_sdcard", "progress", {"job.filePosition": 2000}, 1.0),
    ("virtual_sdcard", "progress", {"job.file.size": 0}, 0.0),
    ("virtual_sdcard", "progress", {"job.filePosition": None}, 0.0),
    ("virtual_sdcard", "file_position", {}, 250),
    ("virtual_sdcard", "file_position", {"job.filePosition": None}, 0),
    ("virtual_sdcard", "file_path", {}, PATH),
    ("virtual_sdcard", "file_size", {}, 1000),
    ("virtual_sdcard", "is_active", {"job.file.fileName": None}, False),
    *(
        ("virtual_sdcard", "is_active", {"state.status": status}, is_active)
        for status, is_active in (
            ("processing", True),
            ("simulating", True),
            ("pausing", True),
            ("paused", False),
            ("resuming", True),
            ("cancelling", True),
            ("idle", False),
            # only within a job, and none was seen before
            ("busy", False),
            ("changingTool", False),
            ("halted", False),
        )
    ),
    ("print_stats", "filename", {}, "sub/part.gcode"),
    (
        "print_stats",
        "filename",
        {"job.file.fileName": "1:/other/part.gcode"},
        "1:/other/part.gcode",
    ),
    ("print_stats", "filename", {"job.file.fileName": None}, ""),
    ("print_stats", "total_duration", {}, 70),
    ("print_stats", "total_duration", {"job.pauseDuration": None}, 60),
    ("print_stats", "total_duration", {"job.duration": None}, 10),
    ("print_stats", "print_duration", {}, 60),
    ("print_stats", "print_duration", {"job.duration": None}, 0.0),
    ("print_stats", "filament_used", {}, 12.5),
    ("print_stats", "filament_used", {"job.rawExtrusion": None}, 0.0),
    ("print_stats", "message", {}, ""),
    ("print_stats", "info", {}, {"total_layer": 50, "current_layer": 3}),
    ("print_stats", "info", {"job.layer": None}, {"total_layer": 50, "current_layer": None}),
    ("print_stats", "info", {"job.file.numLayers": 0}, {"total_layer": None, "current_layer": 3}),
    *(
        ("print_stats", "state", {"state.status": status}, state)
        for status, state in (
            ("processing", "printing"),
            ("simulating", "printing"),
            ("resuming", "printing"),
            ("cancelling", "printing"),
            ("pausing", "paused"),
            ("paused", "paused"),
            ("idle", "standby"),
            ("busy", "standby"),
            ("halted", "standby"),
        )
    ),
    ("display_status", "message", {}, "Layer 3"),
    ("display_status", "message", {"state.displayMessage": None}, ""),
    ("display_status", "progress", {}, 0.25),
    *(
        ("pause_resume", "is_paused", {"state.status": status}, is_paused)
        for status, is_paused in (
            ("processing", False),
            ("pausing", True),
            ("paused", True),
            ("resuming", False),
            ("idle", False),
        )
    ),
]


@pytest.mark.parametrize(("name", "field", "changes", "value"), RUNNING)
def test_print_under_way(name, field, changes, value):
    assert get(world(changed(PRINTING, **changes)), name, field) == value


def after(*models, host=HOST):
    """Return the moment after these models were observed, a second apart; the last counts."""
    kept = Kept()
    for now, model in enumerate(models):
        kept.observe(model, host, float(now))
    return World(models[-1], host, kept.snapshot, float(len(models)))


# object, field, the value after the print above
ENDED = [
    ("virtual_sdcard", "progress", 0.25),
    ("virtual_sdcard", "is_active", False),
    ("virtual_sdcard", "file_position", 250),
    ("virtual_sdcard", "file_path", None),
    ("virtual_sdcard", "file_size", 1000),
    ("print_stats", "filename", "sub/part.gcode"),
    ("print_stats", "print_duration", 55),
    ("print_stats", "total_duration", 65),
    ("print_stats", "filament_used", 12.5),
    ("print_stats", "info", {"total_layer": None, "current_layer": None}),
    ("display_status", "progress", 0.25),
    ("display_status", "message", ""),
]


@pytest.mark.parametrize(("name", "field", "value"), ENDED)
def test_values_stay_after_the_end(name, field, value):
    assert get(after(PRINTING, OVER), name, field) == value


def test_values_stay_until_the_next_print():
    following = changed(
        PRINTING, **{"job.filePosition": 10, "job.duration": 1, "state.upTime": 700}
    )
    at = after(PRINTING, OVER, following)
    assert get(at, "virtual_sdcard", "progress") == 0.01
    assert get(at, "print_stats", "print_duration") == 1
    assert get(at, "print_stats", "state") == "printing"


def test_last_job_that_nobody_saw_is_known_by_its_name_and_duration():
    at = world(OVER)
    assert whole(at, "print_stats") == {
        "filename": "sub/part.gcode",
        "total_duration": 55,
        "print_duration": 55,
        "filament_used": 0.0,
        "state": "standby",
        "message": "",
        "info": {"total_layer": None, "current_layer": None},
    }


def test_selected_file_is_told_and_no_print():
    at = world(changed(OVER, **{"job.file.fileName": PATH, "job.file.size": 4000}))
    assert get(at, "virtual_sdcard", "file_path") == PATH
    assert get(at, "virtual_sdcard", "file_size") == 4000
    assert get(at, "virtual_sdcard", "is_active") is False
    assert get(at, "print_stats", "state") == "standby"
    assert get(at, "print_stats", "filename") == "sub/part.gcode"


def test_no_print_since_the_start():
    at = world({"state": {"status": "idle"}})
    assert whole(at, "virtual_sdcard") == {
        "progress": 0.0,
        "is_active": False,
        "file_position": 0,
        "file_path": None,
        "file_size": 0,
    }
    assert whole(at, "print_stats")["filename"] == ""
    assert whole(at, "print_stats")["state"] == "standby"


@pytest.mark.parametrize("status", ["busy", "changingTool", "off"])
def test_status_that_covers_a_job(status):
    at = after(PRINTING, changed(PRINTING, **{"state.status": status}))
    assert get(at, "print_stats", "state") == "printing"
    assert get(at, "virtual_sdcard", "is_active") is (status != "off")


def test_m408_tells_a_fraction_and_no_name():
    model = {
        "state": {"status": "processing"},
        "job": {"filePosition": 500, "duration": 30},
        "m408": {"fractionPrinted": 12.5},
    }
    at = world(model)
    assert get(at, "virtual_sdcard", "progress") == 0.125
    assert get(at, "virtual_sdcard", "is_active") is True
    assert get(at, "print_stats", "state") == "printing"
    model["m408"] = {"fraction_printed": 0.5}
    assert get(world(model), "virtual_sdcard", "progress") == 0.5
    model["m408"] = {"fractionPrinted": -1}
    assert get(world(model), "virtual_sdcard", "progress") == 0.0


# what the host has, and what is shown
HOST_JOBS = [
    pytest.param(
        {"position": 250, "print_time": 30.5},
        {
            "state": "printing",
            "print_duration": 30.5,
            "total_duration": 30.5,
            "progress": 0.25,
            "is_active": True,
            "file_position": 250,
            "file_path": "part.gcode",
            "message": "",
        },
        id="printing",
    ),
    pytest.param(
        {"position": 250, "state": "paused"},
        {"state": "paused", "is_active": False, "progress": 0.25},
        id="paused",
    ),
    pytest.param(
        {"size": None, "position": 250, "print_time": None},
        {"state": "printing", "progress": 0.0, "file_size": 0, "print_duration": 0.0},
        id="size unknown",
    ),
    pytest.param({"position": 5000}, {"progress": 1.0, "file_position": 5000}, id="beyond the end"),
    pytest.param(
        {"position": 1000, "state": "complete", "print_time": 99.0},
        {
            "state": "complete",
            "is_active": False,
            "progress": 1.0,
            "print_duration": 99.0,
            "file_path": None,
        },
        id="complete",
    ),
    pytest.param(
        {"position": 250, "state": "cancelled"},
        {"state": "standby", "is_active": False, "progress": 0.25, "message": ""},
        id="cancelled",
    ),
    pytest.param(
        {"position": 250, "state": "error", "message": "no answer"},
        {"state": "error", "is_active": False, "message": "no answer"},
        id="error",
    ),
]


@pytest.mark.parametrize("status", ["idle", "busy", "changingTool"])
@pytest.mark.parametrize(("job", "shown"), HOST_JOBS)
def test_hosts_print_is_shown_while_the_card_has_none(status, job, shown):
    model = changed(OVER, **{"state.status": status})
    at = world(model, host(job))
    fields = {**whole(at, "print_stats"), **whole(at, "virtual_sdcard")}
    assert {name: fields[name] for name in shown} == shown
    assert fields["filename"] == "part.gcode"
    assert fields["info"] == {"total_layer": None, "current_layer": None}
    assert get(at, "display_status", "progress") == fields["progress"]
    # all else is the printer's own
    assert get(at, "pause_resume", "is_paused") is False
    assert get(at, "idle_timeout", "state") == ("Ready" if status == "idle" else "Printing")


def test_print_from_the_card_goes_before_the_hosts():
    at = world(PRINTING, host({"position": 900}))
    assert get(at, "print_stats", "filename") == "sub/part.gcode"
    assert get(at, "virtual_sdcard", "progress") == 0.25


OBJECTS = [
    {"name": "square", "cancelled": False, "x": [80, 120], "y": [70, 110]},
    {"name": "no extent", "cancelled": True, "x": None, "y": [1, 2]},
    {"name": None, "cancelled": True, "x": [1.0, None], "y": [1, 2]},
    None,
]


def building(current=-1, objects=OBJECTS):
    return changed(PRINTING, **{"job.build": {"currentObject": current, "objects": objects}})


def test_exclude_object():
    assert whole(world(building()), "exclude_object") == {
        "objects": [
            {
                "name": "square",
                "center": [100.0, 90.0],
                "polygon": [[80, 70], [120, 70], [120, 110], [80, 110]],
            },
            {"name": "no extent"},
            {"name": "object2"},
            {"name": "object3"},
        ],
        "excluded_objects": ["no extent", "object2"],
        "current_object": None,
    }


@pytest.mark.parametrize(
    ("current", "name"), [(-1, None), (0, "square"), (2, "object2"), (9, None), (None, None)]
)
def test_current_object_by_its_name(current, name):
    assert get(world(building(current)), "exclude_object", "current_object") == name


def test_objects_without_a_print_are_none():
    at = world(OVER)
    assert whole(at, "exclude_object") == {
        "objects": [],
        "excluded_objects": [],
        "current_object": None,
    }


def test_no_objects_where_the_firmware_has_none():
    assert "exclude_object" not in names(world({"job": {"duration": 5}}))


def test_a_world_may_have_no_past():
    assert get(World(PRINTING, HOST, Accumulated(), 0.0), "print_stats", "state") == "printing"
