"""How many examples Hypothesis tries: few in a whole run, many where time is no matter."""

from __future__ import annotations

import os

SHARE = float(os.environ.get("RRF_EXAMPLES", "0.25"))
"""Part of the usual number; ``RRF_EXAMPLES=100`` tries a hundred times as many."""

USUAL = 100
"""Hypothesis's own number, for tests that name none."""


def some(usual: int = USUAL) -> int:
    """Return how many of so many examples are tried now."""
    return max(1, round(usual * SHARE))
