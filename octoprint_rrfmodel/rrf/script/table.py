"""All commands of Klipper's that are understood, by their names."""

from __future__ import annotations

from . import heat, move, prints, tuning

ROWS = (*prints.ROWS, *heat.ROWS, *move.ROWS, *tuning.ROWS)

BY_NAME = {row.name: row for row in ROWS}
