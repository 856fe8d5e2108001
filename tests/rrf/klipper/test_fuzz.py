"""No model, whatever it holds, makes the view raise or give what JSON hasn't."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.klipper import Kept, World, names, printer_info, server_info
from tests.support.examples import some

from ..strategies import ANY_JSON
from . import HOST, host, model_of
from .test_query import ALWAYS, is_served

# text and numbers as a model may have them in the wrong place, and worse
ODD = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-2, 4),
    st.sampled_from([2**63, -(2**70), 10**400, float("nan"), float("inf"), -273.15, 2000.0, 1e308]),
    st.sampled_from(
        ["", "idle", "processing", "paused", "busy", "active", "x", "X", "mesh", "\ud800"]
    ),
    st.floats(),
    ANY_JSON,
)

HOSTS = st.sampled_from(
    [
        HOST,
        HOST._replace(is_connected=False),
        HOST._replace(has_protocol=False),
        host({}),
        host({"size": None, "print_time": None, "state": "paused"}),
        host({"state": "complete", "position": -5}),
        host({"state": "nothing known"}, macros=("a.g", "0:/macros/b.g")),
    ]
)


def places(value, path=()):
    """Yield the path of each value of a model, those of objects and arrays too."""
    if path:
        yield path
    steps = value.items() if isinstance(value, dict) else enumerate(value)
    for step, below in steps:
        if isinstance(below, (dict, list)):
            yield from places(below, (*path, step))
        else:
            yield (*path, step)


EACH = "each element"


def replaced(value, path, new):
    """Return a model with the value at a path replaced; as it was where that isn't there."""
    if not path:
        return new
    step, *rest = path
    if isinstance(value, dict) and step in value:
        return {**value, step: replaced(value[step], rest, new)}
    if isinstance(value, list) and step == EACH:
        return [replaced(element, rest, new) for element in value]
    if isinstance(value, list) and isinstance(step, int) and step < len(value):
        return [*value[:step], replaced(value[step], rest, new), *value[step + 1 :]]
    return value


# members that the view reads, so that nearly every change is one that it meets
READ = [
    "boards",
    "directories",
    "fans",
    "global",
    "heat",
    "inputs",
    "job",
    "move",
    "sensors",
    "state",
    "tools",
]
PLACES = {
    machine: [path for path in places(model_of(*machine)) if path[0] in READ and len(path) < 7]
    for machine in (
        ("cartesian", "3.6"),
        ("corexy", "2.05"),
        ("delta", "3.5.3"),
        ("idex", "3.3"),
    )
}


@st.composite
def spoilt_models(draw):
    machine = draw(st.sampled_from(sorted(PLACES)))
    model = model_of(*machine)
    changes = st.tuples(st.sampled_from(PLACES[machine]), ODD)
    for path, value in draw(st.lists(changes, min_size=1, max_size=12)):
        model = replaced(model, path, value)
    return model


def look(model, at_host, kept):
    """Return the names of the objects, once all that is served of a model can be sent."""
    at = World(model, at_host, kept.snapshot, 5.0)
    shown = is_served(at)
    json.dumps([server_info(at, 1, "v"), printer_info(at, "v", "h")], allow_nan=False)
    return set(shown)


@settings(max_examples=some(150))
@given(st.lists(spoilt_models(), min_size=1, max_size=3), HOSTS)
def test_spoilt_model_is_served(models, at_host):
    kept = Kept()
    for now, model in enumerate(models):
        kept.observe(model, at_host, float(now))
        assert look(model, at_host, kept) >= ALWAYS


NAMES = st.sampled_from(
    sorted({step for path in PLACES["cartesian", "3.6"] for step in path if isinstance(step, str)})
)
TREES = st.recursive(
    ODD,
    lambda children: st.lists(children, max_size=3) | st.dictionaries(NAMES, children, max_size=5),
    max_leaves=25,
)


@settings(max_examples=some(150))
@given(st.dictionaries(st.sampled_from(READ), TREES, max_size=6), HOSTS)
def test_any_tree_is_served(model, at_host):
    kept = Kept()
    kept.observe(model, at_host, 1.0)
    kept.heard("Error: anything")
    assert look(model, at_host, kept) >= ALWAYS


@pytest.mark.parametrize(
    "odd",
    [None, [], {}, "x", True, -1, 1.5, [[]], [{}], [None], 10**400],
    ids=lambda odd: repr(odd)[:9],
)
@pytest.mark.parametrize("machine", sorted(PLACES), ids="-".join)
def test_each_member_may_be_of_the_wrong_type(machine, odd):
    kinds = {
        tuple(EACH if isinstance(step, int) else step for step in path) for path in PLACES[machine]
    }
    model = model_of(*machine)
    for kind in sorted(kinds):
        assert look(replaced(model, kind, odd), HOST, Kept()) >= ALWAYS


@given(
    st.text(), st.sampled_from(["", "Error: ", "Finished printing file ", "File a will print in 1"])
)
def test_any_line_may_be_heard(line, before):
    kept = Kept()
    kept.observe(model_of(), HOST, 1.0)
    kept.heard(before + line)
    assert names(World(model_of(), HOST, kept.snapshot, 2.0))
