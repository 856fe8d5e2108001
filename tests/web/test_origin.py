"""Which pages are this server's own, by the origin that a browser names."""

import flask
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
import pytest
from octoprint.server.util.flask import OctoPrintFlaskRequest, ReverseProxiedEnvironment
from tornado.httputil import HTTPConnection, HTTPHeaders, HTTPServerRequest

from octoprint_rrfmodel.web.origin import is_own, origin_of


class Line(HTTPConnection):
    """The connection that a request came by."""

    class context:  # noqa: N801, as Tornado calls it
        protocol = "http"
        remote_ip = _orig_remote_ip = "127.0.0.1"


@pytest.fixture
def app(monkeypatch):
    class Request(OctoPrintFlaskRequest):
        environment_wrapper = ReverseProxiedEnvironment()

    made = flask.Flask(__name__)
    made.request_class = Request
    return made


def request(**headers):
    named = HTTPHeaders({name.replace("_", "-"): value for name, value in headers.items()})
    return HTTPServerRequest("GET", "/x", headers=named, connection=Line())


DIRECT = {"Host": "printer.local:5000"}

SECURE = {"Host": "printer.local", "X_Scheme": "https"}

RENAMED = {
    "Host": "10.0.0.2:5000",
    "X_Forwarded_Host": "shop.example",
    "X_Forwarded_Proto": "https",
}

OWN = [
    (DIRECT, "http://printer.local:5000"),
    (DIRECT, "HTTP://Printer.Local:5000"),
    ({"Host": "printer.local"}, "http://printer.local"),
    ({"Host": "printer.local:80"}, "http://printer.local"),
    (SECURE, "https://printer.local"),
    (RENAMED, "https://shop.example"),
    ({"Host": "[fe80::1]:5000"}, "http://[fe80::1]:5000"),
]

FOREIGN = [
    (DIRECT, ""),
    (DIRECT, "null"),
    (DIRECT, "file://"),
    (DIRECT, "file://printer.local:5000"),
    (DIRECT, "data:"),
    (DIRECT, "http://"),
    (DIRECT, "https://printer.local:5000"),
    (DIRECT, "http://printer.local"),
    (DIRECT, "http://printer.local:5001"),
    (DIRECT, "http://printer.local:5000/"),
    (DIRECT, "http://printer.local:5000 "),
    (DIRECT, "http://a@printer.local:5000"),
    (DIRECT, "http://printer.local:5000.evil.example"),
    (SECURE, "http://printer.local"),
    (RENAMED, "https://evil.example"),
    (RENAMED, ""),
]


@pytest.mark.parametrize("headers, origin", OWN)
def test_own_page(app, headers, origin):
    assert is_own(app, request(**headers), origin)


@pytest.mark.parametrize("headers, origin", FOREIGN)
def test_row_33_foreign_page(app, headers, origin):
    assert not is_own(app, request(**headers), origin)


@pytest.mark.parametrize("text", ["null", "x", "http://", "http://a:b", "http://a:999999"])
def test_no_origin(text):
    assert origin_of(text) is None
