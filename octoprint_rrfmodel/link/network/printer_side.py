"""What OctoPrint is told of a board on the network: state, temperatures, job, lines.

All of it on one thread, ``rrfmodel.printer``, as plugins of others hang on each call. What comes
when the connection is over would close the one that came after it, so it is told nothing then.
"""

import threading

from octoprint.events import Events, eventManager
from octoprint.printer import ErrorInformation, FirmwareInformation
from octoprint.printer.connection import ConnectedPrinterState

from ...rrf.views.event_facts import ending
from ...rrf.views.job_steps import OPERATIONAL, STARTING, JobSteps
from ...rrf.views.machine import Machine
from ...rrf.views.temperatures import temperatures
from ...rrf.wire.gcode_words import quoted
from .reasons import reason


class PrinterSide:
    """Tells ``listener`` of the board; ``printer`` is the ``NetworkPrinter``."""

    def __init__(self, printer, listener, network):
        self._printer = printer
        self._listener = listener
        self._network = network
        self._lock = threading.RLock()
        self._speaks = True
        self._is_begun = False
        self._greeting = None
        self._z = None
        self._tool = None
        self.steps = JobSteps()
        self.is_own = False
        """Whether the job was begun by OctoPrint, whose scripts go with it."""
        self.user = None
        """Who has done to the job what is about to show."""

    def fall_silent(self):
        """Tell nothing any more, from when this returns."""
        with self._lock:
            self._speaks = False

    def say(self, function, *arguments, **named):
        """Call what OctoPrint listens with, unless the connection is over."""
        with self._lock:
            if self._speaks:
                function(*arguments, **named)

    def later(self, function, *arguments):
        """Have something done in its turn, on the thread that tells."""
        self._network.later(self.say, function, *arguments)

    def set_state(self, name):
        """Show a state, if it is another one."""
        state = ConnectedPrinterState[name]
        if state != self._printer.state:
            self.say(self._printer.set_state, state)

    def fail(self, sentence):
        """End the connection, which may never have been one."""
        with self._lock:
            if not self._speaks:
                return
            self._network.close(self)
            self._printer.error_info = ErrorInformation(error=sentence, reason="connection")
            self._printer.set_state(ConnectedPrinterState.CLOSED_WITH_ERROR, error=sentence)
            self._speaks = False

    ##~~ what the link calls

    def greeted(self, greeting):
        """Note what the board has said of itself; what it is doing comes with the model."""
        self._greeting = greeting

    def log(self, line):
        """Show a line in the terminal."""
        self.later(self._listener.on_printer_logs, line)

    def heard(self, line):
        """Note a line that may say how a job has ended."""
        self.later(self._hear, line)

    def ended(self, code, why):
        """End with a reason."""
        self._network.later(self.fail, reason(code, self._printer.host, why))

    def reconnect(self):
        """Connect to the same board again, on the thread of whoever asks."""
        self._printer.connect_again()

    def is_printing(self):
        """Return whether OctoPrint shows a print as going on."""
        return self._printer.is_printing() and not self._printer.is_paused()

    def is_paused(self):
        """Return whether OctoPrint shows a print as paused."""
        return self._printer.is_paused()

    def profile(self):
        """Return the printer profile of the connection."""
        return self._printer.profile

    def control_job(self, action):
        """Return whether OctoPrint does that to the board's job."""
        if self.steps.state == OPERATIONAL:
            return False
        getattr(self._printer, f"{action}_print")()
        return True

    def look(self):
        """Tell what has changed of the model."""
        model = self._network.model()
        if not self._is_begun:
            if not Machine(model).status:
                return
            self._begin()
        if "heat" in model:
            self.say(self._listener.on_printer_temperature_update, told_temperatures(model))
        self._look_at_place(model)
        for step in self.steps.look(model, self._network.clock()):
            self._take(step)
        if self._printer.is_printing():
            self.say(self._listener.on_printer_job_progress)

    ##~~ on the thread that tells

    def _hear(self, line):
        self.steps.heard(line)
        if self._is_begun and ending(line):
            self.look()

    def _begin(self):
        self._is_begun = True
        self.set_state(OPERATIONAL)
        data = {"board": self._greeting.board_type} if self._greeting else {}
        self.say(self._set_firmware, FirmwareInformation(name="RepRapFirmware", data=data))
        self.say(eventManager().fire, Events.CONNECTED, {"connector": self._printer.connector})
        self.say(self._printer.begin_files)

    def _set_firmware(self, information):
        self._printer.firmware_info = information

    def _take(self, step):
        """Show a state, or make a call."""
        if step.state:
            self.set_state(step.state)
        else:
            getattr(self, f"_job_{step.call}")(step)

    def _job_select(self, step):
        self.is_own = False
        self.user = None
        self.say(self._printer.select_of_board, step.path)

    def _job_started(self, step):
        self.say(self._listener.on_printer_job_started, suppress_script=True)

    def _job_paused(self, step):
        self._about_job(self._listener.on_printer_job_paused, user=self.user)

    def _job_resumed(self, step):
        self._about_job(self._listener.on_printer_job_resumed, user=self.user)

    def _job_done(self, step):
        self._printer.is_through = True
        self._about_job(self._listener.on_printer_job_done)

    def _job_cancelled(self, step):
        self._about_job(self._listener.on_printer_job_cancelled, user=self.user)

    def _job_end_again(self, step):
        self._network.link.send(["M0"], ())

    def _about_job(self, call, **named):
        # nothing of OctoPrint's goes into a job that somebody has begun at the machine
        self.say(call, suppress_script=not self.is_own, **named)
        self.user = None

    def _look_at_place(self, model):
        axes = (model.get("move") or {}).get("axes") or ()
        z = next((axis.get("userPosition") for axis in axes if axis.get("letter") == "Z"), None)
        tool = (model.get("state") or {}).get("currentTool")
        if z is not None and z != self._z:
            before, self._z = self._z, z
            self.say(self._listener.on_printer_position_changed, {"z": z})
            self.say(eventManager().fire, Events.Z_CHANGE, {"new": z, "old": before})
        if type(tool) is int and tool >= 0 and tool != self._tool:
            before, self._tool = self._tool, tool
            self.say(self._listener.on_printer_position_changed, {"t": tool})
            if before is not None:
                self.say(eventManager().fire, Events.TOOL_CHANGE, {"new": tool, "old": before})

    ##~~ a job of OctoPrint's own, on the same thread

    def begin_own(self, path, user):
        """Let the board print a file of its card."""
        self.is_own = True
        self._printer.is_through = False
        self.steps.starts(path, self._network.clock())
        self.set_state(STARTING)
        # OctoPrint's script goes out in front of the print
        self.say(self._listener.on_printer_job_started, user=user)
        self._network.link.send([f"M32 {quoted(path)}"], ())


def told_temperatures(model):
    """Return the temperatures in OctoPrint's form."""
    told = temperatures(model)
    found = {f"tool{number}": tuple(value) for number, value in told.tools.items()}
    for name, value in (("bed", told.bed), ("chamber", told.chamber), *told.others.items()):
        if value is not None:
            found[name] = tuple(value)
    return found
