"""Message boxes on the page: each mode answered, closed elsewhere, for those who may only look."""

import re

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import open_octoprint

from .. import helpers
from . import board_value, both_hosts, home, own_errors, part, wait_board, wait_text

MARKUP = "<img src=x onerror=alert(1)>"


BOARD = {"machine": "cartesian"}


@pytest.fixture(autouse=True)
def _no_box(board):
    yield
    board.board.speed = 1
    while board_value(board, "state.messageBox") is not None:
        board.board.execute("M292 P1", channel="telnet")


@pytest.fixture
def box(page):
    return page.locator("#rrfmodel_box_dialog")


def ask(board, parameters, channel="http"):
    board.board.execute(f"M291 {parameters}", channel=channel)


def is_closed(server, board, box):
    expect(box).to_be_hidden()
    server.wait_for(
        lambda: board_value(board, "state.messageBox") is None, 45, "the board to close its box"
    )
    return True


@both_hosts
@pytest.mark.parametrize("mode", [1, 2, 3])
def test_is_shown_and_closed(box, server, board, page_errors, mode):
    ask(board, f'P"Is it {mode}?" R"Title" S{mode} T0')
    wait_text(part(box, "box-message"), f"Is it {mode}?")
    wait_text(part(box, "box-title"), "Title")
    expect(part(box, "box-cancel")).to_be_visible(visible=mode == 3)
    part(box, "box-ok").click()
    assert is_closed(server, board, box)
    assert own_errors(page_errors) == []


def test_mode_0_has_no_buttons_and_goes_by_itself(box, server, board):
    ask(board, 'P"Wait" S0 T300')
    wait_text(part(box, "box-message"), "Wait")
    expect(part(box, "box-time")).to_have_text(re.compile(r"^Closes by itself in \d+ s$"))
    expect(box.locator("button:visible")).to_have_text(["Later"])
    assert 1 <= int(re.findall(r"\d+", part(box, "box-time").inner_text())[0]) <= 300
    # its time is nearly over at once
    board.board.speed = 300
    expect(box).to_be_hidden()
    assert is_closed(server, board, box)


def test_cancel_by_escape(page, box, server, board):
    ask(board, 'P"Sure?" S3')
    wait_text(part(box, "box-message"), "Sure?")
    expect(part(box, "box-ok")).to_be_enabled()
    page.keyboard.press("Escape")
    assert is_closed(server, board, box)


@pytest.mark.parametrize("key", ["Escape", "Enter"])
def test_key_for_something_else_answers_nothing(page, box, server, board, key):
    page.evaluate(
        """(key) => $("#rrfmodel_box_dialog").one("shown", () => {
            const event = new KeyboardEvent("keydown", {key: key, bubbles: true});
            document.activeElement.dispatchEvent(event);
            window.wasPressed = true;
            if (key === "Enter") $("#rrfmodel_box_dialog form").trigger("submit");
        })""",
        key,
    )
    ask(board, 'P"Is the bed clear?" S3')
    wait_text(part(box, "box-message"), "Is the bed clear?")
    expect(part(box, "box-ok")).to_be_enabled()
    helpers.wait_polls(server, 2)
    assert page.evaluate("window.wasPressed") is True
    assert board_value(board, "state.messageBox.message") == "Is the bed clear?"
    # and the focus is on no button
    assert page.evaluate("document.activeElement.tagName") == "H3"


def test_answer_locks_until_there_is_news(page, box, server, board):
    """What is pressed twice must not answer the next box."""
    ask(board, 'P"First" S3')
    ask(board, 'P"Second" S3', "aux")
    wait_text(part(box, "box-message"), "First")
    expect(part(box, "box-ok")).to_be_enabled()
    is_locked = page.evaluate(
        """() => {
            const ok = document.querySelector("#rrfmodel_box_dialog [data-test=box-ok]");
            ok.click();
            ok.click();
            return ok.disabled;
        }"""
    )
    assert is_locked
    wait_text(part(box, "box-message"), "Second")
    # whoever works with the keyboard is in the next box
    expect(box.locator("h3")).to_be_focused()
    helpers.wait_polls(server, 2)
    assert board_value(board, "state.messageBox.message") == "Second"


def test_the_reply_about_one_box_does_not_unlock_the_next(fresh_page, server, board):
    page = fresh_page
    page.clock.install()
    open_octoprint(page, server, ADMIN)
    box = page.locator("#rrfmodel_box_dialog")
    ask(board, 'P"First" S3')
    ask(board, 'P"Second" S3', "aux")
    wait_text(part(box, "box-message"), "First")
    held = []
    page.route("**/api/plugin/rrfmodel", lambda route: held.append(route))
    part(box, "box-ok").click()
    server.wait_for(lambda: page.wait_for_timeout(20) or held, 45, "the answer")
    first = held[0]
    reply = first.fetch()
    wait_text(part(box, "box-message"), "Second")
    # the next one is answered, then the reply about the first comes
    part(box, "box-ok").click()
    server.wait_for(lambda: page.wait_for_timeout(20) or held[1:], 45, "the second answer")
    with page.expect_response("**/api/plugin/rrfmodel"):
        first.fulfill(response=reply)
    # the page knows of it, and of the time after which it would unlock
    helpers.wait_polls(server, 2)
    page.clock.fast_forward(6_000)
    expect(part(box, "box-ok")).to_be_disabled()
    assert len(held) == 2


def test_put_aside_and_shown_again(page, box, server, board):
    ask(board, f'P"Look at it" R"{MARKUP}" S2')
    wait_text(part(box, "box-message"), "Look at it")
    part(box, "box-aside").click()
    expect(box).to_be_hidden()
    again = page.locator("[data-test=box-again]")
    expect(again).to_contain_text(MARKUP)
    # the page behind it can be used
    page.locator("#temp_link a").click()
    helpers.wait_polls(server, 2)
    expect(box).to_be_hidden()
    assert board_value(board, "state.messageBox.message") == "Look at it"
    again.click()
    expect(box).to_be_visible()
    expect(again).to_be_hidden()
    part(box, "box-ok").click()
    assert is_closed(server, board, box)


def test_put_aside_and_answered_elsewhere(page, box, server, board):
    ask(board, 'P"Look at it" S2')
    wait_text(part(box, "box-message"), "Look at it")
    part(box, "box-aside").click()
    board.board.execute("M292", channel="telnet")
    expect(page.locator("[data-test=box-again]")).to_be_hidden()
    # the next one comes by itself
    ask(board, 'P"Another" S2')
    wait_text(part(box, "box-message"), "Another")
    expect(box).to_be_visible()


@pytest.mark.parametrize(
    ("parameters", "answer"),
    [("S2", "M292 P0"), ("S3", "M292 P0"), ('S4 K{"one", "two"} F1', "R{1}")],
    ids=["ok", "ok or cancel", "choices"],
)
def test_enter_confirms_and_the_focus_goes_back(page, box, server, board, parameters, answer):
    came_from = page.locator("#rrfmodel_views [data-test=view-machine]")
    came_from.focus()
    ask(board, f'P"Ready?" {parameters}')
    wait_text(part(box, "box-message"), "Ready?")
    expect(box.locator("button:visible").last).to_be_enabled()
    page.keyboard.press("Enter")
    assert is_closed(server, board, box)
    assert answer in sent(server)[-1]
    expect(came_from).to_be_focused()


def test_enter_that_is_held_down_answers_nothing(page, box, server, board):
    ask(board, 'P"Ready?" S2')
    wait_text(part(box, "box-message"), "Ready?")
    expect(part(box, "box-ok")).to_be_enabled()
    before = len(sent(server))
    page.evaluate(
        """() => document.activeElement.dispatchEvent(
            new KeyboardEvent("keydown", {key: "Enter", bubbles: true, repeat: true}))"""
    )
    helpers.wait_polls(server, 1)
    assert len(sent(server)) == before


def test_what_can_not_be_cancelled_stays(page, box, server, board):
    ask(board, 'P"Read this" S2')
    wait_text(part(box, "box-message"), "Read this")
    page.keyboard.press("Escape")
    helpers.wait_polls(server, 2)
    assert box.is_visible()
    assert board_value(board, "state.messageBox.mode") == 2


@both_hosts
def test_choices(box, server, board):
    ask(board, 'P"Which?" S4 K{"one", "two", "three"} F1')
    wait_text(part(box, "box-message"), "Which?")
    choices = part(box, "box-choice")
    expect(choices).to_have_text(["one", "two", "three"])
    expect(choices.nth(1)).to_have_class("btn btn-primary")
    # whoever goes there by the keyboard stays there
    expect(choices.nth(2)).to_be_enabled()
    choices.nth(2).focus()
    helpers.wait_polls(server, 3)
    expect(choices.nth(2)).to_be_focused()
    choices.nth(2).click()
    assert is_closed(server, board, box)
    assert any("R{2}" in line or "R2" in line for line in sent(server))


def sent(server):
    return [line for line in server.sent() if "M292" in line]


@pytest.mark.parametrize(
    ("parameters", "wrong", "right", "goes_out"),
    [
        ("S5 L1 H9 F4", ["0", "10", "2.5", ""], "7", "7"),
        ("S6 L0.5 H2.5 F1", ["0.4", "3", ""], "1.25", "1.25"),
        ('S7 L2 H5 F"abc"', ["a", "abcdef"], "half", "half"),
    ],
    ids=["integer", "number", "text"],
)
def test_values_within_limits(page, box, server, board, parameters, wrong, right, goes_out):
    ask(board, f'P"How much?" {parameters}')
    wait_text(part(box, "box-message"), "How much?")
    field = part(box, "box-value")
    expect(field).to_have_value(re.compile("^(4|1|abc)$"))
    expect(field).to_be_focused()
    before = len(sent(server))
    for value in wrong:
        field.fill(value)
        part(box, "box-ok").click()
        wait_text(part(box, "box-error"), "not a value")
        # which the next one has to give its own reason for
        page.evaluate("OctoPrint.coreui.viewmodels.rrfModelBoxViewModel.error('')")
    helpers.wait_polls(server, 1)
    assert len(sent(server)) == before
    # what is typed takes the place of what stood there, without a pointer
    field.select_text()
    page.keyboard.type(right)
    page.keyboard.press("Enter")
    assert is_closed(server, board, box)
    assert goes_out in sent(server)[-1]


def test_a_value_by_keyboard_alone(page, box, server, board):
    ask(board, 'P"How much?" S5 L1 H9 F4 J1')
    wait_text(part(box, "box-message"), "How much?")
    expect(part(box, "box-value")).to_be_focused()
    # keys that were meant for what was there before change nothing
    expect(part(box, "box-ok")).to_be_enabled()
    page.keyboard.type("8")
    expect(part(box, "box-value")).to_have_value("8")
    page.keyboard.press("Enter")
    assert is_closed(server, board, box)
    assert "8" in sent(server)[-1]


def test_a_value_is_cancelled_by_escape(page, box, server, board):
    ask(board, 'P"How much?" S5 L1 H9 F4 J1')
    wait_text(part(box, "box-message"), "How much?")
    expect(part(box, "box-cancel")).to_be_enabled()
    page.keyboard.press("Escape")
    assert is_closed(server, board, box)
    assert "P1" in sent(server)[-1]


def test_closes_when_answered_elsewhere_and_the_next_one_comes(box, server, board):
    ask(board, 'P"First" S2')
    ask(board, 'P"Second" S2', "aux")
    wait_text(part(box, "box-message"), "First")
    board.board.execute("M292", channel="telnet")
    wait_text(part(box, "box-message"), "Second")
    board.board.execute("M292", channel="telnet")
    assert is_closed(server, board, box)


def test_axes_are_moved(box, server, board):
    board.board.speed = 10
    home(server, board)
    ask(board, 'P"Jog" S2 Z1')
    wait_text(part(box, "box-axis"), "Z")
    before = board_value(board, "move.axes[2].machinePosition")
    box.get_by_label("Move Z by 1 mm").click()
    wait_board(
        server, board, "move.axes[2].machinePosition", lambda now: abs(now - before - 1) < 0.01
    )
    part(box, "box-ok").click()
    assert is_closed(server, board, box)


def test_who_may_not_control_sees_and_can_not_answer(reader_page, board):
    box = reader_page.locator("#rrfmodel_box_dialog")
    ask(board, 'P"Look" S5 L1 H9')
    wait_text(part(box, "box-message"), "Look")
    wait_text(part(box, "box-readonly"), "not answer")
    controls = box.locator("button:visible:not([data-test=box-aside]), input:visible")
    expect(controls).not_to_have_count(0)
    for control in controls.all():
        expect(control).to_be_disabled()


def test_text_of_the_printer_is_text(box, server, board, page_errors):
    ask(board, f'P"{MARKUP}" R"{MARKUP}" S4 K{{"{MARKUP}", "b"}}')
    wait_text(part(box, "box-message"), MARKUP)
    wait_text(part(box, "box-choice").first, MARKUP)
    assert box.locator("img").count() == 0
    assert own_errors(page_errors) == []


def test_tags_of_a_macro_are_shown_and_its_links_lead_to_pages(box, board, page_errors):
    text = (
        "Insert <b>PLA</b><br>see <a href='https://example.org/a?b=1'>this</a> &amp; wait 5 &deg;C"
    )
    ask(board, f'P"{text}" R"<i>Filament</i> 1" S2')
    wait_text(part(box, "box-message"), "Insert PLA")
    expect(part(box, "box-message")).to_have_text("Insert PLAsee this & wait 5 °C")
    expect(part(box, "box-title")).to_have_text("Filament 1")
    assert part(box, "box-message").evaluate("(element) => element.innerHTML") == (
        "Insert <b>PLA</b><br>see "
        '<a href="https://example.org/a?b=1" target="_blank" rel="noopener noreferrer">this</a>'
        " &amp; wait 5 °C"
    )
    assert own_errors(page_errors) == []


HOSTILE = {
    "<script>window.hit = 1</script>x": "window.hit = 1x",
    "x<img src=x onerror='window.hit=1'>y": "xy",
    "<svg/onload=window.hit=1>": "<svg/onload=window.hit=1>",
    "<b onclick='window.hit=1' style='position:fixed'>b</b>": "b",
    "<a href='javascript:window.hit=1'>a</a>": "a",
    "<a href=' java\tscript:window.hit=1'>a</a>": "a",
    "<a href='&#106;avascript:window.hit=1'>a</a>": "a",
    "<a href='data:text/html,<script>1</script>'>a</a>": None,
    "<a href='/api/logout'>a</a>": "a",
    "<a href='//example.org'>a</a>": "a",
    "<a href='http://example.org/' onmouseover='window.hit=1'>a</a>": "a",
    "<a href='http://x' onclick=1><a href='http://y'>a</a></a>": "a",
    "&lt;img src=x onerror=window.hit=1&gt;": "<img src=x onerror=window.hit=1>",
    "&#60;b&#62; &#1114112; &#0; &bogus;": "<b> &#1114112; &#0; &bogus;",
    "&constructor; &#x3c;": "&constructor; <",
    "a < b and c > d": "a < b and c > d",
    "<filename> and <0.2>": "<filename> and <0.2>",
    "</b></a></p>": "</b></a></p>",
    "<b><i><b>x": "x",
    "<b" * 4000: "<b" * 4000,
    "<b>" * 4000 + "x": "x",
    "<i>" + "<a href='http://x'>" * 2000 + "x": "x",
    "<b " + " href='" * 4000: None,
    "a<p>b</p>c": "abc",
    "<p>a</p>": "a",
    "<<b>>x": "<>x",
    "<scr<b>ipt>window.hit=1</scr</b>ipt>": "<script>window.hit=1</script>",
    "": "",
}
"""Texts of a macro, and what of them is to be read; without one it is only to be harmless."""


def test_hostile_texts_become_text(page, page_errors):
    found = page.evaluate(
        """(texts) => texts.map(function (text) {
            const place = document.createElement("div");
            place.append(RRFModel.markup(text));
            document.body.append(place);
            const all = Array.from(place.querySelectorAll("*"));
            const depth = (each) => (each === place ? 0 : 1 + depth(each.parentNode));
            const result = {
                text: place.textContent,
                tags: all.map((each) => each.localName),
                attributes: all.flatMap((each) => each.getAttributeNames()),
                links: all.filter((each) => each.href).map((each) => each.protocol),
                depth: Math.max(0, ...all.map(depth)),
                plain: RRFModel.plainText(text),
            };
            all.forEach((each) => each.dispatchEvent(new MouseEvent("mouseover")));
            place.remove();
            return result;
        })""",
        list(HOSTILE),
    )
    for text, wanted, seen in zip(HOSTILE, HOSTILE.values(), found):
        assert set(seen["tags"]) <= {"b", "i", "a", "br"}, text
        assert set(seen["attributes"]) <= {"href", "target", "rel"}, text
        assert set(seen["links"]) <= {"http:", "https:"}, text
        assert seen["depth"] <= 3, text
        if wanted is not None:
            assert seen["text"] == wanted
            assert seen["plain"].replace("\n", "") == wanted
    assert page.evaluate("window.hit") is None
    assert own_errors(page_errors) == []
