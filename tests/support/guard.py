"""Runs a command that must not outlive the process that asked for it.

``python guard.py COMMAND...`` ends the command, and whatever it started, as soon as the guard's
standard input closes. A killed parent closes it too, which no clean-up in the parent could promise.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

# OctoPrint ends its plugins before itself; a busy machine takes a while over that
GRACE_SECONDS = 10


def main(command: list[str]) -> int:
    """Return the command's exit status; killed with its group if standard input closed first."""
    # SIGTERM goes to the whole group and the guard has to see the end; a handler, unlike SIG_IGN,
    # isn't inherited by the command
    signal.signal(signal.SIGTERM, lambda *_: None)
    child = subprocess.Popen(command, stdin=subprocess.DEVNULL)
    abandoned = threading.Event()
    threading.Thread(target=_stop_when_abandoned, args=(child, abandoned), daemon=True).start()
    status = child.wait()
    if abandoned.is_set():
        # whatever the command left running
        os.killpg(0, signal.SIGKILL)
    return status


def _stop_when_abandoned(child: subprocess.Popen[bytes], abandoned: threading.Event) -> None:
    sys.stdin.read()
    abandoned.set()
    os.killpg(0, signal.SIGTERM)
    try:
        child.wait(GRACE_SECONDS)
    except subprocess.TimeoutExpired:
        os.killpg(0, signal.SIGKILL)


if __name__ == "__main__":
    status = main(sys.argv[1:])
    sys.exit(status if status >= 0 else 128 - status)
