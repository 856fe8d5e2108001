"""Who is asking on a route of Tornado's, where OctoPrint checks nothing by itself."""

import hmac

import flask
import flask_login
import octoprint.server
from octoprint.access.permissions import Permissions
from octoprint.server.util import get_api_key, get_user_for_apikey
from octoprint.server.util.tornado import WsgiInputContainer
from octoprint.settings import settings

from ..host.version import IS_2
from ..rrf.wire.masking import masked_address


class WithoutKeys:
    """Keeps the key of an address out of the log of requests; comes before Tornado's handler."""

    def _request_summary(self):
        request = self.request
        return f"{request.method} {masked_address(request.uri)} ({request.remote_ip})"


class Caller:
    """A user of OctoPrint as it was at the handshake, who is looked up again for each question.

    ``user`` is OctoPrint's. ``find_by_key()`` finds it by the key that was shown, ``None`` for a
    session; ``find_user(name)`` is the user manager's.
    """

    def __init__(self, user, find_by_key, find_user):
        self._user = user
        self._find_by_key = find_by_key
        self._find_user = find_user
        self._is_out = False

    @property
    def name(self):
        """The user's name."""
        return self._user.get_id()

    def lasting(self):
        """Return who outlasts a request: this one does."""
        return self

    @property
    def is_of_session(self):
        """Whether a browser's session was shown, which a page of another site can make it do."""
        return self._find_by_key is None

    def may_read(self):
        """Return whether the user may read the model now."""
        return self.may("PLUGIN_RRFMODEL_READ")

    def may_control(self):
        """Return whether the user may command the machine now."""
        return self.may("PLUGIN_RRFMODEL_CONTROL")

    def logged_out(self, user):
        """Note that a session has ended: this one's, if it is the same."""
        session = getattr(self._user, "session", None)
        # who is remembered by a cookie has none
        is_same = session is None or session == getattr(user, "session", None)
        if self.is_of_session and is_same and user.get_id() == self._user.get_id():
            self._is_out = True

    def may(self, permission):
        """Return whether the user has one of OctoPrint's permissions now, by its name."""
        user = self._current()
        return user is not None and user.has_permission(getattr(Permissions, permission))

    def _current(self):
        """Return the user as it is by now, ``None`` for one that is gone."""
        if self._is_out:
            return None
        if self._find_by_key is not None:
            return self._find_by_key()
        found = self._find_user(self._user.get_id())
        return found if found is not None and found.is_active else None


def caller_of(app, request, find_user):
    """Return who sends a Tornado request: by key, else by session; ``None`` for nobody.

    A key that isn't known is nobody's, whatever session comes with it. ``app`` is OctoPrint's
    Flask application.
    """
    environ = WsgiInputContainer.environ(request)
    with app.request_context(environ):
        key = get_api_key(flask.request)
        if key:
            return _caller_of_key(app, environ, key, find_user)
        app.login_manager._load_user()
        return _caller_of_session(find_user)


def caller_of_key(app, request, key, find_user):
    """Return whose key this is that comes by a Tornado request's connection, or ``None``."""
    return _caller_of_key(app, WsgiInputContainer.environ(request), key, find_user)


def caller_of_flask(find_user):
    """Return who sends the request that Flask answers, for longer than it; ``None`` for nobody."""
    key = get_api_key(flask.request)
    if key:
        app = flask.current_app._get_current_object()
        # of the request only where it comes from is needed, and nothing that is closed with it
        environ = {
            name: value for name, value in flask.request.environ.items() if isinstance(value, str)
        }
        environ["REQUEST_METHOD"] = "GET"
        found = _caller_of_key(app, environ, key, find_user)
        if found is not None:
            return found
    return _caller_of_session(find_user)


def _caller_of_key(app, environ, key, find_user):
    def find_by_key():
        # OctoPrint notes in the session how somebody came in
        with app.request_context(environ):
            return user_of_key(key, flask.request.remote_addr)

    user = find_by_key()
    return None if user is None else Caller(user, find_by_key, find_user)


def _caller_of_session(find_user):
    user = flask_login.current_user
    if user is None or user.is_anonymous:
        return None
    return Caller(user._get_current_object(), None, find_user)


def user_of_key(key, address):
    """Return whose key this is, ``None`` for nobody's."""
    # each use of the global key would be logged, and it is looked at every second
    global_key = settings().get(["api", "key"])
    if global_key and hmac.compare_digest(key.encode(), global_key.encode()):
        return octoprint.server.userManager.api_user_factory()
    if IS_2:
        # that plugins of OctoPrint's own may use theirs only on this machine
        return get_user_for_apikey(key, remote_address=address)
    return get_user_for_apikey(key)
