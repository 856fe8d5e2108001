"""Prints a line for each printer of a fleet, and again when something of it has changed.

Needs Python 3.9 and paho-mqtt 2 alone. Every OctoPrint of the fleet publishes below
``<root>/<printer>/``, as the README beside this file sets it up:

* ``mqtt``: OctoPrint-MQTT's own, ``connected`` or ``disconnected``
* ``progress/printing``: OctoPrint-MQTT's own, the progress of a print that OctoPrint streams
* ``rrfmodel/status``: the state of the plugin RepRapFirmware Model
* ``rrfmodel/<key>``: the top-level keys of the printer's object model
"""

from __future__ import annotations

import argparse
import json
import os
import queue
import sys
import time
from typing import Any

from paho.mqtt import client as mqtt

PARTS = (
    "mqtt",
    "progress/printing",
    "rrfmodel/status",
    "rrfmodel/state",
    "rrfmodel/job",
    "rrfmodel/heat",
    "rrfmodel/tools",
)

GATHER_SECONDS = 1.0
"""How long messages are collected before lines are printed."""

PATIENCE_SECONDS = 5.0
"""How long ``--once`` waits for the first message; a broker tells what it keeps at once."""


def main(arguments: list[str]) -> int:
    """Return 0 when the lines were printed, 1 without a broker or without a printer."""
    options = _parser().parse_args(arguments)
    news: queue.SimpleQueue[tuple[str, str, Any]] = queue.SimpleQueue()
    try:
        client = _connected(options, news)
    except OSError as error:
        print(f"no broker at {options.host}:{options.port}: {error}", file=sys.stderr)
        return 1
    fleet: dict[str, dict[str, Any]] = {}
    printed: dict[str, str] = {}
    try:
        while True:
            gathered = _gathered(news, PATIENCE_SECONDS if options.once else None)
            if not gathered:
                print(f"nothing is published below {options.root}/", file=sys.stderr)
                return 1
            for name, part, value in gathered:
                fleet.setdefault(name, {})[part] = value
            for name in sorted(fleet):
                line = line_of(name, fleet[name])
                if printed.get(name) != line:
                    printed[name] = line
                    print(line, flush=True)
            if options.once:
                return 0
    except KeyboardInterrupt:
        return 0
    finally:
        client.loop_stop()
        client.disconnect()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description="A line for each printer of a fleet.")
    parser.add_argument("--host", default="localhost", help="the MQTT broker")
    parser.add_argument("--port", type=int, default=1883)
    parser.add_argument("--username", help="its password is in the variable MQTT_PASSWORD")
    parser.add_argument("--root", default="shop", help="what stands before the printers' names")
    parser.add_argument("--once", action="store_true", help="print what is known now, and end")
    return parser


def _connected(
    options: argparse.Namespace, news: queue.SimpleQueue[tuple[str, str, Any]]
) -> mqtt.Client:
    """Return a client that puts all it hears into the queue: printer, part, value."""
    client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2)
    if options.username:
        client.username_pw_set(options.username, os.environ.get("MQTT_PASSWORD"))

    def subscribe(client: mqtt.Client, *others: Any) -> None:
        client.subscribe([(f"{options.root}/+/{part}", 0) for part in PARTS])

    def take(client: mqtt.Client, userdata: Any, message: mqtt.MQTTMessage) -> None:
        name, _, part = message.topic[len(options.root) + 1 :].partition("/")
        text = message.payload.decode(errors="replace")
        try:
            news.put((name, part, text if part == "mqtt" else json.loads(text or "null")))
        except ValueError:
            print(f"no JSON at {message.topic}", file=sys.stderr)

    client.on_connect = subscribe
    client.on_message = take
    client.connect(options.host, options.port)
    client.loop_start()
    return client


def _gathered(news: queue.SimpleQueue[Any], patience: float | None) -> list[Any]:
    """Return what comes within a moment of the first message, nothing if that doesn't come."""
    try:
        gathered = [news.get(timeout=patience)]
    except queue.Empty:
        return []
    end = time.monotonic() + GATHER_SECONDS
    while (left := end - time.monotonic()) > 0:
        try:
            gathered.append(news.get(timeout=left))
        except queue.Empty:
            break
    return gathered


def line_of(name: str, parts: dict[str, Any]) -> str:
    """Return what is to be said of a printer."""
    state = parts.get("rrfmodel/status") or {}
    if parts.get("mqtt") == "disconnected":
        return f"{name:<12} OctoPrint is off"
    if not state.get("connected"):
        return f"{name:<12} no printer"
    if not state.get("ready"):
        return f"{name:<12} connecting"
    words = [str((parts.get("rrfmodel/state") or {}).get("status"))]
    progress = progress_of(parts)
    if progress is not None:
        words.append(f"{progress:.0%}")
    words += temperatures_of(parts)
    if state.get("stale"):
        words.append("(no news)")
    return f"{name:<12} " + "  ".join(words)


def progress_of(parts: dict[str, Any]) -> float | None:
    """Return how much is printed, of the machine's own job or OctoPrint's, if there is one."""
    job = parts.get("rrfmodel/job") or {}
    size = (job.get("file") or {}).get("size")
    if size and job.get("filePosition"):
        return job["filePosition"] / size
    streamed = parts.get("progress/printing") or {}
    if streamed.get("path") and 0 < streamed.get("progress", 0) < 100:
        return streamed["progress"] / 100
    return None


def temperatures_of(parts: dict[str, Any]) -> list[str]:
    """Return current and target temperature of each tool and bed."""
    heat = parts.get("rrfmodel/heat") or {}
    heaters = heat.get("heaters") or []
    places = [
        (f"T{tool['number']}", index)
        for tool in parts.get("rrfmodel/tools") or []
        if tool
        for index in (tool.get("heaters") or [])[:1]
    ]
    places += [("bed", index) for index in heat.get("bedHeaters") or [] if index >= 0]
    return [
        f"{place} {heaters[index]['current']:.0f}/{target_of(heaters[index]):.0f}"
        for place, index in places
        if index < len(heaters) and heaters[index]
    ]


def target_of(heater: dict[str, Any]) -> float:
    """Return what a heater is to reach, 0 for one that is off."""
    return max(heater.get(heater["state"], 0) if heater["state"] in ("active", "standby") else 0, 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
