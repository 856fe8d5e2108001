"""All parts but OctoPrint with a simulated board over HTTP: the model is the board's, cheaply."""

import json
import time
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

pytest.importorskip("octoprint.printer.connection", reason="OctoPrint 2.0 has connectors")

from octoprint_rrfmodel.assembly import Assembly  # noqa: E402
from octoprint_rrfmodel.link.network.address import address_of  # noqa: E402
from octoprint_rrfmodel.link.network.nobody import Nobody  # noqa: E402
from octoprint_rrfmodel.link.network.session import Session  # noqa: E402
from octoprint_rrfmodel.link.network.transport import Transport  # noqa: E402
from octoprint_rrfmodel.rrf.model import dsf  # noqa: E402
from octoprint_rrfmodel.rrf.wire.rr import path_of  # noqa: E402
from octoprint_rrfmodel.simulator.board import Board  # noqa: E402
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard  # noqa: E402
from octoprint_rrfmodel.simulator.network.sbc_board import SbcBoard  # noqa: E402
from tests.e2e import helpers  # noqa: E402
from tests.support.hosts import host_of  # noqa: E402
from tests.support.waiting import wait_for  # noqa: E402

MOST_A_SECOND = 3.0


class Printer(Nobody):
    """OctoPrint's printer, which nothing is asked of here."""


@pytest.fixture
def asked(monkeypatch):
    """The times at which a board was asked something."""
    times, get = [], Transport.get

    def counted(self, *given, **named):
        times.append(time.monotonic())
        return get(self, *given, **named)

    monkeypatch.setattr(Transport, "get", counted)
    return times


@pytest.fixture
def parts(tmp_path):
    nothing = SimpleNamespace(
        is_operational=lambda: False,
        is_printing=lambda: False,
        is_paused=lambda: False,
        get_hooks=lambda hook: {},
        get_helpers=lambda *names: None,
        register_callback=lambda callback: None,
        unregister_callback=lambda callback: None,
    )
    settings = SimpleNamespace(
        get_boolean=lambda path: False,
        get=lambda path, **options: {"enabled": False} if path == ["simulator"] else None,
        get_float=lambda path, **options: None,
        global_get=lambda path: None,
        global_get_basefolder=lambda name: str(tmp_path),
    )
    made = Assembly(
        host_of(
            tmp_path,
            nothing,
            settings,
            profiles=lambda: SimpleNamespace(get_current_or_default=lambda: {"id": "_default"}),
        )
    )
    threads = (made.worker, *made.networks)
    for thread in threads:
        thread.start()
    yield made
    made.networks[0].link.close()
    for thread in threads:
        thread.stop()


class OwnBehindComputer:
    """What the computer in front of a board says of the model, to somebody else."""

    def __init__(self, face):
        self._session = Session(Transport(address_of(face.url)), lambda: "")

    def differences(self, model):
        whole = json.loads(self._session.ask("/machine/model", most=10**6))
        del whole["job"]["layers"]
        return [
            difference
            for key, value in whole.items()
            if key not in ("inputs", *dsf.LEFT_OUT)
            for difference in helpers.differences(model.get(key), value, key)
        ]


class Own:
    """What the board itself says of its model, to somebody else."""

    def __init__(self, face):
        self._session = Session(Transport(address_of(face.url)), lambda: "")

    def value(self, key):
        items = []
        while True:
            flags = f"d99vnoa{len(items)}"
            told = json.loads(self._session.ask(path_of("model", key=key, flags=flags)))
            if not isinstance(told["result"], list):
                return told["result"]
            items += told["result"]
            if not told["next"]:
                return items

    def differences(self, model):
        return [
            difference
            for key in model
            if key not in ("seqs", "inputs")
            for difference in helpers.differences(model[key], self.value(key), key)
        ]


def wait_equal(parts, own):
    last = []

    def is_equal():
        last[:] = own.differences(parts.model())
        return not last

    try:
        wait_for(is_equal, 20, "the model to be the board's")
    except AssertionError as error:
        raise AssertionError(f"{error}: {last[:5]}") from None


def mesh(parts):
    """Return the heights of the bed in Klipper's words."""
    return parts.moonraker.objects.query({"bed_mesh": None})["status"]["bed_mesh"]["probed_matrix"]


STANDALONE, SBC = (HttpBoard, Own, "net_refused"), (SbcBoard, OwnBehindComputer, "net_sbc_down")

BOARDS = [
    ("cartesian", "3.5.3", STANDALONE),
    ("toolchanger", "3.3", STANDALONE),
    ("corexy", "3.6", STANDALONE),
    ("toolchanger", "3.4", SBC),
    ("corexy", "3.6", SBC),
]


@pytest.mark.parametrize(("machine", "firmware", "kind"), BOARDS)
def test_model_is_the_boards_through_resets_and_gaps(parts, asked, machine, firmware, kind):
    (network,) = parts.networks
    make, own_of, gap = kind
    with make(Board(machine=machine, firmware=firmware, speed=5)) as face:
        network.open(Printer(), address_of(face.url))
        wait_for(lambda: parts.status()["ready"], 30, "the whole model")
        assert parts.status()["link"] == "network"
        assert parts.status()["protocol"] == ("rr" if make is HttpBoard else "dsf")
        own = own_of(face)
        wait_equal(parts, own)

        face.board.execute("G29 S1", channel="aux")
        wait_for(lambda: mesh(parts) != [[]], 20, "the mesh")
        assert [len(row) for row in mesh(parts)] == [11] * 10

        since = len(asked), time.monotonic()
        replies = parts.status()["counters"]["replies"]
        wait_for(lambda: parts.status()["counters"]["replies"] >= replies + 5, 30, "five replies")
        rate = (len(asked) - since[0]) / (time.monotonic() - since[1])
        assert rate <= MOST_A_SECOND, rate

        face.board.inject(gap)
        wait_for(lambda: parts.status()["blocked"] == "unreachable", 20, "the gap")
        face.board.clear(gap)
        wait_for(lambda: parts.status()["blocked"] is None, 30, "its end")
        resets = parts.status()["resets"]
        face.board.reset()
        wait_for(lambda: parts.status()["resets"] > resets, 60, "the reset")
        wait_for(lambda: parts.status()["ready"], 30, "the whole model")
        wait_equal(parts, own_of(face))
        network.close(network.link.printer)
        wait_for(lambda: not parts.status()["is_rrf"], 10, "the end")
        assert parts.status()["link"] == "serial"
