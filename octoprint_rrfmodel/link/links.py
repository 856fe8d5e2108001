"""The link that is in use now, asked by all who don't care how the bytes travel."""

import functools

from .link import Link


class Links:
    """Hands on whatever a ``Link`` is asked to the one in use; any thread may ask.

    ``standing`` is in use while no other is, and where there is no printer at all.
    """

    def __init__(self, standing):
        self.standing = standing
        self.current = standing

    def use(self, link):
        """Ask that link from now on."""
        self.current = link

    def leave(self, link):
        """Ask it no more, if it is still the one."""
        if self.current is link:
            self.current = self.standing


def _member(name, kind):
    def get(self):
        return getattr(self.current, name)

    def put(self, value):
        setattr(self.current, name, value)

    if not callable(kind):
        return property(get, put, doc=getattr(kind, "__doc__", None))

    @functools.wraps(kind)
    def call(self, *arguments, **named):
        return getattr(self.current, name)(*arguments, **named)

    return call


for _name, _kind in vars(Link).items():
    if not _name.startswith("_"):
        setattr(Links, _name, _member(_name, _kind))
