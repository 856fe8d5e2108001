"""Whatever a model holds, the hooks answer; any lines and commands are in ``tests.fuzz``."""

import pytest

pytest.importorskip("octoprint")

from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.link.serial.operation_translator import OPERATION_OF_TAG
from octoprint_rrfmodel.rrf.gcode.recognition import ROWS
from octoprint_rrfmodel.rrf.views.temperatures import temperatures
from tests.fuzz.line_rig import Rig, is_answer
from tests.fuzz.made import MODELS
from tests.rrf.klipper import model_of
from tests.rrf.klipper.test_fuzz import PLACES, replaced


@pytest.mark.parametrize("gcode", sorted({gcode for row in ROWS for gcode in row.gcodes}))
@pytest.mark.parametrize(
    "odd", [[[]], [[40]], [None], {}, 5, "x", 10**400, [10**400], [{}]], ids=repr
)
@pytest.mark.parametrize("machine", sorted(PLACES), ids="-".join)
def test_row_37_each_member_of_a_tool_may_be_of_the_wrong_type(machine, odd, gcode):
    rig = Rig()
    tags = [tag for tag, name in OPERATION_OF_TAG.items() for row in ROWS if name == row.operation]
    for path in (
        ("tools", 0, "standby"),
        ("tools", 0, "heaters"),
        ("tools", 0, "extruders"),
        ("move", "axes", 0, "letter"),
        ("heat", "bedHeaters"),
    ):
        rig.model = replaced(replaced(model_of(*machine), path, odd), ("state", "currentTool"), 0)
        for tag in tags:
            for words in ("S60 X1", "S0", "E5 T0"):
                command = f"{gcode} {words}"
                assert is_answer(
                    rig.queued.on_queuing(rig.comm, "", command, None, gcode, tags={tag})
                )


@settings(max_examples=200, deadline=None)
@given(
    MODELS,
    st.dictionaries(
        st.sampled_from(("T", "T0", "T1", "B", "C", "x")), st.tuples(st.floats(), st.floats())
    ),
)
def test_any_model_leaves_a_report_of_temperatures(model, parsed):
    rig = Rig()
    rig.model = model
    assert isinstance(rig.display.on_temperatures(rig.comm, parsed), dict)


@pytest.mark.parametrize(
    "line",
    [
        "o\0k\n",
        "o\ufffdk\n",
        "\ufffdok\n",
        "\0ok\n",
        "ok\0\n",
        "\0\0ok\0\r\n",
        "o\0k T:20.0 /0.0\n",
    ],
)
def test_ok_with_a_byte_of_noise_is_one(line):
    rig = Rig()
    rig.link.awaited = "G28"
    assert rig.hear(line).startswith("ok")
    assert rig.link.awaited is None


def test_many_sensors_of_one_name_take_no_time():
    sensors = [{"name": "x", "lastReading": 1.0} for _ in range(20_000)]
    found = temperatures({"sensors": {"analog": sensors}, "heat": {"heaters": sensors}}).others
    assert len(found) == 20_000 and "Sensor x 20000" in found
