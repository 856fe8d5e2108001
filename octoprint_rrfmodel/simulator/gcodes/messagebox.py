"""M291 and M292: message boxes in the object model, and what a blocking one holds up.

RRF 3.5 GCodes2.cpp, state.messageBox of RepRap.cpp. Eight boxes queue up; the first is shown.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..line.channel import Channel, Macro, Outcome, Running
from ..text.command import Command, GCodeError

if TYPE_CHECKING:
    from ..core import Core

MOST_BOXES = 8
CLOSE_MODE = 1
CANCEL_MODE = 3
CHOICE_MODE = 4
DEFAULT_TIMEOUT = 10.0
AXES_OF_CONTROLS = "XYZ"


class MessageBoxes:
    """The boxes that are open, oldest first."""

    def __init__(self, board: Core):
        self._board = board
        self._open: list[dict[str, Any]] = []
        self._deadlines: dict[int, float] = {}
        self._seq = 0
        self.answers: list[Any] = []
        """What M292 said so far: ``None`` for OK, ``False`` for cancel, or the value."""

    def open(
        self,
        message: str,
        title: str,
        mode: int,
        timeout: float = 0.0,
        controls: int = 0,
        cancel: bool = False,
        **limits: Any,
    ) -> int:
        """Show a box and return its number."""
        if len(self._open) >= MOST_BOXES:
            raise GCodeError("Too many message boxes")
        self._seq += 1
        box: dict[str, Any] = {
            "axisControls": controls,
            "cancelButton": cancel or mode == CANCEL_MODE,
            "choices": limits.get("choices"),
            "default": limits.get("default"),
            "max": limits.get("high"),
            "message": message,
            "min": limits.get("low"),
            "mode": mode,
            "seq": self._seq,
            "timeout": int(timeout * 1000),
            "title": title,
        }
        self._open.append(self._board.members_of(box, "state.messageBox"))
        if timeout > 0:
            self._deadlines[self._seq] = self._board.now + timeout
        self._show()
        return self._seq

    def is_open(self, seq: int) -> bool:
        return any(box["seq"] == seq for box in self._open)

    @property
    def current(self) -> dict[str, Any] | None:
        return self._open[0] if self._open else None

    @property
    def is_blocking(self) -> bool:
        """Whether a box that waits for an answer is open."""
        return any(box["mode"] > CLOSE_MODE for box in self._open)

    def close(self, seq: int) -> None:
        self._open = [box for box in self._open if box["seq"] != seq]
        self._deadlines.pop(seq, None)
        self._show()

    def close_all(self) -> None:
        self._open.clear()
        self._deadlines.clear()
        self._show()

    def expire(self) -> None:
        """Close what has been shown for its time."""
        for seq, deadline in list(self._deadlines.items()):
            if self._board.now >= deadline:
                self.close(seq)

    def _show(self) -> None:
        self._board.data["state"]["messageBox"] = self.current
        self._board.bump("state")


def open_box(board: Core, channel: Channel, command: Command) -> Outcome:
    """M291: modes up to 1 don't wait; from USB even the others acknowledge at once."""
    message, title = command.string("P") or "", command.string("R") or ""
    mode = command.integer("S", CLOSE_MODE) or 0
    if not 0 <= mode <= board.firmware.box_modes:
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
    from_usb = channel.name == "USB"
    if from_usb:
        _print(board, title, message, mode)
    if not from_usb or board.firmware.usb_box_opens:
        seq = board.boxes.open(message, title, mode, **arguments)
    else:
        seq = -1
    if mode <= CLOSE_MODE:
        return None
    if from_usb:
        channel.awaits_acknowledgement = True
        if seq < 0 and board.faults.is_on("usb_box_stuck"):
            channel.is_stuck = True
        elif seq >= 0:
            board.when(lambda: not board.boxes.is_open(seq), lambda: _acknowledged(channel))
        return None
    return _wait_for_answer(board, channel, seq)


def _acknowledged(channel: Channel) -> None:
    channel.awaits_acknowledgement = False


def _limits(command: Command, mode: int) -> dict[str, Any]:
    if mode == CHOICE_MODE:
        choices = command.value("K")
        if not isinstance(choices, list):
            raise GCodeError("missing parameter 'K'")
        return {"choices": choices, "default": command.integer("F")}
    return {"low": command.value("L"), "high": command.value("H"), "default": command.value("F")}


def _print(board: Core, title: str, message: str, mode: int) -> None:
    """Show the text on USB itself (RRF 3.5 Platform.cpp SendAlert)."""
    text = f"- {title} -\n{message}\n" if title else f"{message}\n"
    if mode == CANCEL_MODE:
        text += "Send M292 to continue or M292 P1 to cancel\n"
    elif mode > CLOSE_MODE:
        text += "Send M292 to continue\n"
    board.message(text)


def _wait_for_answer(board: Core, channel: Channel, seq: int) -> Running:
    channel.awaits_acknowledgement = True
    before = len(board.boxes.answers)
    try:
        yield lambda: not board.boxes.is_open(seq)
    finally:
        channel.awaits_acknowledgement = False
    if board.boxes.answers[before:] and board.boxes.answers[-1] is False:
        raise Macro


def answer_box(board: Core, channel: Channel, command: Command) -> Outcome:
    """M292: P1 cancels, R gives a value and S the box meant (both from 3.5)."""
    box = board.boxes.current
    if box is None:
        return None
    wanted = command.integer("S") if board.firmware.at_least(3, 5) else None
    if wanted is not None and wanted != box["seq"]:
        return None
    cancelled = command.integer("P", 0) == 1
    value = command.value("R") if "R" in command and not cancelled else None
    if box["mode"] >= CHOICE_MODE and not cancelled:
        _check(box, value)
    board.boxes.answers.append(False if cancelled else value)
    board.boxes.close(box["seq"])
    return None


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


TABLE = {"M291": open_box, "M292": answer_box}
