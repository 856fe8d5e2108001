"""A release of OctoPrint whose connector API isn't the one that the connector was written against.

What differs is to be looked through, then the record is written anew (``octoprints_api``).
"""

import inspect

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

pytest.importorskip("octoprint.printer.connection", reason="OctoPrint 2.0 has it")
from octoprint.printer.connection import (  # noqa: E402
    ConnectedPrinter,
    ConnectedPrinterListenerMixin,
)

from octoprint_rrfmodel.link.network.connector import NetworkPrinter  # noqa: E402
from tests.support.places import ROOT  # noqa: E402

from . import octoprints_api  # noqa: E402


def test_octoprints_api_is_the_one_that_this_was_written_against():
    recorded = octoprints_api.WRITTEN_AGAINST.read_text().splitlines()
    found = octoprints_api.lines()
    assert {
        "gone": sorted(set(recorded) - set(found)),
        "new": sorted(set(found) - set(recorded)),
    } == {"gone": [], "new": []}


OWN = sorted(
    name
    for name, member in inspect.getmembers(NetworkPrinter, inspect.isroutine)
    if not name.startswith("_")
    and hasattr(ConnectedPrinter, name)
    and member.__module__.startswith("octoprint_rrfmodel")
)
"""What the connector has of its own in place of OctoPrint's."""

OF_FILES = sorted(
    name
    for name, member in inspect.getmembers(NetworkPrinter, inspect.isroutine)
    if hasattr(octoprints_api.printer.PrinterFilesMixin, name)
    and not name.startswith("_")
    and member.__module__.startswith("octoprint_rrfmodel")
)

REPLACED = [
    *((ConnectedPrinter, name) for name in OWN),
    *((octoprints_api.printer.PrinterFilesMixin, name) for name in OF_FILES),
]


def test_there_is_something_to_compare():
    assert {"connect", "jog", "start_print", "is_ready"} <= set(OWN)
    assert {"upload_printer_file", "get_printer_files"} <= set(OF_FILES)


@pytest.mark.parametrize(("owner", "name"), REPLACED, ids=lambda each: str(each))
def test_what_stands_in_for_octoprints_takes_what_that_takes(owner, name):
    """By position, as far as OctoPrint's does, and all of it by name."""
    theirs = inspect.signature(getattr(owner, name)).parameters.values()
    ours = inspect.signature(getattr(NetworkPrinter, name))
    named = [each for each in theirs if each.kind is each.POSITIONAL_OR_KEYWORD]
    only_named = [each for each in theirs if each.kind is each.KEYWORD_ONLY]
    own = {each.name: object() for each in named if each.name != "self"}
    me = [object()] if any(each.name == "self" for each in named) else []
    ours.bind(*me, **own, **{each.name: object() for each in only_named})
    needed = [each for each in named if each.default is each.empty and each.name != "self"]
    bound = ours.bind(*me, *(own[each.name] for each in needed)).arguments
    assert [bound[each.name] for each in needed] == [own[each.name] for each in needed]


def test_listener_has_what_is_called():
    """Names alone: what is given is told by the record, and by the tests of the connector."""
    sources = (ROOT / "octoprint_rrfmodel" / "link" / "network").glob("*.py")
    text = "".join(path.read_text("utf-8") for path in sources)
    called = {word for word in text.replace("(", " ").split() if "_listener.on_printer_" in word}
    names = {word.rpartition(".")[2].rstrip(",)") for word in called}
    assert len(names) > 5
    assert names <= set(dir(ConnectedPrinterListenerMixin))
