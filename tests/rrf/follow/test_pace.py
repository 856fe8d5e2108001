"""The time between two polls."""

import pytest

from octoprint_rrfmodel.rrf.follow.pace import (
    BEGINNING_SECONDS,
    CATCHING_UP_SECONDS,
    IDLE_SECONDS,
    IDLE_SHARE,
    LONGEST_SECONDS,
    OVERHEAD_BYTES,
    PRINTING_SECONDS,
    PRINTING_SHARE,
    Pace,
)


def paced(seconds=None, length=1000, baudrate=0, failures=0):
    pace = Pace()
    pace.connected(baudrate)
    if seconds is not None:
        pace.answered(length, seconds)
    for _ in range(failures):
        pace.failed()
    return pace


def test_fast_board_is_polled_at_the_shortest_intervals():
    pace = paced(0.01)
    assert pace.wait(printing=False) == IDLE_SECONDS
    assert pace.wait(printing=True) == PRINTING_SECONDS
    assert pace.wait(printing=False, begins=True) == BEGINNING_SECONDS
    assert pace.wait(printing=False, behind=True) == CATCHING_UP_SECONDS


def test_host_that_prints_comes_first_even_while_keys_wait():
    pace = paced(0.01)
    assert pace.wait(printing=True, behind=True, begins=True) == PRINTING_SECONDS


@pytest.mark.parametrize("seconds", [0.5, 1.0, 2.0, 10.0])
def test_polls_take_no_more_than_their_share_of_the_line(seconds):
    pace = paced(seconds)
    for printing, share in ((True, PRINTING_SHARE), (False, IDLE_SHARE)):
        wait = pace.wait(printing=printing)
        assert seconds / (seconds + wait) <= share + 1e-9


def test_slow_line_counts_and_not_a_board_that_thinks():
    # 2880 bytes and what is around them, at 115200 bits a second
    pace = paced(5.0, length=2880 - OVERHEAD_BYTES, baudrate=115200)
    assert pace.wait(printing=True) == pytest.approx(0.25 * 0.95 / 0.05)


def test_usb_that_is_faster_than_its_rate_counts_by_the_clock():
    pace = paced(0.02, length=2880, baudrate=9600)
    assert pace.wait(printing=True) == PRINTING_SECONDS


def test_each_failure_makes_it_wait_longer_up_to_a_limit():
    waits = [paced(0.01, failures=failures).wait(printing=False) for failures in range(1, 12)]
    assert waits[:3] == [IDLE_SECONDS * factor for factor in (2, 4, 8)]
    assert waits == sorted(waits)
    assert waits[-1] == LONGEST_SECONDS


def test_board_that_is_silent_for_days_is_still_asked_now_and_then():
    assert paced(0.01, failures=5000).wait(printing=False) == LONGEST_SECONDS


def test_answer_ends_the_waiting():
    pace = paced(0.01, failures=5)
    pace.answered(1000, 0.01)
    assert pace.wait(printing=False) == IDLE_SECONDS


def test_new_connection_begins_anew():
    pace = paced(10.0, failures=5)
    pace.connected(0)
    assert pace.wait(printing=False) == IDLE_SECONDS


USB = 115200
"""Rate that is set; the board's replies come as fast as its USB carries them."""


def heard(pace, *replies):
    """Return what the line is taken for; replies are bytes and the part of the line's time."""
    for length, part in replies:
        pace.answered(length, length * 10 / USB * part)
    return pace.bytes_a_second


def connected():
    pace = Pace()
    pace.connected(USB)
    return pace


def test_line_is_slow_until_enough_was_heard():
    pace = connected()
    assert pace.bytes_a_second == USB / 10
    assert heard(pace, *[(900, 0.1)] * 3) == USB / 10
    assert heard(pace, (900, 0.1)) == 0


def test_usb_stays_fast_though_some_replies_come_late():
    pace = connected()
    assert heard(pace, *[(1000, 0.1)] * 6) == 0
    assert heard(pace, *[(1000, 2.0), (300, 1.5)] * 2) == 0


def test_clock_that_was_held_up_once_makes_no_uart_fast():
    pace = connected()
    assert heard(pace, *[(1000, 1.05)] * 6, *[(400, 0.1), (400, 0.1)], *[(1000, 1.05)] * 2) > 0


def test_uart_that_was_taken_for_usb_is_found_out():
    pace = connected()
    assert heard(pace, *[(1000, 0.5)] * 3) == 0
    assert heard(pace, *[(1000, 1.05)] * 12) == USB / 10


def test_line_that_says_it_is_fast_is_never_spared():
    pace = Pace()
    pace.connected(1_000_000)
    for _ in range(20):
        pace.answered(1000, 1.0)
    assert pace.bytes_a_second == 0
