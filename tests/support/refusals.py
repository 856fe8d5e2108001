"""What is refused: with which status, and in a sentence."""

from __future__ import annotations

from typing import Any, Callable

import pytest


def refused(status: int, function: Callable[..., Any], *arguments: Any, **named: Any) -> str:
    """Return the sentence with which a call is refused; it fails where it isn't, or otherwise."""
    # the glue can't be imported where there is no OctoPrint
    from octoprint_rrfmodel.host.answers import RequestRefused

    with pytest.raises(RequestRefused, match=r"\.$") as error:
        function(*arguments, **named)
    assert error.value.status == status
    return str(error.value)
