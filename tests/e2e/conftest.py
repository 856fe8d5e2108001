"""Fixtures of end-to-end tests: a module's server with its board, or one machine at a time.

Which tests run in both hosts: all of them run in OctoPrint 2.0, and in 1.11 those that are marked
``both_hosts``. Marked is what goes through code that the hosts have each for themselves:

- the serial line: connecting, the queue of lines, ok and timeouts, prints that are streamed, the
  card, what the terminal shows;
- OctoPrint's own requests as the plugin answers or changes them, its settings and profiles;
- who somebody is: keys, sessions, permissions, sockets and what is pushed to them;
- one test of each group of endpoints and of each integration, which shows that it is there at all.

What is worked out from the model alone (``octoprint_rrfmodel.rrf``) is the same in both. Rows of a
table that differ only in that, mostly in machine and firmware, are rows of one kind:
``both_hosts("...", once_for=("machine",))`` runs in 1.11 the first of the rows that are equal in
all other parameters. An empty ``once_for`` of a test takes back the one of its module.
"""

import os
from importlib.metadata import version
from pathlib import Path

import pytest

from . import helpers
from .operations import PROFILE, SETUPS, Machine

HERE = f"{Path(__file__).parent}{os.sep}"


# before the groups are made of what is left
@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """In 1.11 only what differs there; a module's tests on one machine one after the other."""
    _leave_to_the_newer_host(config, items)
    places = [number for number, item in enumerate(items) if "machines" in item.fixturenames]
    ordered = sorted((items[place] for place in places), key=_module_and_machine)
    for place, item in zip(places, ordered):
        items[place] = item


def _leave_to_the_newer_host(config, items):
    """Deselect in 1.11 what is the same in both hosts, and is tested in 2.0."""
    if not version("OctoPrint").startswith("1."):
        return
    seen = set()
    here = [item for item in items if str(item.path).startswith(HERE)]
    left = [item for item in here if not _runs_in_both(item, seen)]
    if left:
        config.hook.pytest_deselected(items=left)
        kept = set(items) - set(left)
        items[:] = [item for item in items if item in kept]


def _runs_in_both(item, seen):
    """Return whether a test runs in 1.11; ``seen`` are the kinds of rows that do already."""
    mark = item.get_closest_marker("both_hosts")
    if mark is None:
        return False
    once_for = mark.kwargs.get("once_for", ())
    if not once_for or not hasattr(item, "callspec"):
        return True
    others = {name: value for name, value in item.callspec.params.items() if name not in once_for}
    kind = item.nodeid.partition("[")[0], repr(sorted(others.items()))
    is_first = kind not in seen
    seen.add(kind)
    return is_first


def _module_and_machine(item):
    parameters = getattr(item, "callspec", None)
    name = parameters.params.get("machine") if parameters else None
    return item.nodeid.partition("::")[0], list(SETUPS).index(name) if name else -1


@pytest.fixture(scope="module")
def board(request, module_board_factory):
    """The module's board: ``BOARD`` in it has the options, ``prepare(board)`` what is put on it."""
    made = module_board_factory(**request.module.BOARD)
    getattr(request.module, "prepare", lambda board: None)(made.board)
    return made


@pytest.fixture(scope="module")
def server(request, module_server_factory):
    """The module's server, connected to its ``board`` where ``BOARD`` says that there is one.

    ``SERVER`` has its options.
    """
    made = module_server_factory(**getattr(request.module, "SERVER", {}))
    if hasattr(request.module, "BOARD"):
        helpers.connect(made, request.getfixturevalue("board"))
    return made


@pytest.fixture(scope="module")
def machines(module_server_factory, module_board_factory):
    """Function that returns the machine called so, connected; the one before is disconnected."""
    server = module_server_factory(profile=PROFILE)
    current = {}

    def connected(name):
        if name not in current:
            helpers.disconnect(server)
            for machine in current.values():
                machine.pty.stop()
            current.clear()
            kind, firmware = SETUPS[name]
            board = module_board_factory(machine=kind, firmware=firmware, speed=20)
            helpers.connect(server, board)
            current[name] = Machine(server, board)
        return current[name]

    return connected


@pytest.fixture
def machine(request, machines):
    """A connected machine, cold, with no axis homed and no tool selected."""
    made = machines(getattr(request, "param", "one tool 3.5.3"))
    made.rest()
    return made
