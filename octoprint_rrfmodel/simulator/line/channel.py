"""One G-code channel: a sequential queue of lines, and the command that holds it up.

A command is a function that returns its reply, or a generator that yields conditions and returns
the reply at the end. While a condition isn't true the channel accepts nothing further, whatever
lies in its input (RRF 3.5 GCodes.cpp:770-785, GCodes4.cpp:1885).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Generator
from types import GeneratorType
from typing import TYPE_CHECKING, Any, Callable, Union

from ..text.command import Command, GCodeError, SyntaxProblem, commands_of, without_comment
from ..text.letters import utf8
from ..text.serial_line import Kind, Reply, framed, parse_line

if TYPE_CHECKING:
    from ..core import Core

Condition = Callable[[], bool]
Running = Generator[Condition, None, Any]
Outcome = Union[None, str, Reply, Running]

MACRO_DEPTH = 10
_STACK_MEMBERS = ("axesRelative", "drivesRelative", "distanceUnit", "feedRate", "selectedPlane")
"""What M120 keeps (RRF 3.5 GCodeMachineState.cpp:41)."""


class MoveError(GCodeError):
    """A G0 to G3 that fails; it takes the rest of its line with it."""


class Macro(Exception):
    """Abandons the macro that runs, after a cancelled message box or ``abort``."""


class Channel:
    """Input, modal state and the running command of one channel."""

    def __init__(self, board: Core, name: str, write: Callable[[str], None], echoes: bool = True):
        self._board = board
        self.name = name
        self._write = write
        self._echoes = echoes
        self.lines: deque[str] = deque()
        self._pending: deque[Command] = deque()
        self._running: Running | None = None
        self._current: Command | None = None
        self._wait: Condition | None = None
        self._stack: list[dict[str, Any]] = []
        self.macro_depth = 0
        self.macros = 0
        """Macros of the firmware's own that run, homing and the like."""
        self.upload: str | None = None
        """File that an open M28 writes to."""
        self.status_request: str | None = None
        """The last of M105, M408 S0 and M409 that came on this channel."""
        self.requires_checksum = False
        self.awaits_acknowledgement = False
        self.is_stuck = False
        self.blocked_since: float | None = None
        self.reported_at = 0.0
        self.variables: dict[str, Any] = {}

    @property
    def input(self) -> dict[str, Any]:
        """The channel's element of ``inputs``."""
        return self._board.input(self.name)

    @property
    def is_blocked(self) -> bool:
        return self._running is not None

    @property
    def is_idle(self) -> bool:
        return self._running is None and not self._pending and not self.lines

    @property
    def state(self) -> str:
        """As ``inputs[].state`` names it."""
        if self.awaits_acknowledgement:
            return "awaitingAcknowledgement"
        if self._wait is not None:
            return "waiting"
        if self._current is not None:
            return "executing"
        return "idle"

    @property
    def is_in_macro(self) -> bool:
        return self.macros > 0 or self.macro_depth > 0

    def push(self) -> None:
        if len(self._stack) >= MACRO_DEPTH:
            raise GCodeError("Push(): stack overflow")
        channel = self.input
        self._stack.append({name: channel.get(name) for name in _STACK_MEMBERS if name in channel})
        self.input["stackDepth"] = len(self._stack)

    def pop(self) -> None:
        if not self._stack:
            raise GCodeError("Pop(): stack underflow")
        self.input.update(self._stack.pop())
        self.input["stackDepth"] = len(self._stack)

    def abandon(self, keep_input: bool = False) -> None:
        """Forget what runs, and what has come in unless that is to be kept."""
        if not keep_input:
            self.lines.clear()
        self._pending.clear()
        self._running = self._current = self._wait = None
        self.macro_depth = 0
        self.upload = None
        self.blocked_since = None
        self.awaits_acknowledgement = False

    def pump(self) -> None:
        """Go on until the input is used up or a command waits."""
        while not self.is_stuck:
            if self._running is not None:
                if self._wait is not None and not self._wait():
                    if not self._answers_box():
                        return
                    continue
                self._resume()
            elif self._pending:
                self._execute(self._pending.popleft())
            elif self.lines:
                self._take(self.lines.popleft())
            else:
                return

    def _answers_box(self) -> bool:
        """Run an M292 past the box that this channel waits for; return whether there was one."""
        if not self.awaits_acknowledgement or not self.lines:
            return False
        if not self.lines[0].lstrip().upper().startswith("M292"):
            return False
        (command,) = self._commands(self.lines.popleft())
        try:
            reply = as_reply(self._board.execute_command(self, command))
        except (GCodeError, SyntaxProblem) as error:
            reply = Reply(f"Error: {command.name}: {error}")
        self._write(framed(reply, self.input["compatibility"], True, False))
        return True

    def _take(self, text: str) -> None:
        """Read one line: an upload's line goes to the card, a bad one nowhere."""
        firmware = self._board.firmware
        line = parse_line(text, firmware.has_crc, self.requires_checksum)
        if line is None:
            return
        if line.number is not None:
            self.input["lineNumber"] = line.number
        if self.upload is not None and not line.text.lstrip().upper().startswith("M29"):
            self._board.card.append(self.upload, line.text + "\n")
            return
        if len(utf8(line.text)) >= firmware.line_length:
            self._answer(Reply("Error: GCode command too long"), True)
            return
        try:
            self._pending.extend(self._commands(line.text))
        except SyntaxProblem as problem:
            self._answer(Reply(self._problem_text(problem)), True)

    def _commands(self, text: str) -> list[Command]:
        board = self._board
        bare = without_comment(text, board.is_cnc) if ";" in text or board.is_cnc else text
        if not bare or bare.isspace():
            return []
        return commands_of(bare, self.lookup, board.motion.last_code if board.is_cnc else None)

    def lookup(self, path: str) -> Any:
        """Return a variable of this channel or a member of the object model."""
        if path.startswith("var."):
            return self.variables.get(path[4:])
        return self._board.member(path)

    def _problem_text(self, problem: SyntaxProblem) -> str:
        if problem.column is not None and self._board.firmware.error_column:
            return f"Error:  at column {problem.column}: {problem.text}"
        return f"Error: {problem.text}"

    def _execute(self, command: Command) -> None:
        self._current = command
        try:
            outcome = self._board.execute_command(self, command)
            if isinstance(outcome, GeneratorType):
                self._running = outcome
                self.blocked_since = self.reported_at = self._board.now
                self._resume()
                return
        except (GCodeError, SyntaxProblem) as error:
            self._fail(command, error)
            return
        self._finish(outcome)

    def _resume(self) -> None:
        command, running = self._current, self._running
        if command is None or running is None:
            return
        try:
            self._wait = next(running)
            return
        except StopIteration as end:
            outcome, error = end.value, None
        except Macro:
            outcome, error = "", None
        except (GCodeError, SyntaxProblem) as failure:
            outcome, error = None, failure
        self._running = self._wait = self.blocked_since = None
        self.macro_depth = 0
        if error is not None:
            self._fail(command, error)
        else:
            self._finish(outcome)

    def _finish(self, outcome: Outcome) -> None:
        self._answer(as_reply(outcome), not self._pending)

    def _fail(self, command: Command, error: Exception) -> None:
        if isinstance(error, SyntaxProblem):
            self._pending.clear()
            self._answer(Reply(self._problem_text(error)), True)
            return
        name = command.name
        if isinstance(error, MoveError):
            following = self._pending.popleft() if self._pending else None
            self._pending.clear()
            if not self._board.firmware.move_error_names_next:
                name = "G0/G1"
            elif following is not None:
                name = following.name
            self._answer(Reply(f"Error: {name}: {error}"), True)
            # the failing move ends the line, but the next command has been decoded already
            # and answers for itself: one ok more than lines (RRF 3.5 GCodeBuffer.cpp:442)
            if following is not None:
                self._pending.append(following)
            return
        self._answer(Reply(f"Error: {name}: {error}"), not self._pending)

    def _answer(self, reply: Reply, is_last: bool) -> None:
        self._current = None
        if not self._echoes:
            if reply.text and reply.kind is not Kind.NONE:
                self._board.message(reply.text + "\n")
            return
        text = framed(reply, self.input["compatibility"], is_last, self.macro_depth > 0)
        if text:
            self._write(text)

    def macro(self, lines: list[str]) -> Running:
        """Run lines as a macro of the current command; their replies get no ``ok``."""
        self.macro_depth += 1
        try:
            for text in lines:
                for command in self._commands(text):
                    yield from self._nested(command)
        finally:
            self.macro_depth -= 1

    def _nested(self, command: Command) -> Running:
        try:
            outcome = self._board.execute_command(self, command)
            if isinstance(outcome, GeneratorType):
                outcome = yield from outcome
            reply = as_reply(outcome)
        except (GCodeError, SyntaxProblem) as error:
            text = self._problem_text(error) if isinstance(error, SyntaxProblem) else None
            reply = Reply(text or f"Error: {command.name}: {error}")
        if reply.text:
            if self._echoes:
                self._write(framed(reply, self.input["compatibility"], False, True))
            else:
                self._board.message(reply.text + "\n")


def as_reply(outcome: Outcome) -> Reply:
    """Return what a command function returned as a reply."""
    if outcome is None:
        return Reply()
    return outcome if isinstance(outcome, Reply) else Reply(str(outcome))
