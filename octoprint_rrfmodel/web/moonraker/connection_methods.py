"""Methods about the connection that a call comes by."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from .methods import Method


def connection_methods():
    """Return the rows."""
    return (Method("server.connection.identify", identify, verbs=("POST",)),)


def identify(call):
    """Return the number of a client's socket."""
    if call.socket is None:
        raise RequestRefused(400, gettext("Only a websocket is a connection."))
    return {"connection_id": call.socket.socket.id}
