"""Starts an OctoPrint with the plugin and its simulated printer, for a look at it: ``make demo``.

The base folder is .demo/ in the project, or DEMO_FOLDER; configuration and user are written anew at
each start, uploaded files stay. DEMO_PORT is the TCP port, 5000 or the next free one by default;
DEMO_MACHINE and DEMO_FIRMWARE are what the simulator's --list names, one tool and 3.5.3 by default.
DEMO_LINK says how the board is connected: ``serial``, or ``network``, in OctoPrint 2.0 alone.
"""

from __future__ import annotations

import os
import secrets
import signal
import sys
from importlib.metadata import version
from pathlib import Path
from types import FrameType
from typing import Any

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.device import demo_print
from octoprint_rrfmodel.simulator.firmware import UnknownFirmware, firmware_called
from octoprint_rrfmodel.simulator.machines import UnknownMachine, machine_called
from tests.support import ports
from tests.support.basedir import DISABLED_PLUGINS, User, is_version_2
from tests.support.server import OctoPrintServer

ROOT = Path(__file__).resolve().parent.parent
FIRST_PORT = 5000
SERIAL_PORT = "RRF-SIM"
BAUDRATE = 115200
BAD_USAGE = 2

LINKS: dict[str, dict[str, Any]] = {
    "serial": {"autoconnect": (SERIAL_PORT, BAUDRATE)},
    "network": {
        "settings": {
            "printerConnection": {
                "autoconnect": True,
                "preferred": {"connector": "rrfmodel", "parameters": {"host": "RRF-SIM"}},
            }
        }
    },
}
"""How the board is connected → the server's options that see to it."""


def main() -> int:
    """Return 0 when the user ended the demo, 1 when OctoPrint ended, 2 for what can't be."""
    link = os.environ.get("DEMO_LINK") or "serial"
    if link not in LINKS:
        print(f"error: DEMO_LINK is {' or '.join(LINKS)}, not {link!r}", file=sys.stderr)
        return BAD_USAGE
    if link == "network" and not is_version_2(version("OctoPrint")):
        print("error: DEMO_LINK=network needs OctoPrint 2.0", file=sys.stderr)
        return BAD_USAGE
    machine = os.environ.get("DEMO_MACHINE") or "cartesian"
    firmware = os.environ.get("DEMO_FIRMWARE") or "3.5.3"
    try:
        summary = machine_called(machine).summary
        firmware_called(firmware)
    except (UnknownMachine, UnknownFirmware) as problem:
        print(f"error: {problem}", file=sys.stderr)
        return BAD_USAGE
    # the one way out for Ctrl-C and for a service manager
    signal.signal(signal.SIGTERM, _interrupt)
    # a new key each time: whoever knows it may do everything, from any page in the browser too
    user = User("demo", "admins", "demo", secrets.token_hex(16).upper())
    try:
        with _server(user, link, machine, firmware) as server:
            print(f"OctoPrint {server.version} with a simulated printer: {server.url}")
            where = "on the network" if link == "network" else "on a serial port"
            print(f"it is a {summary}, with firmware {firmware}, {where}")
            print(f"log in as demo with the password demo; API key {user.api_key}")
            print("stop it with Ctrl-C", flush=True)
            server.wait()
    except KeyboardInterrupt:
        return 0
    print("OctoPrint ended", file=sys.stderr)
    return 1


def _server(user: User, link: str, machine: str, firmware: str) -> OctoPrintServer:
    folder = Path(os.environ.get("DEMO_FOLDER") or ROOT / ".demo").absolute()
    _put_print(machine, folder / "uploads")
    wanted = os.environ.get("DEMO_PORT")
    port = int(wanted) if wanted else next(filter(ports.is_free, range(FIRST_PORT, 65536)))
    return OctoPrintServer(
        folder,
        users=(user,),
        port=port,
        plugins_config={
            "_disabled": [name for name in DISABLED_PLUGINS if name != "pluginmanager"],
            # with the wizard, as whoever installs the plugin sees it
            "rrfmodel": {
                "simulator": {
                    "enabled": True,
                    "machine": machine,
                    "firmware": firmware,
                    "demo_print": True,
                },
                "wizard_seen": False,
            },
        },
        profile={"name": "Simulated printer", "model": "RepRapFirmware"},
        **LINKS[link],
    )


def _put_print(machine: str, uploads: Path) -> None:
    """Have a print among OctoPrint's own files, too, for the board to be given."""
    tools = [tool["number"] for tool in Board(machine).tools()]
    if not tools:
        return
    uploads.mkdir(parents=True, exist_ok=True)
    path = uploads / f"Sent by OctoPrint {demo_print.NAME}"
    path.write_text(demo_print.content(tools), encoding="utf-8")


def _interrupt(signum: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())
