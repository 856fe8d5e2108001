"""Debian's Chromium, driven by Playwright, and OctoPrint's page in it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .basedir import User
    from .server import OctoPrintServer

# the shell draws the same and has no window of its own, which costs a third of the processor's time
BROWSERS = (Path("/usr/bin/chromium-headless-shell"), Path("/usr/bin/chromium"))

CHROMIUM = next((path for path in BROWSERS if path.exists()), BROWSERS[-1])

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

SIZE = {"width": 1280, "height": 900}

# the first page builds OctoPrint's asset bundles; who waits longer only loses time where it fails
PATIENCE_MS = 180_000


def new_context(browser: Any, size: Any = SIZE) -> Any:
    """Return a part of the browser with cookies of its own, of somebody who wants no motion.

    What moves is drawn sixty times a second, which takes a third of a core from what is tested.
    """
    return browser.new_context(viewport=size, reduced_motion="reduce")


def new_page(context: Any, errors: list[str]) -> Any:
    """Return another page of the context; what goes wrong in it lands in ``errors``."""

    def from_console(message: Any) -> None:
        if message.type == "error":
            errors.append(f"{message.text} ({message.location.get('url')})")

    page = context.new_page()
    page.set_default_timeout(PATIENCE_MS)
    # no page lets itself be attached to any more once a script of it goes on for ever
    page.devtools = context.new_cdp_session(page)
    page.on("pageerror", lambda error: errors.append(error.stack or str(error)))
    page.on("console", from_console)
    return page


def open_octoprint(page: Any, server: OctoPrintServer, user: User | None, path: str = "/") -> None:
    """Show OctoPrint's page as that user and return once its interface is usable."""
    if user is not None:
        _log_in(page, server, user)
    page.goto(server.url + path, timeout=PATIENCE_MS)
    wait_usable(page)


def wait_usable(page: Any) -> None:
    """Return once OctoPrint's interface has replaced what is seen while it loads."""
    page.locator("#page-container-loading").wait_for(state="hidden", timeout=PATIENCE_MS)


def _log_in(page: Any, server: OctoPrintServer, user: User) -> None:
    """Guarantee that the page's context is logged in as that user."""
    current = page.request.get(f"{server.url}/api/currentuser")
    # a context that stays may have been so before; checking a password is meant to be slow
    if current.ok and current.json()["name"] == user.name:
        return
    # the login page hands out the CSRF token; requests and page share the cookies
    page.request.get(f"{server.url}/login/")
    cookies = {cookie["name"]: cookie["value"] for cookie in page.context.cookies()}
    response = page.request.post(
        f"{server.url}/api/login",
        data={"user": user.name, "pass": user.password},
        headers={"X-CSRF-Token": cookies[f"csrf_token_P{server.port}"]},
    )
    assert response.ok, response.text()
