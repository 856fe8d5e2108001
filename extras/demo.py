"""Starts an OctoPrint with the plugin and its simulated printer, for a look at it: ``make demo``.

The base folder is .demo/ in the project; configuration and user are written anew at each start,
uploaded files stay. DEMO_PORT is the TCP port, 5000 or the next free one by default.
"""

from __future__ import annotations

import os
import secrets
import signal
import sys
from pathlib import Path
from types import FrameType

from tests.support import ports
from tests.support.basedir import DISABLED_PLUGINS, User
from tests.support.server import OctoPrintServer

ROOT = Path(__file__).resolve().parent.parent
FIRST_PORT = 5000
SERIAL_PORT = "RRF-SIM"
BAUDRATE = 115200


def main() -> int:
    """Return 0 after the user ended the demo, 1 when OctoPrint ended by itself."""
    # the one way out for Ctrl-C and for a service manager
    signal.signal(signal.SIGTERM, _interrupt)
    # a new key each time: whoever knows it may do everything, from any page in the browser too
    user = User("demo", "admins", "demo", secrets.token_hex(16).upper())
    try:
        with _server(user) as server:
            print(f"OctoPrint {server.version} with a simulated printer: {server.url}")
            print(f"log in as demo with the password demo; API key {user.api_key}")
            print("stop it with Ctrl-C", flush=True)
            server.wait()
    except KeyboardInterrupt:
        return 0
    print("OctoPrint ended", file=sys.stderr)
    return 1


def _server(user: User) -> OctoPrintServer:
    wanted = os.environ.get("DEMO_PORT")
    port = int(wanted) if wanted else next(filter(ports.is_free, range(FIRST_PORT, 65536)))
    return OctoPrintServer(
        ROOT / ".demo",
        users=(user,),
        port=port,
        plugins_config={
            "_disabled": [name for name in DISABLED_PLUGINS if name != "pluginmanager"],
            # with the wizard, as whoever installs the plugin sees it
            "rrfmodel": {"simulator": {"enabled": True}, "wizard_seen": False},
        },
        autoconnect=(SERIAL_PORT, BAUDRATE),
        profile={"name": "Simulated printer", "model": "RepRapFirmware, one tool, heated bed"},
    )


def _interrupt(signum: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())
