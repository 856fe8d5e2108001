"""Where the page comes from that asks, which a browser says and no page can make it say wrong."""

import re

import flask
from octoprint.server.util.tornado import WsgiInputContainer

_ORIGIN = re.compile(
    r"(https?)://(\[[^\s\]/?#@]+\]|[^\s/?#@\\:\[\]]+)(?::([0-9]{1,5}))?", re.ASCII | re.IGNORECASE
)
"""Scheme, host and port (RFC 6454, 6.2); ``null`` of files, data and sandboxes is none."""

DEFAULT_PORTS = {"http": 80, "https": 443}


def origin_of(text):
    """Return scheme, host and port of an origin, ``None`` for what is none of a server's."""
    found = _ORIGIN.fullmatch(text)
    if found is None:
        return None
    scheme = found[1].lower()
    return scheme, found[2].lower(), int(found[3] or DEFAULT_PORTS[scheme])


def is_own(app, request, origin):
    """Return whether a page of this very server sends a Tornado request.

    Behind a proxy the server is what the proxy says it is, as for OctoPrint itself; some hand on
    the name that was asked for. ``app`` is OctoPrint's Flask application.
    """
    found = origin_of(origin)
    if found is None:
        return False
    with app.request_context(WsgiInputContainer.environ(request)):
        scheme, named = flask.request.scheme, flask.request.host
    return found in {origin_of(f"{scheme}://{host}") for host in (named, request.host)}
