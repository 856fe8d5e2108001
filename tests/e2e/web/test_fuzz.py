"""A few of the requests and frames that ``make fuzz`` sends for as long as it is told."""

import pytest
from hypothesis import HealthCheck, Phase, given, settings

from tests.fuzz.served import REQUESTS, SERVED_FRAMES, Served
from tests.support.basedir import ADMIN, READER

BOARD = {"machine": "toolchanger", "speed": 20}

FEW = settings(
    max_examples=50,
    deadline=None,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=list(HealthCheck),
)


@pytest.fixture(scope="module")
def served(server, board):
    made = Served(server, board)
    yield made
    made.close()


def test_requests(served):
    FEW(given(REQUESTS)(served.request))()
    assert served.found() == []


def test_frames(served):
    FEW(given(SERVED_FRAMES)(served.frame))()
    assert served.found() == []


@pytest.mark.parametrize("user", [ADMIN, READER], ids=lambda user: user.name)
@pytest.mark.parametrize(
    "path",
    [
        "/api/plugin/rrfmodel",
        "/plugin/rrfmodel/printer/objects/query",
        "/plugin/rrfmodel/printer/gcode/script",
    ],
)
def test_what_is_nested_too_deep_is_the_senders_error(server, path, user):
    with server.client(user) as client:
        answer = client.post(path, data="[" * 100_000, headers={"Content-Type": "application/json"})
    assert answer.status_code in (400, 403), answer.text
