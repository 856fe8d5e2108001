"""What Moonraker's clients are told of a print file."""

import math

import pytest

from octoprint_rrfmodel.rrf.card.sliced import Sliced
from octoprint_rrfmodel.rrf.card.thumbnail import Thumbnail
from octoprint_rrfmodel.rrf.klipper.print_files import (
    of_analysis,
    of_card,
    picture_wanted,
    thumbnails,
)

SMALL, LARGE = Thumbnail("png", 32, 32, 10, 400), Thumbnail("jpeg", 300, 200, 500, 4000)


def test_pictures_lie_beside_their_file():
    told = thumbnails("a b.gcode", (LARGE, SMALL))
    assert told == [
        {"width": 32, "height": 32, "size": 300, "relative_path": ".thumbs/a b.gcode-32x32.png"},
        {
            "width": 300,
            "height": 200,
            "size": 3000,
            "relative_path": ".thumbs/a b.gcode-300x200.jpg",
        },
    ]
    for each, picture in zip(told, (SMALL, LARGE)):
        assert picture_wanted(f"x/{each['relative_path']}") == (
            "x/a b.gcode",
            picture.width,
            picture.height,
        )


@pytest.mark.parametrize(
    "path, wanted",
    [
        (".thumbs/a-1.gcode-3x4.png", ("a-1.gcode", 3, 4)),
        ("a/b/.thumbs/c.g-3x4.jpg", ("a/b/c.g", 3, 4)),
        (".thumbs/a.gcode.png", None),
        (".thumbs/b/a.gcode-3x4.png", None),
        ("thumbs/a.gcode-3x4.png", None),
        ("x.thumbs/a.gcode-3x4.png", None),
        (".thumbs/a.gcode-3x4.svg", None),
        ("a.gcode", None),
    ],
)
def test_which_picture_a_path_is_of(path, wanted):
    assert picture_wanted(path) == wanted


def test_of_octoprints_analysis():
    analysis = {
        "estimatedPrintTime": 61.5,
        "filament": {"tool0": {"length": 10.0}, "tool1": {"length": 2.5}, "tool2": None},
        "printingArea": {"maxZ": 8.0},
    }
    assert of_analysis(analysis, Sliced("Cura", "5.6", (SMALL,)), "a.gcode") == {
        "slicer": "Cura",
        "slicer_version": "5.6",
        "estimated_time": 61.5,
        "object_height": 8.0,
        "filament_total": 12.5,
        "thumbnails": thumbnails("a.gcode", (SMALL,)),
    }


@pytest.mark.parametrize(
    "analysis",
    [
        None,
        {},
        [],
        {"estimatedPrintTime": None, "filament": None, "printingArea": None},
        {"estimatedPrintTime": math.nan, "filament": {"tool0": {"length": math.inf}}},
        {"estimatedPrintTime": True, "filament": [1], "printingArea": {"maxZ": -1e999}},
    ],
)
def test_what_is_not_known_is_left_out(analysis):
    assert of_analysis(analysis, Sliced(), "a.gcode") == {}


def test_of_the_card():
    told = {
        "fileName": "0:/gcodes/a.gcode",
        "generatedBy": "PrusaSlicer 2.8.1 on 2024-11-04",
        "printTime": 100,
        "height": 12.5,
        "layerHeight": 0.2,
        "numLayers": 62,
        "filament": [100.5, 0.0],
    }
    assert of_card(told, (), "a.gcode") == {
        "slicer": "PrusaSlicer",
        "slicer_version": "2.8.1",
        "estimated_time": 100,
        "object_height": 12.5,
        "layer_height": 0.2,
        "layer_count": 62,
        "filament_total": 100.5,
    }
    assert of_card({"simulatedTime": 7, "printTime": 0}, (), "a") == {"estimated_time": 7}
    assert of_card({"filament": "x", "height": None}, (), "a") == {}
