"""HTTP as somebody: an API key, a logged-in session, or nobody at all."""

from __future__ import annotations

from typing import Any
from urllib.parse import urlsplit

import requests

from .basedir import User

TIMEOUT_SECONDS = 30


class Client(requests.Session):
    """A requests session that takes paths of one server and never waits for ever."""

    def __init__(self, url: str, api_key: str | None = None) -> None:
        super().__init__()
        # a proxy or a netrc of the machine has no business with a server on loopback
        self.trust_env = False
        self.base_url = url
        if api_key is not None:
            self.headers["X-Api-Key"] = api_key

    def request(self, method: str, url: str, **kwargs: Any) -> requests.Response:  # type: ignore[override]
        """Return the response to a request for the path ``url``, whatever its status."""
        kwargs.setdefault("timeout", TIMEOUT_SECONDS)
        return super().request(method, self.base_url + url, **kwargs)

    def take_token(self) -> None:
        """Send the CSRF token from now on, as a page does, logged in or not."""
        # the page hands out the token that the request for the login already needs
        self.get("/login/").raise_for_status()
        # the cookie's name ends in the port, so that servers of one host don't share it
        self.headers["X-CSRF-Token"] = self.cookies[f"csrf_token_P{urlsplit(self.base_url).port}"]

    def log_in(self, user: User) -> dict[str, Any]:
        """Make this a browser-like session, with cookies and the CSRF token as a header.

        Returns what OctoPrint tells about the user, ``session`` among it.
        """
        self.take_token()
        response = self.post("/api/login", json={"user": user.name, "pass": user.password})
        response.raise_for_status()
        return response.json()
