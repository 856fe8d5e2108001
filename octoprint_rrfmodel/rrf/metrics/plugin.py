"""Metrics of the plugin itself: what it asks, what comes back, how old the model is."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..views.machine import array, mapping
from .metric import COUNTER, GAUGE, Metric, Sample, Sources, at, own, text

BLOCKED = ("heating", "long_command", "streaming", "buffers")
"""Why no poll goes out."""

INFO = {
    "version": "version",
    "protocol": "protocol",
    "firmware_name": "firmware.name",
    "firmware_version": "firmware.version",
    "firmware_date": "firmware.date",
    "electronics": "firmware.electronics",
}
"""Label of ``rrf_info`` and the member of the plugin's state that it shows."""


def _info(sources: Sources) -> Iterator[Sample]:
    yield tuple(text(at(sources.status, path)) for path in INFO.values()), 1


def _blocked(sources: Sources) -> Iterator[Sample]:
    for reason in BLOCKED:
        yield (reason,), sources.status.get("blocked") == reason


def _warnings(status: Any) -> list[str]:
    codes = [mapping(warning).get("code") for warning in array(mapping(status).get("warnings"))]
    return [code for code in codes if isinstance(code, str)]


def _warning_count(sources: Sources) -> Iterator[Sample]:
    yield (), len(_warnings(sources.status))


def _warning_codes(sources: Sources) -> Iterator[Sample]:
    for code in _warnings(sources.status):
        yield (code,), 1


def _ages(sources: Sources) -> Iterator[Sample]:
    for key, age in mapping(sources.status.get("ages")).items():
        yield (key,), age


METRICS = (
    Metric(
        "rrf_info", GAUGE, "The plugin, and the firmware as it said of itself.", tuple(INFO), _info
    ),
    Metric(
        "rrf_connected", GAUGE, "Whether the host is connected to a printer.", (), own("connected")
    ),
    Metric("rrf_ready", GAUGE, "Whether the whole model is known.", (), own("ready")),
    Metric(
        "rrf_stale",
        GAUGE,
        "Whether the model is older than three poll intervals.",
        (),
        own("stale"),
    ),
    Metric(
        "rrf_blocked",
        GAUGE,
        "Why no poll goes out: 1 for the reason that holds.",
        ("reason",),
        _blocked,
    ),
    Metric("rrf_age_seconds", GAUGE, "Time since the last reply that was applied.", (), own("age")),
    Metric(
        "rrf_key_age_seconds",
        GAUGE,
        "Time since the oldest part of a top-level key was heard of.",
        ("key",),
        _ages,
    ),
    Metric("rrf_warnings", GAUGE, "How many warnings there are.", (), _warning_count),
    Metric("rrf_warning", GAUGE, "1 for each warning that there is.", ("code",), _warning_codes),
    Metric("rrf_revisions_total", COUNTER, "Replies that changed the model.", (), own("revision")),
    Metric(
        "rrf_resets_total", COUNTER, "Resets of the board that were noticed.", (), own("resets")
    ),
    Metric("rrf_polls_total", COUNTER, "Polls that were sent.", (), own("counters.polls")),
    Metric(
        "rrf_replies_total", COUNTER, "Replies that were understood.", (), own("counters.replies")
    ),
    Metric("rrf_reply_bytes_total", COUNTER, "Bytes of all replies.", (), own("counters.bytes")),
    Metric(
        "rrf_malformed_replies_total",
        COUNTER,
        "Replies that could not be read.",
        (),
        own("counters.malformed"),
    ),
    Metric(
        "rrf_out_of_buffers_total",
        COUNTER,
        "Times that the board had no room for an answer.",
        (),
        own("counters.out_of_buffers"),
    ),
    Metric(
        "rrf_timeouts_total",
        COUNTER,
        "Polls that stayed without an answer.",
        (),
        own("counters.timeouts"),
    ),
    Metric(
        "rrf_rewritten_commands_total",
        COUNTER,
        "Commands of the host that went out as others.",
        (),
        own("counters.rewritten"),
    ),
)
