"""A download waits for the board on Tornado's loop, and others are answered meanwhile."""

import asyncio
import json
from types import SimpleNamespace

import pytest
import tornado.httpclient
import tornado.httpserver
import tornado.netutil
import tornado.web

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

pytest.importorskip("octoprint.printer.connection", reason="OctoPrint 2.0 has connectors")
from octoprint_rrfmodel.link.network import download_handler as module  # noqa: E402
from octoprint_rrfmodel.link.network.card_refused import CardRefused  # noqa: E402
from octoprint_rrfmodel.link.network.downloads import Download  # noqa: E402
from octoprint_rrfmodel.rrf.card.listing import CardFile  # noqa: E402
from tests.support import coroutines  # noqa: E402

FILE = CardFile("0:/gcodes/a.gcode", 5, "2026-01-02T03:04:06")


class Card:
    """A card with one file, which comes when the test says so."""

    def __init__(self, folder):
        self.folder = folder
        self.downloads = self
        self.download = None
        self.refreshed = 0

    def file_of(self, name):
        return FILE if name == "a.gcode" else None

    def want(self, file):
        if self.download is None:
            self.download = Download(file, self.folder)
        self.download.hold()
        return self.download

    def refresh(self):
        self.refreshed += 1


class Theirs(tornado.web.RequestHandler):
    """What stands for OctoPrint's handler."""

    def initialize(self, access_validation=None):
        self._access_validation = access_validation

    async def get(self, storage, path, include_body=True):
        self.write(f"theirs {storage} {path}")

    async def head(self, storage, path):
        await self.get(storage, path, include_body=False)


class Other(tornado.web.RequestHandler):
    def get(self):
        self.write("other")


def allow(request):
    if "refused" in request.query:
        raise tornado.web.HTTPError(403)


@pytest.fixture
def card(tmp_path):
    made = Card(tmp_path)
    yield made
    assert made.download is None or not made.download.hold(), "somebody holds it for ever"


def run(card, talk):
    """Have ``talk(get)`` talk with a server; ``get(path)`` asks it."""

    async def all_of_it():
        handler = module.handler_of(Theirs, card)
        routes = [
            (r"/files/([^/]+)/(.*)", handler, {"access_validation": allow}),
            (r"/other", Other),
        ]
        (listening,) = tornado.netutil.bind_sockets(0, "127.0.0.1")
        server = tornado.httpserver.HTTPServer(tornado.web.Application(routes))
        server.add_socket(listening)
        base = f"http://127.0.0.1:{listening.getsockname()[1]}"
        client = tornado.httpclient.AsyncHTTPClient(force_instance=True)

        def get(path, **named):
            return client.fetch(base + path, raise_error=False, request_timeout=10, **named)

        try:
            await asyncio.wait_for(talk(get), 20)
        finally:
            client.close()
            server.stop()
            await server.close_all_connections()

    coroutines.run(all_of_it())


async def until_wanted(card):
    while card.download is None:
        await asyncio.sleep(0.01)


def test_others_are_answered_while_it_waits(card):
    async def talk(get):
        waiting = asyncio.ensure_future(get("/files/printer/a.gcode"))
        await until_wanted(card)
        for _ in range(3):
            assert (await get("/other")).body == b"other"
        assert not waiting.done()
        card.download.end.set_result(None)
        assert (await waiting).body == b"theirs printer a.gcode"

    run(card, talk)


@pytest.mark.parametrize(
    "path", ["/files/local/a.gcode", "/files/printer/none.gcode", "/files/timelapse/a.gcode"]
)
def test_whatever_is_not_the_boards_is_octoprints_own(card, path):
    async def talk(get):
        _, _, storage, name = path.split("/")
        assert (await get(path)).body.decode() == f"theirs {storage} {name}"

    run(card, talk)
    assert card.download is None


def test_only_the_head_needs_no_file(card):
    async def talk(get):
        assert (await get("/files/printer/a.gcode", method="HEAD")).code == 200

    run(card, talk)
    assert card.download is None


def test_who_may_not_download_has_nothing_fetched(card):
    async def talk(get):
        assert (await get("/files/printer/a.gcode?refused")).code == 403

    run(card, talk)
    assert card.download is None


@pytest.mark.parametrize(
    ("code", "status"),
    [("gone", 404), ("busy", 409), ("stopped", 409), ("no_room", 507)]
    + [("not_whole", 504), ("unreachable", 504)],
)
def test_what_does_not_come_is_told(card, code, status):
    async def talk(get):
        waiting = asyncio.ensure_future(get("/files/printer/a.gcode"))
        await until_wanted(card)
        card.download.end.set_exception(CardRefused(code, "a.gcode"))
        answer = await waiting
        assert answer.code == status
        assert json.loads(answer.body)["error"].endswith(".")

    run(card, talk)
    assert card.refreshed == (code in ("gone", "not_whole"))


def test_who_goes_away_wants_it_no_more(card):
    async def talk(get):
        reader, writer = None, None
        port = int((await get("/other")).effective_url.split(":")[2].split("/")[0])
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(b"GET /files/printer/a.gcode HTTP/1.1\r\nHost: x\r\n\r\n")
        await until_wanted(card)
        writer.close()
        # with nobody left it is closed, and can't be held any more
        while card.download.hold():
            card.download.release()
            await asyncio.sleep(0.01)
        card.download.end.set_exception(CardRefused("stopped"))
        # the next one is answered as ever
        assert (await get("/other")).code < 500

    run(card, talk)
    assert not card.download.hold()


def test_it_stands_in_front_of_octoprints_once(monkeypatch):
    theirs = type("Theirs", (Theirs,), {})
    monkeypatch.setattr(module, "served", SimpleNamespace(**{module.NAME: theirs}))
    module.offer(None)
    first = getattr(module.served, module.NAME)
    assert issubclass(first, theirs)
    module.offer(None)
    again = getattr(module.served, module.NAME)
    assert again.__mro__[1] is theirs


def test_an_octoprint_without_it_has_no_downloads_and_still_works(monkeypatch, caplog):
    monkeypatch.setattr(module, "served", SimpleNamespace())
    module.offer(None)
    assert module.NAME in caplog.text
