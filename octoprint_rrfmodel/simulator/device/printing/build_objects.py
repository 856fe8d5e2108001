"""The objects of a print that M486 has told about."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...model.tree import ObjectModel


class BuildObjects:
    """Names objects and cancels them; ``job.build`` as long as there is a print."""

    def __init__(self, model: ObjectModel):
        self._model = model
        self.restart()

    def restart(self) -> None:
        self._found: list[dict[str, Any]] = []
        self._placed: set[int] = set()
        self.current = -1
        self._has_names = self._has_numbers = False

    def build(self) -> dict[str, Any]:
        """Return ``job.build``."""
        return {
            "currentObject": self.current,
            "m486Names": self._has_names,
            "m486Numbers": self._has_numbers,
            "objects": self._found,
        }

    def name(self, number: int, name: str | None = None) -> None:
        """Make object ``number`` the current one; -1 for none."""
        while number >= len(self._found):
            index = len(self._found)
            self._found.append(
                {"cancelled": False, "name": f"Object {index}", "x": [80, 120], "y": [80, 120]}
            )
            self._model.bump("job")
        self._has_numbers = True
        if name is not None and number >= 0:
            self._has_names = True
            self._found[number]["name"] = name
            self._model.bump("job")
        self.current = number

    def printed(self, *points: Sequence[float]) -> None:
        """Note that a line of the current object has these ends, in X and Y."""
        if self.current < 0:
            return
        found = self._found[self.current]
        before = [*found["x"], *found["y"]]
        for place, name in enumerate("xy"):
            known = found[name] if self.current in self._placed else []
            values = [*known, *(round(point[place]) for point in points)]
            found[name] = [min(values), max(values)]
        self._placed.add(self.current)
        if before != [*found["x"], *found["y"]]:
            self._model.bump("job")

    def cancel(self, number: int, cancelled: bool) -> bool:
        """Mark an object; return whether there is such a one."""
        if not 0 <= number < len(self._found):
            return False
        self._found[number]["cancelled"] = cancelled
        self._model.bump("job")
        return True

    def told(self) -> str:
        """Return what M486 says of the objects."""
        if not self._found:
            return "No known objects on build plate"
        return "\n".join(
            f"Object {number}: {found['name']}{' (cancelled)' if found['cancelled'] else ''}"
            for number, found in enumerate(self._found)
        )
