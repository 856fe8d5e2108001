"""Methods about the connection that a call comes by."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from .methods import Method

CLIENT = ("client_name", "version", "url")

KINDS = ("web", "mobile", "desktop", "display", "bot", "agent", "other")
"""Kinds of clients (Moonraker 0.9, ``docs/external_api/server.md``)."""


def connection_methods():
    """Return the rows."""
    return (
        Method("server.connection.identify", identify, verbs=("POST",)),
        Method("server.websocket.id", lambda call: {"websocket_id": _socket(call).id}),
    )


def identify(call):
    """Return the number of a client's socket; from then on it acts for the key that it shows."""
    socket = _socket(call)
    for name in CLIENT:
        call.text(name, "")
    if call.text("type", "other") not in KINDS:
        kinds = ", ".join(KINDS)
        raise RequestRefused(400, gettext("The type of a client is one of %(kinds)s.", kinds=kinds))
    if call.params.get("access_token"):
        raise RequestRefused(403, gettext("Nobody issues access tokens here. Show an API key."))
    if call.params.get("api_key"):
        socket.act_for(call.text("api_key"))
    socket.is_named = True
    return {"connection_id": socket.id}


def _socket(call):
    if call.socket is None:
        raise RequestRefused(400, gettext("Only a websocket is a connection."))
    return call.socket.socket
