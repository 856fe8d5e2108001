"""Whatever a host sends, the board answers by its rules and goes on."""

from __future__ import annotations

import json

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.machines import MACHINES
from octoprint_rrfmodel.simulator.model.om import number
from octoprint_rrfmodel.simulator.text.command import SyntaxProblem
from octoprint_rrfmodel.simulator.text.cutting import commands_of
from octoprint_rrfmodel.simulator.text.serial_line import crc16, parse_line, xor
from tests.support.examples import some

EXAMPLES = settings(max_examples=some(60), deadline=None)
CODES = [code for code in Board().gcodes.names() if code != "meta"]
VALUES = st.one_of(
    st.integers(-2000, 2000).map(str),
    st.floats(-1e6, 1e6).map(lambda value: f"{value:.3f}"),
    st.text(max_size=8).map(lambda text: '"' + text.replace('"', '""') + '"'),
    st.sampled_from(["", "{", "{1}", "{state.status}", '{"a","b"}', "{1/0}", "1:2:3", "x", "-"]),
)
PARAMETERS = st.lists(
    st.tuples(st.sampled_from("ABCDEFHIJKLPRSTUXYZ"), VALUES).map("".join), max_size=5
).map(" ".join)
LINES = st.one_of(
    st.tuples(st.sampled_from(CODES), PARAMETERS).map(" ".join),
    st.tuples(st.sampled_from(["echo", "set", "global", "var", "if"]), st.text(max_size=20)).map(
        " ".join
    ),
    st.text(max_size=60),
)


def driven(board, time, data):
    board.receive(data)
    said = board.transmit()
    for _ in range(3):
        time[0] += 60
        said += board.transmit()
    return said


NO_LINE_END = str.maketrans("\n\r\x00", "   ")


@EXAMPLES
@given(
    st.sampled_from(list(MACHINES)), st.sampled_from(list(VERSIONS)), st.lists(LINES, max_size=8)
)
@example("cnc", "3.5.3", ["T0", "M104 S200", "M109", "M568 P0", "M290 Z1", "M116", "M563 P0"])
@example("cartesian", "3.3", ['M291 P"" S2', "M292", "M291", "M25", "M24", "M0"])
@example("cartesian", "3.5.3", ["M144 P-5", "M140 P-5 S1", "M140 P-5 H1", "M116 H-1 C-3"])
@example("toolchanger", "3.6", ["M23 x", "M32", "M36", "M28", "M29", "M30", "M20 S2 R-5"])
def test_any_lines(machine, firmware, lines):
    time = [0.0]
    board = Board(machine, firmware, clock=lambda: time[0])
    driven(board, time, "\n".join(lines).encode("utf-8", "replace") + b"\n")
    with board.lock:
        assert json.loads(json.dumps(board.model)).keys() == board.model.keys()


@EXAMPLES
@given(st.binary(max_size=400))
def test_any_bytes(data):
    time = [0.0]
    board = Board(clock=lambda: time[0])
    driven(board, time, data)
    board.receive(b"\nM29\n")
    time[0] += 7200
    board.transmit()
    board.power_cycle()
    time[0] += 2
    board.receive(b"M110\n")
    assert board.transmit() == b"ok\n"


@EXAMPLES
@given(st.text(max_size=80))
def test_any_line_is_cut_or_refused(text):
    try:
        found = commands_of(text, {}.get)
    except SyntaxProblem:
        return
    assert all(command.name for command in found)


@EXAMPLES
@given(
    st.text(
        alphabet=st.characters(blacklist_categories=["Cs"], blacklist_characters='*";{}\r\n'),
        max_size=60,
    )
)
def test_any_checksummed_line_comes_through(text):
    numbered = f"N7 {text}"
    data = numbered.encode("utf-8", "surrogateescape")
    for checksum in (str(xor(data)), f"{crc16(data):05d}"):
        line = parse_line(f"{numbered}*{checksum}")
        assert line is not None
        assert (line.text, line.number) == (text.lstrip(), 7)


@EXAMPLES
@given(st.text(max_size=100), st.text(max_size=20))
def test_any_key_and_flags(key, flags):
    board = Board(clock=lambda: 0.0)
    line = f'M409 K"{key}" F"{flags}"'.translate(NO_LINE_END)
    board.receive(line.encode("utf-8", "replace") + b"\n")
    said = board.transmit().decode("utf-8")
    if said.startswith('{"key"'):
        head, _, rest = said.partition("\n")
        # a quote in the key may end it, and another command follow, which is answered by itself
        assert rest.startswith("\nok\n") and rest.endswith("ok\n")
        json.loads(head)
    else:
        assert said == "" or said.endswith("ok\n")


@EXAMPLES
@given(st.floats(width=32), st.integers(0, 9))
def test_any_number_is_json(value, decimals):
    text = number(value, decimals)
    found = json.loads(text)
    if found is not None:
        assert found == pytest.approx(value, abs=0.51 * 10 ** -min(decimals or 7, 7), rel=0.06)
