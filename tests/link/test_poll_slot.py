"""Questions that wait for the one poll: how many, in which order, and what ends them."""

import pytest

from octoprint_rrfmodel.link.poll_slot import GONE, MOST_QUERIES, Queries, TooManyQueries


@pytest.fixture
def queries():
    made = Queries()
    made.open()
    return made


def test_are_handed_out_in_order(queries):
    futures = [queries.ask(key, "v") for key in ("heat", "move")]
    assert len(queries) == 2
    found = [queries.next() for _ in futures]
    assert [(request.key, request.flags) for request, _ in found] == [("heat", "v"), ("move", "v")]
    assert [future for _, future in found] == futures
    assert queries.next() == (None, None)


def test_so_many_may_wait(queries):
    for number in range(MOST_QUERIES):
        queries.ask(str(number), "")
    with pytest.raises(TooManyQueries):
        queries.ask("one more", "")
    queries.next()
    assert not queries.ask("another", "").done()


def test_one_that_was_cancelled_is_left_out(queries):
    queries.ask("heat", "").cancel()
    kept = queries.ask("move", "")
    request, future = queries.next()
    assert (request.key, future) == ("move", kept)


def test_end_of_the_connection_fails_those_that_wait(queries):
    future = queries.ask("heat", "")
    queries.close()
    with pytest.raises(RuntimeError, match=GONE):
        future.result(0)
    assert len(queries) == 0


def test_without_a_printer_a_question_fails_at_once():
    with pytest.raises(RuntimeError, match=GONE):
        Queries().ask("heat", "").result(0)
