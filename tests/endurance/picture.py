"""A subscriber that stays: what it was told, put together, is what somebody asks for anew."""

import contextlib
import json
import threading

import websocket

from tests.support.basedir import ADMIN

PATH = "/plugin/rrfmodel/websocket"

OBJECTS = {
    "toolhead": ["position", "homed_axes", "extruder"],
    "gcode_move": ["speed_factor", "extrude_factor", "gcode_position"],
    "extruder": ["target"],
    "heater_bed": ["target"],
    "fan": ["speed"],
    "display_status": ["message"],
    "print_stats": ["filename", "state"],
    "webhooks": ["state"],
}
"""Members that are at rest with the machine."""


class Picture:
    """Subscribes, and keeps together what it is told; a context manager."""

    def __init__(self, server):
        self._server = server
        self._socket = websocket.WebSocket(skip_utf8_validation=True)
        self._thread = threading.Thread(target=self._collect, daemon=True)
        self._objects = {}
        self.told = 0
        self.is_open = False

    def __enter__(self):
        address = self._server.url.replace("http", "ws", 1) + PATH
        self._socket.connect(address, timeout=30, header={"X-Api-Key": ADMIN.api_key})
        call = {"method": "printer.objects.subscribe", "params": {"objects": OBJECTS}}
        self._socket.send(json.dumps({"jsonrpc": "2.0", "id": 1, **call}))
        self._socket.settimeout(None)
        self.is_open = True
        self._thread.start()
        return self

    def __exit__(self, *exc_info):
        self._socket.shutdown()
        self._thread.join(5)

    def _collect(self):
        # a closed socket is how listening ends
        with contextlib.suppress(websocket.WebSocketException, OSError):
            while text := self._socket.recv():
                self._take(json.loads(text))
        self.is_open = False

    def _take(self, message):
        if message.get("id") == 1 and "result" in message:
            self._merge(message["result"]["status"])
        elif message.get("method") == "notify_status_update":
            self.told += 1
            self._merge(message["params"][0])

    def _merge(self, status):
        for name, members in status.items():
            self._objects.setdefault(name, {}).update(members)

    def differences(self):
        """Return what somebody who asks now is told otherwise."""
        answer = self._server.post(
            "/plugin/rrfmodel/printer/objects/query", json={"objects": OBJECTS}
        )
        asked = answer.json()["result"]["status"]
        known = json.loads(json.dumps(self._objects))
        return [
            f"{name}.{member}: subscribed {known.get(name, {}).get(member)!r}, asked {value!r}"
            for name, members in asked.items()
            for member, value in members.items()
            if known.get(name, {}).get(member) != value
        ]
