"""The switch between links: whatever is asked is asked of the one in use."""

from octoprint_rrfmodel.link.link import Link
from octoprint_rrfmodel.link.links import Links


class Other:
    """Answers every member of the seam with what it was asked for."""

    kind = "other"
    polls_alone = False

    def __getattr__(self, name):
        return lambda *given, **named: (name, given, named)


def test_every_member_of_the_seam_is_handed_on():
    standing, other = Other(), Other()
    links = Links(standing)
    links.use(other)
    for name, kind in vars(Link).items():
        if not name.startswith("_") and callable(kind):
            assert getattr(links, name)("given") == (name, ("given",), {}), name
    links.polls_alone = True
    assert (other.polls_alone, standing.polls_alone) == (True, False)


def test_what_was_taken_before_asks_the_one_in_use():
    first, second = Other(), Other()
    second.profile = lambda: "second"
    links = Links(first)
    profile = links.profile
    links.use(second)
    assert profile() == "second"
    links.leave(first)
    assert links.current is second
    links.leave(second)
    assert links.current is first
