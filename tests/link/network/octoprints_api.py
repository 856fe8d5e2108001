"""OctoPrint's connector API in lines of text, one for each thing that the connector stands on.

``python -m tests.link.network.octoprints_api`` writes those of the OctoPrint that runs it into
``octoprints_api.txt``, once the code has been looked through for what is new.
"""

import inspect
from pathlib import Path

# OctoPrint's printer can't be imported from any side
import octoprint.filemanager  # noqa: F401
from octoprint import printer
from octoprint.filemanager.storage import common
from octoprint.filemanager.storage.printer import PrinterFileStorage
from octoprint.printer import connection, job, standard
from octoprint.server.util.tornado import StorageFileDownloadHandler

WRITTEN_AGAINST = Path(__file__).with_suffix(".txt")

CLASSES = (
    connection.ConnectedPrinter,
    connection.ConnectedPrinterListenerMixin,
    printer.PrinterFilesMixin,
    PrinterFileStorage,
)
"""Those whose members are all recorded: a new one may be for a connector to have."""

FUNCTIONS = (
    *((standard.Printer, name) for name in ("connect", "disconnect", "trigger_printjob_event")),
    (connection.ConnectedPrinterRegistration, "find"),
    (common.StorageError, "__init__"),
    (StorageFileDownloadHandler, "get"),
)

RECORDS = (
    *(printer.PrinterFile, printer.PrinterFilesUsage),
    *(printer.ErrorInformation, printer.FirmwareInformation),
    *(printer.ConnectedPrinterCapabilities, common.StorageCapabilities),
    *(common.MetadataEntry, common.AnalysisResult, common.AnalysisFilamentUse),
    *(common.StorageThumbnail, job.PrintJob, job.JobProgress),
)


def lines():
    """Return the lines for the OctoPrint that is installed, in order."""
    found = []
    for owner in CLASSES:
        for name in ("__init__", *(name for name in dir(owner) if not name.startswith("_"))):
            found.append(f"{owner.__name__}.{name}{_signature(owner, name)}")
    found += [f"{owner.__name__}.{name}{_signature(owner, name)}" for owner, name in FUNCTIONS]
    found += [f"{owner.__name__}: {', '.join(_members(owner))}" for owner in RECORDS]
    states = ", ".join(state.name for state in connection.ConnectedPrinterState)
    found.append(f"ConnectedPrinterState: {states}")
    return sorted(found)


def _signature(owner, name):
    member = inspect.getattr_static(owner, name)
    if isinstance(member, property):
        return " can be set" if member.fset else ""
    if not callable(getattr(owner, name)):
        return ""
    try:
        parameters = inspect.signature(getattr(owner, name)).parameters.values()
    except ValueError:
        return "(...)"
    return f"({', '.join(_parameter(each) for each in parameters)})"


def _parameter(parameter):
    """Return name, kind, and whether it may be left out."""
    bare = str(parameter.replace(annotation=parameter.empty, default=parameter.empty))
    return bare if parameter.default is parameter.empty else f"{bare}="


def _members(record):
    fields = getattr(record, "model_fields", None)
    if fields is None:
        return [_parameter(each) for each in inspect.signature(record).parameters.values()]
    return [name if field.is_required() else f"{name}=" for name, field in fields.items()]


if __name__ == "__main__":
    WRITTEN_AGAINST.write_text("\n".join(lines()) + "\n")
