"""Methods about who is asking. Users are OctoPrint's, and it alone lets them log in."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from .methods import EVERYBODY, Method

SOURCE = "octoprint"
"""Who knows the users."""


def access_methods(tokens):
    """Return the rows; ``tokens`` issues what stands for a user once (``OneshotTokens``)."""

    def info(call):
        may_read = call.caller.may_read()
        return {
            "default_source": SOURCE,
            "available_sources": [SOURCE],
            "login_required": not may_read,
            "trusted": may_read,
        }

    def oneshot_token(call):
        caller = call.caller.lasting()
        if caller is None:
            raise RequestRefused(403, gettext("A token is for who shows a key or has logged in."))
        return tokens.issue(caller)

    return (
        Method("access.info", info, EVERYBODY),
        Method("access.login", login, EVERYBODY, verbs=("POST",)),
        Method("access.get_user", get_user),
        Method("access.users.list", lambda call: {"users": []}),
        Method("access.oneshot_token", oneshot_token),
    )


def login(call):
    """Refuse: second factors and the limit of attempts are OctoPrint's."""
    raise RequestRefused(
        403,
        gettext("Log in on OctoPrint's own page. Programs and other sites show one of its keys."),
    )


def get_user(call):
    """Return who is asking; nobody knows since when there is such a user."""
    name = call.caller.name
    return {"username": name, "source": SOURCE if name else None, "created_on": None}
