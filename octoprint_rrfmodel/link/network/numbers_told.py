"""Numbers in a board's answers that the talk itself goes by."""

import json
import re

_REPLIES = re.compile(r'"seqs":\{[^{}]*"reply":(\d+)|"key":"seqs",[^{}]*\{[^{}]*"reply":(\d+)')
"""The counter of what there is to be fetched by ``rr_reply``, in the live root and in ``seqs``."""


def replies_in(request, text):
    """Return how many replies a board has counted, ``None`` where its answer says nothing of it."""
    if getattr(request, "key", None) not in ("", "seqs"):
        return None
    found = _REPLIES.search(text)
    return int(found[1] or found[2]) if found else None


def number_in(answer):
    """Return the number that an answer to ``rr_model`` gives, ``None`` where it is none."""
    try:
        told = json.loads(answer)
    except ValueError:
        return None
    number = told.get("result") if isinstance(told, dict) else None
    return number if type(number) is int else None
