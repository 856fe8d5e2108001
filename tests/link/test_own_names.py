"""No sensor of the machine can have a name by which OctoPrint calls something of its own."""

import inspect
import re

import pytest

pytest.importorskip("octoprint")

# 2.0's modules need each other, and this order
import octoprint.filemanager  # noqa: F401
from octoprint.printer import standard

from octoprint_rrfmodel.rrf.views.temperatures import RESERVED

try:
    from octoprint.plugins.serial_connector import connector, serial_comm
except ImportError:
    from octoprint.util import comm as serial_comm

    connector = standard

SOURCES = (standard, connector, serial_comm)

MEMBER = re.compile(r"""\b(?:data|result|temperatures|temps)\[f?["'](\w+)(?:%d|\{)?""")
"""A member that OctoPrint's code writes into a record of temperatures, up to its number."""


def own_names():
    """Return what OctoPrint calls the members of its records of temperatures, from its source."""
    found = {"time"}
    for source in SOURCES:
        for _name, function in inspect.getmembers(source):
            if inspect.isclass(function) and function.__module__ == source.__name__:
                for part, method in inspect.getmembers(function, inspect.isfunction):
                    if "emperature" in part or part == "as_script_dict":
                        found.update(MEMBER.findall(inspect.getsource(method)))
    return found


@pytest.mark.parametrize("number", ["", "0", "12"])
def test_row_17_each_name_of_octoprints_own_is_reserved(number):
    names = own_names()
    assert {"bed", "chamber"} & names
    assert [name for name in names if not RESERVED.fullmatch(name + number)] == []
