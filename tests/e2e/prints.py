"""Prints that OctoPrint streams: begun, and waited for to their end."""

from . import helpers

LONG_PRINT = "\n".join(f"G1 X{20 + n % 100} Y{20 + n // 100} F600" for n in range(4000)) + "\n"


def print_long(server):
    """Return when OctoPrint streams a long print (``long.gcode``), and polls go beside it."""
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 30)
    server.upload("long.gcode", LONG_PRINT)
    server.select_and_print("long.gcode")
    server.wait_state("Printing")
    helpers.wait_polls(server, 1)


def wait_done(server, push, seconds):
    """Wait for the end of OctoPrint's print, and until the board has all of its lines.

    ``PrintDone`` is told once the last line is read, which may be on its way then.
    """
    push.wait_for_event("PrintDone", seconds)
    server.wait_state("Operational", 20)
