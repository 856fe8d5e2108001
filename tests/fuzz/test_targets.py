"""The short run over the table: a few inputs for each target, none of them for long."""

import gc

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
from hypothesis import given, settings

from octoprint_rrfmodel.host.version import IS_2

if not IS_2:
    pytest.skip("what is fed is the same in both hosts", allow_module_level=True)

from .hostile import long_lines, slow_ones
from .targets import BY_NAME, TARGETS

EXAMPLES = 40
"""Enough for what anybody would stumble over; ``make fuzz`` looks for the rest."""

SHORT = 8_000
"""What grows with the square takes eight times as long as it may, and the linear a moment."""

OF_TEXT = [target.name for target in TARGETS if target.long]


@pytest.mark.parametrize("name", [target.name for target in TARGETS])
def test_nothing_is_raised(name):
    target = BY_NAME[name]
    taken = []

    @settings(max_examples=EXAMPLES, deadline=None)
    @given(target.inputs)
    def run(given):
        target.make()(given)
        taken.append(given)

    run()
    assert taken


@pytest.mark.parametrize("name", OF_TEXT)
def test_time_grows_with_the_length_alone(name):
    assert slow_ones(BY_NAME[name].long(), SHORT) == {}


LASTING = ["reply followed", "card list", "frame"]
"""What keeps something between two inputs."""


@pytest.mark.parametrize("name", LASTING)
def test_nothing_grows(name):
    take = BY_NAME[name].make()

    def feed(numbers):
        for number in numbers:
            for text in (
                f'{{"key":"x{number}","flags":"d99fin","result":{{"a":{number}}}}}',
                f'{{"dir":"0:/gcodes","first":0,"files":["{number}"],"next":0}}',
            ):
                take(text)
        gc.collect()
        return len(gc.get_objects())

    before = feed(range(100))
    assert feed(range(100, 600)) < before + 200


def test_there_are_long_lines():
    assert all(len(line) > SHORT * 0.9 for line in long_lines(SHORT))
