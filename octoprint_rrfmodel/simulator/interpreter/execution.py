"""Runs what has come in on a channel: one command after the other, each until it has answered."""

from __future__ import annotations

from types import GeneratorType

from ..clock import Clock
from ..firmware import Firmware
from ..line.channel import Channel
from ..line.outcome import MacroAbandoned, MoveError, Outcome, Running, as_reply
from ..line.output import Output
from ..text.command import Command, GCodeError, SyntaxProblem
from ..text.letters import utf8
from ..text.serial_line import Kind, Reply, framed, parse_line
from .decoder import Decoder
from .table import GCodes


class Interpreter:
    """Lets channels go on as far as they can now."""

    def __init__(
        self,
        *,
        gcodes: GCodes,
        decoder: Decoder,
        firmware: Firmware,
        clock: Clock,
        output: Output,
    ):
        self._gcodes = gcodes
        self._decoder = decoder
        self._firmware = firmware
        self._clock = clock
        self._output = output

    def pump(self, channel: Channel) -> None:
        """Go on until the input is used up or a command waits."""
        while not channel.is_stuck:
            if channel.running is not None:
                if channel.wait is not None and not channel.wait():
                    if not self._answers_box(channel):
                        return
                    continue
                self._resume(channel)
            elif channel.pending:
                self._execute(channel, channel.pending.popleft())
            elif channel.lines:
                self._take(channel, channel.lines.popleft())
            else:
                return

    def _answers_box(self, channel: Channel) -> bool:
        """Run an M292 past the box that this channel waits for; return whether there was one."""
        if not channel.awaits_acknowledgement or not channel.lines:
            return False
        if not channel.lines[0].lstrip().upper().startswith("M292"):
            return False
        (command,) = self._decoder.commands(channel, channel.lines.popleft())
        try:
            reply = as_reply(self._gcodes.execute(channel, command))
        except (GCodeError, SyntaxProblem) as error:
            reply = Reply(f"Error: {command.name}: {error}")
        channel.write(framed(reply, channel.input["compatibility"], True, False))
        return True

    def _take(self, channel: Channel, text: str) -> None:
        """Read one line: an upload's line goes to the card, a bad one nowhere."""
        line = parse_line(text, self._firmware.has_crc, channel.requires_checksum)
        if line is None:
            return
        if line.number is not None:
            channel.input["lineNumber"] = line.number
        if channel.upload is not None and not line.text.lstrip().upper().startswith("M29"):
            channel.upload(line.text + "\n")
            return
        if len(utf8(line.text)) >= self._firmware.line_length:
            self._answer(channel, Reply("Error: GCode command too long"), True)
            return
        try:
            channel.pending.extend(self._decoder.commands(channel, line.text))
        except SyntaxProblem as problem:
            self._answer(channel, Reply(self._problem_text(problem)), True)

    def _problem_text(self, problem: SyntaxProblem) -> str:
        if problem.column is not None and self._firmware.error_column:
            return f"Error:  at column {problem.column}: {problem.text}"
        return f"Error: {problem.text}"

    def _execute(self, channel: Channel, command: Command) -> None:
        channel.current = command
        try:
            outcome = self._gcodes.execute(channel, command)
            if isinstance(outcome, GeneratorType):
                channel.running = outcome
                channel.blocked_since = channel.reported_at = self._clock.now
                self._resume(channel)
                return
        except (GCodeError, SyntaxProblem) as error:
            self._fail(channel, command, error)
            return
        self._finish(channel, outcome)

    def _resume(self, channel: Channel) -> None:
        command, running = channel.current, channel.running
        if command is None or running is None:
            return
        try:
            channel.wait = next(running)
            return
        except StopIteration as end:
            outcome, error = end.value, None
        except MacroAbandoned:
            outcome, error = "", None
        except (GCodeError, SyntaxProblem) as failure:
            outcome, error = None, failure
        channel.running = channel.wait = channel.blocked_since = None
        channel.macro_depth = 0
        if error is not None:
            self._fail(channel, command, error)
        else:
            self._finish(channel, outcome)

    def _finish(self, channel: Channel, outcome: Outcome) -> None:
        self._answer(channel, as_reply(outcome), not channel.pending)

    def _fail(self, channel: Channel, command: Command, error: Exception) -> None:
        if isinstance(error, SyntaxProblem):
            channel.pending.clear()
            self._answer(channel, Reply(self._problem_text(error)), True)
            return
        name = command.name
        if isinstance(error, MoveError):
            following = channel.pending.popleft() if channel.pending else None
            channel.pending.clear()
            if not self._firmware.move_error_names_next:
                name = "G0/G1"
            elif following is not None:
                name = following.name
            self._answer(channel, Reply(f"Error: {name}: {error}"), True)
            # the failing move ends the line, but the next command has been decoded already
            # and answers for itself: one ok more than lines (RRF 3.5 GCodeBuffer.cpp:442)
            if following is not None:
                channel.pending.append(following)
            return
        self._answer(channel, Reply(f"Error: {name}: {error}"), not channel.pending)

    def _answer(self, channel: Channel, reply: Reply, is_last: bool) -> None:
        channel.current = None
        if not channel.echoes:
            if reply.text and reply.kind is not Kind.NONE:
                self._output.text(reply.text + "\n")
            return
        in_macro = channel.macro_depth > 0
        text = framed(reply, channel.input["compatibility"], is_last, in_macro)
        if text:
            channel.write(text)

    def macro(self, channel: Channel, lines: list[str]) -> Running:
        """Run lines as a macro of the current command; their replies get no ``ok``."""
        channel.macro_depth += 1
        try:
            for text in lines:
                for command in self._decoder.commands(channel, text):
                    yield from self._nested(channel, command)
        finally:
            channel.macro_depth -= 1

    def _nested(self, channel: Channel, command: Command) -> Running:
        try:
            outcome = self._gcodes.execute(channel, command)
            if isinstance(outcome, GeneratorType):
                outcome = yield from outcome
            reply = as_reply(outcome)
        except (GCodeError, SyntaxProblem) as error:
            text = self._problem_text(error) if isinstance(error, SyntaxProblem) else None
            reply = Reply(text or f"Error: {command.name}: {error}")
        if reply.text:
            if channel.echoes:
                channel.write(framed(reply, channel.input["compatibility"], False, True))
            else:
                self._output.text(reply.text + "\n")
