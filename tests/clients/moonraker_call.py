"""What a client of Moonraker's is, told by its calls."""

from typing import Any, NamedTuple

ALL = "all"


class Call(NamedTuple):
    """A call over the socket; ``verb`` makes it one over HTTP, with the path in ``method``."""

    method: str
    params: dict[str, Any] = {}
    verb: str = ""
    may_fail: bool = False
    is_form: bool = False
    """Of HTTP, whether the parameters are a form in the body."""


class Client(NamedTuple):
    """One client, and what it looks for in the answers."""

    name: str
    source: str
    """Where that is read: repository, files, the first letters of their commits."""
    calls: tuple[Call, ...]
    results: dict[str, tuple[str, ...]] = {}
    """Members without which it fails."""
    objects: tuple[str, ...] = ()
    """Printer objects without which it complains."""
    query: str = ""
    """What the address of its socket ends with; ``KEY`` stands for its key."""


def identify(name, kind, **more):
    """Return the call by which a client says what it is."""
    url = "https://example.org"
    told = {"client_name": name, "version": "1.0.0", "type": kind, "url": url, **more}
    return Call("server.connection.identify", told)


def objects(*names, **fields):
    """Return the parameters that name objects: all fields of them, or those given."""
    return {"objects": {**dict.fromkeys(names), **fields}}


def item(namespace, key=None, **more):
    """Return the parameters of something in the database."""
    return {"namespace": namespace, **({"key": key} if key else {}), **more}
