"""OctoPrint's serial line without threads: its queues, its counting of ``ok``, its patience.

A small model, written from OctoPrint's source (2.0's ``serial_comm.py``; 1.11's ``comm.py`` is the
same in all of this): ``_monitor``, ``_handle_ok``, ``_handle_timeout``, ``_continue_sending``,
``_sendCommand`` and ``_send_loop``. Each thread is a method that does one turn, and a test says
whose turn it is. The queues and the counter are OctoPrint's own classes.
"""

import queue
import re
from collections import deque
from types import SimpleNamespace

from octoprint.util import CountedEvent

from octoprint_rrfmodel.host.tags import FILE_TAG
from octoprint_rrfmodel.host.version import IS_2

if IS_2:
    from octoprint.plugins.serial_connector.serial_comm import (
        CommandQueue,
        JobQueue,
        SendQueue,
        TypeAlreadyInQueue,
        _normalize_command_handler_result,
        regex_command,
    )
else:
    from octoprint.util.comm import (
        CommandQueue,
        JobQueue,
        SendQueue,
        TypeAlreadyInQueue,
        _normalize_command_handler_result,
        regex_command,
    )

PATIENCE = 30.0
"""OctoPrint's default for a line that stays silent, and its timeout of reading."""

STATUS_SECONDS = 5.0

MOST_TIMEOUTS = {"idle": 2, "printing": 5, "long": 5}

MOST_HELLOS = 3

HEATS = frozenset(("M109", "M190", "M191", "M116"))

LONG = frozenset(("G4", "G28", "G29", "G30", "G32", "M400", "M226", "M600"))
"""OctoPrint's own table of commands that may take long."""

TEMPERATURES = re.compile(r"(T\d*|B|C):(-?[\d.]+) */(-?[\d.]+)")


def gcode_of(command):
    """Return the G-code that OctoPrint sees in a command, ``None`` for none."""
    found = regex_command.search(command)
    if not found:
        return None
    return found["codeGM"] or found["codeT"]


class Marker:
    """Something to do when all in front of it has been sent."""

    def __init__(self, run):
        self.run = run


class CountingHost:
    """Both OctoPrint's connection and its printer; ``board`` is at the other end of the line.

    ``hooks`` has the plugin's, by the names of ``Assembly``'s parts. ``on_event(name)`` is told of
    prints and of the connection's end. ``unhurt()`` is called before each line that leaves by the
    queue.
    """

    _serial_encoding = "utf-8"
    _manualStreaming = False
    _sdEnabled = False
    _sdFileToSelect = None
    _toolBeforeHeatup = None
    _toolBeforeChange = None
    _dwelling_until = False
    _ignore_select = False
    _currentFile = None
    _consecutive_not_sd_printing = 0
    _consecutive_not_sd_printing_maximum = 2

    def __init__(self, clock, hooks, on_event, unhurt):
        self._clock = clock
        self._hooks = hooks
        self._on_event = on_event
        self._unhurt = unhurt
        self._callback = SimpleNamespace(
            on_comm_temperature_update=lambda *temperatures: None,
            on_comm_position_update=lambda *position: None,
        )
        self.board = None
        self.print_tag = ""
        """What tells the lines of this print from those of the one before."""
        self.state = "closed"
        self.file = None

    ##~~ the connection

    def connect(self, board):
        """Open the port and say hello, as OctoPrint does."""
        self.board = board
        self.state = "connecting"
        self._session = board.sessions
        self._lines = deque()
        self._rest = b""
        self._clear_to_send = CountedEvent(minimum=None, maximum=1)
        self._send_queue = SendQueue()
        self._command_queue = CommandQueue()
        self._job_queue = JobQueue()
        self.file = self._currentFile = None
        self._long_running_command = self._heating = False
        self._currentTool = 0
        self._sdFiles = {}
        self._checksum_requiring_commands = ["M110"]
        self._sanity_check_tools = True
        self._current_line = 1
        self._timeouts = 0
        self._firmware = None
        self.tickled = False
        """Whether OctoPrint has gone on by itself, without an ``ok``."""
        self.last_temperature = SimpleNamespace(
            tools={},
            bed=(None, None),
            chamber=(None, None),
            custom={},
            set_tool=self._set_tool,
            set_bed=lambda **more: None,
        )
        self._timeout = self._ok_timeout = self._read_at = self._clock() + PATIENCE
        self._status_at = self._clock() + STATUS_SECONDS
        self._hellos = 0
        for _ in range(2):
            self.say_hello()

    def _set_tool(self, number, actual=None, target=None):
        self.last_temperature.tools[number] = actual, target

    def say_hello(self):
        self._send_command("M110 N0", tags={"trigger:comm.say_hello"})
        self._clear_to_send.set()
        self._hellos += 1

    def close(self):
        """End the connection, as a person does or an error."""
        if self.state == "closed":
            return
        if self.is_printing() or self.is_paused():
            self.end_print("PrintFailed")
        self.state = "closed"
        self._on_event("Disconnected")

    def getConnection(self):
        return "/dev/board", 115200

    ##~~ whose turn it is

    def read(self):
        """Let the receiving thread take one line; return whether there was anything."""
        if self.state == "closed":
            return False
        board, now = self.board, self._clock()
        if board.sessions != self._session or not board.is_plugged_in:
            self.close()
            return True
        *whole, self._rest = (self._rest + board.transmit()).split(b"\n")
        self._lines.extend(whole)
        if self._lines:
            self._hear(self._lines.popleft() + b"\n")
        elif now >= self._read_at:
            self._hear(b"")
        else:
            return False
        self._read_at = now + PATIENCE
        return True

    def send(self):
        """Let the sending thread take one entry; return whether it could."""
        if self.state == "closed" or self._clear_to_send.blocked():
            return False
        try:
            command, number, kind, on_sent, _, tags = self._send_queue.get(block=False)
        except queue.Empty:
            return False
        if isinstance(command, Marker):
            command.run()
            self._continue_sending()
            return True
        gcode = gcode_of(command)
        ((command, _, gcode, _, tags),) = self._phase("sending", command, kind, gcode, tags)
        if gcode in LONG:
            self._long_running_command = True
        if gcode == "M110":
            self._current_line = int(command.partition("N")[2] or 0)
        if gcode is not None:
            self._clear_to_send.clear()
        self._unhurt(command, tags)
        self._do_send(command, gcode=gcode)
        if gcode is None:
            self._continue_sending()
        if gcode in HEATS:
            self._heating = self._long_running_command = True
        return True

    def poll_status(self):
        """Let the timer of OctoPrint's own status requests do what is due."""
        if self._clock() < getattr(self, "_status_at", 0.0):
            return
        self._status_at = self._clock() + STATUS_SECONDS
        if self.isOperational() and not (self._long_running_command or self._heating):
            self.sendCommand("M105", "temperature", tags={"trigger:comm.poll_temperature"})

    ##~~ the receiving thread

    def _hear(self, data):
        try:
            line = data.decode("utf-8")
        except UnicodeDecodeError:
            line = data.decode("latin1")
        line, now = self._hooks.received.on_received(self, line), self._clock()
        if line.strip():
            self._timeouts = 0
            self._timeout = now + PATIENCE
        if line.startswith(("echo:busy:", "busy:")):
            self._ok_timeout = now + PATIENCE
            return
        if line.startswith("//"):
            return
        is_error = line.lower().startswith("error:") and "unknown command" not in line.lower()
        if is_error and not self._hooks.received.on_error(self, line[6:].strip()):
            # what the plugin doesn't call harmless is the end
            self.close()
            return
        line = line.strip().strip("\0")
        if line.startswith("ok"):
            if self.state == "connecting":
                self.state = "operational"
                self._send_command("M115", tags={"trigger:comm.on_connected"})
            self._handle_ok()
        elif (line == "" and now >= self._timeout) or (
            self.state == "printing"
            and not (self._long_running_command or self._heating)
            and now >= self._ok_timeout
        ):
            self._handle_timeout()
            self._ok_timeout = now + PATIENCE
        if self.state == "connecting" and now >= self._timeout:
            if self._hellos < MOST_HELLOS:
                self.say_hello()
            else:
                self.close()
                return
        if "NAME:" in line and self._firmware is None:
            self._firmware = line.partition("FIRMWARE_NAME:")[2].partition("FIRMWARE_")[0].strip()
            self._hooks.received.on_firmware_info(self, self._firmware, {"FIRMWARE_NAME": line})
        parsed = {name: (float(a), float(b)) for name, a, b in TEMPERATURES.findall(line)}
        if parsed:
            shown = self._hooks.display.on_temperatures(self, parsed)
            for name, (actual, target) in shown.items():
                if name[:1] == "T" and name[1:].isdigit():
                    self.last_temperature.tools[int(name[1:])] = actual, target

    def _handle_ok(self):
        self._ok_timeout = self._clock() + PATIENCE
        self._clear_to_send.set()
        self._long_running_command = self._heating = False
        if self.isOperational():
            self._continue_sending()

    def _handle_timeout(self):
        if not self.isOperational():
            return
        kind = "printing" if self.is_printing() else "idle"
        self._timeouts += 1
        if self._timeouts > MOST_TIMEOUTS["long" if self._long_running_command else kind]:
            self.close()
        elif self._heating:
            self._heating = False
        elif self._long_running_command:
            pass
        elif self.state in ("printing", "paused"):
            self.tickled = True
            if self._send_command("M105", "temperature", tags={"trigger:comm.handle_timeout"}):
                self._clear_to_send.set()
        elif self._clear_to_send.blocked():
            self.tickled = True
            self._clear_to_send.set()

    ##~~ the queues

    def sendCommand(self, command, kind=None, tags=None, force=False):
        """Queue a command; beside a print it waits for its turn."""
        tags = tags or set()
        if self.isPrinting() and not force:
            try:
                self._command_queue.put((command, kind, None, tags), item_type=kind)
            except TypeAlreadyInQueue:
                return False
            return True
        if self.isOperational() or force:
            return self._send_command(command, kind, tags)
        return False

    def commands(self, commands, tags=None, force=False, **more):
        """OctoPrint's printer: queue what a person or a plugin wants sent."""
        for command in [commands] if isinstance(commands, str) else commands:
            if self.state != "closed":
                self.sendCommand(command, tags=tags, force=force)

    def _send_command(self, command, kind=None, tags=None):
        if isinstance(command, Marker):
            return self._put(command, None, tags)
        queued = False
        found = self._phase("queuing", command, kind, gcode_of(command), tags or set())
        for each, each_kind, _, _, each_tags in found:
            if each is not None:
                queued = self._put(each, each_kind, each_tags) or queued
        return queued

    def _put(self, command, kind, tags):
        try:
            self._send_queue.put((command, None, kind, None, False, tags), item_type=kind)
        except TypeAlreadyInQueue:
            return False
        return True

    def _phase(self, phase, command, kind, gcode, tags):
        hook = self._hooks.queued.on_queuing if phase == "queuing" else self._hooks.sent.on_sending
        said = hook(self, phase, command, kind, gcode, subcode=None, tags=tags)
        return _normalize_command_handler_result(
            command, kind, gcode, None, tags, said, tags_to_add={"source:rewrite"}
        )

    def _continue_sending(self):
        while self.state != "closed" and not self._send_queue.qsize():
            if self._send_from_command_queue():
                return
            if self._job_queue.qsize():
                command, kind, _, tags = self._job_queue.get(block=False)
                if self._send_command(command, kind, tags):
                    return
            elif not self._send_from_file():
                return

    def _send_from_command_queue(self):
        while True:
            try:
                command, kind, _, tags = self._command_queue.get(block=False)
            except queue.Empty:
                return False
            if self._send_command(command, kind, tags):
                return True

    def _send_from_file(self):
        """Return whether there is a print that goes on."""
        if self.state != "printing" or self.file is None:
            return False
        if self.file:
            number, line = self.file.popleft()
            tags = {FILE_TAG, f"filepos:{number}", f"fileline:{number}", self.print_tag}
            self._send_command(line, tags=tags)
        else:
            self.file = None
            self.state = "finishing"
            for command in ("M400", Marker(lambda: self.end_print("PrintDone"))):
                self._job_queue.put((command, None, None, {"source:job"}))
        return True

    ##~~ prints

    def print_lines(self, lines):
        """Begin to stream a file."""
        self.file = deque(enumerate(lines, 1))
        began = self._clock()
        self.print_tag = f"test:print at {began}"
        self._currentFile = SimpleNamespace(
            getStartTime=lambda: began, getFilename=lambda: "print.gcode"
        )
        self.state = "printing"
        self._on_event("PrintStarted")
        self._continue_sending()

    def end_print(self, event):
        self.file = self._currentFile = None
        while self._job_queue.qsize():
            self._job_queue.get(block=False)
        self.state = "operational"
        self._on_event(event)

    def setPause(self, pause, **more):
        if pause and self.state == "printing":
            self.state = "paused"
            self._on_event("PrintPaused")
        elif not pause and self.state == "paused":
            self.state = "printing"
            self._on_event("PrintResumed")
            self._continue_sending()

    def pause_print(self, **more):
        self.setPause(True)

    ##~~ what goes out

    def _do_send(self, command, gcode=None):
        if gcode in self._checksum_requiring_commands or self.is_printing():
            number, self._current_line = self._current_line, self._current_line + 1
            text = f"N{number} {command}"
            checksum = 0
            for byte in text.encode():
                checksum ^= byte
            command = f"{text}*{checksum}"
        self._do_send_without_checksum(command.encode())

    def _do_send_without_checksum(self, data, log=True):
        if self.board.sessions == self._session and self.board.is_plugged_in:
            self.board.receive(data + b"\n")

    ##~~ OctoPrint's words for its state

    def isOperational(self):
        return self.state not in ("closed", "connecting")

    def isPrinting(self):
        return self.state in ("printing", "finishing")

    def isPaused(self):
        return self.state == "paused"

    def isFinishing(self):
        return self.state == "finishing"

    def isBusy(self):
        return self.isPrinting() or self.isPaused()

    def never(self, *args, **more):
        return False

    isStreaming = isSdFileSelected = isSdPrinting = isSdReady = isStarting = never
    isPausing = isResuming = isCancelling = is_pausing = is_cancelling = never
    is_operational, is_printing, is_paused = isOperational, isPrinting, isPaused
    is_finishing = isFinishing

    def getCurrentTool(self):
        return self._currentTool

    def initSdCard(self, **more):
        pass

    refreshSdFiles = initSdCard
    register_callback = initSdCard

    def get_current_data(self):
        return {}
