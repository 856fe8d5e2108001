"""Where recordings of boards and of the firmware's own code lie, outside the repository."""

from __future__ import annotations

import os
from pathlib import Path

from .places import ROOT

RECORDINGS = Path(os.environ.get("RRF_SHARED") or ROOT.parent / "shared")
"""``RRF_SHARED``, or the folder ``shared`` beside the repository; it may not be there."""
