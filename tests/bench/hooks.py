"""What a line that isn't ours costs in each hook, against a hook that does nothing."""

from __future__ import annotations

import itertools
import statistics
import time
from types import SimpleNamespace
from typing import Any

from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.received import ReceivedLines
from octoprint_rrfmodel.link.serial.sdcard import SdCard
from octoprint_rrfmodel.link.serial.sdjob import SdJob
from octoprint_rrfmodel.link.serial.sent import SentCommands
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.rrf.card.listing import CardPlan
from tests.bench import results
from tests.bench.timing import side_by_side

CALLS = 2000
RECEIVED_LIMIT = 0.5
QUEUING_LIMIT = 1.0
STREAMED_LIMIT = 2.0
"""For all three hooks and one line of a print; OctoPrint itself takes about 200 us for one."""

RECEIVED = (
    "ok\n",
    "ok T:205.3 /205.0 T0:205.3 /205.0 B:60.1 /60.0\n",
    "T:205.3 /205.0 T0:205.3 /205.0 B:60.1 /60.0\n",
    "\n",
    "X:10.000 Y:20.000 Z:0.300 E:0.000 E0:0.0 Count 800 1600 120 Machine 10.000 20.000 0.300\n",
)
QUEUED = (("G1 X10.123 Y20.456 E0.0345", "G1"), ("M106 S127", "M106"), ("G92 E0", "G92"))
STREAMED = (*(("G1 X10.123 Y20.456 E0.0345", "G1"),) * 48, *QUEUED[1:])
"""As a sliced file goes: nearly all are moves."""

FILE_TAGS = frozenset(("source:file", "filepos:123456", "fileline:1234"))


class _Comm:
    """Stands for a connection: the hooks only compare it in these cases."""


def measure() -> None:
    """Tell the cost of the hooks over an empty one, in microseconds a line."""
    comm = _Comm()
    link = SerialLink(printer=lambda: None, profiles=lambda: None, clock=time.monotonic)
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
    _tell("received hook, a line", ours, empty, RECEIVED_LIMIT)
    queued = list(itertools.islice(itertools.cycle(QUEUED), CALLS))
    ours, empty = side_by_side(
        lambda: _queue(queue.on_queuing, comm, queued),
        lambda: _queue(_empty_queuing, comm, queued),
    )
    _tell("queuing hook, a line", ours, empty, QUEUING_LIMIT)
    streamed = list(itertools.islice(itertools.cycle(STREAMED), CALLS))
    sending = SentCommands(
        link,
        lambda *note: None,
        time.monotonic,
        show_target=lambda heater, target: None,
        sent=lambda cmd, tags: None,
    )
    ours, empty = side_by_side(
        lambda: _stream(queue.on_queuing, sending.on_sending, hooks.on_received, comm, streamed),
        lambda: _stream(_empty_queuing, _empty_queuing, _empty_received, comm, streamed),
    )
    _tell("all three hooks, a streamed line", ours, empty, STREAMED_LIMIT)


def _tell(name: str, ours: list[float], empty: list[float], limit: float) -> None:
    cost = statistics.median(a - b for a, b in zip(ours, empty)) / CALLS * 1e6
    own, bare = (statistics.median(times) / CALLS * 1e6 for times in (ours, empty))
    results.tell(
        f"{name} over an empty hook",
        cost,
        "us",
        beside=f"{own:.3f} us; empty {bare:.3f} us",
        limit=limit,
    )


def _receive(hook: Any, comm: Any, lines: list[str]) -> None:
    for line in lines:
        hook(comm, line)


def _queue(hook: Any, comm: Any, commands: list[tuple[str, str]]) -> None:
    for command, gcode in commands:
        hook(comm, "queuing", command, None, gcode, subcode=None, tags=FILE_TAGS)


def _stream(
    queuing: Any, sending: Any, received: Any, comm: Any, commands: list[tuple[str, str]]
) -> None:
    """Let lines of a print through, one after the other, each acknowledged."""
    for command, gcode in commands:
        queuing(comm, "queuing", command, None, gcode, subcode=None, tags=FILE_TAGS)
        sending(comm, "sending", command, None, gcode, subcode=None, tags=FILE_TAGS)
        received(comm, "ok\n")


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
