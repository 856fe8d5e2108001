"""Names that stand for others: what was equal stays equal, and nothing leads back."""

from __future__ import annotations

import re

FOLDERS = frozenset(
    ("gcodes", "sys", "macros", "filaments", "firmware", "menu", "www", "scans", "boot", "sd")
    + ("opt", "dsf")
)
"""Folders that every card has, and those of a computer in front of the board."""

_DRIVE = re.compile(r"\d:|\.{0,2}", re.ASCII)
"""The beginning of a path, or what leads nowhere else."""

_OWN_FILE = re.compile(
    r"(?:config|config-override|dsf-config|home(?:all|delta|[a-z])|bed|mesh|pause|resume|cancel"
    r"|start|stop|sleep|daemon|runonce|deployprobe\d?|retractprobe\d?|resurrect|resurrect-prologue"
    r"|filament-(?:change|error)\d?|(?:pre|post)?load|unload|t(?:pre|post|free)\d{0,2}"
    r"|trigger\d{1,2}|toolchangeretries|peel|arm|init|driver-(?:error|stall|warning)"
    r"|heater-fault)\.g|heightmap\.csv|filaments\.csv|eventlog\.txt",
    re.ASCII,
)
"""Files that the firmware itself looks for or writes."""

_ENDING = re.compile(
    r"\.(?:gcode|gco|gc|g|nc|cnc|csv|txt|bin|uf2|json|jsonl|log|py|zip|bgcode|stl|3mf|cfg|yaml)\Z",
    re.IGNORECASE | re.ASCII,
)
"""How a file's name ends that is told with its pseudonym."""


class Pseudonyms:
    """Gives each text one name for good, such as ``name-1`` or ``file-3.gcode``."""

    def __init__(self) -> None:
        self._given: dict[str, str] = {}
        self._numbers: dict[object, int] = {}
        self._counts: dict[str, int] = {}
        self.several_words: list[str] = []
        """The texts with blanks inside that have a name."""

    def of(self, kind: str, text: str) -> str:
        """Return what stands for a text; it is new where the text is, and empty for none."""
        if not text:
            return text
        if text not in self._given:
            ending = _ENDING.search(text)
            # what lies in the kind before counts on, so that no two texts share a name
            shown = "file" if ending and kind in ("folder", "word") else kind
            number = self._counts[shown] = self._counts.get(shown, 0) + 1
            behind = ending[0].lower() if ending and shown == "file" else ""
            self._given[text] = f"{shown}-{number}{behind}"
            if " " in text.strip():
                self.several_words.append(text)
        return self._given[text]

    def path(self, text: str) -> str:
        """Return a path with all but what every card has replaced, name by name.

        >>> Pseudonyms().path("0:/gcodes/Lena/vase.gcode")
        '0:/gcodes/folder-1/file-1.gcode'
        """
        return "/".join(map(self._step, text.replace("\\", "/").split("/")))

    def _step(self, name: str) -> str:
        is_common = _DRIVE.fullmatch(name) or name in FOLDERS or _OWN_FILE.fullmatch(name)
        return name if is_common else self.of("folder", name)

    def number(self, value: int | float) -> int | float:
        """Return what stands for a number that may be somebody's own, of the same type."""
        known = self._numbers.setdefault((type(value), value), len(self._numbers) + 1)
        return type(value)(known)


def is_file_name(text: str) -> bool:
    """Return whether a text ends as a file's name does."""
    return _ENDING.search(text) is not None
