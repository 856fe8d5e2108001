"""M20 to M39: the card over the serial line.

RRF 3.5 GCodes2.cpp:953-1030, RepRap.cpp:1865-2030, MassStorage.cpp:1118-1205. None of the texts is
what OctoPrint waits for: sizes are missing, and no "SD card ok" is ever said.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any

from ..device.card import Entry
from ..device.fileinfo import file_info
from ..line.channel import Channel, Outcome, Running
from ..model.om import encoded, quoted, with_decimals
from ..text.command import Command, GCodeError
from ..text.serial_line import Kind, Reply

if TYPE_CHECKING:
    from ..core import Core

LIST_BYTES = 2600
"""Text length at which a listing goes on with ``next``: the buffers aren't endless."""
THUMBNAIL_BYTES = 1024
"""Letters of a thumbnail in one answer to M36.1 (3.5 RepRap.cpp)."""
NOT_MOUNTED, NO_FOLDER = 1, 2


def _folder(command: Command) -> str:
    """Return the folder as asked for, with a slash at the end only if it came with one."""
    return command.string("P") or "0:/gcodes/"


def list_files(board: Core, channel: Channel, command: Command) -> Outcome:
    """M20: S0 names, S2 JSON names, S3 JSON with sizes and dates."""
    kind = command.integer("S", 0) or 0
    asked = _folder(command)
    path = board.card.path_of(asked)
    if kind not in (2, 3):
        names = "".join(f"{entry.name}\n" for entry in board.card.entries(path))
        text = names or "NONE\n"
        return Reply(text, Kind.FILE_LIST) if _is_marlin(channel) else Reply(text, Kind.LONG)
    first = command.integer("R", 0) or 0
    error = 0
    if not board.card.is_mounted:
        error = NOT_MOUNTED
    elif not board.card.has_folder(path):
        error = NO_FOLDER
    text = (_names if kind == 2 else _details)(board, asked, path, first, error)
    if board.faults.take("err_no_buffers"):
        text = '{"err":-1}'
    return Reply(text + "\n", Kind.LONG)


def _is_marlin(channel: Channel) -> bool:
    return bool(channel.input["compatibility"] == "Marlin")


def _page(head: str, parts: list[str], first: int, tail: str) -> str:
    """Return a listing that stops at :data:`LIST_BYTES` and says where it goes on."""
    text, following = head, 0
    for index in range(first, len(parts)):
        if index > first and len(text) >= LIST_BYTES:
            following = index
            break
        text += ("," if index > first else "") + parts[index]
    return f'{text}],"next":{following}{tail}}}'


def _names(board: Core, asked: str, path: str, first: int, error: int) -> str:
    if error:
        return f'{{"dir":{quoted(asked)},"first":{first},"files":[],"next":0,"err":{error}}}'
    parts = [quoted(("*" if e.is_folder else "") + e.name) for e in board.card.entries(path)]
    head = f'{{"dir":{quoted(asked)},"first":{first},"files":['
    return _page(head, parts, first, ',"err":0')


def _details(board: Core, asked: str, path: str, first: int, error: int) -> str:
    if error:
        return f'{{"dir":{quoted(asked)},"first":{first},"files":[],"next":0,"err":{error}}}'
    parts = [_detail(entry) for entry in board.card.entries(path)]
    return _page(f'{{"dir":{quoted(asked)},"first":{first},"files":[', parts, first, "")


def _detail(entry: Entry) -> str:
    size = "" if entry.is_folder else f'"size":{entry.size},'
    kind = "d" if entry.is_folder else "f"
    return f'{{"type":"{kind}","name":{quoted(entry.name)},{size}"date":"{entry.date}"}}'


def mount(board: Core, channel: Channel, command: Command) -> Outcome:
    """M21."""
    slot = command.integer("P", 0) or 0
    if slot:
        raise GCodeError(f"Cannot initialise SD card {slot}: Card not present")
    board.card.is_mounted = True
    board.volumes_changed(True)
    return "SDHC card mounted in slot 0, capacity 15.9Gb"


def unmount(board: Core, channel: Channel, command: Command) -> Outcome:
    """M22."""
    slot = command.integer("P", 0) or 0
    if board.job.is_printing:
        raise GCodeError("SD card 0 has open file(s)")
    if not slot:
        board.card.is_mounted = False
        board.volumes_changed(False)
    return f"SD card {slot} may now be removed"


def start_upload(board: Core, channel: Channel, command: Command) -> Outcome:
    """M28: every line until M29 goes to the file and gets no ok (RRF 3.5 GCodeInput.cpp:20-55)."""
    name = command.unquoted_text()
    if not name:
        raise GCodeError("missing filename")
    path = board.card.path_of(name)
    board.card.write(path, "", board.date_time())
    channel.upload = path
    return Reply(f"Writing to file: {name}", Kind.UPLOAD)


def end_upload(board: Core, channel: Channel, command: Command) -> Outcome:
    """M29."""
    if channel.upload is None:
        return None
    channel.upload = None
    board.volumes_changed(True)
    return "Done saving file."


def delete(board: Core, channel: Channel, command: Command) -> Outcome:
    """M30."""
    name = command.unquoted_text()
    path = board.card.path_of(name)
    if not board.card.delete(path):
        board.message(f"Error: Failed to delete file {path}\n")
        raise GCodeError(f"Failed to delete file {path}")
    board.volumes_changed(True)
    return None


def information(board: Core, channel: Channel, command: Command) -> Outcome:
    """M36: file information; without a name of the file being printed. M36.1: a thumbnail."""
    if command.fraction == 1:
        return _thumbnail(board, command)
    name = command.unquoted_text()
    if name:
        path = board.card.path_of(name)
        found = board.card.name_of(path)
        extra = ""
    else:
        found = board.job.path
        path, extra = found or "", f',"printDuration":{int(board.job.duration)}'
    content = board.card.read(found) if found else None
    if found is None or content is None:
        return Reply(f'{{"err":1,"fileName":{quoted(name)}}}\n', Kind.LONG)
    info = board.members_of(file_info(path, content, board.card.date(found)), "job.file")
    return Reply(_information(board, info) + extra + "}\n", Kind.LONG)


FIELDS = (
    "fileName",
    "size",
    "lastModified",
    "height",
    "firstLayerHeight",
    "layerHeight",
    "numLayers",
    "printTime",
    "simulatedTime",
    "filament",
    "thumbnails",
    "generatedBy",
)
"""Members of M36 in the order they are printed."""


def _information(board: Core, info: dict[str, Any]) -> str:
    shown = with_decimals(info, board.model_text.decimals["job"]["file"])
    text = '{"err":0'
    for field in FIELDS:
        if field in shown and shown[field] not in (None, []) or field == "filament":
            text += f",{quoted(field)}:{encoded(shown[field])}"
    return text


def _thumbnail(board: Core, command: Command) -> Outcome:
    """A piece of a thumbnail's text, whole lines as far as there is room (3.5 RepRap.cpp,
    GetThumbnailResponse; 3.4 and later)."""
    name, start = command.string("P") or "", command.integer("S", 0) or 0
    content = board.card.read(board.card.path_of(name))
    head = f'{{"thumbnail":{{"fileName":{quoted(name)},"offset":{start},'
    if content is None:
        return Reply(f'{head}"err":1}}}}\n', Kind.LONG)
    data, position, error = "", start, 0
    while len(data) < THUMBNAIL_BYTES:
        line = content[position:].split(b"\n", 1)[0]
        if position >= len(content):
            position, error = 0, 1
            break
        before, position = position, position + len(line) + 1
        letters = line.rstrip(b"\r").lstrip(b"; \t")
        if b" " in letters:
            # the end, or what can't be base64
            position = 0
            break
        room = THUMBNAIL_BYTES - len(data)
        if len(letters) > room:
            position = before + line.index(letters) + room
        data += letters[:room].decode("latin-1")
    return Reply(f'{head}"data":"{data}","next":{position},"err":{error}}}}}\n', Kind.LONG)


def file_hash(board: Core, channel: Channel, command: Command) -> Outcome:
    """M38: the SHA1 of a file (compiled out in 3.5)."""
    name = command.unquoted_text()
    content = board.card.read(board.card.path_of(name))
    if content is None:
        raise GCodeError(f"Cannot open file {name}")
    return hashlib.sha1(content).hexdigest()


def card_information(board: Core, channel: Channel, command: Command) -> Outcome:
    """M39: text, with S2 JSON."""
    volume: dict[str, Any] | None = (board.data.get("volumes") or [None])[0]
    if command.integer("S", 0) != 2:
        return (
            "SD card in slot 0: capacity 15.9Gb, partition size 15.9Gb, free space 15.7Gb, "
            "speed 20.0MBytes/sec, cluster size 32kb"
        )
    capacity = volume["capacity"] if volume else 0
    free = volume["freeSpace"] if volume else 0
    return Reply(
        f'{{"SDinfo":{{"slot":0,"present":1,"capacity":{capacity},"free":{free},'
        f'"speed":20000000,"clsize":32768}}}}\n',
        Kind.LONG,
    )


def run_macro(board: Core, channel: Channel, command: Command) -> Running:
    """M98: the macro's own replies add no ok."""
    name = command.string("P") or ""
    path = board.card.path_of(name, "0:/sys")
    lines = board.card.lines(path)
    if lines is None:
        board.message(f"Warning: Macro file {name} not found\n")
        return
    with board.running_macro(channel):
        yield from channel.macro(lines)


TABLE = {
    "M20": list_files,
    "M21": mount,
    "M22": unmount,
    "M28": start_upload,
    "M29": end_upload,
    "M30": delete,
    "M36": information,
    "M38": file_hash,
    "M39": card_information,
    "M98": run_macro,
}
