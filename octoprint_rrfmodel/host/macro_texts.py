"""What a person is told when a command of Klipper's can't be done: one sentence for each code."""

from flask_babel import gettext

from .command_texts import command_text


def macro_text(code, values):
    """Return the sentence for a code of ``rrf.script``, with its values in it."""
    found = _texts().get(code)
    return command_text(code, values) if found is None else found % values


def _texts():
    return {
        "macro_unknown": gettext(
            "There is no command %(command)s, and no macro of that name on the machine's card."
        ),
        "macro_by_hand": gettext(
            "%(command)s is not there: RepRapFirmware asks by messages of its own while it probes"
            " or levels, and doesn't stop at every step."
        ),
        "macro_in_config": gettext(
            "%(command)s is not there: set that in the machine's config.g, or with its G-code."
        ),
        "macro_of_files": gettext("%(command)s belongs into a file that is printed."),
        "macro_resonances": gettext(
            "%(command)s is not there: RepRapFirmware measures resonances with M956."
        ),
        "macro_misses": gettext("%(command)s misses the parameter %(parameter)s."),
        "macro_parameter": gettext("%(command)s has no parameter %(parameter)s here."),
        "macro_form": gettext("%(command)s takes its parameters in the form NAME=value."),
        "macro_cannot": gettext("The machine has nothing that this could be done to."),
        "macro_unpaired": gettext(
            "%(save)s and %(restore)s belong into one script, with nothing but G-code between."
        ),
        "macro_move_back": gettext("%(restore)s can't move back. Leave MOVE out."),
        "macro_profiles": gettext(
            "The machine has one height map, default. It can be loaded, cleared and probed anew."
        ),
        "macro_no_current": gettext("No object is being printed now."),
        "macro_filament": gettext("Give the NAME of one of the machine's filaments."),
        "macro_smooth_time": gettext("RepRapFirmware has no smooth time. Give ADVANCE."),
        "macro_variables": gettext(
            "Only the machine's global variables can be set, as those of the macro %(globals)s."
        ),
        "macro_letters": gettext(
            "%(command)s takes parameters of one letter, as M98 does, and %(parameter)s is none."
        ),
        "macro_order": gettext(
            "What is done to a print has to stand first in a script, and a restart alone."
        ),
        "no_such_object_name": gettext("There is no %(value)s. There are: %(known)s."),
    }
