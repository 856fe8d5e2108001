"""Requests and websocket frames to a real OctoPrint with the simulated board.

Whoever may only read asks whatever there is to ask, and more. No answer is a server's error or no
JSON, the log stays clean, and the board gets nothing but what is asked of its own accord, and the
questions that somebody who may read may have put to it.
"""

import json
import re
from pathlib import Path

import requests
import websocket
from hypothesis import strategies as st

from tests.e2e import helpers
from tests.rrf.strategies import ANY_JSON
from tests.support.basedir import READER

from .made import CALLS, FLAGS, FRAMES, KEYS, METHODS, WANTED
from .targets import strict

QUOTED = r'"(?:[^"]|"")*"'

ASKED = re.compile(
    rf"M105|M408 S\d|M409 K{QUOTED} F{QUOTED}|M20 S3 P{QUOTED} R\d+|M36 {QUOTED}"
    rf"|M36\.1 P{QUOTED} S\d+|M115|M114|M20"
)
"""What may go out while nobody sends anything: polls, what a reader may ask, whether an ``ok`` was
lost, and OctoPrint's own look at the card behind a connection."""

OWN_ROUTES = [
    *("/status", "/model", "/model/live", "/history", "/meanings", "/setup", "/metrics"),
    *("/printer/objects/list", "/printer/objects/query", "/printer/info", "/server/info"),
    *(
        "/printer/gcode/script",
        "/server/gcode_store",
        "/console",
        "/files",
        "/thumbnail",
    ),
    *("/server/database/item", "/server/database/list", "/server/webcams/item"),
    *("/machine/device_power/device", "/machine/proc_stats", "/server/temperature_store"),
    *("/server/files/directory", "/server/files/metadata", "/server/files/move"),
    *("/server/files/upload", "/server/files/gcodes/a.gcode", "/server/history/job"),
    *("/printer/print/start", "/printer/print/cancel"),
    *("/access/info", "/access/user", "/access/oneshot_token", "/nothing"),
]

ROUTES = st.sampled_from(["/plugin/rrfmodel" + route for route in OWN_ROUTES]) | st.just(
    "/api/plugin/rrfmodel"
)

PATHS = st.sampled_from(["0:/gcodes", "0:/macros/../sys", "a.g", '"', "0:/\n M112", ";M112"])

PARAMETERS = st.dictionaries(
    st.sampled_from(["key", "flags", "path", "count", "since", "toolhead", "extruder", "script"])
    | st.sampled_from(["namespace", "value", "value:json", "device", "uid", "token", "filename"])
    | st.text(max_size=4),
    KEYS | FLAGS | PATHS | st.integers().map(str) | st.text(max_size=12),
    max_size=4,
)

COMMANDS = st.fixed_dictionaries(
    {"command": st.sampled_from(["jog", "home", "tool", "macro", "power", "emergency_stop", "x"])},
    optional={"axes": ANY_JSON, "path": ANY_JSON, "on": ANY_JSON, "key": ANY_JSON},
)

ITEMS = st.fixed_dictionaries(
    {"namespace": st.sampled_from(["a", "../a"]) | ANY_JSON, "key": KEYS | ANY_JSON},
    optional={"value": ANY_JSON},
)

BODIES = st.one_of(
    st.none(),
    (COMMANDS | ITEMS | st.fixed_dictionaries({"objects": WANTED | ANY_JSON}) | ANY_JSON).map(
        json.dumps
    ),
    st.text(max_size=30),
    st.just("[" * 3000),
)

REQUESTS = st.tuples(st.sampled_from(["GET", "POST", "PUT", "DELETE"]), ROUTES, PARAMETERS, BODIES)

REFUSED = st.builds(
    lambda method, script: json.dumps(
        {"jsonrpc": "2.0", "id": 1, "method": method, "params": {"script": script}}
    ),
    st.sampled_from(["printer.gcode.script", "printer.emergency_stop"]),
    st.sampled_from(["M112", "G28\nM112"]) | ANY_JSON,
)
"""What somebody who may only read is refused."""

SERVED_FRAMES = (
    FRAMES
    | REFUSED
    | st.tuples(METHODS, CALLS).map(
        lambda given: json.dumps({**given[1], "jsonrpc": "2.0", "method": given[0], "id": 1})
    )
)

NOISE = re.compile(r"ERROR|Traceback|CRITICAL")


class Served:
    """A server with its board; ``request`` and ``frame`` are fed, ``look`` says what came of it."""

    def __init__(self, server, board):
        self.server = server
        self.board = board
        self._client = server.client(READER)
        self._socket = None
        self._from = len(helpers.commands(board))
        self._logged = self._log_length()

    def _log_length(self):
        return len(self._log())

    def _log(self):
        return (Path(self.server.basedir) / "logs" / "octoprint.log").read_text("utf-8", "replace")

    def request(self, given):
        """Send a request."""
        method, path, parameters, body = given
        data = None if body is None else body.encode("utf-8", "replace")
        headers = {} if body is None else {"Content-Type": "application/json"}
        try:
            answer = self._client.request(
                method, path, params=parameters, data=data, headers=headers, timeout=20
            )
        except UnicodeEncodeError:
            return  # no address can be made of half a letter
        except requests.exceptions.InvalidURL:
            return
        assert answer.status_code < 500, (answer.status_code, answer.text[:300])
        if "json" in answer.headers.get("Content-Type", ""):
            strict(answer.text)

    def described(self, case):
        """Send a request that Schemathesis has made."""
        answer = case.call(headers={"X-Api-Key": READER.api_key}, timeout=20)
        assert answer.status_code < 500, (answer.status_code, answer.text[:300])

    def frame(self, text):
        """Send a frame, and one behind it whose answer shows that the socket lives."""
        if self._socket is None:
            self._socket = websocket.create_connection(
                self.server.url.replace("http", "ws", 1) + "/plugin/rrfmodel/websocket",
                header={"X-Api-Key": READER.api_key},
                timeout=20,
            )
        self._socket.send(text.encode("utf-8", "replace").decode())
        mark = {"jsonrpc": "2.0", "id": "mark", "method": "server.connection.identify"}
        self._socket.send(json.dumps(mark))
        while True:
            said = strict(self._socket.recv())
            if isinstance(said, dict) and said.get("id") == "mark" and "result" in said:
                return

    def found(self):
        """Return what the board got and nobody asked for, and what was logged; nothing else."""
        sent = helpers.commands(self.board)[self._from :]
        unasked = [line for line in sent if not ASKED.fullmatch(line)]
        new = self._log()[self._logged :]
        noise = NOISE.search(new)
        logged = [new[max(0, noise.start() - 200) : noise.start() + 3000]] if noise else []
        return unasked[:5] + logged

    def look(self):
        """Raise where something was found."""
        assert self.found() == []

    def size(self):
        """Return the memory of the server's process in MB."""
        # what is started is a guard, whose child is the server
        first = self.server._process.pid
        children = Path(f"/proc/{first}/task/{first}/children").read_text().split()
        text = Path(f"/proc/{children[0] if children else first}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+)", text)[1]) // 1024

    def close(self):
        if self._socket is not None:
            self._socket.close()
            self._socket = None
