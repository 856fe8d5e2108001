"""The serial object in front of a board."""

from __future__ import annotations

import threading
import time

import pytest

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.port import SimulatedSerial

serial = pytest.importorskip("serial")


@pytest.fixture
def port():
    with SimulatedSerial(Board(speed=50), timeout=5) as opened:
        yield opened


def test_write_and_read_lines(port):
    assert port.write(b"M115\nM105\n") == 10
    assert port.readline().startswith(b"FIRMWARE_NAME: RepRapFirmware")
    assert port.readline() == b"ok\n"
    assert port.readline() == b"ok T0:21.3 /0.0 B:21.3 /0.0\n"


def test_a_blank_line_is_a_line(port):
    port.write(b'M409 K"state.currentTool"\n')
    assert [port.readline() for _ in range(3)][1:] == [b"\n", b"ok\n"]


def test_timeout_returns_nothing(port):
    port.timeout = 0.05
    before = time.monotonic()
    assert port.readline() == b""
    assert time.monotonic() - before >= 0.05


def test_a_timeout_keeps_a_part_of_a_line(port):
    port.board.output.text("half")
    port.timeout = 0.02
    assert port.readline() == b""
    assert port.readline() == b""
    assert port.in_waiting == 4
    port.board.output.text(" a line\nmore")
    assert port.readline() == b"half a line\n"
    assert port.readline() == b""


def test_a_line_may_come_while_readline_waits(port):
    port.write(b"G4 S5\n")
    assert port.readline() == b"ok\n"


def test_read(port):
    port.write(b"M110\n")
    assert port.read(2) == b"ok"
    port.timeout = 0.02
    assert port.read(5) == b"\n"
    assert port.read() == b""


@pytest.mark.parametrize("timeout", [0, 0.0])
def test_no_waiting(port, timeout):
    port.timeout = timeout
    assert port.readline() == b""
    port.write(b"M110\n")
    assert port.readline() == b"ok\n"


def test_in_waiting_and_reset(port):
    port.write(b"M110\n")
    assert port.in_waiting == port.inWaiting() == 3
    port.reset_input_buffer()
    assert port.in_waiting == 0


def test_attributes(port):
    assert (port.port, port.baudrate, port.is_open, port.isOpen()) == (
        "RRF-SIM",
        115200,
        True,
        True,
    )
    port.baudrate = 250000
    port.flush()
    port.flushInput()
    port.flushOutput()
    port.cancel_write()


def test_closing_ends_a_waiting_read(port):
    failures = []

    def read():
        port.timeout = 30
        try:
            port.readline()
        except serial.SerialException as error:
            failures.append(error)

    thread = threading.Thread(target=read)
    thread.start()
    port.close()
    thread.join(5)
    assert not thread.is_alive()
    assert failures


def test_cancel_read_ends_a_waiting_read(port):
    lines = []
    port.timeout = 30
    thread = threading.Thread(target=lambda: lines.append(port.readline()))
    thread.start()
    while thread.is_alive():
        port.cancel_read()
        thread.join(0.01)
    assert lines == [b""]
    assert port.is_open


@pytest.mark.parametrize("action", ["readline", "read"])
def test_a_closed_port(port, action):
    port.close()
    with pytest.raises(serial.SerialException):
        getattr(port, action)()
    with pytest.raises(serial.SerialException):
        port.write(b"M105\n")


def test_a_board_that_goes_away(port):
    port.board.unplug(1000)
    with pytest.raises(serial.SerialException):
        port.readline()
    with pytest.raises(serial.SerialException):
        port.write(b"M105\n")
    with pytest.raises(serial.SerialException):
        SimulatedSerial(port.board)
    port.close()
    with pytest.raises(serial.SerialException):
        port.open()


def test_a_board_that_comes_back_needs_a_new_port(port):
    port.write(b"M999\n")
    with pytest.raises(serial.SerialException):
        port.readline()
    while not port.board.is_plugged_in:
        port.board.advance()
    with pytest.raises(serial.SerialException):
        port.write(b"M105\n")
    with SimulatedSerial(port.board, timeout=5) as again:
        again.write(b"M110\n")
        assert again.readline() == b"ok\n"
    port.open()
    port.write(b"M110\n")
    assert port.readline() == b"ok\n"


def test_write_waits_while_the_board_is_busy(port):
    port.board.inject("stall")
    port.write_timeout = 0.05
    port.write(b"M117 " + b"x" * 600 + b"\n")
    with pytest.raises(serial.SerialTimeoutException):
        port.write(b"M105\n")
    port.board.clear("stall")
    assert port.write(b"M105\n") == 5


def test_reading_and_writing_from_two_threads(port):
    count = 300
    lines = []

    def read():
        while len(lines) < count:
            line = port.readline()
            if line == b"ok\n":
                lines.append(line)

    thread = threading.Thread(target=read)
    thread.start()
    for _ in range(count):
        port.write(b"M110\n")
    thread.join(20)
    assert len(lines) == count
