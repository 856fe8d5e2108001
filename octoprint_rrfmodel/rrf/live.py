"""The live root, read fast: what stands as it stood last time isn't decoded again.

Most of a live reply is the same text as in the one before. Its top-level members come in the
same order each time (RepRapFirmware's table order), so each member's text is compared with the
last one, and only a member that differs is decoded.
"""

from __future__ import annotations

from typing import Any

from .reply import MalformedReply, scan_value

_RESULT = '"result":{'


class LiveReader:
    """Reads successive replies to one request for the live root."""

    def __init__(self) -> None:
        self._head = ""
        self._members: list[tuple[str, str]] = []

    def changed(self, text: str) -> dict[str, Any] | None:
        """Return the members whose text is another than last time, decoded.

        ``None`` where the text isn't built like the one before; ``remember`` must then follow a
        full decoding. Raises ``MalformedReply`` for a text that starts alike and breaks.
        """
        head = self._head
        if not head or not text.startswith(head):
            return None
        position = len(head)
        changed = {}
        members = self._members
        for index, (start, known) in enumerate(members):
            if text.startswith(known, position):
                position += len(known)
            elif text.startswith(start, position):
                try:
                    value, end = scan_value(text, position + len(start))
                except (StopIteration, ValueError, RecursionError) as error:
                    self.forget()
                    raise MalformedReply(f"{error}: {text[:80]!r}") from None
                members[index] = (start, text[position:end])
                changed[start[1:-2]] = value
                position = end
            else:
                self.forget()
                return None
            if text[position] != ",":
                break
            position += 1
        if text[position:] != "}}" or index + 1 != len(members):
            self.forget()
            return None
        return changed

    def remember(self, text: str) -> None:
        """Keep a text that was decoded whole, to compare the next one with."""
        self.forget()
        at = text.find(_RESULT)
        if at < 0:
            return
        position = at + len(_RESULT)
        members = []
        while text[position : position + 1] == '"':
            colon = text.find(":", position)
            end = scan_value(text, colon + 1)[1]
            # a number could go on behind the same text, an object or an array can't
            if text[end - 1] not in "]}":
                return
            members.append((text[position : colon + 1], text[position:end]))
            position = end + 1
        self._head, self._members = text[: at + len(_RESULT)], members

    def forget(self) -> None:
        """Compare with nothing: after a reset, or when the model was changed otherwise."""
        self._head, self._members = "", []
