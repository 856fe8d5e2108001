"""The sub-view Chart: what it draws, each control, and what lasts over a reload."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import wait_usable

from . import both_hosts, open_view, own_errors, part, show_view, styled, wait_text

MARKUP = "<img src=x onerror=alert(1)>"

RANGE = """() => {
    const axis = $("#rrfmodel_chart .rrfmodel-plot").data("plot").getAxes().xaxis;
    return [axis.min / 1000, axis.max / 1000];
}"""
"""Seconds at which the chart begins and ends."""

WIDTH = "() => $('#rrfmodel_chart .rrfmodel-plot').data('plot').width()"

WHEN_ANSWERED = "() => OctoPrint.plugins.rrfmodel.getStatus().then(() => true)"
"""Passes once the page has an answer to a question behind all that it has asked before."""

DRAWN = """() => $("#rrfmodel_chart .rrfmodel-plot").data("plot").getData().map((series) => ({
    points: series.datapoints.points.length / series.datapoints.pointsize,
    axis: series.yaxis.n,
    dashed: series.dashes.show
}))"""


BOARD = {"machine": "cartesian"}


@pytest.fixture(scope="module")
def server(server, board):
    """The server with the beginning of a history: every heater, and one of them has a target."""
    board.board.execute("M568 P0 S55 R33 A2", channel="http")

    def targets():
        told = {series["id"]: series["values"] for series in history(server)}
        return told.get("heater1.target", [])

    # the machines before are in it too
    server.wait_for(lambda: targets()[-3:] == [55, 55, 55], 60, "three rows of the history")
    return server


def history(server):
    """Return the series that the server keeps."""
    return server.get("/plugin/rrfmodel/history").json()["series"]


@pytest.fixture
def view(page, server):
    return drawn_view(page)


def drawn_view(page):
    region = show_view(page, "chart")
    wait_drawn(page, lambda drawn: drawn)
    return region


def wait_drawn(page, fits):
    """Return what is drawn once it is as wanted."""
    page.wait_for_function("() => $('#rrfmodel_chart .rrfmodel-plot').data('plot')")
    for _ in range(180):
        drawn = page.evaluate(DRAWN)
        if fits(drawn):
            return drawn
        page.wait_for_timeout(250)
    raise AssertionError(drawn)


def wait_range(page, fits):
    """Return begin and end of the chart once they are as wanted."""
    # rows come every two seconds, and are asked for every two
    for _ in range(450):
        seen = page.evaluate(RANGE)
        if fits(*seen):
            return seen
        page.wait_for_timeout(100)
    raise AssertionError(seen)


def held_range(page):
    """Return begin and end of a chart that is held, once what was under way is drawn."""
    page.evaluate(
        "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )
    return page.evaluate(RANGE)


def length(begin, end):
    return round(end - begin)


def row(view, key):
    return view.locator(f"[data-series={key}]")


@both_hosts
def test_every_heater_is_drawn_from_what_the_server_kept(page, server, view, page_errors):
    # temperatures and targets, all of before the page was opened
    kept = [series["what"] for series in history(server) if series["what"] != "pwm"]
    assert kept.count("current") >= 2 and kept.count("target") >= 1
    drawn = wait_drawn(page, lambda drawn: len(drawn) == len(kept))
    assert all(series["points"] >= 3 for series in drawn)
    assert [series["dashed"] for series in drawn].count(True) == kept.count("target")
    wait_text(part(row(view, "heater1"), "current"), "°C")
    wait_text(part(row(view, "heater1"), "target"), "55")
    expect(part(row(view, "heater0"), "name")).to_have_text("Bed")
    assert own_errors(page_errors) == []


def test_what_the_server_keeps_no_longer_is_not_shown(page, view):
    """Another machine's heaters are none of this one's."""
    shown = page.evaluate(
        """() => {
            const kept = OctoPrint.coreui.viewmodels.rrfModelViewModel.history;
            const like = kept.series.get("heater0.current");
            const other = {id: "heater9.current", number: 9, values: like.values.slice()};
            kept.series.set(other.id, Object.assign({}, like, other));
            kept.revision(kept.revision() + 1);
            // before the next answer of the server
            return new Promise((done) => setTimeout(() => done(
                document.querySelectorAll("[data-series=heater9]").length)));
        }"""
    )
    assert shown == 1
    expect(row(view, "heater9")).to_have_count(0)
    expect(row(view, "heater0")).to_have_count(1)


def test_goes_on_while_it_is_open(page, view):
    before = page.evaluate(RANGE)[1]
    begin, end = wait_range(page, lambda begin, end: end >= before + 4)
    assert before < end and begin < end


def test_chosen_series_are_kept(own_page, server):
    page = own_page
    view = open_view(page, server, ADMIN, "chart")
    # two temperatures and a target
    wait_drawn(page, lambda drawn: len(drawn) >= 3)
    power = part(row(view, "heater1"), "show-pwm")
    shown = len(page.evaluate(DRAWN))
    power.check()
    drawn = wait_drawn(page, lambda drawn: len(drawn) == shown + 1)
    assert 2 in [series["axis"] for series in drawn]
    part(row(view, "heater0"), "show-current").press("Space")
    wait_drawn(page, lambda drawn: len(drawn) == shown)
    page.reload()
    wait_usable(page)
    expect(part(row(view, "heater1"), "show-pwm")).to_be_checked()
    expect(part(row(view, "heater0"), "show-current")).not_to_be_checked()
    wait_drawn(page, lambda drawn: len(drawn) == shown)


@both_hosts
def test_spans_zoom_and_hold(page, view):
    for place, minutes in enumerate((5, 15, 30, 60)):
        part(view, "span").nth(place).click()
        wait_range(page, lambda *seen, wanted=minutes * 60: length(*seen) == wanted)
    part(view, "span").nth(0).click()
    part(view, "zoom-in").click()
    wait_range(page, lambda *seen: length(*seen) == 150)
    part(view, "zoom-out").press("Enter")
    wait_range(page, lambda *seen: length(*seen) == 300)
    hold = part(view, "hold")
    hold.click()
    expect(hold).to_have_attribute("aria-pressed", "true")
    held = held_range(page)
    part(view, "earlier").click()
    wait_range(page, lambda begin, end: end < held[1])
    part(view, "later").click()
    part(view, "later").click()
    expect(hold).to_have_attribute("aria-pressed", "false")
    wait_range(page, lambda begin, end: end > held[1])


def test_a_held_chart_stands_still(page, view):
    part(view, "hold").click()
    held = held_range(page)
    with page.expect_response(lambda response: "/history" in response.url):
        pass
    with page.expect_response(lambda response: "/history" in response.url):
        pass
    assert page.evaluate(RANGE) == held


def test_dragging_selects(page, view):
    part(view, "span").nth(0).click()
    begin, end = wait_range(page, lambda *seen: length(*seen) == 300)
    box = part(view, "plot").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.7, middle)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.9, middle, steps=4)
    page.mouse.up()
    seen = wait_range(page, lambda *seen: length(*seen) < 100)
    assert begin < seen[0] < seen[1] < end
    expect(part(view, "hold")).to_have_attribute("aria-pressed", "true")
    page.mouse.dblclick(box["x"] + box["width"] * 0.5, middle)
    expect(part(view, "hold")).to_have_attribute("aria-pressed", "false")


def test_values_under_the_pointer(page, view):
    wait_text(part(view, "time"), "Latest")
    box = part(view, "plot").bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.8, box["y"] + 50)
    wait_text(part(view, "time"), ":")
    page.mouse.move(0, 0)
    expect(part(view, "time")).to_contain_text("Latest")


def test_text_of_the_printer_is_text(view, board, page_errors):
    board.board.execute(f'M563 P0 S"{MARKUP}"', channel="http")
    wait_text(part(row(view, "heater1"), "name"), MARKUP)
    assert view.locator("img").count() == 0
    board.board.execute('M563 P0 S"E0"', channel="http")
    assert own_errors(page_errors) == []


def test_nothing_is_asked_for_while_it_is_hidden(page, view):
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.locator("[data-test=view-model]").click()
    expect(part(view, "plot")).to_be_hidden()
    # a question that was under way, and its answer
    page.evaluate(WHEN_ANSWERED)
    asked.clear()
    # by the page's own clock two of the chart's intervals
    page.evaluate("() => new Promise((done) => setTimeout(done, 4100))")
    assert [url for url in asked if "/history" in url] == []


def test_a_reader_may_use_it(reader_page, server, page_errors):
    view = drawn_view(reader_page)
    part(view, "span").nth(3).click()
    wait_range(reader_page, lambda *seen: length(*seen) == 3600)
    assert own_errors(page_errors) == []


def test_narrow(page, view):
    page.set_viewport_size({"width": 480, "height": 900})
    with styled(page, "#rrfmodel_chart { width: 440px; }"):
        part(view, "zoom-in").click()
        wait_range(page, lambda *seen: length(*seen) == 450)
        # the drawing follows the width a little later
        page.wait_for_function(
            """() => {
                const region = document.querySelector("#rrfmodel_chart");
                return region.scrollWidth <= region.clientWidth;
            }""",
        )
        assert page.evaluate(WIDTH) < 440
