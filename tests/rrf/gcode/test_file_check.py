"""What a host would cut or flatten in a file, by line numbers."""

import random

import pytest

from octoprint_rrfmodel.rrf.gcode.file_check import MOST, ROWS, check, in_words

ODD = b"""; if "a;
if true
  M118 S"a;b"
elif false
  G1 X1 ; "c;
else
  while true
    M117 "open
N5 if x
M117 "closed" ; if "
M117 what if ; nothing
""" + 'M118 S"ä;ö"\n'.encode()

FOUND = {"file_blocks": [2, 4, 6, 7, 9], "file_semicolons": [3, 12], "file_quotes": [8]}


def test_kinds():
    assert check([ODD]) == FOUND
    assert set(FOUND) == {row.code for row in ROWS}


@pytest.mark.parametrize("seed", range(20))
def test_any_chunks(seed):
    cuts = sorted(random.Random(seed).sample(range(len(ODD)), 12))
    chunks = [ODD[begin:end] for begin, end in zip([0, *cuts], [*cuts, len(ODD)])]
    assert check(chunks) == FOUND


def test_other_ends_of_lines():
    assert check([ODD.replace(b"\n", b"\r\n")]) == FOUND
    assert check([ODD.rstrip(b"\n")]) == FOUND
    assert check([b"\xef\xbb\xbfif true\n"]) == {"file_blocks": [1]}
    assert check([]) == check([b""]) == check([b"G1 X1\n" * 1000]) == {}


def test_not_all_lines_of_many():
    found = check([b"if true\n" * 1000])["file_blocks"]
    assert len(found) == MOST + 1
    assert in_words(found).endswith("10, …")
    assert in_words([3]) == "3"
