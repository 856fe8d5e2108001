"""The sub-view Machine, above: heaters, fans, axes and factors, each control used on the board."""

import pytest

from tests.support.basedir import ADMIN, READER

from . import helpers
from .page import board_value, open_view, own_errors, part, type_number, wait_board, wait_text

pytestmark = pytest.mark.timeout(240)

MARKUP = "<img src=x onerror=alert(1)>"


@pytest.fixture(scope="module")
def board(module_board_factory):
    return module_board_factory(machine="toolchanger", speed=10)


@pytest.fixture(scope="module")
def server(module_server_factory, board):
    made = module_server_factory()
    helpers.connect(made, board)
    return made


@pytest.fixture
def view(page, server):
    return open_view(page, server, ADMIN, "machine")


def test_tools(view, server, board, page_errors):
    tool = part(view, "tool").first
    type_number(part(tool, "active"), 61)
    wait_board(server, board, "tools[1].active[0]", 61)
    type_number(part(tool, "standby"), 43)
    wait_board(server, board, "tools[1].standby[0]", 43)
    part(tool, "state-standby").click()
    wait_board(server, board, "tools[1].state", "standby")
    wait_text(part(tool, "state"), "standby")
    part(tool, "state-off").click()
    wait_board(server, board, "tools[1].state", "off")
    assert own_errors(page_errors) == []
