"""What is larger than the board's buffers: said to be so, and asked for rarely."""

from __future__ import annotations

RARELY = 60
"""Live replies after which it is tried again; it may have been made smaller."""


class TooLarge:
    """Keys, and members of keys, for which there is no room even where live values have some."""

    def __init__(self) -> None:
        self._rest: dict[str, int] = {}

    def __contains__(self, path: str) -> bool:
        """Return whether there was no room for it."""
        return path in self._rest

    @property
    def paths(self) -> tuple[str, ...]:
        """What can't be had."""
        return tuple(self._rest)

    def note(self, path: str) -> None:
        """Note that there was no room for it."""
        self._rest[path] = RARELY

    def rests(self, path: str) -> bool:
        """Return whether it is not to be asked for now."""
        return self._rest.get(path, 0) > 0

    def resting_of(self, key: str) -> frozenset[str]:
        """Return the members of a key that are not to be asked for now."""
        return frozenset(filter(self.rests, self._of(key)))

    def _of(self, key: str) -> frozenset[str]:
        return frozenset(path for path in self._rest if key_of(path) == key)

    def wake(self, key: str) -> None:
        """Let it be asked for: somebody wants it."""
        self._rest.update(dict.fromkeys(self._of(key), 0))

    def came(self, key: str, left_out: frozenset[str]) -> None:
        """Note that a key has come, but for parts of it."""
        for path in self._of(key) - left_out:
            del self._rest[path]

    def tick(self) -> set[str]:
        """Note a live reply; return the keys that are to be tried again."""
        due = {path for path, left in self._rest.items() if left == 1}
        for path, left in self._rest.items():
            self._rest[path] = max(0, left - 1)
        return {key_of(path) for path in due}


def key_of(path: str) -> str:
    """Return the key that a path begins with."""
    return path.partition(".")[0].partition("[")[0]
