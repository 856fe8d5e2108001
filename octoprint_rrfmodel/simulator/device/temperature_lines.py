"""Temperature lines without ``ok`` that nobody has asked for."""

from __future__ import annotations

from ..clock import Clock
from ..firmware import Firmware
from ..line.channel import Channel
from ..line.outcome import Silently
from ..line.output import Output
from ..line.switches import FaultSwitches
from .thermal import Thermal

SHORTEST_INTERVAL = 0.05
STEP = 0.25
"""How late it may be noticed that a line is due."""


class TemperatureLines:
    """Sends them while the USB channel is blocked, and where a fault wants them."""

    def __init__(
        self,
        *,
        clock: Clock,
        firmware: Firmware,
        thermal: Thermal,
        usb: Channel,
        output: Output,
        faults: FaultSwitches,
    ):
        self._clock = clock
        self._firmware = firmware
        self._thermal = thermal
        self._usb = usb
        self._output = output
        self._faults = faults
        self._unsolicited_at = 0.0

    def tick(self) -> None:
        """Send what is due now."""
        self._report_while_blocked()
        now = self._clock.now
        if self._faults.is_on("unsolicited") and now >= self._unsolicited_at:
            interval = self._faults.number("unsolicited", 1.0)
            self._unsolicited_at = now + max(SHORTEST_INTERVAL, interval)
            self._send()

    def _report_while_blocked(self) -> None:
        """Send temperatures while USB waits (RRF 3.3 GCodes.cpp:4620, 3.5 GCodes.cpp:4865)."""
        usb = self._usb
        if usb.blocked_since is None or not usb.is_marlin or isinstance(usb.wait, Silently):
            return
        interval, now = self._firmware.report_interval, self._clock.now
        late = now - usb.reported_at - interval
        if late < 0:
            return
        # on time also where the board was looked at late
        usb.reported_at = now - late if late < STEP else now
        # after M409 or M408 the report goes to the first aux port instead
        if not self._firmware.report_follows_request or usb.status_request == "M105":
            self._send()

    def _send(self) -> None:
        self._output.to_usb(self._thermal.report() + "\n")
