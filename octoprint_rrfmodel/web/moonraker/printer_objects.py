"""Klipper's printer objects of this printer, and what goes with them."""

import socket

from ...rrf import klipper
from ...rrf.gcode.doing import OTHER
from ...rrf.script.help import help_texts

CONFIGURATION = "configfile"
"""The object that clients take all others from, macros too."""


class PrinterObjects:
    """Answers about printer objects from what is known; any thread may ask.

    ``follower`` has the model, ``link`` leads to the board, ``job()`` gives OctoPrint's own job,
    ``clock()`` the time in seconds that clients get as ``eventtime``, ``version()`` the plugin's.
    """

    def __init__(self, follower, link, job, *, clock, version):
        self._follower = follower
        self._link = link
        self._job = job
        self._clock = clock
        self._version = version
        self._kept = klipper.Kept()
        self._macros = ()
        self._look_for_macros = lambda: None

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Take a reply's news into what is kept from one to the next."""
        self._observe()

    def reset(self):
        """Begin anew with a board that did."""
        self.forgotten()
        self._observe()

    def _observe(self):
        self._kept.observe(self._follower.store.model, self._host(), self._clock())

    def line(self, line):
        """Note a line that the printer said."""
        self._kept.heard(line)

    def forgotten(self):
        """Know nothing: the connection is gone."""
        self._kept.forget()

    def attach(self, look_for_macros):
        """Have ``look_for_macros()`` called where somebody asks what there is; it waits a little.

        It brings its news by ``found_macros``.
        """
        self._look_for_macros = look_for_macros

    def found_macros(self, paths):
        """Take the paths of all macro files."""
        self._macros = paths

    ##~~ what others ask

    def is_connected(self):
        """Return whether a board with RepRapFirmware is at the line's other end."""
        return self._link.is_operational and self._link.is_rrf

    def world(self):
        """Return what objects are computed from, as it is now."""
        model = self._follower.store.model
        return klipper.World(model, self._host(), self._kept.snapshot, self._clock())

    def model(self):
        """Return the snapshot."""
        return self._follower.store.model

    def names(self):
        """Return the names of the objects that there are."""
        self._look_for_macros()
        return klipper.names(self.world())

    def query(self, wanted):
        """Return the fields that are wanted, with the time of the answer."""
        if CONFIGURATION in wanted:
            self._look_for_macros()
        world = self.world()
        return {"eventtime": world.eventtime, "status": klipper.status(world, wanted)}

    def help_texts(self):
        """Return what each command does that can be sent as a script."""
        self._look_for_macros()
        return help_texts(self.world())

    def state(self):
        """Return the printer's state in Klipper's words, ``disconnected`` without a line."""
        return klipper.server_info(self.world(), 0, "")["klippy_state"]

    def server_info(self, websocket_count):
        """Return what ``server.info`` answers."""
        return klipper.server_info(self.world(), websocket_count, self._version())

    def printer_info(self):
        """Return what ``printer.info`` answers."""
        return klipper.printer_info(self.world(), self._version(), socket.gethostname())

    def _host(self):
        doing = self._link.doing()
        return klipper.Host(
            is_at_work=doing is not None and doing.what != OTHER,
            is_connected=self.is_connected(),
            is_ready=self._follower.ready,
            has_protocol=not self._follower.is_mute,
            job=self._job(),
            macros=self._macros,
            heights=self._link.height_map,
        )
