"""Debian's Chromium, driven by Playwright, and OctoPrint's page in it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .basedir import User
    from .server import OctoPrintServer

CHROMIUM = Path("/usr/bin/chromium")

FLAGS = [
    # the tests run as root on a CI machine, where Chromium's sandbox refuses to
    "--no-sandbox",
    "--disable-gpu",
    # nothing but the page asks for anything
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

# the first page builds OctoPrint's asset bundles
PAGE_TIMEOUT_MS = 60_000


def open_octoprint(page: Any, server: OctoPrintServer, user: User | None, path: str = "/") -> None:
    """Show OctoPrint's page as that user and return once its interface is usable."""
    if user is not None:
        # the login page hands out the CSRF token; requests and page share the cookies
        page.request.get(f"{server.url}/login/")
        cookies = {cookie["name"]: cookie["value"] for cookie in page.context.cookies()}
        response = page.request.post(
            f"{server.url}/api/login",
            data={"user": user.name, "pass": user.password},
            headers={"X-CSRF-Token": cookies[f"csrf_token_P{server.port}"]},
        )
        assert response.ok, response.text()
    page.goto(server.url + path, timeout=PAGE_TIMEOUT_MS)
    page.locator("#page-container-loading").wait_for(state="hidden", timeout=PAGE_TIMEOUT_MS)
