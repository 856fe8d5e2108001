"""What a method of Moonraker's is given over HTTP: by the address, as JSON, as a form."""

import json

import pytest

pytest.importorskip("octoprint")

import flask
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from octoprint_rrfmodel.web.moonraker import moonraker_api

ITEM = {"namespace": "obico", "key": "printer_id", "value": "5"}


def params(path="server/database/item", **request):
    with flask.Flask(__name__).test_request_context(f"/{path}", **request):
        return moonraker_api._params(path)


@pytest.mark.parametrize(
    ("request_", "given"),
    [
        ({"method": "POST", "json": ITEM}, ITEM),
        ({"method": "POST", "data": ITEM}, ITEM),
        # as curl sends it, which calls all a form
        (
            {
                "method": "POST",
                "data": json.dumps(ITEM),
                "content_type": "application/x-www-form-urlencoded",
            },
            ITEM,
        ),
        ({"method": "POST", "data": {"apikey": "a", "token": "b"}}, {}),
        ({"method": "POST", "data": b"[1]", "content_type": "application/json"}, {}),
        ({"method": "POST", "data": {"key": "a"}, "query_string": {"key": "b"}}, {"key": "b"}),
        ({"method": "GET", "data": ITEM}, {}),
        ({"method": "GET", "query_string": {"value:int": "5"}}, {"value": 5}),
    ],
)
def test_what_a_request_gives(request_, given):
    assert params(**request_) == given
