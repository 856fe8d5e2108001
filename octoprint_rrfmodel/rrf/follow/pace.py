"""How long to wait before the next poll, from what the last one cost."""

from __future__ import annotations

from collections import deque

IDLE_SECONDS = 1.15
"""Between polls of a host that prints nothing: with a status request each, half of the bytes that
PanelDue asks for (``d99fp`` every 500 ms)."""

PRINTING_SECONDS = 2.0
"""Shortest time between two polls while a host streams a print: they come before its lines."""

IDLE_SHARE = 0.4
PRINTING_SHARE = 0.05
"""Part of the line's time that polling may take."""

BEGINNING_SECONDS = 0.02
"""Between polls until every key is known."""

CATCHING_UP_SECONDS = 0.2
"""Between polls while a key that changed waits to be fetched."""

LONGEST_SECONDS = 30.0

MOST_FAILURES = 10
"""More of them in a row count no further: a power of theirs would leave the range of a float."""

OVERHEAD_BYTES = 120
"""Bytes around a reply: the request, the blank line, two ok, M105 and its temperatures."""

BITS_A_BYTE = 10

SLOW_BITS = 1_000_000
"""Rate below which a line's time is dear; of a USB line the rate that is set says nothing."""

TELLING_BYTES = 250
"""Length from which on a reply tells how fast the line is."""

FASTER = 1.25
"""Factor above the line's rate from which on its replies tell that it is none: it is USB.

It is taken for a slow line again when they come no faster than its rate, which on a UART they
never do, and on USB only from a board that has something else to do.
"""

SPARING_SHARE = 0.028
"""Part of a slow line's time that polling may take beside a print; 3 % is what it may be."""

LOOKED_AT = 12
"""Long replies that are taken together: one that seems to have come fast is a clock held up."""

TELLING_TOTAL = 3000
"""Bytes that they have together at least before they tell anything."""


class Pace:
    """Measures polls and spaces them. Times are in seconds."""

    def __init__(self) -> None:
        self._cost = 0.0
        self._goes_on = False
        self._failures = 0
        self._baudrate = 0
        self._replies: deque[tuple[int, float]] = deque(maxlen=LOOKED_AT)
        self._is_fast = False

    def connected(self, baudrate: int) -> None:
        """Begin anew; ``baudrate`` is 0 where none is known. On USB it means nothing."""
        self._baudrate = baudrate
        self._replies.clear()
        self._is_fast = False
        self._cost = 0.0
        self._goes_on = False
        self._failures = 0

    def answered(self, length: int, seconds: float, goes_on: bool = False) -> None:
        """Note a reply of ``length`` bytes that came ``seconds`` after its request was sent.

        ``goes_on``: the next one is a part of the same, and what they cost is counted together.
        What the line was taken for is at most both: a USB line is faster than its nominal rate,
        and a board may think longer than it talks.
        """
        self._failures = 0
        if length >= TELLING_BYTES:
            self._replies.append((length, seconds))
            self._look()
        cost = seconds
        if self._baudrate:
            line_time = (length + OVERHEAD_BYTES) * BITS_A_BYTE / self._baudrate
            cost = min(seconds, line_time)
        self._cost = self._cost + cost if self._goes_on else cost
        self._goes_on = goes_on

    @property
    def bytes_a_second(self) -> float:
        """What a slow line carries, 0 for one that isn't slow or isn't known."""
        is_slow = self._baudrate < SLOW_BITS and not self._is_fast
        return self._baudrate / BITS_A_BYTE if is_slow else 0.0

    def _look(self) -> None:
        """See whether the line is faster than its rate; between the bounds it stays as it was."""
        length = sum(each for each, _ in self._replies)
        seconds = sum(each for _, each in self._replies)
        line_seconds = length * BITS_A_BYTE / self._baudrate if self._baudrate else 0.0
        if seconds >= line_seconds:
            self._is_fast = False
        elif length >= TELLING_TOTAL and seconds * FASTER < line_seconds:
            self._is_fast = True

    @property
    def has_failed(self) -> bool:
        """Whether it is time to ask less often: more than one poll in a row brought nothing."""
        return self._failures > 1

    def failed(self) -> None:
        """Note a poll that brought nothing: back off, the more the oftener."""
        self._failures = min(self._failures + 1, MOST_FAILURES)

    def wait(self, printing: bool, behind: bool = False, begins: bool = False) -> float:
        """Return the seconds between the end of the last poll and the next one.

        ``behind``: a key waits to be fetched. ``begins``: not every key is known yet.
        """
        share = PRINTING_SHARE if printing else IDLE_SHARE
        spaced = self._cost * (1 - share) / share
        if self._failures:
            return min(LONGEST_SECONDS, max(spaced, IDLE_SECONDS * 2.0**self._failures))
        if self._goes_on:
            return BEGINNING_SECONDS
        if printing:
            return max(PRINTING_SECONDS, spaced)
        if begins:
            return BEGINNING_SECONDS
        if behind:
            return max(CATCHING_UP_SECONDS, spaced)
        return min(LONGEST_SECONDS, max(IDLE_SECONDS, spaced))
