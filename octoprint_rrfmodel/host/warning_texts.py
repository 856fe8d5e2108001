"""What a person is warned of, in sentences."""

from flask_babel import gettext


def waiting_text(text):
    """Return the sentence for a message box that a print was to wait for."""
    return gettext(
        'A message waits for an answer: "%(text)s". Do what it says, then resume the print, or'
        " cancel it.",
        text=text,
    )


def paused_text(why, what_next):
    """Return the sentences for a print that the plugin paused; ``what_next`` as in ``guard``."""
    texts = {
        "wait": gettext("The print was paused. %(why)s Then resume the print, or cancel it."),
        "resume": gettext(
            "The print was paused. %(why)s That is over now: resume the print, or cancel it."
        ),
        "cancel": gettext("The print was paused and can only be cancelled. %(why)s"),
        "answer": gettext("The print was paused. %(why)s"),
        "mend": gettext("The print was paused. %(why)s Then resume the print, or cancel it."),
    }
    return texts[what_next] % {"why": why}


def N_(text):
    """Mark a sentence for translation, which comes when somebody is told it."""
    return text


TEXTS = {
    "halted": N_(
        "The machine was stopped by an emergency stop. Restart it with M999 or its power switch."
    ),
    "off": N_("The motors have no supply voltage."),
    "heater_fault": N_(
        "Heater %(number)s reports a fault. Find the cause, then reset it with M562."
    ),
    "filament_error": N_(
        "The filament monitor of extruder %(number)s reports an error. Check the filament."
    ),
    "driver_error": N_("Motor driver %(number)s reports an error. Find the cause."),
    "reset": N_("The board was reset during the print, which can't go on. Cancel it, then home."),
    "position_lost": N_(
        "The motors had no supply voltage, and the machine has lost its position. Home what can"
        " be homed beside the print, or set the position by G92."
    ),
    "message_box_unanswerable": N_(
        "The machine waits for an answer that this firmware does not take over USB. Answer on"
        " the machine's own page or panel, or reset the machine."
    ),
    "silent": N_(
        "The machine has said nothing for minutes and is taken to be busy with %(command)s. If"
        " it is not, restart it or disconnect; by itself the connection ends after the time in"
        " the plugin's settings."
    ),
    "startup_error": N_("Line %(line)s of %(file)s failed when the machine started: %(message)s"),
    "filament_monitor_mode": N_(
        "The filament monitor of extruder %(number)s acts only on what the machine prints from"
        " its own card. Give it S2 in its M591 in config.g, so that it acts on OctoPrint's"
        " prints too."
    ),
    "supply_voltage": N_(
        "The supply of board %(number)s has fallen below 10 V. Check its power supply and fuses."
    ),
    "driver_warning": N_(
        "Motor driver %(number)s is getting too hot. Cool it, or lower the motor's current."
    ),
    "open_load": N_(
        "Motor driver %(number)s reports that its motor may not be connected. Check its cable."
    ),
    "mcu_temperature": N_(
        "The processor of board %(number)s is hotter than 85 °C. Cool the board."
    ),
    "versions_differ": N_(
        "Board %(number)s runs firmware %(version)s and the main board %(main)s. Update them"
        " to the same version."
    ),
    "refused_move": N_(
        "The machine refused a move of the file, %(place)s: %(text)s. Find the cause, home what"
        " is not homed."
    ),
    "refused_extrusion": N_(
        "The machine moves without extruding, %(place)s: %(text)s. Select the tool and heat it."
    ),
    "refused_selection": N_(
        "The machine has not selected the tool that the file wants, %(place)s: %(text)s. Select it."
    ),
    "refused_heating": N_(
        "The machine does not heat as the file wants, %(place)s: %(text)s. Find the cause, set"
        " the temperature."
    ),
    "refused_pause": N_(
        "The file has come to a pause that the machine takes only from its own card,"
        " %(place)s: %(text)s. Do what is to be done there."
    ),
    "file_pause": N_("The file wants a pause, %(place)s. Do what is to be done there."),
    "file_filament": N_("The file wants another filament, %(place)s. Change it."),
    "file_blocks": N_(
        "The selected file has if, elif, else or while in lines %(lines)s. OctoPrint takes away"
        " the indentation that tells what belongs to them, so that all of it would be run. Put"
        " such parts into a macro on the machine and call it by M98, or print the file from the"
        " machine's card."
    ),
    "file_semicolons": N_(
        "The selected file has semicolons in quoted texts in lines %(lines)s, where OctoPrint"
        " cuts a line off. The plugin sends these lines whole; to be independent of it, take"
        " the semicolons out."
    ),
    "file_quotes": N_(
        "The selected file has quotes that are not closed in lines %(lines)s. What can be"
        " closed is, the rest is not sent. Close them."
    ),
    "long_running_commands": N_(
        "OctoPrint does not know some of RepRapFirmware's commands that take long."
    ),
    "uppercase": N_("OctoPrint's terminal would change file names and texts to upper case."),
    "unknown_commands": N_(
        "OctoPrint does not count the acknowledgements of T-1 and of commands such as echo."
    ),
    "external_heatup": N_(
        "OctoPrint would take RepRapFirmware's temperature reports for a heat-up."
    ),
    "profile_tools": N_(
        "The printer profile has fewer extruders than the machine's highest tool number needs,"
        " so that OctoPrint drops tool commands."
    ),
    "mqtt_topic": N_(
        "Nothing is published over MQTT: the topic in the plugin's settings is empty, too long,"
        " or has one of the characters + and # in it."
    ),
    "profile_reconnect": N_(
        "Disconnect the printer and connect it again: OctoPrint still uses the old number of"
        " extruders."
    ),
    "settings_reconnect": N_(
        "What was set takes effect at the next connection. Disconnect the printer and connect it"
        " again."
    ),
}
"""The sentence of each code; with values where it has any."""


def warning_text(code, values=None):
    """Return the sentence for a warning's code, with its values in it."""
    return gettext(TEXTS[code]) % (values or {})
