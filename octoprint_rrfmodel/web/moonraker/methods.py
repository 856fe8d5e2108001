"""The methods that Moonraker's clients call by name, over the socket and over HTTP alike.

Each part that answers some gives them as rows; ``Methods`` is the table of all. Over HTTP a method
has the path of its name, ``/`` for each dot; a verb at the beginning of the last word (``get_``,
``post_``, ``delete_``) is the request's (Moonraker 0.9, ``docs/external_api/introduction.md``).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, Callable, NamedTuple

from flask_babel import gettext

from ...host.answers import RequestRefused

VERBS = ("get", "post", "delete")

EVERYBODY = ""
"""The permission of what may be called by anybody, without one."""

CONTROL = "PLUGIN_RRFMODEL_CONTROL"


class Upload(NamedTuple):
    """A file that came with a request; it is gone when the request is answered."""

    name: str
    """As the client has it."""
    path: str
    """Where on this disk it lies."""


class Call:
    """One call of a method: what it was given, and by whom.

    ``caller`` says what its user may do: ``may_read()``, ``may_control()``, ``may(permission)`` by
    the name of one of OctoPrint's; ``name`` is the user's, ``lasting()`` is who outlasts the call.
    ``socket`` is the one that it came by, ``None`` over HTTP, where all values are text. Getters
    raise ``RequestRefused`` for what is of the wrong kind.
    """

    upload: Upload | None = None
    """What came with it, over HTTP."""

    def __init__(self, params: dict[str, Any], caller: Any, socket: Any = None) -> None:
        self.params = params
        self.caller = caller
        self.socket = socket

    def needs(self, permission: str) -> None:
        """Refuse it to a user who hasn't one of OctoPrint's permissions, by its name."""
        if not self.caller.may(permission):
            raise RequestRefused(403, gettext("You may not do that. Ask an administrator."))

    def text(self, name: str, otherwise: str | None = None) -> str:
        """Return a text; refused where it is missing and there is nothing instead."""
        value = self.params.get(name)
        if value is None:
            if otherwise is not None:
                return otherwise
            raise RequestRefused(400, gettext("%(name)s is missing.", name=name))
        if not isinstance(value, str):
            raise RequestRefused(400, gettext("%(name)s is a text.", name=name))
        return value

    def number(self, name: str, otherwise: float | None = None) -> float:
        """Return a finite number, also from text."""
        value = self.params.get(name, otherwise)
        try:
            number = math.nan if value is None or isinstance(value, bool) else float(value)
        except (TypeError, ValueError):
            number = math.nan
        if not math.isfinite(number):
            raise RequestRefused(400, gettext("%(name)s is a number.", name=name))
        return number

    def whole(self, name: str, otherwise: int | None = None) -> int:
        """Return a whole number that isn't negative, also from text."""
        number = self.number(name, otherwise)
        if number < 0 or number != int(number):
            raise RequestRefused(400, gettext("%(name)s is a whole number.", name=name))
        return int(number)

    def flag(self, name: str) -> bool:
        """Return whether something is switched on, also as text; without it it isn't."""
        value = self.params.get(name, False)
        return value.lower() == "true" if isinstance(value, str) else value is True


class Method(NamedTuple):
    """One method: what answers it, who may call it, and how over HTTP."""

    name: str
    run: Callable[[Call], Any]
    """Returns the result, which is JSON; raises ``RequestRefused`` with a sentence."""
    permission: str = "PLUGIN_RRFMODEL_READ"
    """OctoPrint's name of what the user needs, or ``EVERYBODY``."""
    verbs: tuple[str, ...] = ()
    """Of HTTP, where the name says none and it isn't only GET."""
    status: int = 200
    """Of HTTP, where all is well."""
    below: str = ""
    """A path below which the rest of an address is its parameter ``path``."""

    @property
    def address(self) -> tuple[str, str]:
        """The verbs and the path over HTTP."""
        *parts, last = self.name.split(".")
        verb, _, rest = last.partition("_")
        if verb in VERBS and rest and not self.verbs:
            return verb.upper(), "/".join((*parts, rest))
        return " ".join(self.verbs or ("GET",)), "/".join((*parts, last))


class Methods:
    """The table of all methods; made once, asked on any thread."""

    def __init__(self, rows: Iterable[Method]) -> None:
        self._by_name = {row.name: row for row in rows}
        self._by_address = {
            (verb, path): row
            for row in self._by_name.values()
            for verbs, path in (row.address,)
            for verb in verbs.split()
        }

    def named(self, name: str) -> Method | None:
        """Return a method by its name."""
        return self._by_name.get(name)

    def at(self, verb: str, path: str) -> Method | None:
        """Return a method by HTTP's verb and path, without a slash at its ends."""
        return self._by_address.get((verb, path))

    def below(self, verb: str, path: str) -> tuple[Method, str] | None:
        """Return a method whose parameter is in the path, and that parameter."""
        for row in self._by_name.values():
            begin = f"{row.below}/"
            if row.below and verb in row.verbs and path.startswith(begin):
                return row, path[len(begin) :]
        return None

    def verbs_of(self, path: str) -> list[str]:
        """Return the verbs that a path can be asked with."""
        return sorted(verb for verb, known in self._by_address if known == path)


def run(method: Method, call: Call) -> Any:
    """Return a method's result; raises ``RequestRefused``, with 403 for who may not call it."""
    if method.permission and not call.caller.may(method.permission):
        if method.permission == "PLUGIN_RRFMODEL_READ":
            raise RequestRefused(403, gettext("You may not read the machine's model."))
        raise RequestRefused(403, gettext("You may not do that. Ask an administrator."))
    return method.run(call)
