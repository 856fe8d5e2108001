"""Fixtures: servers, boards and a browser; every server and board ends with its test."""

from __future__ import annotations

import contextlib
import itertools
import os
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import hypothesis
import pytest

from tests.support import broker as mqtt
from tests.support import browser as chromium
from tests.support import waiting
from tests.support.places import ROOT

# a busy machine makes single examples slow, and a failure has to be the same one when run again
hypothesis.settings.register_profile("bench", deadline=None, print_blob=True)
hypothesis.settings.register_profile("ci", deadline=None, print_blob=True, derandomize=True)
hypothesis.settings.load_profile("ci" if os.environ.get("CI") else "bench")

# the servers of this process that run now, for the report of a failure
RUNNING = []


# xdist's own implementation puts the group into the name of the test, so it has to come later
@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Slow tests first, and the tests that share a server of their module on one worker."""
    for item in items:
        if "module_server_factory" in item.fixturenames and not any(
            item.iter_markers("xdist_group")
        ):
            item.add_marker(pytest.mark.xdist_group(item.nodeid.partition("::")[0]))
    items.sort(key=lambda item: item.get_closest_marker("slow") is None)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Attach what the running servers logged to the report of a failure."""
    report = yield
    if report.failed:
        for server in RUNNING:
            report.sections.append((f"OctoPrint at {server.url}", server.log_tail()))
            report.sections.append((f"serial port of {server.url}", server.serial_log_tail()))
    return report


@pytest.fixture(scope="session")
def octoprint_version():
    """Version of the OctoPrint that this environment has, as text."""
    try:
        return version("OctoPrint")
    except PackageNotFoundError:
        pytest.skip("needs an environment with OctoPrint; make test builds two")


@pytest.fixture(scope="session")
def shared_dir():
    """Folder with recordings and reference answers that lie outside the repository."""
    path = Path(os.environ.get("RRF_SHARED", ROOT.parent / "shared"))
    if not path.is_dir():
        pytest.skip("the folder with recordings isn't there; set RRF_SHARED to its path")
    return path


@pytest.fixture(scope="session")
def ports_dir(tmp_path_factory):
    """Folder in which boards are linked and every server of the bench looks for ports."""
    return tmp_path_factory.mktemp("ports")


@contextlib.contextmanager
def _servers(make_basedir, ports_dir):
    """Yield a function that starts servers; all of them are stopped in the end."""
    from tests.support.server import OctoPrintServer

    with contextlib.ExitStack() as stack:

        def start(**options):
            options.setdefault("ports_glob", str(ports_dir / "*"))
            server = OctoPrintServer(make_basedir(), **options)
            RUNNING.append(server)
            stack.callback(RUNNING.remove, server)
            stack.callback(server.stop)
            return server.start()

        yield start


@pytest.fixture
def server_factory(octoprint_version, tmp_path, ports_dir):
    """Function that returns a running ``OctoPrintServer`` with the options given."""
    numbers = itertools.count()
    with _servers(lambda: tmp_path / f"octoprint-{next(numbers)}", ports_dir) as start:
        yield start


@pytest.fixture(scope="module")
def module_server_factory(octoprint_version, tmp_path_factory, ports_dir):
    """``server_factory`` for servers that all tests of a module share."""
    with _servers(lambda: tmp_path_factory.mktemp("octoprint"), ports_dir) as start:
        yield start


@pytest.fixture(scope="module")
def server(module_server_factory):
    """A server with the plugin and no printer, one for the module.

    A module that needs options or a printer defines its own ``server`` of the same scope.
    """
    return module_server_factory()


# a server sees the boards of other tests too, so that no name may come twice
BOARD_NUMBERS = itertools.count()


@contextlib.contextmanager
def _boards(ports_dir):
    """Yield a function that starts simulated boards; all of them are stopped in the end."""
    from octoprint_rrfmodel.simulator.board import Board
    from octoprint_rrfmodel.simulator.pty import PtyBoard

    with contextlib.ExitStack() as stack:

        def start(*, baud=None, **options):
            link = ports_dir / f"rrf-{next(BOARD_NUMBERS)}"
            return stack.enter_context(PtyBoard(Board(**options), link, baud=baud))

        yield start


@pytest.fixture
def board_factory(ports_dir):
    """Function that returns a running ``PtyBoard``: what a server connects to is its ``link``.

    The options are those of ``simulator.board.Board``: ``machine``, ``firmware``, ``model``,
    ``faults``, ``speed``; and ``baud`` for a line of that speed.
    """
    with _boards(ports_dir) as start:
        yield start


@pytest.fixture(scope="module")
def module_board_factory(ports_dir):
    """``board_factory`` for boards that all tests of a module share."""
    with _boards(ports_dir) as start:
        yield start


@pytest.fixture
def broker(tmp_path):
    """A running MQTT broker of the test's own."""
    if mqtt.mosquitto() is None:
        message = "no MQTT broker: install Debian's mosquitto"
        # on a CI machine nobody reads about a skipped test
        (pytest.fail if os.environ.get("CI") else pytest.skip)(message)
    with mqtt.Broker(tmp_path) as broker:
        yield broker


@pytest.fixture(scope="session")
def browser():
    """Debian's Chromium, headless; one for all tests of a worker."""
    if not chromium.CHROMIUM.exists():
        message = f"no browser: install Debian's chromium ({chromium.CHROMIUM})"
        # on a CI machine nobody reads about a skipped test
        (pytest.fail if os.environ.get("CI") else pytest.skip)(message)
    from playwright.sync_api import expect, sync_playwright

    # who waits longer only loses time where the test fails anyway
    expect.set_options(timeout=waiting.PATIENCE * 30_000)
    with sync_playwright() as playwright:
        instance = playwright.chromium.launch(
            executable_path=str(chromium.CHROMIUM), args=chromium.FLAGS
        )
        yield instance
        instance.close()


@pytest.fixture
def page(browser, page_errors):
    """A page with cookies of its own; what goes wrong in it lands in ``page_errors``."""
    context = browser.new_context(viewport=chromium.SIZE)
    yield chromium.new_page(context, page_errors)
    context.close()


@pytest.fixture
def page_errors():
    """The errors that the page's scripts raised or logged, in order."""
    return []
