"""What the page says of a machine at work: one statement everywhere, and nothing old as if now."""

import re

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import SECONDS, both_hosts, heat_row, own_errors, part, show_view, wait_text

BOARD = {"machine": "idex"}

PLACES = ("#sidebar_plugin_rrfmodel [data-test=status]", "[data-test=strip-state]")
"""Where the state stands whichever view is open."""

CONTRADICTIONS = ("does not answer", "a temperature", "long command")

WATCH = """(places) => {
    window.said = Object.fromEntries(places.map((place) => [place, []]));
    const look = () => places.forEach((place) => {
        const text = document.querySelector(place).innerText;
        const said = window.said[place];
        if (said[said.length - 1] !== text) said.push(text);
    });
    look();
    window.watching = new MutationObserver(look);
    const how = {childList: true, subtree: true, characterData: true};
    window.watching.observe(document.body, how);
}"""

STATE = re.compile(r"/plugin/rrfmodel/status\b")

OLD = re.compile(r"\brrfmodel-old\b")
AGE = re.compile(r"Value of \d+ s ago")


@pytest.fixture
def view(page, server, board):
    yield show_view(page, "machine")
    board.board.speed = 300
    helpers.wait_ready(server)
    server.wait_for(lambda: helpers.status(server)["doing"] is None, SECONDS, "a free line")
    board.board.speed = 1


def is_bold(locator):
    return int(locator.evaluate("element => getComputedStyle(element).fontWeight")) > 400


def axis(view, letter):
    return view.locator(f"[data-test=axis-row][data-axis={letter}]")


@both_hosts
def test_homing_is_said_from_its_beginning_to_its_end(page, view, server, page_errors):
    for place in PLACES:
        expect(page.locator(place)).to_have_text("Idle")
    page.evaluate(WATCH, list(PLACES))
    part(view, "home-all").click()
    for place in PLACES:
        expect(page.locator(place)).to_have_text(re.compile(r"Homing, [5-9] s"))
    position = part(axis(view, "X"), "position")
    expect(position).to_have_class(OLD)
    expect(position).to_have_attribute("title", AGE)
    text = page.locator("body").inner_text()
    assert not [words for words in CONTRADICTIONS if words in text]
    for place in PLACES:
        expect(page.locator(place)).to_have_text("Idle")
    expect(position).not_to_have_class(OLD)
    for place, said in page.evaluate("window.watching.disconnect(), window.said").items():
        # nothing but that, and never back to the old state in between
        assert said[0] == said[-1] == "Idle", (place, said)
        between = [text for text in said[1:-1] if not text.startswith("Homing")]
        assert set(between) <= {"Busy"}, (place, said)
    assert own_errors(page_errors) == []


def test_a_message_that_an_answer_overtakes_is_not_lost(page, view, server, page_errors):
    """On a busy machine an answer overtakes a message that was sent before it."""

    def from_later(route):
        response = route.fetch()
        told = response.json()
        route.fulfill(response=response, json={**told, "at": told["at"] + 3})

    helpers.wait_ready(server)
    page.route(STATE, from_later)
    try:
        # the page asks for the state behind each of its commands
        part(view, "speed-more").click()
        wait_text(part(view, "speed-factor"), "105 %")
        part(view, "speed-less").click()
        wait_text(part(view, "speed-factor"), "100 %")
    finally:
        page.unroute_all(behavior="ignoreErrors")
    assert own_errors(page_errors) == []


def test_temperatures_that_the_line_tells_are_news(page, view, server, board):
    bed = heat_row(view, 0)
    current = part(bed, "current")
    begun = float(current.inner_text())
    server.commands("M190 S45")
    expect(page.locator(PLACES[1])).to_have_text(re.compile(r"Heating the bed, \d+ s"))
    server.wait_for(lambda: helpers.status(server)["stale"], SECONDS, "an old model")
    server.wait_for(lambda: float(current.inner_text()) > begun + 1, SECONDS, "a warmer bed")
    # of what the line tells nothing is old
    expect(current).not_to_have_class(OLD)
    expect(current).to_have_class(re.compile("rrfmodel-fresh"))
    assert is_bold(current)
    # and the rest is
    expect(part(axis(view, "X"), "position")).to_have_class(OLD)
    server.commands("M140 S0")


LOOK = """([more, places]) => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const before = core.status();
    core.fromStatus(Object.assign({}, before, more));
    const seen = places.map(function (place) {
        const element = document.querySelector(place);
        const weight = Number(getComputedStyle(element).fontWeight);
        return [element.classList.contains("rrfmodel-old"), weight > 400, element.title];
    });
    core.fromStatus(before);
    return seen;
}"""

BESIDE = "#sidebar_plugin_rrfmodel [data-test=heater]:nth-child({}) [data-test=current]"
SLOT = "#rrfmodel_machine [data-test=heat-row][data-heater='0'] [data-test=current]"
POSITION = "#rrfmodel_machine [data-test=axis-row][data-axis=X] [data-test={}]"
FAN = "#rrfmodel_machine [data-test=fan] .rrfmodel-value"


def seen(page, places, **more):
    """Return of each place whether it is old, bold, and its title, were that the state.

    Where nothing is said of the age of a key, that of the whole counts.
    """
    return page.evaluate(LOOK, [{"ages": {}, **more}, places])


def test_a_temperature_that_nobody_tells_is_told_as_old(page, view, server):
    (bed,) = {helpers.value(server, "heat.bedHeaters[0]")}
    places = [SLOT, BESIDE.format(1)]
    doing = {"command": "G4 S60", "what": "waiting", "since": 34}
    old = {"stale": True, "age": 34, "doing": doing, "blocked": "long_command"}
    for found in seen(page, places, **old, heater_ages={}):
        assert found == [True, False, "Value of 34 s ago"]
    # the bed's own is told, that of the first tool isn't
    told = seen(page, places, **old, heater_ages={str(bed): 1})
    assert told == [[False, True, ""], [True, False, "Value of 34 s ago"]]
    # the last line that has told of it is long ago
    told = seen(page, places[:1], **old, heater_ages={str(bed): 25})
    assert told == [[True, False, "Value of 25 s ago"]]
    # by key where the server tells that
    told = seen(page, places[:1], **old, heater_ages={}, ages={"heat": 1})
    assert told == [[False, True, ""]]
    told = seen(page, places[:1], stale=False, age=1, heater_ages={}, ages={"heat": 100})
    assert told == [[True, False, "Value of 100 s ago"]]
    assert [found[:2] for found in seen(page, places)] == [[False, True], [False, False]]


def test_so_is_a_position_and_whatever_else_is_bold(page, view):
    doing = {"command": "G28", "what": "homing", "since": 4}
    positions = [POSITION.format("position")]
    # also before three polls are missing
    for found in seen(page, positions, stale=False, age=3, doing=doing):
        assert found == [True, False, "Value of 3 s ago"]
    assert [bold for _, bold, _ in seen(page, [FAN], stale=True, age=34)] == [False]
    assert [bold for _, bold, _ in seen(page, [FAN])] == [True]


PLACED = """async () => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const tell = core.onDataUpdaterPluginMessage;
    // no news of the machine come in between
    core.onDataUpdaterPluginMessage = () => undefined;
    const move = core.latest.move;
    const axes = move.axes.slice();
    axes[0] = Object.assign({}, axes[0], {userPosition: 12.345, machinePosition: -10});
    const told = (value) =>
        tell("rrfmodel", {type: "model", changed: {move: value}, status: core.status()});
    told(Object.assign({}, move, {axes: axes}));
    await new Promise((done) => setTimeout(done));
    const seen = ["[data-test=axis]", "[data-test=axis-row] [data-test=position]"].map(
        (place) => document.querySelector(place).innerText
    );
    told(move);
    core.onDataUpdaterPluginMessage = tell;
    return seen;
}"""


def test_sidebar_and_tab_agree_on_a_position(page, view):
    """Both are the user's, of workplace and tool."""
    beside, in_tab = page.evaluate(PLACED)
    assert beside.split() == ["X", *in_tab.split()]
    assert in_tab in ("12.35", "12.34")


ASKS = """([more, box, places]) => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const before = core.status();
    const state = core.latest.state;
    const tell = (status, value) =>
        core.onDataUpdaterPluginMessage("rrfmodel", {
            type: "model",
            changed: {state: Object.assign({}, state, {messageBox: value})},
            status: status
        });
    tell(Object.assign({}, before, more), box);
    const said = places.map((place) => document.querySelector(place).textContent);
    const beside = document.querySelector("#sidebar_plugin_rrfmodel").innerText;
    tell(before, state.messageBox);
    return [said, beside];
}"""

UNANSWERABLE = {"code": "message_box_unanswerable", "text": "", "level": "warning"}


@pytest.mark.parametrize(
    ("warnings", "box"), [([UNANSWERABLE], None), ([], {"mode": 3, "seq": 1_000_000})]
)
def test_a_macro_that_asks_is_one_statement(page, view, warnings, box):
    doing = {"command": 'M98 P"0:/macros/ask.g"', "what": "macro", "since": 20}
    more = {"stale": True, "age": 20, "blocked": "heating", "doing": doing, "warnings": warnings}
    said, beside = page.evaluate(ASKS, [more, box, list(PLACES)])
    assert said == ["Waits for an answer"] * len(PLACES)
    assert not [words for words in CONTRADICTIONS if words in beside]


def test_a_shared_heater_is_the_tools_that_is_selected(page, view, server, board):
    board.board.execute("M568 P0 S120 R90\nT0 P0", channel="http")
    helpers.wait_value(server, "state.currentTool", 0, SECONDS)
    heater = helpers.value(server, "tools[0].heaters[0]")
    own, copy = (heat_row(view, heater, tool) for tool in (0, 2))
    expect(part(own, "tool-active")).to_have_attribute("aria-pressed", "true")
    assert helpers.value(server, "tools[2].state") == "off"
    expect(part(copy, "tool-active")).to_have_attribute("aria-pressed", "false")
    expect(part(copy, "tool-off")).to_have_attribute("aria-pressed", "true")
    # each heater once
    names = page.locator("#sidebar_plugin_rrfmodel [data-test=heater] td:first-child")
    assert not [name for name in names.all_inner_texts() if "Copy" in name]
    board.board.execute("M568 P0 S0 R0 A0\nT-1 P0", channel="http")
    helpers.wait_value(server, "state.currentTool", -1, SECONDS)


WORDS = [
    ("G28 X", "homing", "Homing, 6 s"),
    ("M109 S200", "heating", "Heating the tool, 6 s"),
    ("M191 S40", "heating", "Heating the chamber, 6 s"),
    ("M116", "heating", "Waiting for temperatures, 6 s"),
    ("G29", "probing", "Probing, 6 s"),
    ("G32", "calibrating", "Levelling or calibrating, 6 s"),
    ("T3", "tool_change", "Changing to T3, 6 s"),
    ("T-1", "tool_change", "Putting the tool away, 6 s"),
    ('M98 P"0:/macros/a/purge.g"', "macro", "Macro purge.g, 6 s"),
    ('M98 P"<b>""x"".g"', "macro", 'Macro <b>"x".g, 6 s'),
    ("M501", "macro", "Running a macro, 6 s"),
    ('M701 S"PLA"', "filament", "Loading the filament, 6 s"),
    ("M25", "pausing", "Pausing, 6 s"),
    ("M24", "resuming", "Resuming, 6 s"),
    ("M0", "cancelling", "Cancelling, 6 s"),
    ("M291 S3", "answer", "Waits for an answer"),
    ("M500", "saving", "Saving, 6 s"),
    ("M150", "other", "Busy, 6 s"),
    ("M150", "a new one", "Busy, 6 s"),
]
"""Commands that the line waits for, what the server calls it, and what people read."""


def test_what_is_done_in_words(page, view):
    found = page.evaluate(
        """([rows, places]) => {
            const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
            const before = core.status();
            // no news of the machine come in between
            return rows.map(([command, what]) => {
                const doing = {command, what, since: 6.2};
                const more = {stale: true, blocked: "long_command", doing};
                core.fromStatus(Object.assign({}, before, more));
                return places.map((place) => document.querySelector(place).textContent);
            });
        }""",
        [[row[:2] for row in WORDS], list(PLACES)],
    )
    assert found == [[said] * len(PLACES) for _, _, said in WORDS]
