"""Runs what has come in on a channel: one command after the other, each until it has answered."""

from __future__ import annotations

import re
from collections.abc import Iterable
from types import GeneratorType
from typing import Any

from ..clock import Clock
from ..device.job import Job
from ..firmware import Firmware
from ..line.channel import Channel
from ..line.outcome import MacroAbandoned, MoveError, Outcome, Running, as_reply
from ..line.output import Output
from ..text.command import Command, GCodeError, SyntaxProblem
from ..text.cutting import bad_command
from ..text.letters import utf8
from ..text.serial_line import Kind, Reply, framed, parse_line
from .decoder import Decoder
from .table import GCodes

OK_FIRST = {
    "M28": Kind.UPLOAD,
    "M105": Kind.TEMPERATURES,
    "M998": Kind.TEMPERATURES,
}
"""Whose ``ok`` comes first, in errors too (RRF 3.5 GCodes.cpp:3907)."""

_END_OF_UPLOAD = re.compile(r"\s*[Mm]29(?!\d)")
IGNORED = "\x7f"
"""What makes a line that begins with it unheard (seen in firmware)."""


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
        job: Job,
    ):
        self._gcodes = gcodes
        self._decoder = decoder
        self._firmware = firmware
        self._clock = clock
        self._output = output
        self._job = job

    def pump(self, channel: Channel) -> None:
        """Go on until the input is used up or a command waits."""
        while not channel.is_stuck:
            if channel.running is not None:
                if channel.wait is not None and not channel.wait():
                    if not self._answers_box(channel) and not self._runs_meanwhile(channel):
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
        line = parse_line(channel.lines[0], self._firmware.has_crc, channel.requires_checksum)
        if line is None or not line.text.lstrip().upper().startswith("M292"):
            return False
        channel.lines.popleft()
        (command,) = self._decoder.commands(channel, line.text)
        try:
            reply = as_reply(self._gcodes.execute(channel, command))
        except (GCodeError, SyntaxProblem) as error:
            reply = Reply(f"Error: {command.name}: {error}")
        # the macro's end is acknowledged, not what is sent meanwhile
        channel.write(framed(reply, channel.input["compatibility"], True, channel.is_in_macro))
        return True

    def _runs_meanwhile(self, channel: Channel) -> bool:
        """Run a line while the channel's macro waits for good; return whether there was one."""
        if not channel.is_lost_in_box or not channel.lines:
            return False
        line = parse_line(
            channel.lines.popleft(), self._firmware.has_crc, channel.requires_checksum
        )
        if line is not None:
            commands = self._decoder.commands(channel, line.text)
            rest, wait = channel.running, channel.wait
            channel.running = self._before(channel, commands, (wait, rest))
            channel.wait = None
        return True

    def _before(
        self, channel: Channel, commands: Iterable[Command], later: tuple[Any, Any]
    ) -> Running:
        """Run the commands, and then what has been under way."""
        for command in commands:
            yield from self._nested(channel, command)
        wait, rest = later
        yield wait
        return (yield from rest)

    def _take(self, channel: Channel, text: str) -> None:
        """Read one line: an upload's line goes to the card, a bad one nowhere."""
        channel.line_count += 1
        line = parse_line(text, self._firmware.has_crc, channel.requires_checksum)
        if line is None or line.text.startswith(IGNORED):
            return
        channel.line_number = line.number
        if line.number is not None:
            channel.input["lineNumber"] = line.number
        if channel.upload is not None and not _END_OF_UPLOAD.match(line.text):
            channel.upload(line.text + "\n")
            return
        try:
            commands = self._decoder.commands(channel, line.text, in_file=not channel.echoes)
            # comments don't count (seen in firmware)
            if len(utf8(self._decoder.without_comment(line.text))) >= self._firmware.line_length:
                is_one = len(commands) < 2
                self._answer(channel, Reply("Error: GCode command too long"), is_one)
                return
            channel.pending.extend(commands)
        except SyntaxProblem as problem:
            self._answer(channel, Reply(self._problem_text(channel, problem)), True)

    def _problem_text(self, channel: Channel, problem: SyntaxProblem) -> str:
        if problem.column is None or not self._firmware.error_column:
            return f"Error: {problem.text}"
        where = f"line {channel.line_count}" if problem.names_line else "at"
        return f"Error: {problem.told} {where} column {problem.column}: {problem.text}"

    def _execute(self, channel: Channel, command: Command) -> None:
        channel.current = command
        try:
            if command.letter == "bad":
                raise SyntaxProblem(bad_command(command.text))
            outcome = self._gcodes.execute(channel, command)
            if isinstance(outcome, GeneratorType):
                channel.running = outcome
                channel.blocked_since = self._clock.now
                if not self._firmware.report_follows_request:
                    channel.reported_at = self._clock.now
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
        reply, command = as_reply(outcome), channel.current
        if command is not None and reply.kind is Kind.STRING:
            reply = Reply(reply.text, _kind_of(command))
        self._answer(channel, reply, not channel.pending)

    def _fail(self, channel: Channel, command: Command, error: Exception) -> None:
        if not channel.echoes and self._job.is_running:
            self._fail_job(command, error)
            return
        is_last = not channel.pending
        if isinstance(error, SyntaxProblem):
            text, kind = self._problem_text(channel, error), _kind_of(command)
            self._answer(channel, Reply(text, kind), is_last)
            return
        if isinstance(error, GCodeError) and error.is_silent:
            self._answer(channel, Reply(f"Error: {error}"), False)
            return
        name, kind = command.name, _kind_of(command)
        if isinstance(error, MoveError):
            # the next command of the line has been decoded already: the error speaks in its name,
            # with its ok where it is the last one (RRF 3.5 GCodeBuffer.cpp:442, seen in firmware)
            if channel.pending:
                following = channel.pending[0]
                name, kind, is_last = following.name, _kind_of(following), len(channel.pending) == 1
            if not self._firmware.move_error_names_next:
                name = "G0/G1"
        text = str(error) if isinstance(error, GCodeError) and error.is_bare else f"{name}: {error}"
        self._answer(channel, Reply(f"Error: {text}", kind), is_last)

    def _fail_job(self, command: Command, error: Exception) -> None:
        """The first command of a file that fails cancels the print (seen in firmware)."""
        line = self._job.line_number
        where = f"line {line}"
        if isinstance(error, SyntaxProblem):
            if error.column is not None and self._firmware.error_column:
                where += f" column {error.column}"
            text = error.text
        else:
            text = f"{command.name}: {error}"
        self._job.finish(cancelled=True)
        self._output.text(f"Error: in GCode file {where}: {text}\n")

    def _answer(self, channel: Channel, reply: Reply, is_last: bool) -> None:
        channel.current = None
        reply = self._with_line_number(channel, reply)
        if not channel.echoes:
            if reply.text and reply.kind is not Kind.NONE:
                self._output.text(reply.text + "\n")
            return
        in_macro = channel.macro_depth > 0
        text = framed(reply, channel.input["compatibility"], is_last, in_macro)
        if text:
            channel.write(text)

    def _with_line_number(self, channel: Channel, reply: Reply) -> Reply:
        """Return a reply in JSON with the number of the line it answers, first (RRF #1178)."""
        is_named = self._firmware.names_line and channel.line_number is not None
        if not is_named or not reply.text.startswith('{"'):
            return reply
        return Reply(f'{{"line":{channel.line_number},{reply.text[1:]}', reply.kind)

    def macro(self, channel: Channel, lines: list[str]) -> Running:
        """Run lines as a macro of the current command; their replies get no ``ok``."""
        channel.macro_depth += 1
        # the macro's lines take the place of the one that it was called on (seen in firmware)
        channel.pending.clear()
        try:
            for text in lines:
                for command in self._decoder.commands(channel, text, in_file=True):
                    yield from self._nested(channel, command)
        finally:
            channel.macro_depth -= 1

    def _nested(self, channel: Channel, command: Command) -> Running:
        try:
            if command.letter == "bad":
                raise SyntaxProblem(bad_command(command.text))
            outcome = self._gcodes.execute(channel, command)
            if isinstance(outcome, GeneratorType):
                outcome = yield from outcome
            reply = as_reply(outcome)
        except (GCodeError, SyntaxProblem) as error:
            if isinstance(error, SyntaxProblem):
                reply = Reply(self._problem_text(channel, error))
            else:
                reply = Reply(f"Error: {command.name}: {error}")
        if reply.text:
            if channel.echoes:
                channel.write(framed(reply, channel.input["compatibility"], False, True))
            else:
                self._output.text(reply.text + "\n")


def _kind_of(command: Command) -> Kind:
    return OK_FIRST.get(f"{command.letter}{command.number}", Kind.STRING)
