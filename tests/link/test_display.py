"""What OctoPrint is shown of a report of temperatures, beside what the model knows."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.serial.display import Display
from octoprint_rrfmodel.rrf.views.temperatures import Temperatures


def shown(parsed, *, is_fresh=True, tools=None):
    comm = SimpleNamespace(
        getCurrentTool=lambda: 0,
        last_temperature=SimpleNamespace(set_tool=lambda *args, **kwargs: None),
    )
    model = Temperatures(tools or {0: (20.0, 0.0)}, (30.0, 0.0), None, {"mcu": (40.0, None)})
    display = Display(
        SimpleNamespace(connection=comm),
        SimpleNamespace(heat=lambda: (model, True)),
        lambda: not is_fresh,
        fire=None,
    )
    return display.on_temperatures(comm, parsed)


def test_the_line_is_newer_than_any_model():
    told = shown({"T0": (150.0, 200.0), "B": (55.0, 60.0)})
    assert told == {"T0": (150.0, 200.0), "B": (55.0, 60.0), "mcu": (40.0, None)}


def test_a_report_of_one_tool_is_not_taken_for_all():
    """A T alone may be any tool's; the model has the numbers."""
    told = shown({"T0": (150.0, 200.0)}, tools={0: (20.0, 0.0), 1: (150.0, 200.0)})
    assert told["T0"] == (20.0, 0.0)
    assert told["B"] == (30.0, 0.0)
