"""The bed as a picture in the sub-view Machine: mesh, objects, head, what is calibrated."""

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import SECONDS, home, own_errors, part, show_view, unfold, wait_text
from .test_everyone import serious

BOARD = {"machine": "corexy", "speed": 60}

HEIGHTMAP = {
    "file": "0:/sys/heightmap.csv",
    "axes": ["X", "Y"],
    "min": [20, 20],
    "spacing": [40, 30],
    "count": [3, 2],
    "radius": -1,
    "points": [[-0.08, 0, 0.04], [0.01, None, 0.02]],
    "deviation": 0.043,
    "mean": -0.012,
    "least": -0.08,
    "most": 0.04,
}

TELL = """(changed) => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const latest = core.latest;
    const merged = _.mapValues(changed, (value, key) => Object.assign({}, latest[key], value));
    core.onDataUpdaterPluginMessage("rrfmodel",
        {type: "model", changed: merged, status: core.status()});
}"""

DELTA = {
    "name": "delta",
    "printRadius": 120.0,
    "xTilt": 0.00012,
    "yTilt": -0.00031,
    "towers": [
        {"xPos": -127.1, "yPos": -73.4, "endstopAdjustment": 0.112, "angleCorrection": 0.5},
        {"xPos": 127.1, "yPos": -73.4, "endstopAdjustment": -0.24, "angleCorrection": 0.0},
        {"xPos": 0.0, "yPos": 146.7, "endstopAdjustment": 0.128, "angleCorrection": 0.0},
    ],
}


@pytest.fixture
def bed(page):
    show_view(page, "machine")
    found = unfold(page.locator("#rrfmodel_machine_parts"), "bed")
    expect(part(found, "bed-map")).to_be_visible()
    return found


def number(locator, name):
    return float(locator.get_attribute(name))


def dots(bed):
    return (part(bed, "mesh-dots").get_attribute("d") or "").count("M")


def change(board, key, change_it):
    with board.board.lock:
        change_it(board.board.data[key])
        board.board.bump(key)


def test_grid_head_and_how_even_it_is(bed, server, board, page_errors):
    home(server, board)
    # the next probing's, paler
    wait_text(part(bed, "grid"), "next probing: 11 × 10 points, every 20 × 20 mm")
    assert dots(bed) == 110
    expect(part(bed, "profile")).to_have_count(0)
    board.board.execute("G1 X120 Y80 F12000", channel="http")
    helpers.wait_value(server, "move.axes[0].machinePosition", 120, SECONDS)
    expect(part(bed, "head")).to_have_attribute("cx", "120")
    expect(part(bed, "head")).to_have_attribute("cy", "-80")
    board.board.execute("G29 S1", channel="http")
    expect(part(bed, "grid")).to_have_text("11 × 10 points, every 20 × 20 mm")
    expect(part(bed, "reach")).to_have_text("±0.1 mm")
    # mean -0.012 and deviation 0.043 of a picture that reaches from -1 to 1
    band = part(bed, "profile").locator("rect")
    assert number(band, "y") == pytest.approx(-0.31)
    assert number(band, "height") == pytest.approx(0.86)
    board.board.execute("G29 S2", channel="http")
    expect(part(bed, "profile")).to_have_count(0)
    assert own_errors(page_errors) == []


def test_objects_of_the_print_lie_on_it(page, bed, page_errors):
    objects = [{"name": "<b>left", "x": [80, 120], "y": [60, 90], "cancelled": False}]
    page.evaluate(TELL, {"job": {"build": {"currentObject": 0, "objects": objects}}})
    shape = part(bed, "bed-object").locator("rect")
    expect(shape).to_have_count(1)
    assert [number(shape, name) for name in ("x", "y", "width", "height")] == [80, -90, 40, 30]
    assert shape.locator("title").text_content() == "<b>left"
    page.evaluate(TELL, {"job": {"build": None}})
    expect(shape).to_have_count(0)
    assert own_errors(page_errors) == []


def test_screws_of_the_bed(bed, board):
    screws = [0.05, -0.12, 0.0]

    def correct(move):
        move["kinematics"]["tiltCorrection"]["lastCorrections"] = screws
        move["calibration"].update(
            numFactors=3,
            initial={"deviation": 0.2, "mean": 0.1},
            final={"deviation": 0.02, "mean": 0.0},
        )

    change(board, "move", correct)
    expect(part(bed, "correction")).to_have_text(["+0.050 mm", "−0.120 mm", "+0.000 mm"])
    expect(part(bed, "mark")).to_have_text(["1 +0.050 mm", "2 −0.120 mm", "3 +0.000 mm"])
    # those that stand beside the bed have their room
    left, _, width, _ = map(float, part(bed, "bed-map").get_attribute("viewBox").split())
    assert left < -40
    assert left + width > 390
    expect(part(bed, "calibration")).to_have_text(
        "3 factors, deviation 0.020 mm, before it 0.200 mm"
    )


def test_a_delta_has_a_round_bed_and_its_towers(page, bed, page_errors):
    page.evaluate(TELL, {"move": {"kinematics": DELTA}})
    expect(part(bed, "mark")).to_have_text(["X +0.112 mm", "Y −0.240 mm", "Z +0.128 mm"])
    expect(part(bed, "correction").first).to_have_text("+0.112 mm, +0.50 °")
    expect(part(bed, "tilt")).to_have_text("X +0.012 %, Y −0.031 %")
    assert "A120" in bed.locator(".rrfmodel-map-bed").get_attribute("d")
    assert own_errors(page_errors) == []


def test_points_that_are_known_have_colours_and_a_profile(page, bed, server, board, page_errors):
    board.board.execute("G29 S1", channel="http")
    expect(part(bed, "profile")).to_be_visible()
    page.evaluate(
        "(map) => OctoPrint.coreui.viewmodels.rrfModelViewModel.heightmap(map)", HEIGHTMAP
    )
    cells = part(bed, "mesh-cell")
    expect(cells).to_have_count(5)
    assert [number(cells.first, name) for name in ("x", "y", "width", "height")] == [0, -35, 40, 30]
    assert cells.first.get_attribute("fill") == "rgba(47, 134, 214, 0.80)"
    assert cells.nth(2).get_attribute("fill") == "rgba(217, 83, 79, 0.40)"
    assert cells.first.locator("title").text_content() == "X 20, Y 20: −0.080 mm"
    assert dots(bed) == 0
    wait_text(part(bed, "grid"), "3 × 2 points, every 40 × 30 mm")
    lines = part(bed, "profile").locator(".rrfmodel-profile-line").get_attribute("d")
    assert lines.count("M") == 2
    assert serious(page) == []
    expect(part(bed, "profile").locator("rect")).to_have_count(0)
    # one over other axes isn't seen from above
    page.evaluate(
        "(map) => OctoPrint.coreui.viewmodels.rrfModelViewModel.heightmap(map)",
        {**HEIGHTMAP, "axes": ["X", "Z"]},
    )
    expect(cells).to_have_count(0)
    assert dots(bed) == 110
    # without a mesh in use there is none to look at
    board.board.execute("G29 S2", channel="http")
    expect(cells).to_have_count(0)
    page.evaluate("() => OctoPrint.coreui.viewmodels.rrfModelViewModel.heightmap(null)")
    assert own_errors(page_errors) == []


NETWORK = """() => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const own = core.fromStatus;
    core.fromStatus = (status) => own(Object.assign({}, status, {link: "network"}));
    core.fromStatus(core.status());
    window.overNetwork = () => { core.fromStatus = own; };
}"""
"""Has the page take each state for that of a board on the network, until ``overNetwork()``."""


def test_they_are_asked_for_where_the_card_can_be_read(page, bed, board):
    asked = []

    def answer(route):
        asked.append(route.request.url)
        route.fulfill(json=HEIGHTMAP)

    page.route("**/plugin/rrfmodel/heightmap", answer)
    board.board.execute("G29 S1", channel="http")
    expect(part(bed, "profile")).to_be_visible()
    assert asked == []
    page.evaluate(NETWORK)
    expect(part(bed, "mesh-cell")).to_have_count(5)
    page.unroute("**/plugin/rrfmodel/heightmap")
    board.board.execute("G29 S2", channel="http")
    expect(part(bed, "mesh-cell")).to_have_count(0)
    page.evaluate("() => window.overNetwork()")
