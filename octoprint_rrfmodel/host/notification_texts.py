"""What a person is told once: refusals of what was asked for, and what has happened."""

from flask_babel import gettext


def notification_text(code, detail):
    """Return the sentence for a notification's code, with its detail in it."""
    texts = {
        "not_homed": gettext("Nothing was moved: home %(detail)s first."),
        "no_tool_selected": gettext("Nothing was done: select a tool first."),
        "too_cold": gettext("Nothing was extruded: tool %(detail)s is too cold. Heat it first."),
        "no_such_tool": gettext("Nothing was done: the machine has no tool %(detail)s."),
        "no_bed": gettext("Nothing was heated: the machine has no heated bed."),
        "no_chamber": gettext("Nothing was heated: the machine has no heated chamber."),
        "message_box": gettext(
            "Not sent, nobody could answer it on this firmware: %(detail)s. Update the firmware to"
            " 3.6.1 or newer."
        ),
        "debug_table": gettext(
            "Not sent, the printer would not acknowledge it: %(detail)s. Use the machine's own"
            " console."
        ),
        "asterisk": gettext(
            "Not sent, the printer would take the asterisk for a checksum and drop the line:"
            " %(detail)s. Put the text in quotes, or leave the asterisk out."
        ),
        "heaters_off": gettext(
            "The print was cancelled. These heaters, which OctoPrint's script does not know, were"
            " switched off too: %(detail)s."
        ),
        "quotes": gettext(
            "Not sent, a quote in it is not closed: %(detail)s. Close it; OctoPrint takes a"
            " semicolon for the end of the line, also in quotes."
        ),
        "refused": gettext("The machine has refused %(detail)s."),
        "file_checked": gettext("Before you print: %(detail)s"),
        "box_waits": gettext(
            "A message of the machine waits for an answer that this firmware does not take over"
            " USB. Answer on the machine's own page or panel, and everything goes on by itself; or"
            " restart the machine."
        ),
        "print_paused": gettext("The print was paused. %(detail)s"),
        "board_reset": gettext(
            "The board was reset. Its axes have to be homed again, and its heaters are off."
        ),
        "stop_waits": gettext(
            "The emergency stop was sent, but this firmware reads it only when %(detail)s is"
            " through. If that is too late, switch the machine off. Firmware 3.6.3 and newer stops"
            " at once."
        ),
        "stopped_beside": gettext(
            "The machine has stopped: the emergency stop has come over its network."
        ),
        "prints": gettext("Nothing was done: the machine prints."),
        "not_brought": gettext("The print was not begun. %(detail)s"),
        "unsent_away": gettext("Not sent, the machine doesn't answer: %(detail)s."),
        "unsent_reset": gettext("Not sent, the machine was reset: %(detail)s."),
        "unsent_doubtful": gettext(
            "It is not known whether the machine got %(detail)s. It is not sent again; look at the"
            " machine first."
        ),
        "unsent_too_long": gettext(
            "Not sent, it is longer than the 240 letters that the machine's network takes:"
            " %(detail)s."
        ),
        "recover_failed": gettext(
            "The machine did not come back after its restart. Check its power and cable, then"
            " connect."
        ),
    }
    return texts[code] % {"detail": detail}
