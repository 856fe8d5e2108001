"""What a person is told when something that was asked for didn't happen."""

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
    }
    return texts[code] % {"detail": detail}
