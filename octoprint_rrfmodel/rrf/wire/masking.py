"""Passwords and keys, taken out of what is kept, shown or logged of a line.

Nothing behind a command that may hold one is kept: where a text ends, a line says in too many
ways (quotes, braces, none at all) for one to be left to a pattern.
"""

from __future__ import annotations

import re

MASK = "***"

SECRETIVE = (
    r"M[ \t]*0*551",  # the board's own password (3.5 GCodes2.cpp, case 551)
    r"M[ \t]*0*586\.0*4",  # of MQTT, with the user's name
    r"M[ \t]*0*587",  # of a network, with names and keys of enterprise ones
    r"M[ \t]*0*589",  # of the board's own network
)
"""Commands with a secret among their parameters."""

_COMMAND = re.compile(
    rf"(?<![A-Za-z])(?:{'|'.join(SECRETIVE)})(?![0-9.])", re.ASCII | re.IGNORECASE
)

_NAMED = re.compile(
    r"(?:passw(?:or)?d|passphrase|passcode|secret|api[-_ ]?key|token|psk)"
    r"(?=(\w{0,30}))\1[\"']?[ \t]{0,8}(?:[:=]|is\b)",
    re.IGNORECASE,
)
"""What is called a secret, as a variable or in a reply, up to its value; the rest of the name
is bounded and taken as a whole, or a long line of nothing but such names would take long."""


def masked(line: str) -> str:
    """Return a line without what is secret in it; nearly every line comes back as it is.

    >>> masked('M587 S"shed" P"swordfish"')
    'M587 ***'
    """
    for pattern in (_COMMAND, _NAMED):
        found = pattern.search(line)
        if found is not None and line[found.end() :].strip():
            line = f"{line[: found.end()]} {MASK}"
    return line


_KEY_ARGUMENT = re.compile(r"([?&](?:apikey|token)=)[^&#\s]*", re.IGNORECASE)


def masked_address(address: str) -> str:
    """Return a request's path and query without the key in it."""
    return _KEY_ARGUMENT.sub(rf"\1{MASK}", address)
