"""The message boxes of the object model. Eight queue up; the first is shown.

RRF 3.5 state.messageBox of RepRap.cpp.
"""

from __future__ import annotations

from typing import Any

from ..clock import Clock, Condition
from ..model.tree import ObjectModel
from ..text.command import GCodeError

MOST_BOXES = 8
CLOSE_MODE = 1
CANCEL_MODE = 3
CHOICE_MODE = 4


class MessageBoxes:
    """The boxes that are open, oldest first."""

    def __init__(self, model: ObjectModel, clock: Clock):
        self._model = model
        self._clock = clock
        self.restart()

    def restart(self) -> None:
        self._open: list[dict[str, Any]] = []
        self._deadlines: dict[int, float] = {}
        self._seq = 0
        self.unanswerable = 0
        """Blocking boxes of USB that aren't in the model and stay for good."""
        self.answers: list[Any] = []
        """What M292 said so far: ``None`` for OK, ``False`` for cancel, or the value."""

    def open(
        self,
        message: str,
        title: str,
        mode: int,
        timeout: float = 0.0,
        controls: int | None = None,
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
        self._open.append(self._model.members_of(box, "state.messageBox"))
        if timeout > 0:
            self._deadlines[self._seq] = self._clock.now + timeout
        self._show()
        return self._seq

    def adopt(self, box: dict[str, Any]) -> None:
        """Take a box for open that is in the model from the beginning."""
        self._seq = box["seq"]
        self._open = [box]

    def is_open(self, seq: int) -> bool:
        return any(box["seq"] == seq for box in self._open)

    def when_closed(self, seq: int) -> Condition:
        """Return the condition that this box isn't open any more."""
        return lambda: not self.is_open(seq)

    @property
    def current(self) -> dict[str, Any] | None:
        return self._open[0] if self._open else None

    @property
    def is_blocking(self) -> bool:
        """Whether a box that waits for an answer is open."""
        return self.unanswerable > 0 or any(box["mode"] > CLOSE_MODE for box in self._open)

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
            if self._clock.now >= deadline:
                self.close(seq)

    def _show(self) -> None:
        self._model.data["state"]["messageBox"] = self.current
        self._model.bump("state")
