"""M291 and M292: message boxes, and what a blocking one holds up (RRF 3.5 GCodes2.cpp)."""

from __future__ import annotations

from typing import Any

from ..clock import Clock
from ..device.boxes import CANCEL_MODE, CHOICE_MODE, CLOSE_MODE, MessageBoxes
from ..firmware import Firmware
from ..hardware.blank import USB_CHANNELS
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import MacroAbandoned, Outcome, Running, Silently
from ..line.output import Output
from ..line.switches import FaultSwitches
from ..text.command import Command, GCodeError, SyntaxProblem

DEFAULT_TIMEOUT = 10.0
AXES_OF_CONTROLS = "XYZ"


class BoxCodes:
    """Opens message boxes and answers them."""

    def __init__(
        self,
        *,
        clock: Clock,
        firmware: Firmware,
        boxes: MessageBoxes,
        faults: FaultSwitches,
        output: Output,
    ):
        self._clock = clock
        self._firmware = firmware
        self._boxes = boxes
        self._faults = faults
        self._output = output

    def rows(self) -> Rows:
        return {
            "M291": Row(self._open_box),
            "M292": Row(self._answer_box),
        }

    def _open_box(self, channel: Channel, command: Command) -> Outcome:
        """M291: modes up to 1 don't wait; from USB even the others acknowledge at once."""
        message, title = command.needed_string("P"), command.string("R") or ""
        mode = command.integer("S", CLOSE_MODE) or 0
        if not 0 <= mode <= self._firmware.box_modes:
            raise GCodeError("Invalid message box mode")
        timeout = command.number_of("T", 0.0 if mode > CLOSE_MODE else DEFAULT_TIMEOUT) or 0.0
        controls = sum(
            1 << index for index, axis in enumerate(AXES_OF_CONTROLS) if command.integer(axis, 0)
        )
        arguments: dict[str, Any] = dict(
            timeout=timeout, controls=controls, cancel=bool(command.integer("J", 0))
        )
        if mode >= CHOICE_MODE:
            arguments.update(_limits(command, mode))
        from_usb = channel.name in USB_CHANNELS
        if from_usb:
            self._print(title, message, mode)
        if not from_usb or self._firmware.usb_box_opens:
            seq = self._boxes.open(message, title, mode, **arguments)
        else:
            seq = -1
        if mode <= CLOSE_MODE:
            return None
        if seq < 0:
            return self._without_box(channel)
        if from_usb and not channel.is_in_macro:
            channel.awaits_acknowledgement = True
            self._clock.when(self._boxes.when_closed(seq), channel.acknowledged)
            return None
        return self._wait_for_answer(channel, seq)

    def _without_box(self, channel: Channel) -> Outcome:
        """USB waits for an answer that nobody can give (3.5 to 3.6.0, #1141; seen in firmware)."""
        if channel.is_in_macro:
            channel.is_lost_in_box = True
            return _wait_for_ever()
        channel.awaits_acknowledgement = True
        channel.input["stackDepth"] += 1
        self._boxes.unanswerable += 1
        if self._faults.is_on("usb_box_stuck"):
            channel.is_stuck = True
        return None

    def _print(self, title: str, message: str, mode: int) -> None:
        """Show the text on USB itself (RRF 3.5 Platform.cpp SendAlert)."""
        text = f"- {title} -\n{message}\n" if title else f"{message}\n"
        if mode == CANCEL_MODE:
            text += "Send M292 to continue or M292 P1 to cancel\n"
        elif CLOSE_MODE < mode < CHOICE_MODE:
            text += "Send M292 to continue\n"
        self._output.to_usb(text)

    def _wait_for_answer(self, channel: Channel, seq: int) -> Running:
        channel.awaits_acknowledgement = True
        before = len(self._boxes.answers)
        try:
            yield Silently(self._boxes.when_closed(seq))
        finally:
            channel.awaits_acknowledgement = False
        if self._boxes.answers[before:] and self._boxes.answers[-1] is False:
            raise MacroAbandoned

    def _answer_box(self, channel: Channel, command: Command) -> Outcome:
        """M292: P1 cancels, R gives a value and S the box meant (both from 3.5)."""
        if "R" in command and not command.raw["R"][0].startswith("{"):
            raise SyntaxProblem(
                f"{command.name}: expected an expression inside {{ }}", command.raw["R"][1]
            )
        box = self._boxes.current
        if box is None:
            return None
        wanted = command.integer("S") if self._firmware.at_least(3, 5) else None
        if wanted is not None and wanted != box["seq"]:
            return None
        cancelled = command.integer("P", 0) == 1
        value = command.value("R") if "R" in command and not cancelled else None
        if box["mode"] >= CHOICE_MODE and not cancelled:
            _check(box, value)
        self._boxes.answers.append(False if cancelled else value)
        self._boxes.close(box["seq"])
        return None


def _wait_for_ever() -> Running:
    yield Silently(lambda: False)


def _limits(command: Command, mode: int) -> dict[str, Any]:
    if mode == CHOICE_MODE:
        choices = command.value("K")
        if not isinstance(choices, list):
            raise GCodeError("missing parameter 'K'")
        return {"choices": choices, "default": command.integer("F")}
    return {"low": command.value("L"), "high": command.value("H"), "default": command.value("F")}


def _check(box: dict[str, Any], value: Any) -> None:
    mode = box["mode"]
    if mode == CHOICE_MODE:
        if not isinstance(value, int) or not 0 <= value < len(box["choices"] or ()):
            raise GCodeError("Invalid choice")
        return
    size = len(value) if isinstance(value, str) else value
    if mode == 7 and not isinstance(value, str) or mode in (5, 6) and isinstance(value, str):
        raise GCodeError("Value is not of the right type")
    if size is None:
        raise GCodeError("missing parameter 'R'")
    low, high = box.get("min"), box.get("max")
    if (low is not None and size < low) or (high is not None and size > high):
        raise GCodeError("Value is out of range")
