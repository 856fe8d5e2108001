"""A board on the network, and a server that is connected to it."""

import contextlib

import pytest

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard

from . import bench


@contextlib.contextmanager
def _faces():
    with contextlib.ExitStack() as stack:

        def start(kind=HttpBoard, **options):
            return stack.enter_context(kind(Board(**options)))

        yield start


@pytest.fixture(scope="module")
def face(request):
    """The module's board: ``BOARD`` in it has the options, ``FACE`` is how it is on the network."""
    with _faces() as start:
        made = start(getattr(request.module, "FACE", HttpBoard), **request.module.BOARD)
        getattr(request.module, "prepare", lambda board: None)(made.board)
        yield made


@pytest.fixture(scope="module")
def server(request, module_server_factory):
    """The module's server, connected to its ``face`` where ``BOARD`` says that there is one."""
    made = module_server_factory(**getattr(request.module, "SERVER", {}))
    if hasattr(request.module, "BOARD"):
        bench.connect(made, request.getfixturevalue("face"))
    return made


@pytest.fixture
def without_print(server, face):
    """Ends the print that a test leaves behind."""
    yield
    if server.state() != "Operational":
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 30)


@pytest.fixture
def face_factory():
    """Function that starts boards on the network, of one test's own."""
    with _faces() as start:
        yield start
