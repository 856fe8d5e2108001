"""The firmware's event system: what it says of a fault, and what it does then.

RRF 3.4 and later go through it (``- Event notification -``), 3.3 prints an error (RRF 3.3
LocalHeater.cpp:743); only a print from the card is paused (RRF 3.5 GCodes3.cpp:1520-1573).
"""

from __future__ import annotations

from ..firmware import Firmware
from ..line.output import Output
from .boxes import MessageBoxes
from .job import Job

ALERT_MODE = 1


class Events:
    """Announces faults as that firmware does."""

    def __init__(self, *, firmware: Firmware, job: Job, boxes: MessageBoxes, output: Output):
        self._firmware = firmware
        self._job = job
        self._boxes = boxes
        self._output = output

    def announce(self, text: str, opens_box: bool = True) -> None:
        """Tell everybody of a fault, and pause a print from the card."""
        prints = self._job.is_printing
        if not self._firmware.has_events:
            self._output.text(f"Error: {text}\n")
        else:
            title = "Printing paused" if prints else "Event notification"
            self._output.text(f"- {title} -\n{text}\n")
            if opens_box:
                self._boxes.open(text, title, ALERT_MODE, timeout=0.0)
        if prints:
            self._job.pause_for_fault()
