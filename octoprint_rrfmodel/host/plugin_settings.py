"""The plugin's settings and what they are when nobody has changed them."""

from ..rrf.card.wording import ROWS as WORDING
from ..rrf.gcode.quotes import ROW as QUOTES
from ..rrf.gcode.recognition import ROWS
from ..rrf.gcode.stops import ROW as STOP
from ..rrf.gcode.switch_off import ROW as HEATERS_OFF
from ..rrf.gcode.unsendable import PAUSE_ROW
from ..rrf.gcode.unsendable import ROWS as UNSENDABLE
from ..rrf.views.warnings import GUARDS
from ..rrf.wire.refusals import CODES as REFUSALS

VERSION = 1

SIDEBAR = (
    "state",
    "message",
    "warnings",
    "heaters",
    "axes",
    "fans",
    "factors",
    "job",
    "data",
)
"""Rows of the sidebar, from top to bottom."""

DEFAULTS = {
    # rows of the table of operations that are switched off go out as OctoPrint has them
    "operations": dict.fromkeys(
        [*(row.name for row in (*ROWS, *UNSENDABLE)), STOP, PAUSE_ROW, QUOTES, HEATERS_OFF], True
    ),
    # rows of the table of replies that are switched off reach OctoPrint as the firmware has them
    "replies": {row.name: True for row in WORDING},
    # what pauses a print that OctoPrint streams
    "guard": {code: True for code in (*GUARDS, *REFUSALS)},
    # minutes that a board may say nothing during a command that takes long; 0: any time
    "silence_minutes": 60.0,
    # keep the plugin's polls out of the terminal tab
    "hide_polls": True,
    "mqtt": {
        # publish the model, where OctoPrint-MQTT is there
        "enabled": True,
        # the whole one: OctoPrint-MQTT puts nothing before it
        "topic": "octoPrint/plugin/rrfmodel",
    },
    # tell what DisplayLayerProgress tells, where that plugin isn't there
    "layer_progress": True,
    "moonraker": {
        # listen on a port of its own for clients that know no prefix
        "enabled": False,
        "address": "127.0.0.1",
        "port": 7125,
    },
    # message boxes also in OctoPrint's own dialog for prompts of a printer
    "prompts": False,
    # rows of the sidebar that are shown
    "sidebar": dict.fromkeys(SIDEBAR, True),
    # what the machine does in the bar at the top of OctoPrint's page
    "navbar": True,
    # whether somebody has been led through what a machine needs of OctoPrint
    "wizard_seen": False,
    "network": {
        # minutes that a board may not answer for before the connection with it ends
        "gap_minutes": 30.0,
        # port of the web server of a board on the cable, for an emergency stop over its network,
        # too; 0: not
        "beside_port": 0,
        # by address; both are kept by the plugin alone, and told to nobody
        "passwords": {},
        "hosts": {},
    },
    "simulator": {
        # whether the port RRF-SIM is offered
        "enabled": False,
        "machine": "cartesian",
        "firmware": "3.5.3",
        "speed": 1.0,
        # names as the simulator's --list tells them, such as "lost_ok:50"
        "faults": [],
        # whether a large print with several objects is on its card
        "demo_print": False,
    },
}
