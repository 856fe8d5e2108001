"""What a person is told: refusals of what was asked for, and what is wrong."""

from flask_babel import gettext


def notice_text(code, detail):
    """Return the sentence for a refusal's code, with its detail in it."""
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
        "print_paused": gettext("The print was paused. %(detail)s"),
        "recover_failed": gettext(
            "The machine did not come back after its restart. Check its power and cable, then"
            " connect."
        ),
    }
    return texts[code] % {"detail": detail}


def waiting_text(text):
    """Return the sentence for a message box that a print was to wait for."""
    return gettext(
        'A message waits for an answer: "%(text)s". Do what it says, then resume the print, or'
        " cancel it.",
        text=text,
    )


def warning_text(code, numbers=()):
    """Return the sentence for a warning's code, with its numbers in it."""
    texts = {
        "halted": gettext(
            "The machine was stopped by an emergency stop. Restart it with M999 or its power"
            " switch."
        ),
        "off": gettext("The motors have no supply voltage."),
        "heater_fault": gettext(
            "Heater %(number)s reports a fault. Find the cause, then reset it with M562."
        ),
        "filament_error": gettext(
            "The filament monitor of extruder %(number)s reports an error. Check the filament."
        ),
        "driver_error": gettext("Motor driver %(number)s reports an error. Find the cause."),
        "reset": gettext(
            "The board was reset during the print, which can't go on. Cancel it, then home."
        ),
        "message_box_unanswerable": gettext(
            "The machine waits for an answer that this firmware does not take over USB. Answer on"
            " the machine's own page or panel, or reset the machine."
        ),
        "long_running_commands": gettext(
            "OctoPrint does not know some of RepRapFirmware's commands that take long."
        ),
        "uppercase": gettext(
            "OctoPrint's terminal would change file names and texts to upper case."
        ),
        "unknown_commands": gettext(
            "OctoPrint does not count the acknowledgements of T-1 and of commands such as echo."
        ),
        "external_heatup": gettext(
            "OctoPrint would take RepRapFirmware's temperature reports for a heat-up."
        ),
        "profile_tools": gettext(
            "The printer profile has fewer extruders than the machine's highest tool number needs,"
            " so that OctoPrint drops tool commands."
        ),
        "mqtt_topic": gettext(
            "Nothing is published over MQTT: the topic in the plugin's settings is empty, too long,"
            " or has one of the characters + and # in it."
        ),
        "profile_reconnect": gettext(
            "Disconnect the printer and connect it again: OctoPrint still uses the old number of"
            " extruders."
        ),
    }
    return texts[code] % {"number": ".".join(map(str, numbers))}
