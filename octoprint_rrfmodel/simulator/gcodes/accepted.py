"""G-codes that are taken note of in no way, because a host couldn't see any effect."""

from __future__ import annotations

from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..text.command import Command

_ACCEPTED = """
    M401 M402
    G11 G17 G18 G19 G53 G80 G93 G94 M17 M73 M110 M201 M203 M204 M205 M501 M551 M556 M557
    M558 M566 M567 M569 M570 M571 M573 M574 M577 M578 M580 M581 M582 M583 M584 M585 M586
    M587 M588 M589 M592 M595 M665 M666 M667 M668 M669 M671 M675 M851 M905 M911
    M912 M913 M915 M917 M918 M929 M950 M951 M952 M955 M956 M957 M958 M959 M970
"""
"""Configuration that the simulator takes note of in no way."""

_SINCE = {"M73": (3, 3)}
"""Where a release doesn't know it."""


class Accepted:
    """Accepts configuration that the simulator doesn't look at."""

    def rows(self) -> Rows:
        return {name: Row(_nothing, since=_SINCE.get(name)) for name in _ACCEPTED.split()}


def _nothing(channel: Channel, command: Command) -> Outcome:
    """Accepted without any effect a host could see."""
    return None
