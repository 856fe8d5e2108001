"""The objects of a print that M486 has told about."""

from __future__ import annotations

from typing import Any

from ..model.tree import ObjectModel


class BuildObjects:
    """Names objects and cancels them; ``job.build`` as long as there is a print."""

    def __init__(self, model: ObjectModel):
        self._model = model
        self.restart()

    def restart(self) -> None:
        self._found: list[dict[str, Any]] = []
        self.current = -1

    def build(self) -> dict[str, Any]:
        """Return ``job.build``."""
        return {
            "currentObject": self.current,
            "m486Names": bool(self._found),
            "m486Numbers": False,
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
        if name is not None and number >= 0:
            self._found[number]["name"] = name
            self._model.bump("job")
        self.current = number

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
