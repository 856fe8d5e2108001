"""The 255 bytes in which G-code from the network waits (RRF 3.5 GCodeInput.cpp; seen in
firmware).
"""

from __future__ import annotations

from ...firmware import Firmware
from ...interpreter.urgent import Urgent
from ...line.channel import Channel
from ...text.letters import utf8

SIZE = 255


class HttpInput:
    """Takes the texts of ``rr_gcode``, whoever sends them."""

    def __init__(self, channel: Channel, urgent: Urgent, firmware: Firmware):
        self._channel = channel
        self._urgent = urgent
        self._tells_full = firmware.tells_full_input

    @property
    def free(self) -> int:
        """Bytes that there is room for."""
        return SIZE - sum(len(utf8(line)) + 1 for line in self._channel.lines)

    def put(self, text: str) -> str:
        """Queue a text, which may have several lines; return the JSON that answers it."""
        if text:
            if len(utf8(text)) + 1 > self.free:
                # lost without a word before 3.4.5
                return '{"err":1}' if self._tells_full else f'{{"buff":{self.free}}}'
            for line in text.split("\n"):
                if not self._urgent.takes(line, True) and line:
                    self._channel.lines.append(line)
        return f'{{"buff":{max(self.free, 0)}}}'
