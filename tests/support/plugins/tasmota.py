"""Stands in for plugins that look at the line behind this one, by their names: smart plugs, and
those that count filament and read positions (SpoolManager, Octolapse).

``/api/plugin/tasmota`` tells what each of them would have made of it.
"""

import re

import flask
import octoprint.plugin

__plugin_name__ = "Onlooker"
__plugin_pythoncompat__ = ">=3.9,<4"

POSITION = re.compile(r"X:\s*[-\d.]+\s*Y:\s*[-\d.]+\s*Z:\s*([-\d.]+)\s*E:\s*([-\d.]+)")
"""A position as OctoPrint and Octolapse read it."""

EXTRUDED = re.compile(r"G[01]\b.*\bE(-?[\d.]+)")


class Onlooker(octoprint.plugin.SimpleApiPlugin):
    def __init__(self):
        self._queued, self._left, self._sent, self._received = [], [], [], []
        self._positions = 0
        self._filament = 0.0
        self._e = 0.0
        self._is_relative = self._is_relative_e = False

    def on_queuing(self, comm, phase, cmd, cmd_type, gcode, *args, **kwargs):
        self._queued.append(cmd)

    def on_queued(self, comm, phase, cmd, cmd_type, gcode, *args, **kwargs):
        self._left.append(cmd)

    def on_sent(self, comm, phase, cmd, cmd_type, gcode, *args, **kwargs):
        """Count filament as OctoPrint's own analysis does, which the others are made from."""
        self._sent.append(cmd)
        if gcode in ("G90", "G91"):
            self._is_relative = gcode == "G91"
        elif gcode in ("M82", "M83"):
            self._is_relative_e = gcode == "M83"
        elif gcode in ("G0", "G1"):
            found = EXTRUDED.match(cmd)
            if found:
                amount = float(found[1])
                if not (self._is_relative or self._is_relative_e):
                    amount -= self._e
                self._e += amount
                self._filament += amount

    def on_received(self, comm, line, *args, **kwargs):
        self._received.append(line)
        self._positions += POSITION.search(line) is not None
        return line

    def is_api_protected(self):
        return True

    def on_api_get(self, request):
        return flask.jsonify(
            queued=self._queued,
            left=self._left,
            sent=self._sent,
            received=self._received,
            positions=self._positions,
            filament=self._filament,
            absolute=not (self._is_relative or self._is_relative_e),
        )


def __plugin_load__():
    global __plugin_implementation__, __plugin_hooks__
    __plugin_implementation__ = onlooker = Onlooker()
    __plugin_hooks__ = {
        "octoprint.comm.protocol.gcode.queuing": onlooker.on_queuing,
        "octoprint.comm.protocol.gcode.queued": onlooker.on_queued,
        "octoprint.comm.protocol.gcode.sent": onlooker.on_sent,
        # as Octolapse
        "octoprint.comm.protocol.gcode.received": (onlooker.on_received, -1),
    }
