"""Warnings of extrusion that doesn't happen, which come behind the ``ok`` and not often."""

from __future__ import annotations

from ..clock import Clock
from ..line.output import Output

INTERVAL = 4.0
"""Shortest time between two of a kind (seen in firmware)."""
NO_TOOL = "Error: Attempting to extrude with no tool selected.\n"


class ExtrusionWarnings:
    """Says that nothing was extruded, once there has been no such warning for a while."""

    def __init__(self, clock: Clock, output: Output):
        self._clock = clock
        self._output = output
        self.restart()

    def restart(self) -> None:
        self._lacks_tool = False
        self._cold: int | None = None
        self._is_cold_again = False
        self._tool_said_at = self._cold_said_at = -INTERVAL

    @property
    def is_waiting(self) -> bool:
        """Whether there is something to be said later."""
        return self._lacks_tool or self._cold is not None

    def no_tool(self) -> None:
        """Extrusion was asked for while no tool is selected."""
        self._lacks_tool = True

    def cold(self, tool: int) -> None:
        """Extrusion was asked for while that tool is too cold or has a fault."""
        self._is_cold_again = self._cold is not None
        self._cold = tool

    def tick(self) -> None:
        """Say what is due."""
        now = self._clock.now
        if self._lacks_tool and now - self._tool_said_at >= INTERVAL:
            self._lacks_tool, self._tool_said_at = False, now
            self._output.text(NO_TOOL)
        if self._cold is not None and now - self._cold_said_at >= INTERVAL:
            tool, self._cold_said_at = self._cold, now
            # what was asked for behind the first is warned of later
            self._cold, self._is_cold_again = (tool if self._is_cold_again else None), False
            self._output.text(
                f"Warning: Tool {tool} was not driven because its heater temperatures were not "
                "high enough or it has a heater fault\n"
            )
