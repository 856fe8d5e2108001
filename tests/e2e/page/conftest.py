"""Fixtures of the page's tests: one server for many modules, and pages that stay open.

To open OctoPrint's page costs seconds of the processor, and so does a server's start. Hence the
modules of a group share a server, and a module's tests the page of each user, which is brought
back to rest before each of them.
"""

import os
from importlib.metadata import version
from pathlib import Path

import pytest

from tests import conftest as bench
from tests.support import browser as chromium
from tests.support.basedir import ADMIN, READER

from .. import helpers
from . import SECONDS, board_value, open_view
from .rest import bring_to_rest
from .wizard import FIELDS, PROFILE, command

HERE = f"{Path(__file__).parent}{os.sep}"

GROUPS = (
    {
        "test_box",
        "test_chart",
        "test_data",
        "test_emergency",
    },
    {
        "test_heat",
        "test_model",
        "test_notifications",
        "test_now",
        "test_sidebar",
        "test_strip",
    },
    {
        "test_answers",
        "test_bed",
        "test_console",
        "test_every_control",
        "test_jobs_counted",
    },
    {
        "test_keyboard",
        "test_machine",
        "test_machine_parts",
        "test_panels",
        "test_spindle",
    },
    {
        "test_everyone",
        "test_job",
        "test_job_controls",
        "test_job_idle",
    },
    {
        "test_old_firmware",
        "test_setup",
        "test_streamed",
        "test_wide",
        "test_wizard",
        "test_words",
    },
)
"""Modules that run on one worker, and so on one server; each group takes about as long."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Keep each group's tests on one worker."""
    for item in items:
        if str(item.path).startswith(HERE):
            number = next(n for n, group in enumerate(GROUPS) if item.path.stem in group)
            # the few that run in 1.11 are worth one server
            name = "page" if version("OctoPrint").startswith("1.") else f"page-{number}"
            item.add_marker(pytest.mark.xdist_group(name))


def say_nothing(server, board):
    """Close the message boxes that are open at the board, and clear its display."""
    state = board_value(board, "state")
    if state.get("messageBox") is None and not state.get("displayMessage"):
        return
    board.board.execute('M117 ""', channel="telnet")
    while board_value(board, "state.messageBox") is not None:
        board.board.execute("M292 P1", channel="telnet")
    # what is still in the model would be shown again
    helpers.wait_value(server, "state.messageBox", None, 45)
    helpers.wait_value(server, "state.displayMessage", "", 45)


@pytest.fixture(scope="session")
def shared_server(server_pool):
    """A server with the plugin and no options, for every module that a worker runs."""
    with bench.lent_servers(server_pool) as lend:
        yield lend()


@pytest.fixture(scope="module")
def board(request, module_board_factory):
    """The module's board: ``BOARD`` in it has the options, ``prepare(board)`` what is put on it."""
    made = module_board_factory(**request.module.BOARD)
    getattr(request.module, "prepare", lambda board: None)(made.board)
    return made


@pytest.fixture(scope="module")
def server(shared_server, board):
    """The shared server, connected to the module's board."""
    helpers.connect(shared_server, board, SECONDS)
    yield shared_server
    helpers.disconnect(shared_server)


@pytest.fixture
def unasked_server(shared_server, board):
    """The shared server as before anybody was asked what to set, with a machine that is ready."""
    profile = shared_server.get(PROFILE).json()
    shared_server.set_setting("plugins.rrfmodel.wizard_seen", False)
    helpers.connect(shared_server, board, SECONDS)
    yield shared_server
    # what a test has set is taken back by the plugin, what a person has by this
    command(shared_server, command="restore_settings")
    own = {name: profile[name] for name in FIELDS}
    assert shared_server.patch(PROFILE, json={"profile": own}).ok
    shared_server.set_setting("plugins.rrfmodel.wizard_seen", True)
    helpers.disconnect(shared_server)


@pytest.fixture(scope="session")
def context_of(browser, shared_server):
    """Function that returns a user's part of the browser: who has been at the server before."""
    known = {}

    def context(user):
        if user not in known:
            known[user] = chromium.new_context(browser)
        return known[user]

    yield context
    for made in known.values():
        made.close()


@pytest.fixture(scope="session")
def heard():
    """What the pages of this worker have told of errors since the test began."""
    return []


@pytest.fixture
def page_errors(heard):
    """The errors that the page's scripts raised or logged in this test, in order."""
    heard.clear()
    return heard


@pytest.fixture(scope="module")
def kept(context_of, server):
    """The pages by user that the module's tests find open."""
    pages = {}
    yield pages
    for page in pages.values():
        page.close()


@pytest.fixture
def at_rest(request, kept, server, board, context_of, page_errors):
    """Function that returns a user's open page, with no trace of the tests before."""
    used = []
    say_nothing(server, board)

    def page_of(user):
        if user not in kept:
            kept[user] = chromium.new_page(context_of(user), page_errors)
            open_view(kept[user], server, user, "machine")
        bring_to_rest(kept[user])
        used.append(user)
        return kept[user]

    failed = request.session.testsfailed
    yield page_of
    if request.session.testsfailed > failed:
        # nobody knows how that one was left
        for user in used:
            kept.pop(user).close()


@pytest.fixture
def page(at_rest):
    """The admin's page that stays open; each test chooses a sub-view and finds it at rest."""
    return at_rest(ADMIN)


@pytest.fixture
def reader_page(at_rest):
    """The same of somebody who may only look."""
    return at_rest(READER)


BLANK = "/blank"
NO_ICON = "<link rel=icon href='data:,'>"


@pytest.fixture
def own_page(context_of, server, page_errors):
    """A page of the admin that isn't opened yet, for tests of what comes with opening it.

    The browser knows the admin and OctoPrint's files already.
    """
    page = chromium.new_page(context_of(ADMIN), page_errors)
    # what tests before have made their page remember
    page.route(
        f"{server.url}{BLANK}", lambda route: route.fulfill(content_type="text/html", body=NO_ICON)
    )
    page.goto(f"{server.url}{BLANK}")
    page.evaluate("window.localStorage.clear()")
    page.unroute(f"{server.url}{BLANK}")
    yield page
    if page.url.startswith(server.url):
        page.evaluate("window.localStorage.clear()")
    page.close()


@pytest.fixture
def fresh_page(browser, page_errors):
    """A page with cookies and a clock of its own: nobody is logged in."""
    context = chromium.new_context(browser)
    yield chromium.new_page(context, page_errors)
    context.close()
