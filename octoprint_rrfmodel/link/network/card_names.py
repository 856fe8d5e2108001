"""Names that a board's card may have."""

from ...rrf.wire.rr import LONGEST_PATH
from .card_refused import CardRefused

FORBIDDEN = frozenset('\\:*?"<>|;')
"""Letters that no name of the card has, and the semicolon, which begins a comment."""


def check_name(path):
    """Raise ``CardRefused`` for a path that the card can't have."""
    below = path[len("0:/") :]
    parts = below.split("/")
    is_bad = FORBIDDEN.intersection(below) or not below.isprintable() or ".." in parts
    if is_bad or "" in parts or "." in parts or len(path.encode()) > LONGEST_PATH:
        raise CardRefused("name", path.rpartition("/")[2])
