"""Moonraker's methods over HTTP: a path and what it was given become a call, and its answer."""

import json

import flask
import flask_login
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.settings import settings

from ...host.answers import RequestRefused, answer
from ...host.request_json import json_of
from ..access import caller_of_flask
from .methods import Call, Upload, run

MULTIPART = "multipart/form-data"

TOKEN_ARGUMENT = "token"
"""The argument that stands for a user once."""

NO_PARAMETERS = frozenset(("apikey", TOKEN_ARGUMENT))
"""Arguments that no method is given; the first is OctoPrint's own."""

OBJECTS = "printer/objects/query"
"""The path whose arguments are names of objects, each with its fields or none for all of them."""

HINTS = {
    "int": int,
    "float": float,
    "bool": lambda text: text.lower() == "true",
    "json": json.loads,
    "str": str,
}
"""What a value is that has its kind behind its name (Moonraker 0.9, introduction to its API)."""


class RequestCaller:
    """The user of the request that Flask answers; ``find_user(name)`` is the user manager's."""

    def __init__(self, find_user):
        self._find_user = find_user

    @property
    def name(self):
        """The user's name, ``None`` for a guest."""
        return flask_login.current_user.get_id()

    def lasting(self):
        """Return the user for longer than the request, ``None`` for a guest."""
        return caller_of_flask(self._find_user)

    def may(self, permission):
        """Return whether the user has one of OctoPrint's permissions, by its name."""
        return getattr(Permissions, permission).can()

    def may_read(self):
        """Return whether the user may read the model."""
        return self.may("PLUGIN_RRFMODEL_READ")

    def may_control(self):
        """Return whether the user may command the machine."""
        return self.may("PLUGIN_RRFMODEL_CONTROL")


class MoonrakerApi:
    """Answers requests in Moonraker's forms by the table of its methods.

    ``redeem(token)`` gives whom a token stands for, ``find_user(name)`` is the user manager's.
    """

    def __init__(self, methods, redeem, find_user):
        self._methods = methods
        self._redeem = redeem
        self._find_user = find_user

    def respond(self, path):
        """Return the answer to the request that Flask has, at a path below the prefix."""
        verb = flask.request.method
        method, more = self._methods.at("GET" if verb == "HEAD" else verb, path), {}
        if method is None:
            method, rest = self._methods.below(verb, path) or (None, "")
            more = {"path": rest}
        try:
            if method is None:
                return self._unknown(path)
            call = Call({**_params(path), **more}, self._caller())
            call.upload = _upload()
            return answer({"result": run(method, call)}, method.status)
        except RequestRefused as error:
            return failure(error.status, str(error))

    def _caller(self):
        token = flask.request.args.get(TOKEN_ARGUMENT)
        if token is None:
            return RequestCaller(self._find_user)
        caller = self._redeem(token)
        if caller is None:
            raise RequestRefused(403, gettext("The token is unknown, was used, or is too old."))
        return caller

    def _unknown(self, path):
        verbs = self._methods.verbs_of(path)
        if not verbs:
            return failure(404, gettext("There is nothing at this address."))
        told = failure(
            405, gettext("This address is asked with %(verbs)s.", verbs=", ".join(verbs))
        )
        told.headers["Allow"] = ", ".join(verbs)
        return told


def failure(status, text):
    """Return an error as Moonraker gives it."""
    return answer({"error": {"code": status, "message": text}}, status)


def _params(path):
    """Return what a method is given: the address's arguments before those of the body."""
    arguments = {
        name: value for name, value in flask.request.args.items() if name not in NO_PARAMETERS
    }
    body = _body()
    if path == OBJECTS and flask.request.method != "POST":
        fields = {name: value.split(",") if value else None for name, value in arguments.items()}
        return {"objects": fields}
    return {**body, **dict(_hinted(name, value) for name, value in arguments.items())}


def _body():
    if flask.request.mimetype == MULTIPART:
        return _form()
    # OctoPrint's server hands on no body of other requests
    if flask.request.method != "POST":
        return {}
    # of both kinds, whatever it says that it is: curl calls all a form, Obico sends one
    body = json_of(flask.request, force=True)
    return body if isinstance(body, dict) else _form()


def _form():
    return {name: value for name, value in flask.request.form.items() if name not in NO_PARAMETERS}


def _upload():
    """Return the file that came with the request, ``None`` where none did.

    OctoPrint's server has put it on the disk piece by piece, and refuses members of those names
    from anybody else; only of a form, and so only a form's are believed.
    """
    if flask.request.mimetype != MULTIPART:
        return None
    form, uploads = flask.request.form, settings().get(["server", "uploads"], merged=True)
    name, path = (form.get(f"file.{uploads[kind]}") for kind in ("nameSuffix", "pathSuffix"))
    return Upload(name, path) if name and path else None


def _hinted(name, value):
    name, _, kind = name.partition(":")
    if kind not in HINTS:
        return name, value
    try:
        return name, HINTS[kind](value)
    except (ValueError, RecursionError):
        raise RequestRefused(
            400, gettext("%(name)s is not of the kind %(kind)s.", name=name, kind=kind)
        ) from None
