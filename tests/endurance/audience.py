"""Who looks meanwhile: pages, sockets and requests that come and go."""

import contextlib
import json
import random
import threading

import requests
import websocket

from tests.support.basedir import ADMIN, READER
from tests.support.browser import CHROMIUM, FLAGS, SIZE, open_octoprint
from tests.support.push import PushListener

from .picture import PATH

ROUTES = ("status", "model", "model/live", "history", "metrics", "printer/objects/list", "setup")

VIEWS = ("machine", "job", "chart", "model")

SUBSCRIBED = {"toolhead": None, "heater_bed": None, "print_stats": None, "extruder": None}

VISITORS = 2

PAGE_EVERY, PAGE_STAYS = 40, 8
"""Seconds between two pages, and for how long each is open: Chromium takes most of a core."""


class Audience:
    """A context manager; with ``has_pages`` a browser's page comes now and then.

    ``visits`` counts who came, ``errors`` has what went wrong with them.
    """

    def __init__(self, server, seed, has_pages):
        self._server = server
        self._chance = random.Random(f"{seed} audience")
        self._over = threading.Event()
        self._room = threading.Condition()
        self._is_let_in, self._inside = True, 0
        self.visits = {}
        self.errors = []
        rows = [self._visit_sockets] * VISITORS
        if has_pages and CHROMIUM.exists():
            rows.append(self._visit_pages)
        self._threads = [threading.Thread(target=row, daemon=True) for row in rows]

    def __enter__(self):
        for thread in self._threads:
            thread.start()
        return self

    def __exit__(self, *exc_info):
        self._over.set()
        with self._room:
            self._is_let_in = True
            self._room.notify_all()
        for thread in self._threads:
            thread.join(60)

    @contextlib.contextmanager
    def sent_home(self):
        """Nobody is there meanwhile."""
        with self._room:
            self._is_let_in = False
            self._room.wait_for(lambda: not self._inside, 90)
        try:
            yield
        finally:
            with self._room:
                self._is_let_in = True
                self._room.notify_all()

    @contextlib.contextmanager
    def _a_visit(self, kind):
        with self._room:
            self._room.wait_for(lambda: self._is_let_in)
            self._inside += 1
        try:
            yield
            self.visits[kind] = self.visits.get(kind, 0) + 1
        except Exception as error:
            if not self._over.is_set():
                self.errors.append(f"{kind}: {type(error).__name__}: {error}"[:500])
        finally:
            with self._room:
                self._inside -= 1
                self._room.notify_all()

    def _visit_sockets(self):
        ways = {
            "requests": self._ask,
            "OctoPrint's socket": self._listen,
            "Moonraker's socket": self._subscribe,
            "live model": self._watch,
        }
        while not self._over.is_set():
            kind = self._chance.choice(list(ways))
            with self._a_visit(kind):
                ways[kind]()
            self._over.wait(self._chance.uniform(0.5, 3))

    def _stay(self):
        # those who are inside are asked to leave
        for _ in range(self._chance.randrange(1, 16)):
            if self._over.wait(0.25) or not self._is_let_in:
                return

    def _ask(self):
        with self._server.client(READER) as client:
            for route in ROUTES:
                answer = client.get(f"/plugin/rrfmodel/{route}")
                assert answer.status_code != 500, f"{route}: {answer.status_code} {answer.text}"

    def _watch(self):
        """Ask the board itself, and don't always wait for its answer."""
        with self._server.client(READER) as client, contextlib.suppress(requests.Timeout):
            for key in ("state", "heat", ""):
                client.get("/plugin/rrfmodel/model/live", params={"key": key}, timeout=2)

    def _listen(self):
        with PushListener(self._server, ADMIN):
            self._stay()

    def _subscribe(self):
        socket = websocket.WebSocket(skip_utf8_validation=True)
        address = self._server.url.replace("http", "ws", 1) + PATH
        socket.connect(address, timeout=30, header={"X-Api-Key": READER.api_key})
        try:
            call = {"method": "printer.objects.subscribe", "params": {"objects": SUBSCRIBED}}
            socket.send(json.dumps({"jsonrpc": "2.0", "id": 1, **call}))
            while json.loads(socket.recv()).get("id") != 1:
                pass
            # who never reads again is thrown out by the plugin, who hangs up isn't missed
            self._stay()
        finally:
            socket.shutdown()

    def _visit_pages(self):
        from playwright.sync_api import sync_playwright

        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=FLAGS)
            while not self._over.wait(self._chance.uniform(0.5, 1.5) * PAGE_EVERY):
                with self._a_visit("pages"):
                    self._look(browser)
            browser.close()

    def _look(self, browser):
        context = browser.new_context(viewport=SIZE)
        try:
            page = context.new_page()
            page.on(
                "pageerror",
                lambda error: self.errors.append(f"page: {error.stack or error}"[:500]),
            )
            view = self._chance.choice(VIEWS)
            open_octoprint(page, self._server, ADMIN, f"/#tab_plugin_rrfmodel/{view}")
            for _ in range(PAGE_STAYS * 2):
                page.wait_for_timeout(500)
                if self._over.is_set() or not self._is_let_in:
                    return
        finally:
            context.close()
