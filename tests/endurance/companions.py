"""Faults that come with a scene. Their times are simulated seconds, made of those of the clock.

What each does is said in ``octoprint_rrfmodel.simulator.faults``.
"""

from typing import NamedTuple


class Companion(NamedTuple):
    """A fault, and how to switch it on."""

    name: str
    argument: str = ""
    seconds: float = 0.0
    """Of the clock, where the argument is a time."""
    lasts: float = 0.0
    """Seconds of the clock after which it is over; without them it lasts as long as the scene."""

    def text(self, speed):
        """Return what ``Board.inject`` takes, on a board of that speed."""
        argument = f"{self.seconds * speed:.2f}" if self.seconds else self.argument
        return f"{self.name}:{argument}" if argument else self.name


ON_A_PRINT = (
    Companion("lost_ok", "once"),
    Companion("lost_ok", "211"),
    Companion("extra_ok", "3"),
    Companion("glued_before", "5"),
    Companion("glued_after", "5"),
    Companion("err_no_buffers", "3"),
    # from 3.5 on the board says nothing as long as it lasts
    Companion("few_buffers", lasts=2.5),
    Companion("truncated", "2"),
    Companion("nul_bytes", "2"),
    Companion("bad_utf8", "2"),
    Companion("garbage", "3"),
    Companion("huge_line", "2"),
    Companion("nesting_bomb", "1"),
    Companion("nan"),
    Companion("exponent"),
    Companion("no_reply", "1"),
    Companion("stall", seconds=1.5),
    Companion("debug_text", "3"),
    Companion("unsolicited", seconds=0.5),
    Companion("error_reply", "50"),
    Companion("sbc"),
    # a server that is itself kept waiting for a second is no fault of the line's: what it loses by
    # that is the one line that tells whether a job of the card was done
    Companion("unread", seconds=8.0),
)
"""What the line, the firmware and a board do to a print that goes on all the same."""

IN_REPLIES = tuple(each for each in ON_A_PRINT if each.name not in ("lost_ok", "extra_ok"))
"""The same where no line is to be waited for half a minute, or to be early."""

ON_A_NEW_LINE = tuple(each for each in IN_REPLIES if each.name != "glued_before")
"""The same where OctoPrint connects: it knows an ok by the beginning of a line, gives up without
one, and until it knows the firmware no plugin changes a line."""

WHILE_IDLE = (
    *ON_A_PRINT,
    Companion("slow", seconds=0.5),
    Companion("stall", seconds=6),
    Companion("baud"),
    Companion("heater_fault", "1"),
    Companion("filament_error", "0"),
    Companion("driver_error", "0"),
    Companion("vin_off"),
    Companion("message_box", "2"),
)
"""What may also happen while nobody prints. Resets, lost ports and ``halted`` are scenes of
their own; ``usb_box_stuck`` is over with a reset alone."""
