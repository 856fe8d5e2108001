"""Answers to requests, in the one form that all endpoints have."""

import json

import flask
from octoprint.access.permissions import Permissions


class RequestRefused(Exception):
    """A request that gets no answer; says the status and the sentence."""

    def __init__(self, status, text):
        super().__init__(text)
        self.status = status


def answer(data, status=200):
    """Return data as compact JSON; Flask's own way may spread it over lines."""
    text = json.dumps(data, separators=(",", ":"))
    return flask.Response(text, status=status, mimetype="application/json")


def refusal(status, text):
    """Return an answer that says, in one sentence, what a person can do about it."""
    return answer({"error": text}, status)


def may_read():
    """Return whether the user of this request may read the model."""
    return Permissions.PLUGIN_RRFMODEL_READ.can()
