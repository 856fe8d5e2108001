"""``rr_fileinfo`` and ``rr_thumbnail``."""

from __future__ import annotations

from ...device.card import Card
from ...device.job import Job
from ...device.network_access import NetworkAccess
from ...device.printing.file_text import FileText, piece_of_thumbnail
from ...firmware import Firmware
from ...model.om import quoted
from .answers import error_answer, text_answer
from .request_parser import Request
from .requests import RequestRow, RequestRows

THUMBNAIL_BYTES = 2600
"""Letters of a thumbnail in one answer."""
NAMES_SINCE = (3, 5)
"""From here on a refusal names the file, and ends without a line break."""
LINE_BREAK_SINCE = (3, 2)


class PrintFileRequests:
    """Tells about print files, and gives their thumbnails."""

    def __init__(
        self, card: Card, job: Job, files: FileText, *, access: NetworkAccess, firmware: Firmware
    ):
        self._card = card
        self._job = job
        self._files = files
        self._access = access
        self._release = firmware.release

    def requests(self) -> RequestRows:
        return {
            "fileinfo": RequestRow(self._tell),
            "thumbnail": RequestRow(self._thumbnail, since=(3, 4)),
        }

    def _tell(self, request: Request) -> bytes:
        """Without a name of the file being printed."""
        name = request.parameter("name") or ""
        path = self._card.path_of(name) if name else self._job.printed_path
        duration = None if name else int(self._job.duration)
        text = path and self._files.network_text(name or path, path, self._card, duration)
        return text_answer(f"{text}\n" if text else self._refusal(name), self._access.cors_site)

    def _refusal(self, name: str) -> str:
        if self._release >= NAMES_SINCE:
            return f'{{"err":1,"fileName":{quoted(name)}}}'
        return '{"err":1}\n' if self._release >= LINE_BREAK_SINCE else '{"err":1}'

    def _thumbnail(self, request: Request) -> bytes:
        name, start = request.parameter("name"), request.number("offset")
        site = self._access.cors_site
        if name is None or not start:
            return error_answer(1, site)
        content = self._card.read(self._card.path_of(name))
        text = f'{{"fileName":{quoted(name)},"offset":{start},'
        if content is None:
            return text_answer(f'{text}"err":1}}\n', site)
        piece = piece_of_thumbnail(content, start, THUMBNAIL_BYTES)
        text += f'"data":"{piece.data}","next":{piece.following},"err":{piece.error}}}\n'
        return text_answer(text, site)
