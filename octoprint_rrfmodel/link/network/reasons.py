"""Why a connection with a board on the network could not be made, or has ended, in sentences."""

from flask_babel import gettext


def reason(code, host, why=""):
    """Return the sentence; ``why`` is a word or two of the network's."""
    texts = {
        "unreachable": gettext(
            "The board at %(host)s can't be reached: %(why)s. Check its power, its network and the"
            " address."
        ),
        "wrong_password": gettext(
            "The board at %(host)s wants another password. Set the one of M551 in the connection"
            " panel."
        ),
        "no_slot": gettext(
            "All sessions of the board at %(host)s are taken. Close other programs or pages that"
            " use it, wait ten seconds and connect again."
        ),
        "too_old": gettext(
            "The firmware of the board at %(host)s is too old for this. RepRapFirmware 3.1 or newer"
            " is needed; until then connect it by USB."
        ),
        "sbc_too_old": gettext(
            "The software of the single-board computer at %(host)s is too old for this. Duet"
            " Software Framework 3.4 or newer is needed."
        ),
        "sbc_down": gettext(
            "The single-board computer at %(host)s answers, but its control server doesn't. Wait"
            " until it has started; if that doesn't help, update or restart it."
        ),
        "not_rrf": gettext("What answers at %(host)s is no board with RepRapFirmware."),
        "gone": gettext("The board at %(host)s has not come back: %(why)s."),
        "no_address": gettext(
            "That is no address of a board. Give a name or an address, if need be with a port:"
            " duet.local or 192.168.1.14:8080."
        ),
    }
    return texts.get(code, texts["not_rrf"]) % {"host": host, "why": why or code}


def card_sentence(refused):
    """Return why a file or folder of the card could not be changed (``card.CardRefused``)."""
    texts = {
        "name": gettext(
            "The board can't have a file called %(detail)s: its card takes no \\ : * ? \" < > | ;"
            " and 115 letters with the folders at most."
        ),
        "unreachable": gettext("The board can't be reached: %(detail)s."),
        "failed": gettext("The board has refused it: %(detail)s."),
        "not_whole": gettext("%(detail)s has not come through whole. Try again."),
        "stopped": gettext("It was called off."),
        "busy": gettext("Another file is on its way to or from the board. Wait for its end."),
        "no_room": gettext("There is no room for %(detail)s on the disk of OctoPrint's host."),
        "gone": gettext("The card has no file %(detail)s any more."),
        "not_here": gettext("%(detail)s has to be downloaded from the board by itself first."),
        "large": gettext("%(detail)s is larger than it may be."),
    }
    return texts[refused.code] % {"detail": refused.detail}


def no_board_sentence():
    """Return why the machine's own files can't be had over a line."""
    return gettext(
        "The machine's files can be read and changed over the network alone. Connect it that way."
    )


def height_map_sentence(broken, name):
    """Return what is wrong with the file of a mesh (``rrf.card.height_map.BrokenHeightMap``)."""
    cut = gettext(
        "%(name)s has not all points of its grid. It was changed or cut: probe the bed again (G29)."
    )
    texts = {
        "title": gettext("%(name)s is no height map."),
        "labels": gettext("%(name)s is no height map of a form that is known."),
        "grid": gettext("The grid in %(name)s makes no sense. Probe the bed again (G29)."),
        "rows": cut,
        "row": cut,
        "value": gettext(
            "Row %(detail)s of %(name)s holds something that is no height. Probe the bed again"
            " (G29)."
        ),
        "large": gettext("%(name)s is too large for a height map."),
    }
    return texts[broken.code] % {"name": name, "detail": broken.detail}
