"""OctoPrint's serial line as a link; the only part that knows OctoPrint's connection for others.

The hooks of this folder keep its state: ``received``, ``queued`` and ``sent``.
"""

import threading
from collections import deque

from ...host.tags import POLL_TAG
from ...rrf.gcode.blocking import MOVES, SETTLING, is_plain_move, may_change
from ...rrf.gcode.doing import HEATING, what_of
from ...rrf.gcode.duration import takes_long
from ...rrf.wire.masking import masked
from ..link import Doing, Link
from ..terminal import RecentPolls
from .box_answer import BoxAnswer
from .card_job import control_card_job
from .emergency import stop
from .extra_ok import ExtraOk
from .fitting import fit, look_again
from .lost_ok import LostOk
from .own_commands import to_queue
from .own_requests import OwnRequests
from .pending import is_change_waiting
from .restart import Connection, reconnect, restart
from .shown_targets import shown_as_it_is

STATUS_REQUEST = "M105"

RUNS_MACROS = frozenset(("T", "M98"))
"""Commands whose macros may extrude."""


class SerialLink(Link):
    """Knows OctoPrint's connection from its telling that it is RepRapFirmware to its end.

    ``printer()`` and ``profiles()`` are OctoPrint's. ``later(function, *arguments)`` calls it on
    the thread on which hooks of other plugins may take their time. ``notify("halted", doing)``
    only takes note.
    """

    kind = "serial"

    def __init__(self, printer, profiles, clock, *, later=None, notify=None):
        self._printer = printer
        self._profiles = profiles
        self.clock = clock
        self.later = later or (lambda function, *arguments: function(*arguments))
        self._notify = notify
        self.beside = None
        """What reads the board's height map over its network, ``None`` for nobody."""
        self._last = None
        self._lost_ok = LostOk(self, clock)
        self.box = BoxAnswer(self)
        """The message box that the awaited command waits in."""
        self._asked = deque(maxlen=1)
        self.polled = RecentPolls()
        self.was_identified = threading.Event()
        """Set when a board tells what it is; a restart waits for that."""
        self.forget()

    def forget(self):
        self.connection = None
        self._asked.clear()
        self.awaited = None
        """G-code of the command whose acknowledgement is awaited."""
        self.awaited_command = ""
        self.awaited_tags = ()
        self.awaits_a_move = False
        """Whether the awaited command is a plain move of a file, and nothing else is awaited."""
        self._settles = False
        self.extruded = "", ()
        """The last command that extruded, and its tags: what is refused of it comes later."""
        self.own = OwnRequests()
        self.awaited_since = 0.0
        self.awaits_long = False
        """Whether the awaited command may take long without a word."""
        self.given_up_on = None
        """``awaited_since`` of a command for which patience is over."""
        self.heard_at = 0.0
        """When the board last said something, or a command last went out to it."""
        self.asks_of_a_file = False
        self.targets = {}
        """Line that is to go out to the heater and the target that it sets."""
        self.extra_ok = ExtraOk()
        self.expects_refusal = False

    def is_known_now(self, comm):
        """Begin with a connection that has told that it is RepRapFirmware."""
        self.forget()
        fit(comm)
        look_again(comm)
        self.connection = comm

    def awaits_move(self, cmd, gcode, tags):
        """Note a move of a file that is about to go out, and return whether that is all there is
        to note of it."""
        if self.awaited is not None or self.own.awaited or self.extra_ok.awaits is not None:
            return False
        if not is_plain_move(cmd):
            return False
        self.awaited_command = cmd
        self.awaited_tags = tags
        self.awaited_since = self.heard_at = self.clock()
        self._settles = self.awaits_long = self.asks_of_a_file = False
        if "E" in cmd:
            self.extruded = cmd, tags
        # last, for its ok may be waited for from here on
        self.awaited = gcode
        self.awaits_a_move = True
        return True

    def awaits(self, cmd, gcode, tags=()):
        """Note the command that is about to go out."""
        self.awaits_a_move = False
        self.awaited = gcode
        self.awaited_command = cmd
        self.awaited_tags = tags
        self.awaited_since = self.heard_at = self.clock()
        if gcode in MOVES and is_plain_move(cmd):
            self._settles = self.awaits_long = False
            if "E" in cmd:
                self.extruded = cmd, tags
            return
        if gcode in RUNS_MACROS or ("E" in cmd and (gcode in MOVES or " E" in cmd)):
            self.extruded = cmd, tags
        self._settles = gcode in SETTLING or may_change(gcode, cmd)
        self.awaits_long = gcode is not None and takes_long(cmd, gcode)
        if self.awaits_long:
            # whatever OctoPrint's settings know of it: it asks for nothing meanwhile, and doesn't
            # take a missing ok for a lost one (comm._handle_ok ends that)
            self.connection._long_running_command = True

    def acknowledged(self):
        """Note that the awaited command is through."""
        if self._settles:
            self.settled_at = self.clock()
        self.awaited = None

    ##~~ a listener

    def identified(self):
        """Note what OctoPrint is connected with, for a restart."""
        self.was_identified.set()
        comm = self.connection
        if comm is not None:
            profile = self._profiles().get_current_or_default()["id"]
            self._last = Connection(*comm.getConnection(), profile)

    def tick(self):
        """Look after an acknowledgement that doesn't come; return the seconds until then."""
        return self._lost_ok.tick()

    ##~~ Link

    @property
    def is_operational(self):
        return self._printer().is_operational()

    def ask(self, request):
        self._asked.append(request.line)
        self.later(self._queue_poll)

    def _queue_poll(self):
        # the one before may have been hung up, and has taken it along
        if self._asked:
            self._printer().commands(STATUS_REQUEST, tags={POLL_TAG})

    def give_up(self):
        # its place in OctoPrint's queue stays, and goes out as the M105 it is
        self._asked.clear()

    def take_asked(self):
        """Return the line of the question that is to go out now, ``None`` where none is to."""
        try:
            return self._asked.pop()
        except IndexError:
            return None

    def send(self, lines, tags, force=False):
        self._printer().commands(to_queue(lines), tags=tags, force=force)

    def send_later(self, lines, tags):
        self.later(self._send_to, self.connection, lines, tags)

    def _send_to(self, comm, lines, tags):
        if comm is self.connection:
            self.send(lines, tags)

    def stop_now(self, tags):
        stop(self, tags, self._notify)

    def carried(self, lines, machine):
        return [self._carried(line, machine) for line in lines]

    def _carried(self, line, machine):
        return shown_as_it_is(line, self.profile, machine) if self.connection else line

    @property
    def can_restart(self):
        return self._last is not None

    def restart(self, is_running):
        restart(self, self._printer, self._last, is_running)

    def reconnect(self):
        reconnect(self._printer(), self._last)

    def blocked(self):
        comm = self.connection
        if comm is None:
            return None
        if comm.isStreaming() or comm._manualStreaming:
            return "streaming"
        if self.awaited is None:
            return None
        # a temperature lets OctoPrint think of heating, also where a move waits for room
        if what_of(self.awaited_command) == HEATING:
            return "heating"
        if comm._long_running_command or self.awaits_long:
            return "long_command"
        return None

    def silent_for(self):
        is_busy = self.awaits_long or self.own.report_elsewhere
        if self.connection is None or self.awaited is None or not is_busy:
            return 0.0
        return self.clock() - self.heard_at

    def doing(self):
        if self.connection is None or self.awaited is None:
            return None
        command = self.awaited_command
        return Doing(masked(command), what_of(command), self.awaited_since)

    def is_changing(self):
        comm = self.connection
        if comm is None:
            return False
        # told by who sends, on another thread
        awaited = self.awaited
        is_under_way = awaited is not None and may_change(awaited, self.awaited_command)
        return is_under_way or is_change_waiting(comm)

    def waits_in_a_box(self):
        return self.box.is_wanted()

    def has_polled(self, command):
        return command in self.polled

    def has_polled_at_all(self):
        return bool(self.polled)

    def rate(self):
        comm = self.connection
        rate = comm.getConnection()[1] if comm is not None else 0
        return rate if isinstance(rate, int) else 0

    @property
    def height_map(self):
        return self.beside and self.beside.height_map

    def read_height_map(self):
        return self.beside and self.beside.read_height_map()

    def is_streaming_a_print(self):
        comm = self.connection
        return comm is not None and comm.isPrinting() and not comm.isSdFileSelected()

    def has_a_print(self):
        comm = self.connection
        if comm is None or comm.isSdFileSelected():
            return False
        return comm.isPrinting() or comm.isPaused()

    def is_printing(self):
        return self.connection is not None and self.connection.isPrinting()

    def is_paused(self):
        return self.connection is not None and self.connection.isPaused()

    def control_card_job(self, action):
        return control_card_job(action, self.connection, self._printer(), self.card)

    def end_job(self):
        return self.card.end_job()

    def has_card(self):
        comm = self.connection
        # where OctoPrint's settings say that there is none it answers by itself
        return comm is not None and (comm.isSdReady() or not comm._sdEnabled)

    def profile(self):
        comm = self.connection
        if comm is None:
            return None
        # 2.0 keeps the one that the connection was made with
        return getattr(comm, "_printer_profile", None) or self._profiles().get_current_or_default()
