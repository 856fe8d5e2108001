"""One table of all measurements: printed as they come, and written as JSON in the end."""

from __future__ import annotations

import json
import platform
import time
from pathlib import Path
from typing import Any

ROWS: list[dict[str, Any]] = []


def tell(
    what: str,
    value: float,
    unit: str,
    *,
    beside: str = "",
    limit: float | None = None,
    at_least: bool = False,
    **more: Any,
) -> None:
    """Print a row and keep it.

    ``beside`` says what it is compared with in the same run, ``limit`` what it is to keep: at most,
    or at least. ``more`` stands in the JSON alone.
    """
    kept = None if limit is None else (value >= limit if at_least else value <= limit)
    ROWS.append(
        {"what": what, "value": value, "unit": unit, "beside": beside, "limit": limit, "kept": kept}
        | more
    )
    goal = "" if limit is None else f"{'at least' if at_least else 'limit'} {limit:g}"
    word = {None: "", True: "kept", False: "EXCEEDED"}[kept]
    print(f"{what:58} {value:10.3f} {unit:8} {beside:34} {goal:14} {word}".rstrip(), flush=True)


def write(path: Path) -> None:
    """Write all rows, with the machine and the time."""
    machine = {"python": platform.python_version(), "machine": platform.machine(), "at": _now()}
    path.write_text(json.dumps({**machine, "rows": ROWS}, indent=1) + "\n", encoding="utf-8")


def _now() -> str:
    return time.strftime("%Y-%m-%d %H:%M")
