"""G-codes of prints from the card: M0, M23 to M27, M32, M37, M226, M486, M600, M601."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..device import job as jobs
from ..line.channel import Channel, Outcome, Running
from ..text.command import Command, GCodeError
from .moves import standstill

if TYPE_CHECKING:
    from ..core import Core

PAUSE_SECONDS = 2.0
CANCEL_SECONDS = 2.0
ONLY_IN_FILE = "use M226 and M601 only within a file being printed"


def _open(board: Core, command: Command, name: str) -> None:
    if board.job.is_printing:
        raise GCodeError("Cannot set file to print, because a file is already being printed")
    found = board.card.name_of(board.card.path_of(name))
    content = board.card.read(found) if found else None
    if found is None or content is None:
        raise GCodeError(f'GCode file "{name}" not found')
    board.job.select(found, content)


def select_file(board: Core, channel: Channel, command: Command) -> Outcome:
    """M23: name and size aren't told."""
    _open(board, command, command.unquoted_text())
    return "File opened\nFile selected"


def select_and_start(board: Core, channel: Channel, command: Command) -> Outcome:
    """M32."""
    reply = select_file(board, channel, command)
    board.job.start()
    return reply


def simulate(board: Core, channel: Channel, command: Command) -> Outcome:
    """M37: goes through a file without moving; tells the time at the end."""
    name = command.string("P")
    if name is None:
        return "Not simulating"
    _open(board, command, name)
    board.job.start(simulate=True)
    return None


def start_or_resume(board: Core, channel: Channel, command: Command) -> Outcome:
    """M24."""
    job = board.job
    if job.state == jobs.PAUSED:
        return _resume(board, channel)
    if job.state == jobs.SELECTED:
        return _start(board, channel)
    if job.is_printing:
        return None
    raise GCodeError("Cannot print, because no file is selected!")


def _start(board: Core, channel: Channel) -> Running:
    with board.running_macro(channel):
        yield from board.run_system_macro(channel, "start.g")
    board.job.start()


def _resume(board: Core, channel: Channel) -> Running:
    board.job.state = jobs.RESUMING
    with board.running_macro(channel):
        yield from board.run_system_macro(channel, "resume.g")
        yield board.after(PAUSE_SECONDS)
        yield standstill(board)
    board.job.state = jobs.PRINTING
    return "Printing resumed"


def pause(board: Core, channel: Channel, command: Command) -> Outcome:
    """M25: answers after pause.g."""
    if board.job.state != jobs.PRINTING:
        what = "Printing is already paused!" if board.job.is_printing else ""
        raise GCodeError(what or "Cannot pause print, because no file is being printed!")
    return _pause(board, channel)


def _pause(board: Core, channel: Channel) -> Running:
    board.job.state = jobs.PAUSING
    board.save_restore_point(1)
    where = " ".join(f"{axis['letter']}{axis['userPosition']:.1f}" for axis in board.motion.axes)
    if channel.name != "File":
        yield lambda: board.channels["File"].is_idle
    yield standstill(board)
    with board.running_macro(channel):
        yield from board.run_system_macro(channel, "pause.g")
        yield board.after(PAUSE_SECONDS)
        yield standstill(board)
    board.job.state = jobs.PAUSED
    return f"Printing paused at {where}"


def stop(board: Core, channel: Channel, command: Command) -> Outcome:
    """M0, M1, M2: cancels a paused print with cancel.g, ends a file from within."""
    job = board.job
    if channel.name == "File":
        return _end(board)
    if job.state != jobs.PAUSED:
        raise GCodeError("Pause the print before attempting to cancel it")
    return _cancel(board, channel)


def _end(board: Core) -> Running:
    yield standstill(board)
    board.when(lambda: True, lambda: board.job.finish(cancelled=False))


def _cancel(board: Core, channel: Channel) -> Running:
    board.job.state = jobs.CANCELLING
    with board.running_macro(channel):
        yield standstill(board)
        yield from board.run_system_macro(channel, "cancel.g")
        yield board.after(CANCEL_SECONDS)
    board.job.finish(cancelled=True)


def set_position(board: Core, channel: Channel, command: Command) -> Outcome:
    """M26."""
    position = command.integer("S")
    if position is None:
        raise GCodeError("missing parameter 'S'")
    board.job.seek(position)
    return None


def tell_progress(board: Core, channel: Channel, command: Command) -> Outcome:
    """M27."""
    if not board.job.is_printing:
        return "Not SD printing."
    size = (board.data["job"].get("file") or {}).get("size") or 0
    return f"SD printing byte {board.job.position}/{size}"


def pause_from_file(board: Core, channel: Channel, command: Command) -> Outcome:
    """M226, M600, M601: only the file itself may."""
    if channel.name != "File":
        raise GCodeError(ONLY_IN_FILE)
    return _pause(board, channel)


def objects(board: Core, channel: Channel, command: Command) -> Outcome:
    """M486: T count, S current, A name, P cancel, U resume, C cancel the current one."""
    job = board.job
    if not job.is_printing:
        if "P" in command or "U" in command or "C" in command:
            raise GCodeError("No print in progress")
        return None
    number = command.integer("S")
    if number is not None:
        job.name_object(number, command.string("A") if "A" in command else None)
    if "C" in command:
        job.cancel_object(job.current_object, True)
    for letter, cancelled in (("P", True), ("U", False)):
        wanted = command.integer(letter)
        if wanted is not None and not job.cancel_object(wanted, cancelled):
            raise GCodeError("Object number out of range")
    return None


TABLE = {
    "M0": stop,
    "M1": stop,
    "M2": stop,
    "M23": select_file,
    "M24": start_or_resume,
    "M25": pause,
    "M26": set_position,
    "M27": tell_progress,
    "M32": select_and_start,
    "M37": simulate,
    "M125": pause,
    "M226": pause_from_file,
    "M486": objects,
    "M600": pause_from_file,
    "M601": pause_from_file,
}
