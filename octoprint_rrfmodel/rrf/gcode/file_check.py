"""What a host that streams a file would cut or flatten in it, found before it is printed.

OctoPrint ends a line at its first semicolon, also in quotes, and takes away what a line is
indented by, by which the firmware knows what belongs to ``if`` and ``while`` (3.5
GCodeBuffer.cpp, StringParser.cpp). Line by line and without the indentation there is no telling.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Callable, NamedTuple

from .quotes import has_odd_quote, without_comment

CHUNK = 1024 * 1024

MOST = 10
"""Lines of a kind that are kept; a person looks at a few."""

_BLOCK = re.compile(r"\s*(?:N\d+\s+)?(?:if|elif|else|while)\b")


class Row(NamedTuple):
    """One line of the table."""

    code: str
    marks: tuple[bytes, ...]
    """What stands in each such line: most lines have none of it."""
    is_so: Callable[[str], bool]


def _is_cut(line: str) -> bool:
    whole = without_comment(line)
    return ";" in whole and not has_odd_quote(whole)


def _begins_a_block(line: str) -> bool:
    return _BLOCK.match(line) is not None


def _is_open(line: str) -> bool:
    return has_odd_quote(without_comment(line))


ROWS = (
    Row("file_blocks", (b"if", b"else", b"while"), _begins_a_block),
    Row("file_semicolons", (b'"',), _is_cut),
    Row("file_quotes", (b'"',), _is_open),
)

_MARKS = tuple(dict.fromkeys(mark for row in ROWS for mark in row.marks))

Findings = dict[str, list[int]]


def check(chunks: Iterable[bytes]) -> Findings:
    """Return the numbers of the first lines of each kind, by the row's code; of a whole file.

    >>> check([b'if true\\n  M117 "a;b"\\n', b'; if "\\nM98 P"a'])
    {'file_blocks': [1], 'file_semicolons': [2], 'file_quotes': [4]}
    """
    found: Findings = {}
    for number, text in _marked(_whole_lines(chunks)):
        line = text.decode("utf-8", "replace").lstrip("\ufeff")
        if line.lstrip().startswith(";"):
            continue
        for row in ROWS:
            numbers = found.get(row.code, [])
            if len(numbers) <= MOST and row.is_so(line):
                found[row.code] = [*numbers, number]
    return {row.code: found[row.code] for row in ROWS if row.code in found}


def in_words(numbers: list[int]) -> str:
    """Return line numbers for a sentence.

    >>> in_words([1, 7]), in_words(list(range(1, 12)))
    ('1, 7', '1, 2, 3, 4, 5, 6, 7, 8, 9, 10, …')
    """
    more = [*map(str, numbers[:MOST]), *("…" for _ in numbers[MOST : MOST + 1])]
    return ", ".join(more)


def _whole_lines(chunks: Iterable[bytes]) -> Iterator[bytes]:
    """Yield the same bytes in parts that end where a line does."""
    rest = b""
    for chunk in chunks:
        end = chunk.rfind(b"\n") + 1
        if not end and len(rest) < CHUNK:
            rest += chunk
            continue
        yield rest + chunk[:end]
        rest = chunk[end:]
    yield rest


def _marked(parts: Iterable[bytes]) -> Iterator[tuple[int, bytes]]:
    """Yield each line that has a mark, with its number; looks at no other line by itself."""
    first = 1
    for part in parts:
        yield from _marked_in(part, first)
        first += part.count(b"\n")


def _marked_in(part: bytes, number: int) -> Iterator[tuple[int, bytes]]:
    counted = begin = 0
    # where each mark comes next; one that is through is beyond the end
    places = {mark: _find(part, mark, 0) for mark in _MARKS}
    while True:
        place = min(places.values())
        if place >= len(part):
            return
        begin = part.rfind(b"\n", 0, place) + 1
        end = _find(part, b"\n", place)
        number += part.count(b"\n", counted, begin)
        counted = begin
        yield number, part[begin:end]
        for mark, at in places.items():
            if at < end:
                places[mark] = _find(part, mark, end)


def _find(part: bytes, what: bytes, start: int) -> int:
    place = part.find(what, start)
    return len(part) if place < 0 else place
