"""What a client is shown of the serial traffic: all but the plugin's own."""

import re

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

pytestmark = pytest.mark.both_hosts("each has its own code for the serial line")

TYPED = 'M409 K"move.axes[0].letter" F""'
OWN = re.compile(r'M409|M408|\{"key"')


@pytest.fixture(scope="module")
def server(module_server_factory, module_board_factory):
    made = module_server_factory()
    helpers.connect(made, module_board_factory(machine="cartesian"))
    return made


def lines_of(push):
    """Return the lines of this connection that were pushed, those of the first message too."""
    lines = []
    for kind, payload in list(push.messages):
        if kind in ("current", "history"):
            lines += payload.get("logs") or []
    begun = [place for place, line in enumerate(lines) if 'to "Connecting"' in line]
    return lines[begun[-1] :] if begun else lines


def has_shown(push, text):
    return any(text in line for line in lines_of(push))


def test_polls_are_kept_out_and_the_rest_is_there(server):
    with PushListener(server, ADMIN) as push:
        helpers.wait_polls(server, 4)
        server.commands(TYPED)
        server.commands("M117 hello")
        server.wait_for(lambda: has_shown(push, "M117 hello"), 10, "what was typed to be shown")
        helpers.wait_polls(server, 2)
        lines = lines_of(push)
    shown = [line for line in lines if OWN.search(line)]
    assert len(shown) == 2, shown
    assert TYPED in shown[0]
    assert '"result":"X"' in shown[1]
    # an ok for each line that is shown as sent, and none for those that aren't
    sent = [line for line in lines if line.startswith(("Send: ", ">>> "))]
    acknowledged = [line for line in lines if re.match(r"(Recv: |<<< )ok", line)]
    assert abs(len(sent) - len(acknowledged)) <= 1
    assert any("M115" in line for line in sent)


def test_serial_log_has_them_all(server):
    assert any("M409" in line for line in server.sent())
    assert any('{"key"' in line for line in server.received())


def test_a_setting_shows_them(server):
    server.set_setting("plugins.rrfmodel.hide_polls", False)
    try:
        with PushListener(server, ADMIN) as push:
            helpers.wait_polls(server, 3)
            assert server.wait_for(lambda: has_shown(push, '{"key"'), 10, "the polls to be shown")
    finally:
        server.set_setting("plugins.rrfmodel.hide_polls", True)
