"""Faults that are there while the model is fetched for the first time, and two that last."""

import pytest

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts(
        "each has its own code for the serial line", once_for=("fault", "firmware", "counts")
    ),
]


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(serial=helpers.PATIENT)


@pytest.mark.parametrize(
    "fault, firmware, counts",
    [
        # what doesn't fit is fetched in smaller parts, and never in one again
        ("err_no_buffers:>2900", "3.4", {"out_of_buffers"}),
        ("err_no_buffers:>4350", "3.5.3", {"out_of_buffers"}),
        ("err_no_buffers:2", "3.3", {"out_of_buffers"}),
        ("truncated:2", "3.5.3", {"malformed"}),
        ("nul_bytes:6", "3.5.3", {"malformed"}),
        ("nesting_bomb:2", "3.5.3", {"malformed"}),
        ("debug_text:8", "3.5.3", {"malformed"}),
        ("sbc", "3.5.3", set()),
        ("exponent", "3.6", set()),
        ("garbage:30", "3.5.3", set()),
        ("baud:115200", "3.5.3", set()),
        ("slow:0.2", "3.5.3", set()),
    ],
)
def test_connecting_with_a_fault(server, board_factory, fault, firmware, counts):
    # a large model on the board that is to be short of buffers
    board = board_factory(
        machine="toolchanger" if "buffers" in fault else "corexy", firmware=firmware
    )
    helpers.disconnect(server)
    # the end of a connection may cut off a poll
    before = helpers.status(server)["counters"]
    server.connect(board.link)
    # all is fetched within a second
    server.wait_for(
        lambda: any(map(helpers.is_poll, helpers.commands(board))), 15, "the first question"
    )
    board.board.inject(fault)
    helpers.wait_ready(server, 60)
    board.board.clear(fault.partition(":")[0])
    helpers.wait_equal(server, board, helpers.RECOVERY_SECONDS)
    counters = helpers.status(server)["counters"]
    assert {name for name in helpers.WRONG if counters[name] > before[name]} == counts
    assert server.state().startswith("Operational")


def test_older_firmware_short_of_buffers(server, board_factory):
    """3.4 answers err -1 at once where 3.5 waits; the state says why nothing is asked."""
    board = board_factory(firmware="3.4")
    helpers.connect(server, board)
    before = helpers.status(server)["counters"]["out_of_buffers"]
    board.board.inject("few_buffers")
    server.wait_for(
        lambda: helpers.status(server)["blocked"] == "buffers", 20, "the state to say it"
    )
    helpers.change(board)
    server.wait_for(
        lambda: helpers.status(server)["counters"]["out_of_buffers"] >= before + 2, 30, "more of it"
    )
    board.board.clear("few_buffers")
    helpers.wait_equal(server, board, helpers.RECOVERY_SECONDS)
    assert helpers.status(server)["blocked"] is None


def test_channel_stuck_by_a_message_box(server, board_factory):
    """Only a reset frees such a channel; the plugin has to be there again after it."""
    board = board_factory(firmware="3.5.3")
    helpers.connect(server, board)
    board.board.inject("usb_box_stuck")
    # the plugin doesn't let such a command out unless it is told to
    server.set_setting("plugins.rrfmodel.operations.message_box", False)
    server.commands('M291 P"Continue?" S2')
    server.wait_for(lambda: helpers.status(server)["stale"], 30, "the data to be stale")
    server.set_setting("plugins.rrfmodel.operations.message_box", True)
    assert server.state().startswith("Operational")
    board.board.clear("usb_box_stuck")
    board.board.reset()
    helpers.change(board)
    helpers.wait_equal(server, board, helpers.RECOVERY_SECONDS + 15)
    assert server.state().startswith("Operational")
