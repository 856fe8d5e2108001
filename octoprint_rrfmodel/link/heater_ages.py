"""How fresh the temperatures are that the line tells by itself, heater by heater."""


class HeaterAges:
    """Remembers when a line has told of each heater since the last reply (a listener).

    Noted by the worker, read by any thread; ``clock()`` gives the seconds.
    """

    def __init__(self, clock):
        self._clock = clock
        self._told = {}

    def warmed(self, warmed):
        """Note that a line has told of some heaters."""
        # another thread may read meanwhile, in another dictionary
        self._told = {**self._told, **dict.fromkeys(warmed.heaters, self._clock())}

    def replied(self, taken, asked_at):
        """Forget them: the model is as old as its reply again."""
        self.forgotten()

    def reset(self):
        """Forget them: the board began anew."""
        self.forgotten()

    def forgotten(self):
        """Forget them, as the connection has ended."""
        if self._told:
            self._told = {}

    def __call__(self):
        """Return the seconds since each heater was told of, by its index as JSON has it."""
        now = self._clock()
        return {str(index): round(now - at, 2) for index, at in sorted(self._told.items())}
