"""The page's data in whatever order they come: replies that are late, and pushes before them."""

from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import open_octoprint

from .. import helpers
from . import SECONDS, TOLD, both_hosts, own_errors, part

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
            lambda: self._page.wait_for_timeout(20) or self._answered, 45, "the request"
        )

    def release(self):
        """Let the replies through, and all later ones at once."""
        self._is_open = True
        for route, response in self._answered:
            with self._page.expect_response(self._url):
                route.fulfill(response=response)


@both_hosts
def test_pushed_values_are_newer_than_the_model_that_comes_late(
    own_page, server, board, page_errors
):
    board.board.execute('M117 "old"', channel="http")
    helpers.wait_value(server, "state.displayMessage", "old", 45)
    held = Held(own_page, "**/plugin/rrfmodel/model?*", server)
    open_octoprint(own_page, server, ADMIN)
    held.wait()
    message = part(own_page, "message").first
    board.board.execute('M117 "new"', channel="http")
    expect(message).to_have_text("new")
    # what has not changed since comes with the model alone
    expect(part(own_page, "axis")).to_have_count(0)
    held.release()
    expect(part(own_page, "axis")).to_have_count(3)
    expect(message).to_have_text("new")
    assert own_errors(page_errors) == []


@both_hosts
def test_a_late_state_does_not_take_the_machine_away(own_page, server, board, page_errors):
    page = own_page
    helpers.disconnect(server)
    held = Held(page, "**/plugin/rrfmodel/status", server)
    open_octoprint(page, server, ADMIN)
    held.wait()
    helpers.connect(server, board, SECONDS)
    expect(part(page, "axis")).to_have_count(3)
    held.release()
    helpers.wait_polls(server, 3)
    expect(part(page, "axis")).to_have_count(3)
    expect(part(page, "status").first).to_have_text("Idle")
    assert own_errors(page_errors) == []


@both_hosts
def test_what_was_missed_while_the_socket_was_away_is_asked_for(own_page, server, page_errors):
    open_octoprint(own_page, server, ADMIN)
    expect(part(own_page, "axis")).to_have_count(3)
    with own_page.expect_response("**/plugin/rrfmodel/model?*") as answered:
        own_page.evaluate("OctoPrint.socket.socket.close(3000)")
    assert answered.value.ok
    expect(own_page.locator("#offline_overlay")).to_be_hidden()
    expect(part(own_page, "axis")).to_have_count(3)
    assert own_errors(page_errors) == []


def test_messages_kept_until_somebody_logs_in_are_no_news(page, page_errors):
    expect(part(page, "axis")).to_have_count(3)
    notices = page.locator(TOLD)
    page.evaluate(
        """() => {
            const page = OctoPrint.coreui.viewmodels.rrfModelViewModel;
            const now = page.status();
            const before = Object.assign({}, now, {at: now.at - 3600, is_rrf: false});
            const told = (message) => page.onDataUpdaterPluginMessage("rrfmodel", message);
            told({type: "notice", code: "old", text: "An old notice.", at: before.at});
            told({type: "reset", status: before});
            told({type: "notice", code: "new", text: "A new notice.", at: now.at + 0.001});
        }"""
    )
    expect(notices.filter(has_text="A new notice.")).to_have_count(1)
    expect(notices.filter(has_text="An old notice.")).to_have_count(0)
    expect(part(page, "axis")).to_have_count(3)
    assert own_errors(page_errors) == []


def test_a_model_that_the_server_did_not_have_is_asked_for_again(fresh_page, server):
    page = fresh_page
    page.clock.install()
    page.route(
        "**/plugin/rrfmodel/model?*",
        lambda route: route.fulfill(status=503, json={"error": "Not yet."}),
        times=1,
    )
    answers = []
    page.on(
        "response",
        lambda response: "/rrfmodel/model?" in response.url and answers.append(response.status),
    )
    open_octoprint(page, server, ADMIN)
    # the page sees the refusal a little later than this test does
    server.wait_for(
        lambda: page.clock.fast_forward(6_000) or 200 in answers, 45, "the second question"
    )
    assert answers[0] == 503
    expect(part(page, "axis")).to_have_count(3)
