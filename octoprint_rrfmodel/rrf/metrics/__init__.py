"""View: the model and the plugin's state as metrics for Prometheus.

``METRICS`` is the table. A value that isn't known, or is no finite number, is left out; so is
what a sparse model lacks. Labels that tell parts apart are RRF's own numbers, and names, which
may change, are labels of the ``_info`` metrics alone.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

from . import boards, heat, machine, motion, plugin
from .metric import Metric, Sources

CONTENT_TYPE = "text/plain; version=0.0.4; charset=utf-8"
"""Of what ``exposition`` returns (Prometheus, text-based exposition format)."""

METRICS: tuple[Metric, ...] = (
    *plugin.METRICS,
    *machine.METRICS,
    *heat.METRICS,
    *motion.METRICS,
    *boards.METRICS,
)

_SPECIAL = re.compile(r'[\\"\n]')
"""Characters of a label's value that need a backslash."""

_ESCAPES = {"\\": r"\\", '"': r"\"", "\n": r"\n"}

WHOLE_BELOW = 1e15
"""Up to here a whole number is written without a fraction; a float holds it exactly."""


def exposition(model: Mapping[str, Any], status: Mapping[str, Any]) -> str:
    """Return all metrics in Prometheus' text format; never raises on any model.

    ``status`` is the plugin's state, as ``GET /plugin/rrfmodel/status`` tells it. Each row has its
    ``HELP`` and ``TYPE``, also one that has no value now.
    """
    sources = Sources(model, status)
    lines = [line for metric in METRICS for line in _lines(metric, sources)]
    # a broken name may hold half a character, which no encoding has
    return "\n".join([*lines, ""]).encode("utf-8", "replace").decode("utf-8")


def _lines(metric: Metric, sources: Sources) -> Iterator[str]:
    yield f"# HELP {metric.name} {metric.help}"
    yield f"# TYPE {metric.name} {metric.kind}"
    told = set()
    for labels, value in metric.samples(sources):
        number = _number(value)
        # the format has no place for two values of the same labels, a broken model may
        if number is not None and labels not in told:
            told.add(labels)
            yield f"{metric.name}{_braced(metric.labels, labels)} {number}"


def _braced(names: tuple[str, ...], values: tuple[str, ...]) -> str:
    pairs = ",".join(f'{name}="{_escaped(value)}"' for name, value in zip(names, values))
    return f"{{{pairs}}}" if pairs else ""


def _escaped(text: str) -> str:
    return _SPECIAL.sub(lambda match: _ESCAPES[match[0]], text)


def _number(value: Any) -> str | None:
    """Return a number's text; ``None`` for what is none, or not finite."""
    if not isinstance(value, (bool, int, float)):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    if not math.isfinite(number):
        return None
    return str(int(number)) if number.is_integer() and abs(number) < WHOLE_BELOW else repr(number)
