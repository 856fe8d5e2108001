"""Addresses and passwords of boards on the network: who may give them, and that none shows."""

import json

import pytest

from tests.support.basedir import ADMIN, OPERATOR, READER
from tests.support.push import PushListener

from .. import helpers
from . import bench

SECRET = "swordfish-42"


@pytest.fixture
def face(face_factory):
    made = face_factory(machine="cartesian", speed=10)
    made.board.execute(f'M551 P"{SECRET}"', channel="aux")
    return made


def host_of(face):
    return face.url.partition("//")[2]


@pytest.fixture
def server(server_factory, face):
    made = server_factory()
    yield made
    helpers.disconnect(made)
    bench.command(made, "network_password", host=host_of(face), password="")


def test_password_is_needed_kept_and_told_to_nobody(server, face):
    host = host_of(face)
    with PushListener(server, ADMIN) as push:
        bench.ask_to_connect(server, host)
        error = push.wait_for_event("Error", 20)
        assert "password" in error["error"]
        server.wait_for(lambda: not helpers.status(server)["connected"], 10, "the end")

        kept = bench.command(server, "network_password", host=host, password=SECRET)
        assert kept.status_code == 204
        assert bench.ask_to_connect(server, host, save=True).status_code == 204
        helpers.wait_ready(server, 20)
        server.wait_state("Operational", 20)
        told = json.dumps(push.messages)
    assert SECRET not in told
    for path in ("/api/connection", "/api/settings", "/api/plugin/rrfmodel", "/api/printer"):
        for headers in ({}, bench.NEW):
            assert SECRET not in server.get(path, headers=headers).text, path
    # as a page saves them that was never told any
    empty = {"plugins": {"rrfmodel": {"network": {"passwords": {}, "hosts": {}}}}}
    assert server.post("/api/settings", json=empty).status_code == 200
    server.disconnect()
    server.wait_disconnected()
    with server.client(OPERATOR) as operator:
        # the address is one that was given by somebody who may
        assert bench.ask_to_connect(operator, host).status_code == 204
    server.wait_state("Operational", 20)
    assert SECRET not in server.log()
    assert "sessionKey" not in server.log()
    connection = server.get("/api/connection", headers=bench.NEW).json()
    assert connection["current"]["parameters"] == {"host": host}
    assert connection["current"]["connector"] == "rrfmodel"


def test_only_who_may_change_settings_gives_an_address_or_a_password(server, face):
    host = host_of(face)
    with server.client(OPERATOR) as operator, server.client(READER) as reader:
        for client in (operator, reader):
            refused = bench.command(client, "network_password", host=host, password="x")
            assert refused.status_code == 403
            assert bench.ask_to_connect(client, "10.0.0.1").status_code == 403
    assert not helpers.status(server)["connected"]


@pytest.mark.parametrize(
    "host", ["", "duet/path", "user@duet", "http://duet?x=1", "file:///etc/passwd", "ftp://duet"]
)
def test_nothing_but_an_address_is_one(server, host):
    refused = bench.ask_to_connect(server, host)
    assert refused.status_code == 400
    assert "address" in refused.json()["error"]
    assert bench.command(server, "network_password", host=host, password="x").status_code == 400
