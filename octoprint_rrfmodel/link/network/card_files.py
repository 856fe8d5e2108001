"""The board's card as OctoPrint's storage ``printer``, answered from what is kept of it."""

import asyncio
import io
from datetime import datetime

from octoprint.filemanager.storage.common import (
    AnalysisFilamentUse,
    AnalysisResult,
    MetadataEntry,
    StorageCapabilities,
    StorageError,
    StorageThumbnail,
)
from octoprint.printer import PrinterFile, PrinterFilesMixin, PrinterFilesUsage

from ...rrf.card.listing import EARLIEST
from .card_names import FORBIDDEN
from .card_refused import CardRefused
from .downloads import Reader
from .reasons import card_sentence

ROOT = "0:/gcodes"

SHOWN = ("height", "layerHeight", "numLayers", "generatedBy", "simulatedTime")
"""Further members of a file's that OctoPrint's API shows."""


class CardFiles(PrinterFilesMixin):
    """The part of the printer that has files."""

    storage_capabilities = StorageCapabilities(
        read_file=True,
        write_file=True,
        remove_file=True,
        move_file=True,
        add_folder=True,
        remove_folder=True,
        move_folder=True,
        metadata=True,
        thumbnails=True,
    )

    _files = ()
    _files_of = None

    def begin_files(self):
        """Show the card, and whenever it has changed say so."""
        self.network.card.changed = lambda: self.side.later(self._tell_files)
        self._listener.on_printer_files_available(True)
        self._tell_files()

    def _tell_files(self):
        self._listener.on_printer_files_refreshed(self.get_printer_files())

    @property
    def printer_files_mounted(self):
        return self.is_operational()

    def refresh_printer_files(self, blocking=False, timeout=10, *args, **kwargs):
        self.network.card.refresh()

    def get_printer_files(self, refresh=False, recursive=False, *args, **kwargs):
        card = self.network.card
        if refresh:
            card.refresh()
        kept = card.files, card.folders, card.details.known
        before = self._files_of
        if before is None or any(now is not then for now, then in zip(kept, before)):
            files, folders, known = kept
            made = [_printer_file(file, known.get(file.path)) for file in files.values()]
            made += [_printer_folder(path) for path in folders]
            self._files, self._files_of = made, kept
        return list(self._files)

    def sanitize_file_name(self, name, *args, **kwargs):
        return "".join("_" if letter in FORBIDDEN or letter == "/" else letter for letter in name)

    def upload_printer_file(self, path_or_file, path, progress_callback=None, *args, **kwargs):
        told = progress_callback or (lambda **_: None)
        try:
            self._change(
                "upload", path_or_file, whole(path), lambda percent: told(progress=percent)
            )
        except StorageError:
            told(failed=True)
            raise
        told(done=True)
        return path

    def download_printer_file(self, path, *args, **kwargs):
        """Return what to read a file from that is here whole; waits unless on a loop.

        On a loop, which serves everybody, it has to be here already (``download_handler``).
        """
        try:
            return Reader(self._fetched(whole(path)))
        except CardRefused as refused:
            code = StorageError.DOES_NOT_EXIST if refused.code == "gone" else None
            raise StorageError(card_sentence(refused), code=code) from None

    def _fetched(self, path):
        card = self.network.card
        file = card.files.get(path)
        if file is None:
            raise CardRefused("gone", path.rpartition("/")[2])
        if is_on_a_loop():
            download = card.downloads.here(file)
            if download is None:
                raise CardRefused("not_here", path.rpartition("/")[2])
            return download
        download = card.downloads.want(file)
        try:
            download.end.result()
        except CardRefused:
            download.release()
            raise
        return download

    def delete_printer_file(self, path, *args, **kwargs):
        self._change("delete", whole(path))

    def create_printer_folder(self, target, *args, **kwargs):
        self._change("make_folder", whole(target))
        return target

    def delete_printer_folder(self, target, recursive=False, *args, **kwargs):
        self._change("delete_folder", whole(target))

    def move_printer_file(self, source, target, *args, **kwargs):
        self._change("move", whole(source), whole(target))
        return target

    def move_printer_folder(self, source, target, *args, **kwargs):
        return self.move_printer_file(source, target)

    def get_printer_file_metadata(self, path, printer_file=None, *args, **kwargs):
        detail = self.network.card.details.known.get(whole(path))
        return _metadata(detail) if detail else None

    def has_thumbnail(self, path, *args, **kwargs):
        return self._picture(path) is not None

    def get_thumbnail(self, path, platehint=None, sizehint=None, *args, **kwargs):
        detail = self._picture(path)
        if detail is None:
            return None
        kind = detail.picture.kind
        return StorageThumbnail(
            name=f"{path.rpartition('/')[2]}.{kind.rpartition('/')[2]}",
            printable=path,
            sizehint=detail.sides,
            mime=kind,
            size=len(detail.picture.data),
            last_modified=datetime.fromtimestamp(EARLIEST),
        )

    def download_thumbnail(self, path, platehint=None, sizehint=None, *args, **kwargs):
        detail = self._picture(path)
        found = self.get_thumbnail(path) if detail else None
        return (found, io.BytesIO(detail.picture.data)) if found else None

    def _picture(self, path):
        detail = self.network.card.details.known.get(whole(path))
        return detail if detail is not None and detail.picture is not None else None

    def get_usage_information(self):
        volume = next(iter(self.network.model().get("volumes") or ()), None) or {}
        free, total = volume.get("freeSpace"), volume.get("capacity")
        if type(free) is not int or type(total) is not int:
            return None
        return PrinterFilesUsage(used=max(0, total - free), total=total)

    def _change(self, name, *arguments):
        try:
            getattr(self.network.card, name)(*arguments)
        except CardRefused as refused:
            code = StorageError.INVALID_DESTINATION if refused.code == "name" else None
            raise StorageError(card_sentence(refused), code=code) from None


def is_on_a_loop():
    """Return whether this thread is one that serves everybody."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return False
    return True


def whole(path):
    """Return the path on the card of a file or folder of OctoPrint's storage."""
    return f"{ROOT}/{path.strip('/')}"


def _printer_file(file, detail):
    modified = file.modified
    return PrinterFile(
        path=file.name,
        display=file.name.rpartition("/")[2],
        size=file.size,
        date=datetime.fromtimestamp(modified) if modified else None,
        metadata=_metadata(detail) if detail else None,
        thumbnails=[detail.sides] if detail and detail.picture else [],
    )


def _metadata(detail):
    """Return what a slicer has said of a file in OctoPrint's words."""
    told = detail.members
    filament = told.get("filament")
    lengths = filament if isinstance(filament, list) else []
    seconds = told.get("printTime") or told.get("simulatedTime")
    return MetadataEntry(
        analysis=AnalysisResult(
            estimatedPrintTime=seconds if isinstance(seconds, (int, float)) else None,
            filament={
                f"tool{number}": AnalysisFilamentUse(length=length)
                for number, length in enumerate(lengths)
                if isinstance(length, (int, float))
            },
        ),
        additional={
            "rrf": {name: told[name] for name in SHOWN if told.get(name) not in (None, 0, "")}
        },
    )


def _printer_folder(path):
    name = path[len(ROOT) + 1 :]
    return PrinterFile(path=f"{name}/", display=name.rpartition("/")[2])
