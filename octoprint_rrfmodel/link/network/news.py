"""What an exchange with a board has to tell."""

from typing import NamedTuple


class News(NamedTuple):
    """Who is told of what; each is called on the exchange's thread."""

    greeted: object
    """``(greeting)``: the board has said what it is."""
    polled: object
    """``(request, asked at, text)``; ``None`` for what can't be asked this way."""
    sent: object
    """``(line)``: the board has a command."""
    done: object
    """``(line)``: a command is through, where that is told; or nothing more will be heard of it."""
    said: object
    """``(text)``: what it has to say."""
    unsent: object
    """``(line, why)``: a command won't be sent, or nobody knows whether it was."""
    away: object
    """``(why)``: it doesn't answer."""
    back: object
    """``(up-time, when it was asked for)``: it answers again."""
    lost: object
    """``()``: it was asked to remember the session and doesn't: mostly it was reset."""
    ended: object
    """``(code, why)``: there is no use in going on."""


TOLD = tuple(News.__annotations__)
"""The names of all."""
