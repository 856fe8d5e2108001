"""JSON-RPC 2.0 as text: what a client asks is taken apart, what it gets is put together."""

import json
import logging
import math
from typing import Any, NamedTuple

PARSE_ERROR = -32700
INVALID_REQUEST = -32600
METHOD_NOT_FOUND = -32601
INVALID_PARAMS = -32602
INTERNAL_ERROR = -32603
REFUSED = -32000

MOST_AT_ONCE = 20
"""Calls that one message may hold."""


class Call(NamedTuple):
    """One call of a method."""

    method: str
    params: dict
    id: Any
    """What the answer is told apart by."""
    is_notification: bool
    """Whether the client wants no answer."""


class RpcError(Exception):
    """A call that can't be answered: its code and a sentence."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def call_of(message):
    """Return the call that a decoded message stands for; raise ``RpcError``."""
    if not isinstance(message, dict) or message.get("jsonrpc") != "2.0":
        raise RpcError(INVALID_REQUEST, 'A call is an object with "jsonrpc": "2.0".')
    method = message.get("method")
    if not isinstance(method, str):
        raise RpcError(INVALID_REQUEST, "A call names its method as a string.")
    if not _is_id(message.get("id")):
        raise RpcError(INVALID_REQUEST, "The id of a call is a string or a number.")
    params = message.get("params")
    if params is None:
        params = {}
    if not isinstance(params, dict):
        raise RpcError(INVALID_PARAMS, "Parameters are given by name, in an object.")
    return Call(method, params, message.get("id"), "id" not in message)


def respond(text, run):
    """Return the answer to a client's text as text, ``None`` where it wants none.

    ``run(method, params)`` gives a call's result or raises ``RpcError``.
    """
    try:
        message = json.loads(text, parse_constant=_no_number, parse_float=_finite)
    except (ValueError, RecursionError):
        return _text(_failure(None, RpcError(PARSE_ERROR, "This is not JSON.")))
    if not isinstance(message, list):
        answer = _answer(message, run)
        return None if answer is None else _text(answer)
    if not 0 < len(message) <= MOST_AT_ONCE:
        error = RpcError(INVALID_REQUEST, f"One to {MOST_AT_ONCE} calls go into one message.")
        return _text(_failure(None, error))
    answers = [answer for answer in (_answer(call, run) for call in message) if answer]
    return _text(answers) if answers else None


def notification(method, params):
    """Return the text of a notification."""
    return _text({"jsonrpc": "2.0", "method": method, "params": params})


def _answer(message, run):
    identifier = message.get("id") if isinstance(message, dict) else None
    if not _is_id(identifier):
        identifier = None
    try:
        call = call_of(message)
        result = run(call.method, call.params)
    except RpcError as error:
        is_call = isinstance(message, dict) and isinstance(message.get("method"), str)
        return None if is_call and "id" not in message else _failure(identifier, error)
    except Exception:
        logging.getLogger("octoprint.plugins.rrfmodel.jsonrpc").exception("Could not answer")
        return _failure(identifier, RpcError(INTERNAL_ERROR, "The plugin failed, see its log."))
    return None if call.is_notification else {"jsonrpc": "2.0", "result": result, "id": call.id}


def _failure(identifier, error):
    return {
        "jsonrpc": "2.0",
        "error": {"code": error.code, "message": str(error)},
        "id": identifier,
    }


def _is_id(value):
    return isinstance(value, (str, int, float, type(None))) and not isinstance(value, bool)


def _no_number(name):
    raise ValueError(f"{name} is no JSON")


def _finite(text):
    """Return a number; one that is too large for any would be none in the answer."""
    value = float(text)
    return value if math.isfinite(value) else _no_number(text)


def _text(value):
    return json.dumps(value, separators=(",", ":"))
