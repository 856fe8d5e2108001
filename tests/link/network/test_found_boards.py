"""Boards that say where they are are offered; who says anything else isn't, and does no harm."""

import contextlib
import fcntl
import os
import socket
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")
import zeroconf

from octoprint_rrfmodel.host.discovery import addresses_of_discovery
from octoprint_rrfmodel.link.network import found_boards
from octoprint_rrfmodel.link.network.found_boards import FoundBoards, board_of
from octoprint_rrfmodel.rrf.wire.announcement import announced
from tests.support.waiting import wait_for, within

HERE = "127.0.0.1"

WIFI = {"product": "DuetWiFi", "version": "2.1.0"}

ETHERNET = {"product": "RepRapFirmware for Duet 3 MB6HC", "version": "3.5.3"}


def service(
    name="duet", port=8080, properties=WIFI, addresses=(HERE,), kind=found_boards.SERVICE, **more
):
    return zeroconf.ServiceInfo(
        kind,
        f"{name}.{kind}",
        addresses=[socket.inet_aton(address) for address in addresses],
        port=port,
        properties=properties,
        server=more.get("server", f"{name}.local."),
    )


ALONE = Path(tempfile.gettempdir()) / f"tests-with-mdns-{os.getuid()}.lock"
"""Locked by who registers: the tests of both hosts run at the same time, and hear each other."""


@pytest.fixture
def network():
    """Somebody on the network who can register services; this host alone hears them."""
    with ALONE.open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        # on another thread it makes a loop of its own; the test's may have the browser's
        with ThreadPoolExecutor(1) as thread:
            made = thread.submit(zeroconf.Zeroconf, interfaces=[HERE]).result()
        with contextlib.closing(made):
            yield made


@pytest.fixture
def found():
    made = FoundBoards(lambda: [HERE], time.monotonic)
    yield made
    made.stop()


def looks():
    return [each for each in threading.enumerate() if each.name == "rrfmodel.found"]


def test_boards_come_and_go(network, found, monkeypatch):
    monkeypatch.setattr(found_boards, "CHANGE_SECONDS", 0.1)
    assert looks() == [], "nobody has asked yet"
    wifi, wired = service(), service("HTTP", 80, ETHERNET, ["192.168.1.9"], server="big.local.")
    printer = service("laser", 8081, {"product": "(GPL Ghostscript)", "ty": "LaserJet"})
    for each in (wifi, printer, wired):
        network.register_service(each)
    wanted = {
        f"{HERE}:8080": "duet (DuetWiFi 2.1.0)",
        "192.168.1.9": "big (RepRapFirmware for Duet 3 MB6HC 3.5.3)",
    }
    wait_for(lambda: found.boards() == wanted, 20, "both boards")
    assert len(looks()) == 1
    network.unregister_service(wired)
    wait_for(lambda: list(found.boards()) == [f"{HERE}:8080"], 30, "the one that stays")
    began = time.monotonic()
    found.stop()
    assert time.monotonic() - began < within(4)
    assert looks() == []
    found.boards()
    assert looks() == [], "after the plugin's end nobody looks"


def test_a_change_waits_for_its_time():
    """With each one OctoPrint's pages set their panel anew, whoever is writing there."""
    now = [100.0]
    made = FoundBoards(lambda: [HERE], lambda: now[0])
    told = {"a": "b"}
    made._tell(told)
    assert made._boards == told
    for seconds, wanted in ((1, told), (58, told), (1, {})):
        now[0] += seconds
        made._tell({})
        assert made._boards == wanted


def test_nobody_looks_any_more_when_nobody_asks(found, monkeypatch):
    monkeypatch.setattr(found_boards, "ASKED_SECONDS", 0.1)
    found.boards()
    wait_for(lambda: not looks(), 10, "the end of the look")
    monkeypatch.setattr(found_boards, "ASKED_SECONDS", 60)
    found.boards()
    assert len(looks()) == 1


def test_a_look_ends_though_somebody_asks_all_the_time(found, monkeypatch):
    found.boards()
    (first,) = looks()
    monkeypatch.setattr(found_boards, "LOOK_SECONDS", 0.1)
    wait_for(lambda: found.boards() is not None and not first.is_alive(), 10, "another look")
    assert first not in looks()


# Zeroconf leaves a socket behind where it can't begin, which Python then closes
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("has", ["no zeroconf", "no discovery", "no network"])
def test_without_what_it_needs_no_board_is_offered(monkeypatch, has):
    addresses = [] if has == "no discovery" else [HERE]
    if has == "no zeroconf":
        monkeypatch.setitem(sys.modules, "zeroconf", None)
    if has == "no network":
        addresses = ["192.0.2.1"]
    made = FoundBoards(lambda: addresses, time.monotonic)
    assert made.boards() == {}
    wait_for(lambda: not looks(), 10, "the end of the look")
    assert made.boards() == {}
    assert looks() == [], "it isn't tried again at once"


@pytest.mark.parametrize(
    ("implementation", "wanted"),
    [
        (SimpleNamespace(get_interface_addresses=lambda: iter(["10.0.0.2"])), ["10.0.0.2"]),
        (SimpleNamespace(), []),
        (None, []),
    ],
)
def test_octoprints_plugin_says_where(implementation, wanted):
    info = SimpleNamespace(implementation=implementation)
    plugins = SimpleNamespace(get_plugin_info=lambda name, require_enabled: info)
    assert addresses_of_discovery(plugins) == wanted


def test_without_octoprints_plugin_there_is_nowhere():
    plugins = SimpleNamespace(get_plugin_info=lambda name, require_enabled: None)
    assert addresses_of_discovery(plugins) == []


def test_no_more_boards_than_anybody_looks_through(found):
    seen = {}
    for number in range(100):
        told = service(f"duet-{number}", addresses=[f"10.0.0.{number + 1}"])
        found._take(True, told.name, lambda name, told=told: told, seen)
    assert len(seen) == found_boards.MOST_BOARDS


@pytest.mark.parametrize(
    "hostile",
    [
        service(port=0),
        service(addresses=["224.0.0.1"]),
        service(addresses=["0.0.0.0"]),
        service(addresses=["255.255.255.255"]),
        service(addresses=[]),
        service(properties={}),
        service(properties={"product": "DuetWiFi"}),
        service(properties={b"product": None, b"version": b"1"}),
        service(properties={"product": "OctoPrint", "version": "2.0"}),
        SimpleNamespace(server="x", properties={b"product": b"Duet", b"version": b"1"}, port=70000),
        SimpleNamespace(server=None, properties={}, port=80),
        None,
    ],
)
def test_what_is_no_board_or_nowhere_is_not_offered(hostile):
    if isinstance(hostile, SimpleNamespace):
        hostile.parsed_addresses = lambda: ["10.0.0.1"]
    assert board_of(hostile) is None


def test_address_of_the_sixth_version_is_passed_over():
    told = service()
    told.addresses = [socket.inet_pton(socket.AF_INET6, "fe80::1"), socket.inet_aton("10.0.0.1")]
    assert board_of(told)[0] == "10.0.0.1:8080"


@pytest.mark.parametrize(
    ("server", "product", "version", "shown"),
    [
        ("duet.local.", b"DuetWiFi", b"1.26", "duet (DuetWiFi 1.26)"),
        ("<b>x</b>\x1b[1m\n.local.", b"Duet", b"1", "bx/b1m (Duet 1)"),
        ('"><script>', b"Duet", b"3.5<br>", "script (Duet 3.5br)"),
        ("d" * 200, b"RepRapFirmware" * 99, b"9" * 999, None),
        ("duet.local.", b"\xff\xfeDuet", b"\x001", "duet (Duet 1)"),
    ],
)
def test_names_are_plain_and_short(server, product, version, shown):
    told = announced(server, {b"product": product, b"version": version})
    assert len(told) <= 3 * 40 + len(" ( )")
    if shown is not None:
        assert told == shown
