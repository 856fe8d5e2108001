"""The plugin's tab in a real browser: opened as somebody, a sub-view at a time."""

import json

from playwright.sync_api import expect

from tests.support import waiting
from tests.support.browser import open_octoprint

SECONDS = 15


def open_view(page, server, user, view):
    """Return the sub-view called so once it is shown to that user."""
    open_octoprint(page, server, user, f"/#tab_plugin_rrfmodel/{view}")
    region = page.locator(f"#rrfmodel_{view}")
    region.locator("visible=true").first.wait_for(timeout=30_000)
    return region


def part(region, name):
    """Return what is marked so in a region."""
    return region.locator(f"[data-test={name}]")


def wait_text(locator, wanted, seconds=SECONDS):
    """Return once the element's text has ``wanted`` in it."""
    expect(locator).to_contain_text(wanted, timeout=seconds * 1000)


def type_number(field, number):
    """Type into a field that shows and sets a number, and confirm it."""
    field.fill(str(number))
    field.press("Enter")


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


def own_errors(page_errors):
    """Return the errors but those of OctoPrint's own page for users who aren't administrators."""
    return [error for error in page_errors if "(FORBIDDEN)" not in error]
