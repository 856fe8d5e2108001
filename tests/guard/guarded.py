"""A guard and OctoPrint's print of one of its own files, with a clock."""

from types import SimpleNamespace

from octoprint_rrfmodel.guard.print_guard import PrintGuard


class GuardedPrint:
    """What the guard looks after, what it has told, and how often it has paused it.

    ``off`` are codes that aren't watched. ``model`` may be put in another's place.
    """

    def __init__(self, off=(), is_paused=False):
        self.now = 0.0
        self.pauses = 0
        self.is_paused = is_paused
        self.state = ""
        self.told = []
        self.model = {}
        printer = SimpleNamespace(
            get_state_id=lambda: self.state,
            is_pausing=lambda: False,
            is_cancelling=lambda: False,
            is_finishing=lambda: False,
            is_printing=lambda: not self.is_paused,
            is_paused=lambda: self.is_paused,
            pause_print=lambda: self.pause(),
        )
        self.guard = PrintGuard(
            lambda: printer,
            lambda: True,
            lambda: self.model,
            is_on=lambda group, code: code not in off,
            tell=lambda code, detail: self.told.append((code, detail)),
            clock=lambda: self.now,
        )

    def pause(self):
        """Pause as OctoPrint does, which tells of it."""
        self.pauses += 1
        self.is_paused = True
        self.guard.paused()
