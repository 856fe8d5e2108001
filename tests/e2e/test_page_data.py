"""The page's data in whatever order they come: replies that are late, and pushes before them."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import open_octoprint

from . import helpers
from .page import own_errors, part

pytestmark = pytest.mark.timeout(240)

BOARD = {"machine": "cartesian"}


class Held:
    """Requests of a page whose replies are kept back, as a slow line would."""

    def __init__(self, page, url, server):
        self._page = page
        self._url = url
        self._server = server
        self._answered = []
        self._is_open = False
        page.route(url, self._keep)

    def _keep(self, route):
        if self._is_open:
            route.continue_()
        else:
            self._answered.append((route, route.fetch()))

    def wait(self):
        """Return once the server has answered such a request."""
        # the page's requests are seen while Playwright is at work
        self._server.wait_for(
            lambda: self._page.wait_for_timeout(20) or self._answered, 30, "the request"
        )

    def release(self):
        """Let the replies through, and all later ones at once."""
        self._is_open = True
        for route, response in self._answered:
            with self._page.expect_response(self._url):
                route.fulfill(response=response)


@pytest.fixture
def page_of(page, server):
    open_octoprint(page, server, ADMIN)
    return page


def reload(page):
    page.reload()
    page.locator("#page-container-loading").wait_for(state="hidden", timeout=60_000)


def test_pushed_values_are_newer_than_the_model_that_comes_late(
    page_of, server, board, page_errors
):
    board.board.execute('M117 "old"', channel="http")
    helpers.wait_value(server, "state.displayMessage", "old", 15)
    held = Held(page_of, "**/plugin/rrfmodel/model?*", server)
    reload(page_of)
    held.wait()
    message = part(page_of, "message").first
    board.board.execute('M117 "new"', channel="http")
    expect(message).to_have_text("new")
    # what has not changed since comes with the model alone
    expect(part(page_of, "axis")).to_have_count(0)
    held.release()
    expect(part(page_of, "axis")).to_have_count(3)
    expect(message).to_have_text("new")
    assert own_errors(page_errors) == []


def test_a_late_state_does_not_take_the_machine_away(page_of, server, board, page_errors):
    helpers.disconnect(server)
    held = Held(page_of, "**/plugin/rrfmodel/status", server)
    reload(page_of)
    held.wait()
    helpers.connect(server, board)
    expect(part(page_of, "axis")).to_have_count(3)
    held.release()
    helpers.wait_polls(server, 3)
    expect(part(page_of, "axis")).to_have_count(3)
    expect(part(page_of, "status").first).to_have_text("Idle")
    assert own_errors(page_errors) == []
