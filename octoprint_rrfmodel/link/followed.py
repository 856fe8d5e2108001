"""What follows the model, and who says at which parts of it somebody looks."""

from ..rrf.follow.follower import Follower
from ..rrf.follow.interest import Interest
from ..rrf.follow.rows import Rows


def make_follower(clock):
    """Return an interest, and the follower that heeds it."""
    interest = Interest(clock)
    return interest, Follower(Rows(clock, interest))
