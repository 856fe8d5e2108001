"""What a row of the table of metrics is, and the small functions that its values come from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Callable, NamedTuple

from ..views.machine import array, mapping
from ..views.state_words import UNKNOWN, known
from ..views.temperatures import ABSOLUTE_ZERO, BAD_READING

GAUGE = "gauge"
COUNTER = "counter"

Model = Mapping[str, Any]

Sample = tuple[tuple[str, ...], Any]
"""The labels' values and a number; anything but a finite number stands for none."""


class Sources(NamedTuple):
    """What metrics are made of."""

    model: Model
    status: Mapping[str, Any]
    """The plugin's state, as ``GET /plugin/rrfmodel/status`` tells it."""


Samples = Callable[[Sources], Iterable[Sample]]


class Metric(NamedTuple):
    """One row of the table."""

    name: str
    kind: str
    help: str
    labels: tuple[str, ...]
    samples: Samples


Parts = Callable[[Model], Iterable[tuple[str, Mapping[str, Any]]]]
"""The parts of one sort, each with the label that tells it from the others."""

Convert = Callable[[Any], Any]


def same(value: Any) -> Any:
    """Return the value."""
    return value


def at(value: Any, path: str) -> Any:
    """Return the member below ``value``; names in ``path`` have ``.`` between."""
    for name in path.split("."):
        value = mapping(value).get(name)
    return value


def numeric(value: Any) -> bool:
    """Return whether it is a number that can be compared; true and false are none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def one(path: str, convert: Convert = same) -> Samples:
    """Return what gives one value of the model, without a label."""

    def samples(sources: Sources) -> Iterator[Sample]:
        yield (), convert(at(sources.model, path))

    return samples


def own(path: str, convert: Convert = same) -> Samples:
    """Return what gives one value of the plugin's state, without a label."""

    def samples(sources: Sources) -> Iterator[Sample]:
        yield (), convert(at(sources.status, path))

    return samples


def each(parts: Parts, path: str, convert: Convert = same) -> Samples:
    """Return what gives one value for each of the parts."""

    def samples(sources: Sources) -> Iterator[Sample]:
        for label, part in parts(sources.model):
            yield (label,), convert(at(part, path))

    return samples


def states(parts: Parts, words: tuple[str, ...], path: str) -> Samples:
    """Return what gives 1 for the word that holds and 0 for the others, for each of the parts.

    Nothing for a part that tells no word.
    """

    def samples(sources: Sources) -> Iterator[Sample]:
        for label, part in parts(sources.model):
            for labels, value in states_of(at(part, path), words):
                yield (label, *labels), value

    return samples


def states_of(word: Any, words: tuple[str, ...]) -> Iterator[Sample]:
    """Yield 1 for the word and 0 for the others; ``unknown`` stands for one that isn't known."""
    if isinstance(word, str):
        word = known(word, words)
        for name in (*words, UNKNOWN):
            yield (name,), name == word


def infos(parts: Parts, *paths: str) -> Samples:
    """Return what gives 1 for each of the parts, with texts as further labels."""

    def samples(sources: Sources) -> Iterator[Sample]:
        for label, part in parts(sources.model):
            yield (label, *(text(at(part, path)) for path in paths)), 1

    return samples


def text(value: Any) -> str:
    """Return a text, an empty one for anything else."""
    return value if isinstance(value, str) else ""


def indexed(path: str) -> Parts:
    """Return what gives the objects in an array, each with its index; empty places are none."""

    def parts(model: Model) -> Iterator[tuple[str, Mapping[str, Any]]]:
        for index, part in enumerate(array(at(model, path))):
            if mapping(part):
                yield str(index), part

    return parts


def tools(model: Model) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield each tool with RRF's number."""
    for tool in array(model.get("tools")):
        number = mapping(tool).get("number")
        if type(number) is int:
            yield str(number), tool


def reading(value: Any) -> Any:
    """Return a temperature; nothing for the values that stand for none, or a broken sensor."""
    return value if numeric(value) and ABSOLUTE_ZERO < value < BAD_READING else None


def not_negative(value: Any) -> Any:
    """Return a number; negative ones stand for what isn't there."""
    return value if numeric(value) and value >= 0 else None


def positive(value: Any) -> Any:
    """Return a number; zero stands for one that isn't known."""
    return value if numeric(value) and value > 0 else None
