"""A board behind a pseudo-terminal, with pyserial as the host."""

from __future__ import annotations

import os
import pathlib
import time

import pytest

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.pty import PtyBoard
from tests.support.waiting import wait_for

serial = pytest.importorskip("serial")


@pytest.fixture
def link(tmp_path):
    return str(tmp_path / "rrf")


def opened(link):
    return serial.Serial(link, 115200, timeout=5)


def test_questions_and_answers(link):
    with PtyBoard(Board(), link), opened(link) as port:
        port.write(b'M115\nM409 K"state.currentTool"\nM105\n')
        lines = [port.readline() for _ in range(6)]
    assert lines[0].startswith(b"FIRMWARE_NAME: RepRapFirmware")
    assert lines[1:] == [
        b"ok\n",
        b'{"key":"state.currentTool","flags":"","result":-1}\n',
        b"\n",
        b"ok\n",
        b"ok T0:21.3 /0.0 B:21.3 /0.0\n",
    ]


def test_nothing_is_echoed_or_translated(link):
    with PtyBoard(Board(), link), opened(link) as port:
        port.write(b"foo\x03\x04\x11\x13\x1a b\n")
        assert port.readline() == b"Error: Bad command: foo[0x03][0x04][0x11][0x13][0x1a] b\n"
        assert port.readline() == b"ok\n"


def test_the_link_goes_with_the_board(link):
    with PtyBoard(Board(), link):
        assert os.path.islink(link)
        assert os.readlink(link).startswith("/dev/pts/")
    assert not os.path.lexists(link)


def test_an_old_link_is_replaced(link):
    os.symlink("/dev/null", link)
    with PtyBoard(Board(), link), opened(link) as port:
        port.write(b"M110\n")
        assert port.readline() == b"ok\n"


def test_a_file_is_not(link):
    path = pathlib.Path(link)
    path.write_text("mine")
    with pytest.raises(FileExistsError):
        PtyBoard(Board(), link).start()
    assert path.read_text() == "mine"


def test_the_host_may_come_and_go(link):
    with PtyBoard(Board(), link) as terminal:
        for _ in range(5):
            with opened(link) as port:
                port.write(b"M110\n")
                assert port.readline() == b"ok\n"
        assert terminal.error is None


def test_what_nobody_reads_is_lost(link):
    board = Board()
    with PtyBoard(board, link) as terminal:
        with opened(link) as port:
            port.write(b"M110\n")
            assert port.readline() == b"ok\n"
        wait_for(lambda: terminal.turns_alone > 0, 10, "the end of the session to be seen")
        board.execute('M118 P1 S"nobody hears this"')
        seen = terminal.turns_alone
        wait_for(lambda: terminal.turns_alone > seen + 1, 10, "what is said to be lost")
        with opened(link) as port:
            port.write(b"M110\n")
            assert port.readline() == b"ok\n"


def test_large_replies_arrive_whole(link):
    expected = b"x" * 65536 + b"\nok\n"
    with PtyBoard(Board(faults=["huge_line:3"]), link), opened(link) as port:
        for _ in range(3):
            port.write(b"M110\n")
            assert port.read(len(expected)) == expected


def test_restart_takes_the_terminal_away_and_brings_it_back(link):
    board = Board(speed=20)
    with PtyBoard(board, link) as terminal, opened(link) as port:
        port.write(b"M999\n")
        with pytest.raises(serial.SerialException):
            while True:
                port.readline()
        wait_for(lambda: os.path.lexists(link))
        with opened(link) as again:
            again.write(b'M409 K"state.upTime"\n')
            assert again.readline().startswith(b'{"key":"state.upTime"')
        assert terminal.error is None


def test_the_link_is_gone_meanwhile(link):
    board = Board()
    with PtyBoard(board, link):
        board.unplug(0.3)
        wait_for(lambda: not os.path.lexists(link))
        wait_for(lambda: os.path.lexists(link))
        with opened(link) as port:
            port.write(b"M110\n")
            assert port.readline() == b"ok\n"


def test_baud(link):
    with PtyBoard(Board(), link, baud=9600), opened(link) as port:
        before = time.monotonic()
        port.write(b"M122\n")
        size = 0
        while True:
            line = port.readline()
            size += len(line)
            if line == b"ok\n":
                break
        assert time.monotonic() - before > size / 960 * 0.9


def test_stopping_twice(link):
    terminal = PtyBoard(Board(), link).start()
    terminal.stop()
    terminal.stop()
    assert terminal.error is None
    assert not os.path.lexists(link)


def test_a_stream_of_moves(link):
    """Five thousand moves, each sent when the one before has its ok."""
    board = Board(speed=200)
    with PtyBoard(board, link), opened(link) as port:
        port.write(b"M564 H0\nM302 P1\n")
        assert port.readline() + port.readline() == b"ok\nok\n"
        for index in range(5000):
            port.write(b"N%d G1 X%d Y%d F6000\n" % (index, 100 + index % 3, 100 + index % 2))
            line = port.readline()
            while line != b"ok\n":
                line = port.readline()
        port.write(b"M400\n")
        while port.readline() != b"ok\n":
            pass
    assert board.model["inputs"][3]["lineNumber"] == 4999
    assert len(board.received()) == 5003
