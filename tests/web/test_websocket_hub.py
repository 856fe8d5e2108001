"""What sockets ask is worked on off Tornado's loop, which goes on meanwhile."""

import asyncio
import json
import threading
from functools import partial
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
from tornado.ioloop import IOLoop

from octoprint_rrfmodel.web.moonraker import websocket
from octoprint_rrfmodel.web.moonraker.methods import Methods
from octoprint_rrfmodel.web.moonraker.off_loop import OffLoop
from octoprint_rrfmodel.web.moonraker.printer_methods import printer_methods
from octoprint_rrfmodel.web.moonraker.subscribers import Subscribers
from octoprint_rrfmodel.web.moonraker.websocket import PrinterSocket, SocketHub
from tests.support import coroutines
from tests.support.waiting import within

OBJECTS = {"objects": {"toolhead": None}}


class Socket:
    """A client that has said who it is; what it gets is kept."""

    on_message = PrinterSocket.on_message

    def __init__(self, hub):
        self._hub = hub
        self.id = 1
        self.is_named = False
        self.got = []
        self.caller = SimpleNamespace(may=lambda permission: True)
        hub.opened(self)

    def ask(self, method, number, params=None):
        call = {"jsonrpc": "2.0", "method": method, "params": params or {}, "id": number}
        return asyncio.ensure_future(self.on_message(json.dumps(call)))

    def send(self, text):
        self.got.append(json.loads(text))


class Bench:
    """The hub with objects whose computation waits until the test lets it go; made on a loop."""

    def __init__(self):
        self.may_go_on = threading.Event()
        self.has_begun = threading.Event()
        self.threads = set()
        self.queries = self.stops = 0
        objects = SimpleNamespace(
            state=lambda: "ready",
            query=self.query,
            server_info=lambda count: {"websocket_count": count},
        )
        loop = IOLoop.current()
        run = OffLoop(loop).run
        scripts = SimpleNamespace(emergency_stop=self.stop)
        methods = printer_methods(objects, scripts, None, websocket_count=lambda: 1)
        self.hub = SocketHub(
            Methods(methods),
            objects.state,
            Subscribers(lambda: None, loop, run),
            find_user=None,
            run=run,
            redeem=None,
        )

    def query(self, wanted):
        self.queries += 1
        self.threads.add(threading.current_thread())
        self.has_begun.set()
        assert self.may_go_on.wait(within(20))
        return {"eventtime": 1.0, "status": {"toolhead": {"extruder": "extruder"}}}

    def stop(self):
        self.stops += 1

    async def begun(self):
        """Let the loop run until the computation waits."""
        waiting = asyncio.get_running_loop().run_in_executor(None, self.has_begun.wait, within(20))
        assert await waiting


def on_a_loop(test):
    def run():
        coroutines.run(test(Bench))

    run.__name__, run.__doc__ = test.__name__, test.__doc__
    return run


def handshake(monkeypatch, token, shown):
    """Return the caller that a handshake comes to, ``None`` where it is refused."""
    redeemed = {"good": caller_like("redeemed")}
    monkeypatch.setattr(websocket, "caller_of", lambda app, request, find_user: shown)
    refusals = []
    socket = SimpleNamespace(
        _app=None,
        _hub=SimpleNamespace(redeem=redeemed.get, find_user=None),
        request=None,
        get_query_argument=lambda name, otherwise: token,
        set_status=refusals.append,
        finish=lambda answer: None,
    )
    socket._without_token = partial(PrinterSocket._without_token, socket)
    PrinterSocket.prepare(socket)
    assert refusals == ([403] if socket.caller is None else [])
    return socket.caller and (socket.caller.name, socket._has_token)


def caller_like(name, is_of_session=False):
    return SimpleNamespace(name=name, is_of_session=is_of_session, may_read=lambda: True)


KEY, SESSION = caller_like("key"), caller_like("session", True)


@pytest.mark.parametrize(
    ("token", "shown", "found"),
    [
        (None, KEY, ("key", False)),
        (None, SESSION, ("session", False)),
        (None, None, None),
        ("good", SESSION, ("redeemed", True)),
        # KlipperScreen's, which has its key there
        ("wrong", KEY, ("key", False)),
        ("wrong", SESSION, None),
        ("wrong", None, None),
    ],
)
def test_who_is_let_in(monkeypatch, token, shown, found):
    assert handshake(monkeypatch, token, shown) == found


@on_a_loop
async def test_the_loop_goes_on_while_a_query_is_worked_on(make):
    bench = make()
    socket, other = Socket(bench.hub), Socket(bench.hub)
    asked = socket.ask("printer.objects.query", 1, OBJECTS)
    # that this goes on shows it: the computation waits for this thread
    await bench.begun()
    assert threading.current_thread() not in bench.threads
    # and an emergency stop waits for nobody
    await other.ask("printer.emergency_stop", 1)
    assert bench.stops == 1 and other.got[0]["result"] == "ok"
    assert not asked.done() and socket.got == []
    bench.may_go_on.set()
    await asked
    assert socket.got[0]["result"]["status"] == {"toolhead": {"extruder": "extruder"}}


@on_a_loop
async def test_news_of_the_computer_are_told_to_clients_that_are_named(make):
    bench = make()
    named, other = Socket(bench.hub), Socket(bench.hub)
    named.is_named = True
    bench.hub.notify("notify_proc_stat_update", [{"cpu_temp": 40.0}], "READ", True)
    assert [each["method"] for each in named.got] == ["notify_proc_stat_update"]
    assert other.got == []


@on_a_loop
async def test_answers_come_in_the_order_of_the_questions(make):
    bench = make()
    socket = Socket(bench.hub)
    asked = [socket.ask("printer.objects.query", 1, OBJECTS)]
    await bench.begun()
    asked.append(socket.ask("server.info", 2))
    asked.append(socket.ask("printer.objects.subscribe", 3, OBJECTS))
    bench.may_go_on.set()
    await asyncio.gather(*asked)
    assert [each["id"] for each in socket.got] == [1, 2, 3]


@on_a_loop
async def test_work_for_a_socket_that_is_gone_is_dropped(make):
    bench = make()
    socket, other = Socket(bench.hub), Socket(bench.hub)
    asked = [other.ask("printer.objects.subscribe", 1, OBJECTS)]
    await bench.begun()
    asked += [socket.ask("printer.objects.query", number, OBJECTS) for number in range(5)]
    # until they wait in the queue
    await asyncio.sleep(0)
    bench.hub.closed(socket)
    bench.hub.closed(other)
    bench.may_go_on.set()
    await asyncio.gather(*asked)
    # begun, and not told any more; not even begun
    assert bench.queries == 1
    assert socket.got == other.got == []
    assert len(bench.hub._subscribers) == 0


@on_a_loop
async def test_an_error_is_said_as_klipper_says_it(make):
    bench = make()
    socket = Socket(bench.hub)
    for line in ("Error: G28: no endstop", "Warning: cold"):
        bench.hub.responded(line)
    assert [each["params"] for each in socket.got] == [
        ["!! Error: G28: no endstop"],
        ["Warning: cold"],
    ]
