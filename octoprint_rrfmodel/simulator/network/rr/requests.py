"""Request → function, as groups register them; what a function answers with."""

from __future__ import annotations

from collections.abc import Generator, Mapping
from typing import Callable, NamedTuple, Protocol, Union

from ...firmware import Release, is_within
from .request_parser import Request

Waiting = Generator[Callable[[], bool], None, bytes]
"""Yields what has to become true, without the board's lock, and returns the answer."""
Function = Callable[[Request], Union[bytes, Waiting]]


class UnknownRequest(Exception):
    """There is no such request, or it lacks what it can't do without."""


class RequestRow(NamedTuple):
    """What a request does, and which releases know it."""

    function: Function
    since: Release | None = None
    until: Release | None = None

    def is_known_to(self, release: Release) -> bool:
        return is_within(release, self.since, self.until)


RequestRows = Mapping[str, RequestRow]


class RequestGroup(Protocol):
    """Requests that work on the same parts of a board."""

    def requests(self) -> RequestRows:
        """Return name → row; names are in lower case."""


def needed(request: Request, name: str) -> str:
    """Return a parameter that the request can't do without."""
    value = request.parameter(name)
    if value is None:
        raise UnknownRequest
    return value
