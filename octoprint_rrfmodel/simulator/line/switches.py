"""The faults that are switched on: when they strike, and what they do where they are asked."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial
from typing import Callable, NamedTuple, Protocol

from ..clock import Clock
from ..faults import FAULTS, ON_REPLY, OnReply, parse_fault
from ..model.om import OUT_OF_BUFFERS

NESTING = 20000
_READING = re.compile(r'("(?:current|heaters)":\[?)-?\d+\.\d+')
"""The first temperature of a reply; the group is what stands in front of it. Without decimals these
are motors' currents and numbers of heaters, which no firmware has as a ``nan``."""


def _is_json(data: bytes) -> bool:
    return data.startswith(b"{")


class Incident(NamedTuple):
    """What a fault does to the machine, and how that ends."""

    start: Callable[[str | None], None]
    """Called with the fault's argument."""
    stop: Callable[[], None] | None = None


class Incidents(Protocol):
    """Faults that do something to the same parts of a board."""

    def incidents(self) -> Mapping[str, Incident]:
        """Return what the faults of these names do."""


class FaultSwitches:
    """The faults that are on, with what is left of their counts."""

    def __init__(self, clock: Clock):
        self._clock = clock
        self._incidents: dict[str, Incident] = {}
        self._on: dict[str, str | None] = {}
        self._seen: dict[str, int] = {}

    def register(self, *groups: Incidents) -> None:
        """Let faults do something to the machine."""
        for group in groups:
            for name, incident in group.incidents().items():
                parse_fault(name)
                self._incidents[name] = incident

    def inject(self, text: str) -> None:
        """Switch a fault on, ``name`` or ``name:argument``."""
        name, argument = parse_fault(text)
        fault = FAULTS[name]
        if not fault.is_event:
            self._on[name] = argument
            self._seen[name] = 0
        self._start(name, argument)
        if fault.ends_after_argument and argument is not None:
            self._clock.after_seconds(argument, partial(self.clear, name))

    def _start(self, name: str, argument: str | None) -> None:
        incident = self._incidents.get(name)
        if incident is not None:
            incident.start(argument)

    def clear(self, name: str) -> None:
        """Switch a fault off."""
        name, _ = parse_fault(name)
        if name in self._on:
            del self._on[name]
            incident = self._incidents.get(name)
            if incident is not None and incident.stop is not None:
                incident.stop()

    def restart(self) -> None:
        """Forget what a restart puts right, and let the rest strike again."""
        for name, argument in list(self._on.items()):
            if FAULTS[name].survives_reset:
                self._start(name, argument)
            else:
                del self._on[name]

    def names(self) -> list[str]:
        return list(self._on)

    def is_on(self, name: str) -> bool:
        return name in self._on

    def number(self, name: str, otherwise: float = 0.0) -> float:
        """Return the argument of a fault that is on, ``otherwise`` while it is off."""
        argument = self._on.get(name)
        return otherwise if argument is None else float(argument)

    def take(self, name: str) -> bool:
        """Return whether the fault strikes now, and count it; it ends with its count."""
        if name not in self._on:
            return False
        argument = self._on[name]
        if argument is None:
            return True
        left = int(float(argument)) - 1
        if left > 0:
            self._on[name] = str(left)
        else:
            self.clear(name)
        return left >= 0

    def _strikes(self, name: str, row: OnReply, data: bytes) -> bool:
        if row.json_only and not _is_json(data):
            return False
        if row.takes_count:
            return self.take(name)
        argument = self._on[name] or "1"
        if argument == "once":
            self.clear(name)
            return True
        self._seen[name] += 1
        return self._seen[name] % max(1, int(float(argument))) == 0

    def on_reply(self, data: bytes) -> bytes:
        """Return the bytes of a reply as the host gets them."""
        if not self._on:
            return data
        for name, row in ON_REPLY.items():
            if name in self._on and self._strikes(name, row, data):
                data = row.change(data)
        return data

    def has_no_buffers_for(self, text: str) -> bool:
        """Return whether there is no room for a reply; those that are counted are counted."""
        argument = self._on.get("err_no_buffers")
        if argument is not None and argument.startswith(">"):
            return len(text) > float(argument[1:])
        return self.take("err_no_buffers")

    def model_text(self, text: str) -> str:
        """Return the JSON text of M409 or M408 as the faults leave it."""
        if not self._on:
            return text
        if self.has_no_buffers_for(text):
            return OUT_OF_BUFFERS
        if self.take("nesting_bomb"):
            head = text.partition('"result":')[0]
            return f'{head}"result":{"[" * NESTING}{"]" * NESTING}}}'
        if self.is_on("nan"):
            return _READING.sub(lambda match: match.group(1) + "nan", text, count=1)
        return text
