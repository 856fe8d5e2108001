"""Run every measurement and tell each beside what it is compared with: ``make bench``.

``python -m tests.bench NAME...`` runs some of them. All rows go to ``bench.json``.
"""

from __future__ import annotations

import sys

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from tests.bench import (
    growth,
    hooks,
    idle,
    listeners,
    live_reply,
    long_lines,
    page,
    results,
    server,
    streaming,
)
from tests.support.places import ROOT

BENCHES = {
    "streaming": streaming.measure,
    "idle": idle.measure,
    "hooks": hooks.measure,
    "live_reply": live_reply.measure,
    "growth": growth.measure,
    "listeners": listeners.measure,
    "long_lines": long_lines.measure,
    "server": server.measure,
    "page": page.measure,
}


def main(names: list[str]) -> None:
    """Run the measurements of those names, all where there are none."""
    for name in names or BENCHES:
        BENCHES[name]()
    results.write(ROOT / "bench.json")


if __name__ == "__main__":
    main(sys.argv[1:])
