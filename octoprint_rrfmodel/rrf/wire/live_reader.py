"""The live root, read fast: what stands as it stood last time isn't decoded again.

Most of a live reply is the same text as in the one before. Its top-level members come in the
same order each time (RepRapFirmware's table order), so each member's text is compared with the
last one, and only a member that differs is decoded.
"""

from __future__ import annotations

from typing import Any

from .reply import scanner_of

_RESULT = '"result":{'

_UNREADABLE = (StopIteration, ValueError, IndexError, RecursionError)


class LiveReader:
    """Reads successive replies to one request for the live root."""

    def __init__(self) -> None:
        self._head = ""
        # of each member its name, the text up to its value, and the text with its value
        self._members: list[tuple[str, str, str]] = []

    def changed(self, text: str) -> dict[str, Any] | None:
        """Return the members whose text is another than last time, decoded.

        ``None`` where the text isn't built like the one before, or is broken: a full decoding
        finds out which, and ``remember`` must follow it.
        """
        comparable = self._head and text.isascii() and text.startswith(self._head)
        changed = self._compared(text) if comparable else None
        if changed is None:
            self.forget()
        return changed

    def _compared(self, text: str) -> dict[str, Any] | None:
        position = len(self._head)
        changed = {}
        scan = None
        for index, (name, start, known) in enumerate(self._members):
            if text.startswith(known, position):
                position += len(known)
            elif text.startswith(start, position):
                scan = scan or scanner_of(text)
                try:
                    changed[name], end = scan(text, position + len(start))
                except _UNREADABLE:
                    return None
                self._members[index] = (name, start, text[position:end])
                position = end
            else:
                return None
        return changed if text[position:] == "}}" else None

    def remember(self, text: str) -> None:
        """Keep a text that was decoded whole, to compare the next one with."""
        self.forget()
        at = text.find(_RESULT)
        if at < 0:
            return
        position = at + len(_RESULT)
        members: list[tuple[str, str, str]] = []
        scan = scanner_of(text)
        try:
            while text[position] != "}":
                start = position
                name, colon = scan(text, position + 1 if members else position)
                end = scan(text, colon + 1)[1]
                members.append((name, text[start : colon + 1], text[start:end]))
                position = end
        except _UNREADABLE:
            # blanks or a nan; the next one may be without
            return
        self._head, self._members = text[: at + len(_RESULT)], members

    def forget(self) -> None:
        """Compare with nothing: after a reset, or when the model was changed otherwise."""
        self._head, self._members = "", []
