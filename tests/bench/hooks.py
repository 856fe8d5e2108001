"""What a line that isn't ours costs in each hook, against a hook that does nothing."""

from __future__ import annotations

import itertools
import statistics
from types import SimpleNamespace
from typing import Any

from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.received import ReceivedLines
from octoprint_rrfmodel.link.serial.sdcard import SdCard
from octoprint_rrfmodel.link.serial.sdjob import SdJob
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.rrf.card.listing import CardPlan
from tests.bench.timing import side_by_side, verdict

CALLS = 2000
RECEIVED_LIMIT = 0.5
QUEUING_LIMIT = 1.0

RECEIVED = (
    "ok\n",
    "ok T:205.3 /205.0 T0:205.3 /205.0 B:60.1 /60.0\n",
    "T:205.3 /205.0 T0:205.3 /205.0 B:60.1 /60.0\n",
    "\n",
    "X:10.000 Y:20.000 Z:0.300 E:0.000 E0:0.0 Count 800 1600 120 Machine 10.000 20.000 0.300\n",
)
QUEUED = (("G1 X10.123 Y20.456 E0.0345", "G1"), ("M106 S127", "M106"), ("G92 E0", "G92"))
FILE_TAGS = frozenset(("source:file", "filepos:123456", "fileline:1234"))


class _Comm:
    """Stands for a connection: the hooks only compare it in these cases."""


def measure() -> None:
    """Print the cost of both hooks over an empty one, in microseconds a line."""
    comm = _Comm()
    link = SerialLink(printer=lambda: None, profiles=lambda: None, clock=lambda: 0.0)
    card = SdCard(
        CardPlan(),
        SdJob(dict, lambda: True, lambda lines, tags: None, clock=lambda: 0.0),
        link,
        model=dict,
        is_reworded=lambda row: True,
    )
    hooks = ReceivedLines(
        link,
        card,
        lambda *note: None,
        guards=lambda error: False,
        patience=SimpleNamespace(feed=lambda comm: ""),
        refusals=SimpleNamespace(look=lambda comm, line: None),
    )
    queue = QueuedCommands(
        link, lambda *note: None, lambda *command: None, translators=(card.translate,)
    )
    hooks.on_firmware_info(comm, "RepRapFirmware for Duet 2 WiFi/Ethernet", {})
    received = list(itertools.islice(itertools.cycle(RECEIVED), CALLS))
    ours, empty = side_by_side(
        lambda: _receive(hooks.on_received, comm, received),
        lambda: _receive(_empty_received, comm, received),
    )
    _tell("received", ours, empty, RECEIVED_LIMIT)
    queued = list(itertools.islice(itertools.cycle(QUEUED), CALLS))
    ours, empty = side_by_side(
        lambda: _queue(queue.on_queuing, comm, queued),
        lambda: _queue(_empty_queuing, comm, queued),
    )
    _tell("queuing", ours, empty, QUEUING_LIMIT)


def _tell(name: str, ours: list[float], empty: list[float], limit: float) -> None:
    cost = statistics.median(a - b for a, b in zip(ours, empty)) / CALLS * 1e6
    own, bare = (statistics.median(times) / CALLS * 1e6 for times in (ours, empty))
    print(
        f"{name} hook: {own:.3f} us a line, empty hook {bare:.3f} us,"
        f" {cost:.3f} us more ({verdict(cost, limit)})"
    )


def _receive(hook: Any, comm: Any, lines: list[str]) -> None:
    for line in lines:
        hook(comm, line)


def _queue(hook: Any, comm: Any, commands: list[tuple[str, str]]) -> None:
    for command, gcode in commands:
        hook(comm, "queuing", command, None, gcode, subcode=None, tags=FILE_TAGS)


def _empty_received(comm: Any, line: str, *args: Any, **kwargs: Any) -> str:
    return line


def _empty_queuing(
    comm: Any,
    phase: str,
    cmd: str,
    cmd_type: Any,
    gcode: Any,
    subcode: Any = None,
    tags: Any = None,
    *args: Any,
    **kwargs: Any,
) -> None:
    return None
