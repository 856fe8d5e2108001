"""The board itself: M111, M112, M555, M575, M999."""

from __future__ import annotations

from ..clock import Clock
from ..device.emergency import Emergency
from ..device.restart import Restart
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..line.output import Output
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError
from ..text.serial_line import COMPATIBILITIES, NO_REPLY

EMERGENCY = "Emergency Stop! Reset the controller to continue.\n"
MODULES = """
    Platform Network Webserver Gcodes Move Heat Kinematics InputShaping Debug PrintMonitor Storage
    PortControl DuetExpansion FilamentSensors WiFi Display SbcInterface CAN Expansion
"""
"""Names of M111, in the order of their numbers (RRF 3.5)."""
RESET_SECONDS = 1.0
"""Time from M999 to the restart (RRF 3.5 GCodes2.cpp:4718)."""


class System:
    """Stops and restarts the board, and sets how its channels talk."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        clock: Clock,
        emergency: Emergency,
        restart: Restart,
        usb: Channel,
        output: Output,
    ):
        self._model = model
        self._clock = clock
        self._emergency = emergency
        self._restart = restart
        self._usb = usb
        self._output = output
        self._debugged: set[int] = set()

    def rows(self) -> Rows:
        return {
            "M111": Row(self._debug),
            "M112": Row(self._emergency_stop),
            "M555": Row(self._compatibility),
            "M575": Row(self._serial_settings),
            "M999": Row(self._restart_board),
        }

    def _emergency_stop(self, channel: Channel, command: Command) -> Outcome:
        """M112: everything off; from then on only a few commands are accepted."""
        self._emergency.stop()
        self._output.text(EMERGENCY)
        return None

    def _restart_board(self, channel: Channel, command: Command) -> Outcome:
        """M999: no reply; the port goes away and comes back."""
        self._clock.after_seconds(RESET_SECONDS, self._restart.power_cycle)
        return NO_REPLY

    def _debug(self, channel: Channel, command: Command) -> Outcome:
        """M111: a table; without parameters or with P there is no ok (RRF 3.5 GCodes2.cpp:1914)."""
        if not command.raw or "P" in command:
            number = command.integer("P")
            if number is not None and "S" in command:
                self._debugged.discard(number)
                if command.integer("S", 0):
                    self._debugged.add(number)
            self._output.text(self._debug_table())
            return NO_REPLY
        return None

    def _debug_table(self) -> str:
        modules = MODULES.split()
        on = "".join(f" {modules[n]}({n} - 0xffffffff)" for n in sorted(self._debugged))
        off = " ".join(f"{name}({n})" for n, name in enumerate(modules) if n not in self._debugged)
        return f"Debugging enabled for modules:{on}\nDebugging disabled for modules: {off}\n"

    def _compatibility(self, channel: Channel, command: Command) -> Outcome:
        """M555: for this channel only."""
        number = command.integer("P")
        if number is None:
            return f"Output mode: {channel.input['compatibility']}"
        if not 0 <= number < len(COMPATIBILITIES):
            raise GCodeError("Invalid output mode")
        channel.input["compatibility"] = COMPATIBILITIES[number]
        self._model.bump("inputs")
        return None

    def _serial_settings(self, channel: Channel, command: Command) -> Outcome:
        """M575 P0 S: whether USB requires a checksum."""
        mode = command.integer("S")
        if command.integer("P", 0) == 0 and mode is not None:
            self._usb.requires_checksum = bool(mode & 1)
        return None
