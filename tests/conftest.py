"""Fixtures: servers, boards and a browser; every server and board ends with its test."""

from __future__ import annotations

import contextlib
import functools
import inspect
import itertools
import os
import sys
from importlib.metadata import PackageNotFoundError, version

import hypothesis
import pytest

from tests.support import broker as mqtt
from tests.support import browser as chromium
from tests.support.examples import some
from tests.support.recordings import RECORDINGS

# a busy machine makes single examples slow, and a failure has to be the same one when run again
COMMON = {"deadline": None, "print_blob": True, "max_examples": some()}
hypothesis.settings.register_profile("bench", **COMMON)
hypothesis.settings.register_profile("ci", **COMMON, derandomize=True)
hypothesis.settings.load_profile("ci" if os.environ.get("CI") else "bench")

# what others wrote to read a printer wants a newer Python (requirements/clients.txt)
WITH_CLIENTS = ["e2e/web/test_moonraker_clients.py", "e2e/web/test_openapi.py"]
collect_ignore = WITH_CLIENTS if sys.version_info < (3, 10) else []

# the servers of this process that run now, for the report of a failure
RUNNING = []


# seconds that the tests of a module take one after the other, where that is more than half a
# minute; a rough guess is enough, for it only says what begins first
SECONDS = {
    "test_package": 300,
    "line/test_faults": 280,
    "endurance/test_endurance": 80,
    "line/test_operations_heat": 220,
    "line/test_truth": 220,
    "line/test_operations": 160,
    "line/test_faults_early": 130,
    "line/test_recover": 120,
    "line/test_fresh": 110,
    "line/test_heatup": 160,
    "line/test_long_commands": 110,
    "line/test_reading": 90,
    "line/test_unsendable": 90,
    "line/test_connect": 70,
    "line/test_slow_line": 60,
    "line/test_not_rrf": 50,
    "line/test_silence": 120,
    "line/test_same_breath": 60,
    "line/test_usb_channels": 50,
    "rrf/follow/test_rows": 30,
    "web/test_commands_states": 180,
    "web/test_commands_http": 150,
    "web/test_openapi": 110,
    "web/test_http": 100,
    "web/test_commands": 90,
    "web/test_commands_boxes": 90,
    "web/test_moonraker": 80,
    "web/test_websocket": 70,
    "web/test_history": 50,
    "web/test_jobs": 60,
    "web/test_moonraker_files": 60,
    "web/test_moonraker_clients": 60,
    "web/test_scripts": 50,
    "web/test_bundle": 30,
    "print/test_print": 280,
    "print/test_guard": 280,
    "print/test_refused": 100,
    "print/test_hanging_plugins": 80,
    "print/test_cnc": 60,
    "print/test_cancelled": 50,
    "print/test_file_check": 50,
    "print/test_lost_ok": 50,
    "print/test_stops": 50,
    "card/test_sdcard": 300,
    "card/test_thumbnail": 40,
    "card/test_files": 60,
    "network/test_losses": 100,
    "link/network/test_whole": 30,
    "network/test_jobs": 80,
    "network/test_sbc": 100,
    "link/network/test_sbc": 20,
    "network/test_operations": 40,
    "network/test_files": 40,
    "network/test_secrets": 40,
    "network/test_stop": 30,
    "network/test_machine_files": 60,
    "network/test_beside": 30,
    "network/test_panel": 30,
    "setup/test_settings": 100,
    "setup/test_buttons": 60,
    "setup/test_safe_mode": 40,
    "setup/test_demo": 30,
    "integrations/test_layer_progress": 120,
    "integrations/test_mqtt": 90,
    "integrations/test_onlookers": 60,
    "integrations/test_psu": 60,
    "integrations/test_prompt": 50,
    "integrations/test_events": 50,
    "integrations/test_helpers": 40,
}

PARTS = {
    "line/test_faults": 4,
    "line/test_operations_heat": 3,
    "line/test_truth": 2,
    "line/test_operations": 2,
    "line/test_faults_early": 2,
    "line/test_recover": 2,
    "line/test_heatup": 2,
    "line/test_unsendable": 2,
    "web/test_commands_states": 2,
    "web/test_commands_http": 2,
    "print/test_print": 4,
    "print/test_guard": 4,
    "card/test_sdcard": 4,
}
"""Modules whose tests go to several workers; each part has its own server and boards."""

# among those that aren't named: a page takes longer than a look at a module
BROWSER_SECONDS = 60


def _module(item):
    """Return what the tables have as the name of a test's module."""
    name = item.nodeid.partition("::")[0].rpartition(".py")[0]
    return name.partition("tests/")[2].removeprefix("e2e/")


def _is_of_the_page(item):
    return "page" in getattr(item, "fixturenames", ())


def _seconds(item):
    return SECONDS.get(_module(item), BROWSER_SECONDS if _is_of_the_page(item) else 0)


def _group(item):
    """Return what of the tests runs one after the other: a group, or the module's own."""
    mark = item.get_closest_marker("xdist_group")
    return mark.args[0] if mark else _module(item)


def _seconds_of_groups(items):
    """Return how long each group takes, whose modules run on one worker."""
    modules = {}
    for item in items:
        modules.setdefault(_group(item), {})[_module(item)] = _seconds(item)
    return {
        group: sum(seconds / PARTS.get(module, 1) for module, seconds in found.items())
        for group, found in modules.items()
    }


def _beginnings(seconds, of_pages):
    """Return in which part of the run each group begins, from 0 to 1: what takes long first.

    Pages take the processor, while most others wait: they are spread over the whole run.
    """
    found = {}
    for is_page in (True, False):
        groups = [group for group in seconds if (group in of_pages) == is_page]
        whole, done = sum(seconds[group] for group in groups) or 1, 0
        for group in sorted(groups, key=seconds.get, reverse=True):
            found[group] = done / whole
            done += seconds[group]
    return found


# xdist's own implementation puts the group into the name of the test, so it has to come later
@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """What takes long first, and the tests that share a server of their module on one worker."""
    sharing = {}
    for item in items:
        if "module_server_factory" in item.fixturenames and not any(
            item.iter_markers("xdist_group")
        ):
            sharing.setdefault(_module(item), []).append(item)
    for module, tests in sharing.items():
        parts = PARTS.get(module, 1)
        for number, item in enumerate(tests):
            part = number * parts // len(tests)
            item.add_marker(pytest.mark.xdist_group(f"{module}-{part}" if part else module))
    of_pages = {_group(item) for item in items if _is_of_the_page(item)}
    begins = _beginnings(_seconds_of_groups(items), of_pages)
    items.sort(key=lambda item: begins[_group(item)])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Attach to the report of a failure what the running servers logged and what the page does."""
    report = yield
    if report.failed:
        page = getattr(item, "funcargs", {}).get("page")
        # before the logs, of which a CI machine shows the beginning only
        if page is not None and call.when == "call":
            from tests.support.page_report import page_report

            report.sections.append(("the page", page_report(page)))
        # the test's own first: what was lent to a whole session comes last
        for server in reversed(RUNNING):
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
    if not RECORDINGS.is_dir():
        pytest.skip("the folder with recordings isn't there; set RRF_SHARED to its path")
    return RECORDINGS


@pytest.fixture(scope="session")
def ports_dir(tmp_path_factory):
    """Folder in which boards are linked and every server of the bench looks for ports."""
    return tmp_path_factory.mktemp("ports")


@pytest.fixture(scope="session")
def server_pool(octoprint_version, tmp_path_factory, ports_dir):
    """The servers that the tests of this process have one after another."""
    from tests.support.pool import ServerPool

    pool = ServerPool(lambda: tmp_path_factory.mktemp("octoprint"), str(ports_dir / "*"))
    yield pool
    pool.stop()


@contextlib.contextmanager
def lent_servers(pool):
    """Yield a function that lends servers; all of them are given back in the end."""
    with contextlib.ExitStack() as stack:

        def lend(**options):
            server = pool.lend(**options)
            RUNNING.append(server)
            stack.callback(RUNNING.remove, server)
            stack.callback(pool.take_back, server)
            return server

        yield lend


@pytest.fixture
def server_factory(server_pool):
    """Function that returns a running ``OctoPrintServer`` with the options given.

    Nothing is connected, and all but the logs and counters is as after a start; with ``own=True``
    it is one that has just been started.
    """
    with lent_servers(server_pool) as lend:
        yield lend


@pytest.fixture(scope="module")
def module_server_factory(server_pool):
    """``server_factory`` for servers that all tests of a module share."""
    with lent_servers(server_pool) as lend:
        yield lend


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
    from playwright.sync_api import Locator, expect, sync_playwright

    expect.set_options(timeout=chromium.PATIENCE_MS)
    # OctoPrint's page stays where it is, and Playwright has waited 40 s for it to go elsewhere
    Locator.click = functools.partialmethod(Locator.click, no_wait_after=True)
    # behind each call Playwright looks up the module of each frame; those of xdist's have none, and
    # all modules would be gone through for them
    inspect.modulesbyfile["<string>"] = "builtins"
    with sync_playwright() as playwright:
        instance = playwright.chromium.launch(
            executable_path=str(chromium.CHROMIUM), args=chromium.FLAGS
        )
        yield instance
        instance.close()


@pytest.fixture
def page(browser, page_errors):
    """A page with cookies of its own; what goes wrong in it lands in ``page_errors``."""
    context = chromium.new_context(browser)
    yield chromium.new_page(context, page_errors)
    context.close()


@pytest.fixture
def page_errors():
    """The errors that the page's scripts raised or logged, in order."""
    return []
