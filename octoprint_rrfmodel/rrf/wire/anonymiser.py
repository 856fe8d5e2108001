"""What is known of a machine, so that it can be shown to anybody.

Nothing is told that isn't known to be the firmware's or the plugin's own (``harmless``). Numbers,
truth values and the structure stay; equal texts stay equal.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from .anonymous_line import AnonymousLine
from .harmless import (
    ADDRESS,
    DATE,
    KEPT,
    KINDS,
    MEMBER,
    MEMBERS,
    PATHS,
    PEOPLES,
    SHAPE,
    TEXTS,
    WORDS,
)
from .line import find_reply
from .pseudonyms import Pseudonyms
from .reply import MalformedReply, members_of

_STRING_OR_BARE = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"?|[^"]+')
"""A JSON string, to its end or that of all, or what stands between two."""

_BARE_WORD = re.compile(r"[^\s,{}\[\]]+")
"""What stands between the brackets, commas and texts of JSON."""

_BARE_VALUE = re.compile(
    r":?(?:-?\d{1,7}(?:\.\d{1,7})?(?:[eE][-+]?\d{1,2})?|true|false|null|nan|inf)?:?", re.ASCII
)
"""A number or a word of JSON, with a colon before or behind."""

_INDEX = re.compile(r"\[[^\]]*\]|[#^]")

SECRETS = frozenset(("network.passwords", "network.hosts"))
"""Settings of which nothing is told."""

CHOSEN = frozenset(("simulator.machine", "simulator.firmware", "simulator.faults"))
"""Settings that are words of the plugin's own."""

_CHOICE = re.compile(r"[a-z0-9_.]{1,30}(?::\d{1,6}(?:\.\d{1,3})?)?", re.ASCII)

VALUES = "warnings.values."
"""Below this are the values that belong into a warning's sentence."""

UNREADABLE = "\"a reply of somebody's own values that can't be read\""


class Anonymiser:
    """One report's; whatever it makes has the same names for the same things."""

    def __init__(self) -> None:
        self._names = Pseudonyms()
        self._line = AnonymousLine(self._names)
        self.sentence = self._line.sentence
        self.command = self._line.command

    def model(self, value: Any, key: str = "") -> Any:
        """Return an object model, or the part of one that has that key."""
        return self._value(value, ".".join(_INDEX.sub("", key).split(".")))

    def members(self, value: Any) -> Any:
        """Return the plugin's state, or what ``M408``, ``M20`` and ``M36`` answer."""
        return self._value(value, "")

    def settings(self, value: Any, path: str = "") -> Any:
        """Return the plugin's settings; of what is secret how much there is."""
        if path in SECRETS:
            return len(value) if isinstance(value, Mapping) else 0
        if isinstance(value, Mapping):
            return {
                name: self.settings(below, f"{path}.{name}" if path else name)
                for name, below in value.items()
                if MEMBER.fullmatch(name)
            }
        if isinstance(value, (list, tuple)):
            return [self.settings(element, path) for element in value]
        if isinstance(value, str) and not (path in CHOSEN and _CHOICE.fullmatch(value)):
            return self._names.of("text", value)
        return value

    def codes(self, value: Any) -> Any:
        """Return a setting of OctoPrint's that is a switch or a list of G-codes."""
        if isinstance(value, (list, tuple)):
            return [self.sentence(str(code)) for code in value]
        return value if value is None or isinstance(value, (bool, int)) else "?"

    def reply(self, text: str) -> str:
        """Return the JSON of a reply; of one that can't be read its structure and numbers."""
        try:
            members = members_of(text)
        except MalformedReply:
            return self._broken(text)
        key = members.get("key")
        if not isinstance(key, str) or "result" not in members:
            return _compact(self.members(members))
        shown = {**members, "key": self._line.key(key)}
        if "flags" in shown:
            shown["flags"] = self._line.key(str(shown["flags"]))
        shown["result"] = self.model(members["result"], key)
        return _compact(
            {
                name: value if name in ("key", "flags", "result") else self._value(value, "?")
                for name, value in shown.items()
                if MEMBER.fullmatch(name)
            }
        )

    def line(self, text: str) -> str:
        """Return a line that came from the board."""
        found = find_reply(text)
        if found is None:
            return self.sentence(text)
        rest = self.sentence(found.rest)
        return f"{rest} {self.reply(found.reply)}" if rest else self.reply(found.reply)

    def _value(self, value: Any, path: str) -> Any:
        if isinstance(value, Mapping):
            return {
                self._member(name, path): self._value(below, f"{path}.{name}" if path else name)
                for name, below in value.items()
            }
        if isinstance(value, (list, tuple)):
            return [self._value(element, path) for element in value]
        if isinstance(value, str):
            return self._text(value, path)
        if isinstance(value, (int, float)) and not isinstance(value, bool) and is_peoples(path):
            return self._names.number(value)
        return value

    def _member(self, name: str, path: str) -> str:
        is_own = not is_peoples(path) and MEMBER.fullmatch(name) is not None
        return name if is_own else self._names.of("variable", name)

    def _text(self, text: str, path: str) -> str:
        if path == "doing.command":
            return self.command(text)
        if path == "too_large":
            return self._line.key(text)
        if path in PATHS:
            return self._names.path(text)
        if path in TEXTS or path.startswith(VALUES):
            return self.sentence(text)
        if path in KEPT and is_the_firmwares(text):
            return text
        return self._names.of(KINDS.get(path.rpartition(".")[2], "text"), text)

    def _broken(self, text: str) -> str:
        if any(f'"{name}' in text for name in ("global", "plugins", "customInfo", "data")):
            return UNREADABLE
        parts = list(_STRING_OR_BARE.finditer(text))
        return "".join(self._broken_part(part, text[part.end() : part.end() + 1]) for part in parts)

    def _broken_part(self, part: re.Match[str], behind: str) -> str:
        text = part[0]
        if not text.startswith('"'):
            return _BARE_WORD.sub(lambda found: self._bare(found[0]), text)
        inner = text.strip('"')
        is_known = inner in MEMBERS if behind == ":" else inner.lower() in WORDS
        return text if not inner or is_known else f'"{self._names.of("text", inner)}"'

    def _bare(self, word: str) -> str:
        return word if _BARE_VALUE.fullmatch(word) else self._names.of("word", word)


def is_peoples(path: str) -> bool:
    """Return whether a member, or what is below it, is named and filled by people."""
    return any(path == root or path.startswith(f"{root}.") for root in PEOPLES)


def is_the_firmwares(text: str) -> bool:
    """Return whether a text looks like a word of the firmware's, or a time."""
    if DATE.fullmatch(text):
        return True
    return SHAPE.fullmatch(text) is not None and ADDRESS.search(text) is None


def _compact(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False)
