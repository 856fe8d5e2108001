"""The warnings that hold now, of the machine, the print and OctoPrint, put together."""

from ..host.warning_texts import paused_text, waiting_text
from ..host.warnings import ALL_LEVELS, PRINT_PAUSED, warning, worst_first
from ..rrf.views.warnings import UNANSWERABLE, warnings_of
from ..rrf.wire.masking import masked

SILENT_SECONDS = 120.0
"""Silence of the line that is worth telling of: most commands that take long are through."""

SILENT = "silent"
"""The code of the warning that tells of it."""


class WarningList:
    """Puts the warnings together; any thread may ask.

    ``model()`` is the snapshot, ``link`` the line to the board. ``problems()`` gives the codes of
    what OctoPrint is to be set up for. The others know what is to be told.
    """

    def __init__(self, model, link, guard, *, recovery, boxes, problems):
        self._model = model
        self._link = link
        self._guard = guard
        self._recovery = recovery
        self._boxes = boxes
        self._problems = problems

    def __call__(self):
        """Return the warnings, the worst first, in the form of the public contract, section 2."""
        if not self._link.is_rrf:
            was_halted = self._recovery.is_wanted and not self._link.is_operational
            return [warning("halted")] if was_halted else []
        found = warnings_of(self._model(), self._guard.has_print())
        found += [cause for cause in self._guard.causes() if cause not in found]
        if self._boxes.is_open and UNANSWERABLE not in found:
            found.append(UNANSWERABLE)
        warnings = [
            *self._paused(),
            *map(_in_form, found),
            *self._silence(),
            *map(warning, self._problems()),
        ]
        return worst_first(warnings)

    def _silence(self):
        doing = self._link.doing()
        if doing is None or self._boxes.is_open or self._link.silent_for() < SILENT_SECONDS:
            return []
        return [warning(SILENT, {"command": masked(doing.command)})]

    def _paused(self):
        pause = self._guard.pause()
        if pause is None:
            return []
        causes = [_in_form(cause) for cause in pause.causes]
        why = waiting_text(pause.message) if pause.message else _sentences(causes)
        return [
            {
                "code": PRINT_PAUSED,
                "text": paused_text(why, pause.what_next),
                "level": ALL_LEVELS[PRINT_PAUSED],
                "values": {"next": pause.what_next, "message": pause.message},
                "causes": causes,
            }
        ]


def _in_form(found):
    return warning(found.code, found.values, found.name)


def _sentences(warnings):
    return " ".join(told["text"] for told in warnings)
