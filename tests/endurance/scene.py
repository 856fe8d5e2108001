"""What a scene is."""

from dataclasses import dataclass, field
from typing import Any, Callable

from .companions import Companion


class Harmed(AssertionError):
    """Something that a scene forbids has happened."""


@dataclass(frozen=True)
class Scene:
    """A row of the table."""

    name: str
    does: str
    holds: str
    """What must be so afterwards, beside what ``Rig.at_rest`` sees to after every scene."""
    run: Callable[[Any], None]
    """Called with the rig; what it asserts is said with what ``holds``."""
    companions: tuple[Companion, ...] = ()
    """Faults that may come with it, alone or two at once."""
    events: dict[str, Any] = field(default_factory=dict)
    """OctoPrint's events of ``rig.TOLD`` → how many come, or the least and the most. The others
    don't come."""
    breaks_line: bool = False
    """Whether a poll may be cut off from the M105 behind it."""
    prints: bool = False
    """Whether the time of the scene is time of a print."""

    def wanted(self, event):
        """Return the least and the most events of that name."""
        wanted = self.events.get(event, 0)
        return wanted if isinstance(wanted, tuple) else (wanted, wanted)
