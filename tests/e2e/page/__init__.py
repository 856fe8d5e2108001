"""The plugin's tab in a real browser: opened as somebody, a sub-view at a time."""

import contextlib
import json
import re

import pytest
from playwright.sync_api import expect

from tests.support import waiting
from tests.support.browser import open_octoprint

from .. import helpers

SECONDS = 45

both_hosts = pytest.mark.both_hosts("each has its own page, log-in, settings and bundles")

CONFIRM = ".modal.in .modal-footer .btn-danger"
"""The button of a question that goes on; OctoPrint's dialogs have links for buttons."""

TOLD = ".ui-pnotify:visible .ui-pnotify-text"
"""The texts of the notifications that are seen."""


def open_view(page, server, user, view):
    """Return the sub-view called so once it is shown to that user, in a page that is loaded."""
    open_octoprint(page, server, user, f"/#tab_plugin_rrfmodel/{view}")
    return _seen(page, view)


def show_view(page, view):
    """Return the sub-view called so once it is shown in a page that is open already."""
    page.evaluate("(view) => { window.location.hash = '#tab_plugin_rrfmodel/' + view; }", view)
    return _seen(page, view)


def _seen(page, view):
    region = page.locator(f"#rrfmodel_{view}")
    region.locator("visible=true").first.wait_for()
    return region


def show_terminal(page):
    """Show OctoPrint's terminal: what the strip tells is told elsewhere then."""
    page.locator('#tabs a[href="#term"]').evaluate("link => link.click()")
    page.locator("#term").wait_for(state="visible")


def part(region, name):
    """Return what is marked so in a region."""
    return region.locator(f"[data-test={name}]")


def heat_row(view, heater, tool=None):
    """Return the row of a heater in the sub-view Machine; of one that tools share, a tool's."""
    of_tool = "" if tool is None else f"[data-tool='{tool}']"
    return view.locator(f"[data-test=heat-row][data-heater='{heater}']{of_tool}")


def unfold(view, name):
    """Return a section of the sub-view Machine once it is open."""
    head = part(view, f"fold-{name}")
    expect(head).to_be_visible()

    def is_open():
        if head.get_attribute("aria-expanded") == "true":
            return True
        # values that come between pressing and letting go move the head away from below the mouse
        head.click()
        return False

    waiting.wait_for(is_open, SECONDS, f"{name} to be open")
    return part(view, name)


def wait_text(locator, wanted):
    """Return the element's text once it has ``wanted`` in it."""
    expect(locator).to_contain_text(wanted)
    return locator.inner_text()


def type_number(field, number):
    """Type into a field that shows and sets a number, and confirm it."""
    field.fill(str(number))
    # a value of the machine that comes between Playwright's selecting and its typing stays in front
    if field.input_value() != str(number):
        field.fill(str(number))
    expect(field).to_have_value(str(number))
    field.press("Enter")


@contextlib.contextmanager
def styled(page, css):
    """Give the page a style sheet for a while."""
    page.evaluate(
        """(css) => $("<style class='of-a-test'>").text(css).appendTo(document.head)""", css
    )
    yield
    page.evaluate("""() => $("style.of-a-test").remove()""")


def board_value(board, key):
    """Return the value that the board itself has for a key."""

    def answer():
        # a channel of its own: that of a test's commands may be busy
        said = board.board.execute(f'M409 K"{key}" F"vnd99"', channel="telnet").splitlines()
        return [json.loads(line) for line in said if line.startswith("{")]

    return waiting.wait_for(answer, SECONDS, f"the board's answer about {key}")[-1]["result"]


def wait_board(server, board, key, wanted, seconds=SECONDS):
    """Return the board's own value once it is ``wanted``, which may be a predicate."""
    fits = wanted if callable(wanted) else lambda found: found == wanted

    def fitting():
        found = board_value(board, key)
        return (found,) if fits(found) else None

    return server.wait_for(fitting, seconds, f"{key} of the board to be {wanted!r}")[0]


def home(server, board):
    """Home all axes; return once the model says so, and not of an earlier time."""
    board.board.execute("M84", channel="http")
    helpers.wait_value(server, "move.axes[].homed", lambda homed: not any(homed), SECONDS)
    board.board.execute("G28", channel="http")
    helpers.wait_value(server, "move.axes[].homed", all, SECONDS)


EXPECTED = re.compile(
    r"\(FORBIDDEN\)|(409 \(Conflict\)|504 \(Gateway Timeout\)).*/plugin/rrfmodel/files\?"
)


def own_errors(page_errors):
    """Return the errors but those of OctoPrint's own page for users who aren't administrators.

    Nor does it count that a folder of the card can't be read while the machine is busy, or this
    one is too busy for its answer: the browser notes each refusal.
    """
    return [error for error in page_errors if not EXPECTED.search(error)]
