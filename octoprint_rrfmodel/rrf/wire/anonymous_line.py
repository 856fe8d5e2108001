"""G-code and sentences with all replaced that a person may have written."""

from __future__ import annotations

import re

from .harmless import ADDRESS, WORD, WORDS
from .masking import masked
from .pseudonyms import Pseudonyms, is_file_name

_TOKEN = re.compile(r"\"(?P<quoted>[^\"\n]+)\"|[^\s\"'`()<>{}\[\],;=|]+")
"""What stands in quotes, or between blanks and brackets; group ``quoted`` is the first of these."""

_EDGES = ".:!?*/"
"""What may stand around a word and is none of it."""

_COMMAND = re.compile(r"\s*(?:N\d{1,9}\s*)?(?P<code>[GMT]\s?-?\d{1,4}(?:\.\d{1,2})?)", re.ASCII)
"""A command behind its line number; group ``code`` is the letter with its number."""

_PART = re.compile(
    r"(?P<blank>\s+)"
    r"|(?P<comment>;.*)"
    r"|(?P<quoted>\"(?:[^\"]|\"\")*\"?)"
    r"|(?P<checksum>\*\d{1,5}\s*\Z)"
    r"|(?P<number>'?[A-Za-z][-+]?\d{0,7}(?:\.\d{1,6})?(?::[-+]?\d{1,7}(?:\.\d{1,6})?)*"
    r"(?=[\s\"*]|\Z))"
    r"|(?P<letter>[A-Za-z](?=\"))"
    r"|(?P<other>[^\s\"*;]+|\*)",
    re.ASCII | re.DOTALL,
)
"""A part of a command's parameters; whatever is no ``number`` is somebody's own."""

NAMES_A_FILE = frozenset(("M23", "M28", "M30", "M32", "M36", "M37", "M38", "M471", "M98"))
"""Commands whose parameter is a file, with quotes or without any."""

IS_TEXT = frozenset(
    ("M117", "M118", "M540", "M550", "M551", "M552", "M553", "M554", "M586", "M587", "M588")
    + ("M589", "M929", "M472")
)
"""Commands with names, addresses or texts, also without quotes."""

ASKS_MODEL = "M409"

_AXES = re.compile(r"(?<=G28)[XYZUVWABCD]+\b|(?<=G28 )[XYZUVWABCD]+\b")


class AnonymousLine:
    """Makes lines that can be shown to anybody; ``names`` remember what stands for what."""

    def __init__(self, names: Pseudonyms) -> None:
        self._names = names
        self._known: list[str] = []
        self._looked_at = 0

    def sentence(self, text: str) -> str:
        """Return a text in which only the firmware's own words, numbers and codes are left."""
        text = masked(text)
        known = [each for each in self._several_words() if each in text]
        if not known:
            return self._words(text)
        pieces: list[str] = []
        at = 0
        for found in re.finditer("|".join(map(re.escape, known)), text):
            pieces += [self._words(text[at : found.start()]), self._names.of("name", found[0])]
            at = found.end()
        return "".join([*pieces, self._words(text[at:])])

    def _several_words(self) -> list[str]:
        """Return the texts with blanks that have a name already, the longest first."""
        texts = self._names.several_words
        new, self._looked_at = texts[self._looked_at :], len(texts)
        told = [text for text in new if self._words(text) != text]
        if told:
            self._known = sorted([*self._known, *told], key=len, reverse=True)
        return self._known

    def _words(self, text: str) -> str:
        return _TOKEN.sub(self._token, text)

    def _token(self, found: re.Match[str]) -> str:
        quoted = found["quoted"]
        if quoted is None:
            return self._word(found[0])
        is_told = all(self._is_harmless(word.strip(_EDGES)) for word in quoted.split())
        return found[0] if is_told else f'"{self._quoted(quoted)}"'

    def _word(self, token: str) -> str:
        word = token.strip(_EDGES)
        if not word or self._is_harmless(word):
            return token
        before, _, behind = token.partition(word)
        return f"{before}{self._replaced(word)}{behind}"

    def _is_harmless(self, word: str) -> bool:
        parts = word.split("/") if "/" in word else [word]
        return not word or all(part.lower() in WORDS or WORD.fullmatch(part) for part in parts)

    def _replaced(self, word: str) -> str:
        if ADDRESS.fullmatch(word):
            return self._names.of("address", word)
        if "/" in word or "\\" in word or is_file_name(word):
            return self._names.path(word)
        return self._names.of("word", word)

    def command(self, line: str) -> str:
        """Return a line of G-code whose parameters are numbers and letters alone; no comment."""
        line = masked(line)
        found = _COMMAND.match(line)
        if found is None:
            return self.sentence(line)
        code = found["code"].replace(" ", "")
        rest = line[found.end() :]
        if code in NAMES_A_FILE and '"' not in rest:
            return found[0] + self._bare_file(rest)
        if code in IS_TEXT and '"' not in rest:
            return found[0] + self._apart(rest)
        if code == "G28" and _AXES.search(line):
            return line if _AXES.sub("", line).strip() == found[0].strip() else found[0]
        return found[0] + "".join(self._part(part, code) for part in _PART.finditer(rest))

    def _bare_file(self, rest: str) -> str:
        name = rest.strip()
        return f" {self._names.path(name)}" if name else ""

    def _apart(self, rest: str) -> str:
        """Return a text word by word; none is told, as numbers are somebody's own here."""
        return _TOKEN.sub(lambda found: self._names.of("word", found[0]), rest)

    def _part(self, part: re.Match[str], code: str) -> str:
        if part["comment"] is not None:
            return ";"
        if part["quoted"] is not None:
            text = part["quoted"].strip('"')
            return f'"{self.key(text) if code == ASKS_MODEL else self._quoted(text)}"'
        if part["other"] is None or part["other"] == "***":
            is_own = part["number"] is not None and code in IS_TEXT
            return self._names.of("word", part[0]) if is_own and len(part[0]) > 2 else part[0]
        return self._names.path(part[0]) if "/" in part[0] else self._names.of("word", part[0])

    def _quoted(self, text: str) -> str:
        if "/" in text or is_file_name(text):
            return self._names.path(text)
        return self._names.of("text", text)

    def key(self, key: str) -> str:
        """Return a key of ``M409``, or flags; below what people have named it tells nothing."""
        root, _, behind = key.partition(".")
        is_plain = re.fullmatch(r"#?[\w.\[\]^#]*", key, re.ASCII) is not None
        if is_plain and root.lstrip("#") not in ("global", "plugins") or key == root and is_plain:
            return key
        return f"{root}.{self._names.of('name', behind)}" if is_plain else "?"
