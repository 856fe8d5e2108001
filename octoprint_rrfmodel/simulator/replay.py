"""A board as a support bundle describes it, so that a report becomes a test."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any, NamedTuple

from octoprint_rrfmodel.rrf.wire import bundle

from . import captured
from .board import Board
from .interpreter.table import Row, Rows
from .line.channel import Channel
from .line.outcome import Outcome
from .text.command import Command

OLD = "2.05"
"""The firmware that stands for all without M409."""

NAMES = {
    "FIRMWARE_NAME": "firmwareName",
    "FIRMWARE_VERSION": "firmwareVersion",
    "ELECTRONICS": "name",
    "FIRMWARE_DATE": "firmwareDate",
}
"""What M115 tells, by its member of ``boards[0]``."""

DSF = "dsf"
"""The protocol of a board behind a computer."""

AWAITING = "awaitingAcknowledgement"
"""``inputs[].state`` of a channel that waits for the answer to a message box."""

BOX = ("mode", "seq")
"""Members without which nobody could answer a box."""


class Recording(NamedTuple):
    """What a bundle tells of a machine."""

    model: Mapping[str, Any]
    protocol: str | None
    """``M409``, ``M408``, ``rr`` or ``dsf``."""
    reported: Mapping[str, str]
    """What ``M115`` has told, by its words."""

    @property
    def firmware(self) -> str:
        """The name of the known firmware that it is replayed on."""
        return OLD if self.protocol == "M408" else captured.firmware_of(self.model)

    @property
    def is_behind_computer(self) -> bool:
        """Whether a computer stood in front of the board."""
        return self.protocol == DSF

    def board(
        self, firmware: str | None = None, *, faults: Iterable[str] = (), speed: float = 1.0
    ) -> Board:
        """Return the machine, doing what it did then."""
        chosen = firmware or self.firmware
        made = Board(firmware=chosen, model=self.model, faults=faults, speed=speed)
        go_on(made, self.model)
        if self.reported:
            made.gcodes.register(ToldIdentity(self.reported))
        return made


class ToldIdentity:
    """``M115`` as the recorded machine has answered it."""

    def __init__(self, reported: Mapping[str, str]):
        self._text = " ".join(f"{name}: {value}" for name, value in reported.items())

    def rows(self) -> Rows:
        return {"M115": Row(self._identify)}

    def _identify(self, channel: Channel, command: Command) -> Outcome:
        return self._text


def load(path: str | os.PathLike[str]) -> Recording:
    """Return what a bundle tells; ``UnreadableModel`` says why there is none in that file."""
    try:
        with open(path, "rb") as file:
            archive = file.read()
        return recording(archive)
    except OSError as problem:
        raise captured.UnreadableModel(f"cannot read {os.fspath(path)}: {problem}") from None


def recording(archive: bytes) -> Recording:
    """Return what a bundle tells; ``UnreadableModel`` says why it tells nothing."""
    try:
        model = bundle.member(archive, bundle.MODEL)
        machine = bundle.member(archive, bundle.MACHINE)
    except bundle.NoBundle as problem:
        raise captured.UnreadableModel(str(problem)) from None
    told = machine if isinstance(machine, Mapping) else {}
    protocol, names = told.get("protocol"), told.get("reported")
    reported = {
        str(name): value
        for name, value in (names if isinstance(names, Mapping) else {}).items()
        if isinstance(value, str) and value.isprintable()
    }
    return Recording(
        _with_names(captured.model_of(model), reported),
        protocol if isinstance(protocol, str) else None,
        reported,
    )


def _with_names(model: dict[str, Any], reported: Mapping[str, Any]) -> dict[str, Any]:
    """Return the model with the names that M115 has told, where it has none of them itself."""
    boards = list(model.get("boards") or [None])
    first = dict(boards[0]) if isinstance(boards[0], Mapping) else {}
    for name, member in NAMES.items():
        if name in reported and not first.get(member):
            first[member] = reported[name]
    return {**model, "boards": [first, *boards[1:]]} if first else model


def go_on(board: Board, model: Mapping[str, Any]) -> None:
    """Let a board do what its model tells, until it is restarted or does something else."""
    status, box = (model["state"].get(name) for name in ("status", "messageBox"))
    board.activity.is_halted = status == "halted"
    board.power.is_on = status != "off"
    board.status.recorded = status if isinstance(status, str) else None
    is_open = isinstance(box, Mapping) and {type(box.get(name)) for name in BOX} == {int}
    if is_open:
        board.boxes.adopt(dict(box))
    for each in model.get("inputs") or ():
        if isinstance(each, Mapping) and each.get("state") == AWAITING:
            _await_answer(board, str(each.get("name")), box["seq"] if is_open else None)
    nulls = [name for name, value in model["state"].items() if value is None]
    board.restart.register(partial(_forget, board, nulls))
    _show(board, nulls)


def _await_answer(board: Board, name: str, seq: int | None) -> None:
    """Let a channel wait for the answer to a box, ``None`` for one that none can be given to."""
    channel = board.channels.get(name)
    if channel is None:
        return
    channel.awaits_acknowledgement = True
    if seq is None:
        board.boxes.unanswerable += 1
    else:
        board.clock.when(board.boxes.when_closed(seq), channel.acknowledged)


def _forget(board: Board, nulls: Iterable[str]) -> None:
    """Be the same machine with nothing to do: it has been restarted."""
    board.status.recorded = None
    board.boxes.close_all()
    _show(board, nulls)


def _show(board: Board, nulls: Iterable[str]) -> None:
    """Bring the model up to date; what a whole recording has as null isn't only missing in it."""
    board.data["state"].update(dict.fromkeys(nulls))
    board.live.refresh()
