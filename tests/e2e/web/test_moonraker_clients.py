"""Moonraker's clients at a root of their own: the plugin's port, reverse proxies, each client."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import aiohttp
import pytest
import requests
import websocket
from moonraker_api import MoonrakerClient as ApiClient
from moonraker_api import MoonrakerListener
from moonraker_client import AsyncMoonrakerClient, MoonrakerClient
from moonrakerpy import MoonrakerPrinter
from pymoonraker import MoonrakerClient as PyMoonrakerClient

from tests.clients.moonraker_call import ALL
from tests.clients.moonraker_calls import CLIENTS
from tests.support import coroutines, ports
from tests.support.basedir import ADMIN, OPERATOR, READER
from tests.support.places import ROOT

BOARD = {"machine": "cartesian"}

SETTING = "plugins.rrfmodel.moonraker"

MAINSAIL = "recipes/mainsail.md"

NOT_FOUND = 404

NO_METHOD = -32601
REFUSED = -32000

NETWORK_CLIENTS = Path(os.environ.get("NETWORK_CLIENTS") or ROOT / ".venv" / "network-clients")


def answers(url, key=ADMIN.api_key):
    try:
        return requests.get(f"{url}/server/info", headers={"X-Api-Key": key}, timeout=10).ok
    except requests.RequestException:
        return False


@pytest.fixture(scope="module")
def root(server):
    """The address of the port that clients have to themselves."""
    port = ports.free_port()
    server.set_setting(SETTING, {"enabled": True, "address": "127.0.0.1", "port": str(port)})
    url = f"http://127.0.0.1:{port}"
    server.wait_for(lambda: answers(url), 10, "the port")
    return url


class Socket:
    """A client's socket: one call after the other."""

    def __init__(self, url, query="", **options):
        self._socket = websocket.WebSocket(skip_utf8_validation=True)
        self._socket.settimeout(15)
        self._last = 0
        try:
            address = url.replace("http", "ws", 1) + "/websocket" + query
            self._socket.connect(address, **options)
        except websocket.WebSocketBadStatusException:
            self._socket.shutdown()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *exc_info):
        self._socket.close()
        # of a connection that the server has closed the library leaves the socket open
        self._socket.shutdown()

    def answer(self, method, params):
        self._last += 1
        call = {"jsonrpc": "2.0", "method": method, "params": params, "id": self._last}
        self._socket.send(json.dumps(call))
        while True:
            text = self._socket.recv()
            if not text:
                raise websocket.WebSocketConnectionClosedException("the server has closed")
            found = json.loads(text)
            if found.get("id") == self._last:
                return found


def keyed(user=ADMIN):
    return {"header": {"X-Api-Key": user.api_key}}


# the port


@pytest.mark.both_hosts("a server of its own, made of what each host has")
def test_what_is_moonraker_s_is_at_the_root(root):
    key = {"X-Api-Key": OPERATOR.api_key}
    info = requests.get(f"{root}/printer/info", headers=key, timeout=10)
    assert info.json()["result"]["state"] == "ready"
    by_address = requests.get(f"{root}/server/info?apikey={READER.api_key}", timeout=10)
    assert by_address.json()["result"]["klippy_state"] == "ready"
    address = f"{root}/printer/gcode/script"
    sent = requests.post(address, headers=key, json={"script": "M117 a"}, timeout=10)
    assert sent.json() == {"result": "ok"}
    with Socket(root, **keyed(READER)) as socket:
        assert socket.answer("printer.info", {})["result"]["state"] == "ready"
        refused = socket.answer("printer.gcode.script", {"script": "M117 a"})
        assert refused["error"]["message"].endswith(".")


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_who_shows_no_key_gets_nothing(root):
    assert requests.get(f"{root}/printer/info", timeout=10).status_code == 403
    sent = requests.post(f"{root}/printer/gcode/script?script=G28", timeout=10)
    # OctoPrint itself wants a token of who shows no key
    assert sent.status_code in (400, 403)
    for options in ({}, {"header": {"X-Api-Key": "nonsense"}}):
        with pytest.raises(websocket.WebSocketBadStatusException) as refused:
            Socket(root, **options)
        assert refused.value.status_code == 403


@pytest.mark.parametrize(
    "path",
    [
        "/",
        "/api/version",
        "/static/js/core.js",
        "/serverinfo",
        "/server/nosuch",
        "/login",
        "//",
        "/%2e",
    ],
)
def test_nothing_else_is_there(root, path):
    found = requests.get(root + path, headers={"X-Api-Key": ADMIN.api_key}, timeout=10)
    assert found.status_code == 404
    assert found.json()["error"]["code"] == 404


def test_a_port_that_is_taken_is_told_and_another_may_be_chosen(server, root):
    own = server.url.rpartition(":")[2]
    at = {"enabled": True, "address": "127.0.0.1"}
    try:
        with Socket(root, **keyed()) as socket:
            server.set_setting(SETTING, {**at, "port": int(own)})
            with pytest.raises((ConnectionError, websocket.WebSocketConnectionClosedException)):
                # what comes before its end
                while socket.answer("printer.info", {}):
                    pass
        server.wait_for(lambda: not answers(root), 10, "the port to be left")
        server.wait_for(lambda: f"on port {own} can't be listened on" in server.log(), 10, "a word")
        server.set_setting(SETTING, {**at, "port": "none"})
        server.wait_for(lambda: "There is no port none" in server.log(), 10, "a word")
    finally:
        server.forget_logs()
        server.set_setting(SETTING, {**at, "port": root.rpartition(":")[2]})
    server.wait_for(lambda: answers(root), 10, "the port again")


# clients by their calls


def asked(client, root):
    """Return method and answer of each call that a client makes, in its order."""
    key = {"X-Api-Key": ADMIN.api_key}
    with Socket(root, client.query.replace("KEY", ADMIN.api_key), **keyed()) as socket:
        listed = socket.answer("printer.objects.list", {})["result"]["objects"]
        for call in client.calls:
            params = dict(call.params)
            if params.get("objects") == ALL:
                params["objects"] = dict.fromkeys(listed)
            if params.get("api_key") == "KEY":
                params["api_key"] = ADMIN.api_key
            if call.verb:
                place = "params" if call.verb == "GET" else "data" if call.is_form else "json"
                found = requests.request(
                    call.verb, f"{root}/{call.method}", headers=key, timeout=15, **{place: params}
                )
                yield call, found.json()
            else:
                yield call, socket.answer(call.method, params)


@pytest.mark.parametrize("client", CLIENTS, ids=lambda client: client.name)
def test_no_call_of_a_client_s_start_fails(root, client):
    for call, found in asked(client, root):
        error = found.get("error")
        if error is not None:
            # Mainsail takes anything but 404 for the file
            assert call.may_fail and error["code"] in (NOT_FOUND, NO_METHOD, REFUSED), (call, error)
            continue
        for name in client.results.get(call.method, ()):
            assert name in found["result"], call
    with Socket(root, **keyed()) as socket:
        listed = socket.answer("printer.objects.list", {})["result"]["objects"]
    assert set(client.objects) <= set(listed)


# clients by themselves


def test_moonraker_api(root):
    async def run():
        session = aiohttp.ClientSession()
        port = int(root.rpartition(":")[2])
        client = ApiClient(
            MoonrakerListener(), "127.0.0.1", port, api_key=OPERATOR.api_key, session=session
        )
        await client.connect()
        try:
            return await client.call_method("printer.info")
        finally:
            await client.disconnect()
            await session.close()

    assert coroutines.run(run())["state"] == "ready"


def test_moonraker_client(root):
    with MoonrakerClient(root, api_key=OPERATOR.api_key) as client:
        assert client.printer_info()["state"] == "ready"
        assert "toolhead" in client.printer_objects_list()["objects"]
        client.gcode_script("M117 hello")

    async def run():
        async with AsyncMoonrakerClient(root, api_key=OPERATOR.api_key) as client:
            return await client.printer_info()

    assert coroutines.run(run())["state"] == "ready"


# proxies, as the docs have them


def blocks(language, page="clients.md"):
    page = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", page, re.MULTILINE | re.DOTALL)


def nginx(folder, text):
    config = folder / "nginx.conf"
    logs = f"pid {folder}/pid; error_log {folder}/error.log; daemon off; master_process off;"
    kept = "".join(
        f"{name}_temp_path {folder}/{name};"
        for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
    )
    config.write_text(
        f"{logs} events {{}} http {{ access_log off; {kept}\n{text}\n}}", encoding="utf-8"
    )
    return ["nginx", "-p", str(folder), "-c", str(config)]


def haproxy(folder, text):
    config = folder / "haproxy.cfg"
    config.write_text(text, encoding="utf-8")
    return ["haproxy", "-db", "-f", str(config)]


def caddy(folder, text):
    config = folder / "Caddyfile"
    config.write_text(f"{{\n admin off\n auto_https off\n}}\n{text}", encoding="utf-8")
    return ["caddy", "run", "--adapter", "caddyfile", "--config", str(config)]


PROXIES = {"nginx": nginx, "haproxy": haproxy, "caddy": caddy}


@pytest.fixture(scope="module")
def proxied(tmp_path_factory):
    """Function that starts a proxy with the text of the docs, and ends what it started before."""
    running = []

    def end():
        for process, log in running:
            process.terminate()
            process.wait(30)
            log.close()
        running.clear()

    def started(name, text):
        end()
        folder = tmp_path_factory.mktemp(name)
        command = PROXIES[name](folder, text)
        places = os.pathsep.join([os.environ.get("PATH", os.defpath), "/usr/sbin"])
        program = shutil.which(command[0], path=places)
        if program is None:
            pytest.skip(f"{name} isn't installed")
        environment = {**os.environ, "HOME": str(folder), "XDG_DATA_HOME": str(folder)}
        log = (folder / "output").open("wb")
        process = subprocess.Popen(
            [program, *command[1:]], env=environment, stdout=log, stderr=log, cwd=folder
        )
        running.append((process, log))

    yield started
    end()


def placed(text, server, port):
    """Return a block of the docs with the test's own ports."""
    own = server.url.rpartition("/")[2]
    for host in ("listen 7125", "bind *:7125", ":7125 {"):
        text = text.replace(host, host.replace("*:", "127.0.0.1:").replace("7125", f"{port}"))
    return text.replace("127.0.0.1:5000", own)


@pytest.mark.parametrize("name", PROXIES)
def test_a_proxy_as_in_the_docs(server, proxied, name):
    port = ports.free_port()
    proxied(name, placed(blocks(name)[0], server, port))
    url = f"http://127.0.0.1:{port}"
    server.wait_for(lambda: answers(url), 20, name)
    key = {"X-Api-Key": OPERATOR.api_key}
    query = requests.get(
        f"{url}/printer/objects/query?toolhead&gcode_macro%20PAUSE", headers=key, timeout=10
    )
    assert set(query.json()["result"]["status"]) == {"toolhead", "gcode_macro PAUSE"}
    script = {"script": "M117 a"}
    sent = requests.post(f"{url}/printer/gcode/script", headers=key, json=script, timeout=10)
    assert sent.json() == {"result": "ok"}
    assert requests.get(f"{url}/api/version", headers=key, timeout=10).status_code == 404
    assert requests.get(f"{url}/server/info", timeout=10).status_code == 403
    with Socket(url, **keyed()) as socket:
        assert socket.answer("printer.info", {})["result"]["state"] == "ready"


def test_the_recipe_has_the_parts_of_the_page_of_clients():
    text, keys, header, page = blocks("nginx")
    (whole,) = blocks("nginx", MAINSAIL)
    text, _, rest = text.partition("        return 404;\n")
    for part in (*text.partition("        proxy_http_version 1.1;\n"), rest, header, page):
        for line in part.splitlines():
            assert line.strip() in whole
    assert keys.rstrip().rstrip("}") in whole


@pytest.fixture(scope="module")
def with_key(server, proxied, tmp_path_factory):
    """The port of a proxy that adds a key, as in the docs."""
    port = ports.free_port()
    (text,) = blocks("nginx", MAINSAIL)
    folder = tmp_path_factory.mktemp("page")
    (folder / "index.html").write_text("a page")
    for there, here in (
        ("/var/www/mainsail", str(folder)),
        ("http://octopi.local:7125", f"http://127.0.0.1:{port}"),
        ("KEY", OPERATOR.api_key),
    ):
        assert there in text
        text = text.replace(there, here)
    proxied("nginx", placed(text, server, port))
    server.wait_for(lambda: answers(f"http://127.0.0.1:{port}", key=""), 20, "nginx")
    return port


def test_klipper_tui(with_key):
    python = NETWORK_CLIENTS / "bin" / "python"
    if not python.exists():
        pytest.skip("`make environments` installs klipper-tui")
    script = ROOT / "tests" / "clients" / "klipper_tui_client.py"
    done = subprocess.run(
        [str(python), str(script), str(with_key)],
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["state"] == "ready" and found["answer"] == "ok"
    assert {"toolhead", "extruder", "configfile", "gcode_macro PAUSE"} <= set(found["objects"])


# what it uses of aiohttp is its own affair
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_pymoonraker(with_key):
    async def run():
        async with PyMoonrakerClient("127.0.0.1", with_key) as client:
            info = await client.printer_info()
            status = await client.query_objects({"toolhead": None})
            return info, status, await client.gcode("M117 hello")

    info, status, answer = coroutines.run(run())
    assert info.state == "ready"
    assert set(status["status"]) == {"toolhead"}
    assert answer == "ok"


def test_moonrakerpy(with_key):
    printer = MoonrakerPrinter(f"http://127.0.0.1:{with_key}")
    assert "homed_axes" in printer.query_status("toolhead")
    assert printer.send_gcode("M117 hello")


def test_a_page_of_its_own_gets_in(with_key):
    url = f"http://127.0.0.1:{with_key}"
    assert requests.get(f"{url}/settings/any", timeout=10).text == "a page"
    with Socket(url, origin=url) as socket:
        assert socket.answer("printer.info", {})["result"]["state"] == "ready"


def test_a_page_of_another_site_gets_no_key(with_key):
    with pytest.raises(websocket.WebSocketBadStatusException) as refused:
        Socket(f"http://127.0.0.1:{with_key}", origin="http://evil.example")
    assert refused.value.status_code == 403
