"""What the channels other than USB have replied, until somebody fetches it."""

from __future__ import annotations

from functools import partial
from typing import Callable

from ..model.tree import ObjectModel


class Replies:
    """Texts by channel; HTTP's are announced in ``seqs.reply``."""

    def __init__(self, model: ObjectModel):
        self._model = model
        self._texts: dict[str, list[str]] = {}
        self.takers: dict[str, Callable[[str], bool]] = {}
        """Channel → who is given its replies, and says whether anybody wants them."""

    def writer(self, name: str) -> Callable[[str], None]:
        """Return the function that keeps the replies of that channel."""
        return partial(self._keep, name)

    def _keep(self, name: str, text: str) -> None:
        taker = self.takers.get(name)
        if taker is not None and taker(text):
            return
        self._texts.setdefault(name, []).append(text)
        if name == "HTTP":
            self._model.bump("reply")

    def take(self, name: str) -> str:
        """Return what that channel has replied since the last call."""
        return "".join(self._texts.pop(name, ()))

    def restart(self) -> None:
        self._texts.clear()
