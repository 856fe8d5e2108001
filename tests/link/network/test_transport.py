"""Requests to a board: one connection each, an end in sight, nobody else asked."""

import io
import itertools
import math
import threading
import time

import pytest

from octoprint_rrfmodel.link.network.address import Address
from octoprint_rrfmodel.link.network.transport import NotConnected, Transport, Unreachable
from tests.support.waiting import within

from .standin import StandIn, answer


def transport_to(standin, resolve=None):
    return Transport(Address("http", "127.0.0.1", standin.port), resolve)


def get(transport, path="/rr_model", *, seconds=3.0, most=1000, **headers):
    return transport.get(path, headers, seconds=seconds, most=most)


def test_request_is_one_write_with_few_headers():
    with StandIn(lambda _: answer("{}")) as standin:
        transport = transport_to(standin)
        assert get(transport, "/rr_model?key=&flags=d99fn", **{"X-Session-Key": "5"}) == (
            200,
            b"{}",
        )
        assert get(transport).status == 200
    first = standin.requests[0].decode()
    assert first.startswith("GET /rr_model?key=&flags=d99fn HTTP/1.1\r\n")
    assert first.endswith("\r\n\r\n"), "a board takes what comes later for another request"
    assert "X-Session-Key: 5\r\n" in first
    assert len(first) < 300
    assert len(standin.requests) == 2


def test_answer_without_length_ends_with_the_connection():
    reply = b"HTTP/1.1 500 Unknown request\r\nConnection: close\r\n\r\n<html>"
    with StandIn(lambda _: reply) as standin:
        assert get(transport_to(standin)) == (500, b"<html>")


def test_no_redirect_is_followed():
    with StandIn(lambda _: answer("", "302 Found", "Location: http://127.0.0.1:9/")) as standin:
        assert get(transport_to(standin)).status == 302
    assert len(standin.requests) == 1


def test_no_proxy_of_the_environment_is_asked(monkeypatch):
    for name in ("http_proxy", "HTTP_PROXY", "https_proxy", "ALL_PROXY"):
        monkeypatch.setenv(name, "http://127.0.0.1:9")
    with StandIn(lambda _: answer("{}")) as standin:
        assert get(transport_to(standin)).status == 200


@pytest.mark.parametrize(
    "reply",
    [
        answer("x" * 20000),
        b"HTTP/1.1 200 OK\r\n\r\n" + b"x" * 20000,
        b"HTTP/1.1 200 OK\r\n" + b"".join(b"X-%d: %s\r\n" % (n, b"y" * 900) for n in range(30)),
        b"HTTP/1.1 200 OK\r\nX: " + b"y" * 60000,
        b"SSH-2.0-OpenSSH_9.2\r\n",
        b"",
    ],
)
def test_what_is_too_long_or_no_answer_is_none(reply):
    with StandIn(lambda _: reply) as standin, pytest.raises(Unreachable):
        get(transport_to(standin))


def test_answer_that_trickles_ends_with_its_time():
    never = threading.Event()

    def drops():
        yield b"HTTP/1.1 200 OK\r\n\r\n"
        for _ in itertools.count():
            never.wait(0.05)
            yield b"x"

    with StandIn(lambda _: drops()) as standin:
        began = time.monotonic()
        with pytest.raises(Unreachable, match="in time"):
            get(transport_to(standin), seconds=0.4)
    assert time.monotonic() - began < within(2)


def test_name_is_looked_up_once_and_the_place_stays_the_same():
    asked = []

    with StandIn(lambda _: answer("{}")) as standin:

        def resolve(host, port):
            asked.append(host)
            # the first doesn't answer
            return ("127.0.0.1", 1), ("127.0.0.1", port)

        transport = Transport(Address("http", "duet.local", standin.port), resolve)
        for _ in range(3):
            get(transport)
    assert asked == ["duet.local"]
    assert b"Host: duet.local:" in standin.requests[0]


def test_reason_says_nothing_of_the_request():
    transport = Transport(Address("http", "127.0.0.1", 1))
    with pytest.raises(Unreachable) as caught:
        get(transport, "/rr_connect?password=secret")
    assert "secret" not in repr(caught.value)
    assert caught.value.__cause__ is None


def test_file_is_sent_in_pieces_with_its_length():
    content, told = b"G1 X1\n" * 30000, []
    with StandIn(lambda _: answer('{"err":0}')) as standin:
        transport = transport_to(standin)
        headers = {"Content-Length": str(len(content))}
        found = transport.post("/rr_upload?name=a", headers, io.BytesIO(content), told.append)
    assert found.body == b'{"err":0}'
    head, _, body = standin.requests[0].partition(b"\r\n\r\n")
    assert body == content
    assert b"chunked" not in head.lower()
    assert told[-1] == len(content)
    assert len(told) > 1


def test_file_is_read_as_it_comes():
    with StandIn(lambda _: answer(b"abc" * 1000)) as standin:
        response = transport_to(standin).open("/rr_download?name=a", {}, 10000)
        assert response.status == 200
        assert response.read(5) == b"abcab"
        assert len(response.read()) == 2995
        response.close()


def test_nothing_has_left_where_nobody_listens():
    with StandIn(lambda _: answer("")) as standin:
        port = standin.port
    with pytest.raises(NotConnected):
        Transport(Address("http", "127.0.0.1", port)).send("POST", "/", {}, most=10)


def test_answer_may_take_as_long_as_it_takes():
    release = threading.Event()

    def reply(_):
        release.wait(10)
        return answer("said")

    with StandIn(reply) as standin:
        found = []
        thread = threading.Thread(
            target=lambda: found.append(
                transport_to(standin).send("POST", "/", {}, most=10, end=math.inf)
            )
        )
        thread.start()
        release.set()
        thread.join(10)
        assert found == [(200, b"said")]
