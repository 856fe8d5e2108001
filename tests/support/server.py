"""A real OctoPrint in a process of its own."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from importlib.metadata import version as distribution_version
from pathlib import Path
from typing import Any, Callable, TypeVar

import requests

from . import guard, ports, waiting
from .basedir import USB_BAUD, USERS, User, configuration, write_basedir
from .client import Client

T = TypeVar("T")

# five seconds on an idle machine; several servers starting at once on two cores need far more
START_SECONDS = 120

PORTS_COME_AND_GO = "onnection options"
"""What the log of each server has of all boards of the bench."""

LOG = "logs/octoprint.log"
SERIAL_LOG = "logs/serial.log"

BEGINNING = 200
"""Bytes by which a log is known: the first of them tell when it was begun."""


class ServerDied(AssertionError):
    """The process ended before it answered; the message carries the end of its log."""


class OctoPrintServer:
    """An OctoPrint with its own base folder, from ``start()`` to ``stop()``.

    ``ports_glob`` is where the server looks for serial ports besides the machine's own; ``python``
    is the interpreter that has OctoPrint ``version``, by default the one that runs the tests. The
    first of ``users`` is the one in whose name the methods act. ``plugin_files`` are plugins of one
    file each, known by its name. The other options are those of ``basedir.configuration`` and
    ``basedir.write_basedir``.
    """

    def __init__(
        self,
        basedir: Path,
        *,
        ports_glob: str | None = None,
        plugins_config: dict[str, Any] | None = None,
        serial: dict[str, Any] | None = None,
        autoconnect: tuple[str, int] | None = None,
        settings: dict[str, Any] | None = None,
        profile: dict[str, Any] | None = None,
        environment: dict[str, str] | None = None,
        users: tuple[User, ...] = USERS,
        plugin_files: tuple[Path, ...] = (),
        port: int | None = None,
        python: str = sys.executable,
        version: str | None = None,
    ) -> None:
        self.basedir = basedir
        self.version = version or distribution_version("OctoPrint")
        self.port = port or ports.free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self.api_key = users[0].api_key
        self._python = python
        self._environment = environment or {}
        self._process: subprocess.Popen[bytes] | None = None
        # file below the base folder -> how it began and its length when what it had was forgotten
        self._forgotten: dict[str, tuple[bytes, int]] = {}
        self._admin = self.client(users[0])
        if ports_glob is not None:
            serial = {"additionalPorts": [ports_glob], **(serial or {})}
        config = configuration(
            self.version,
            plugins_config=plugins_config,
            serial=serial,
            autoconnect=autoconnect,
            settings=settings,
        )
        write_basedir(basedir, config, users=users, profile=profile)
        for path in plugin_files:
            (basedir / "plugins").mkdir(exist_ok=True)
            shutil.copy(path, basedir / "plugins")

    # life cycle

    def start(self) -> OctoPrintServer:
        """Return the server itself once it answers; ``ServerDied`` if it never will."""
        octoprint = [self._python, "-m", "octoprint", "serve", "--iknowwhatimdoing"]
        where = ["--host", "127.0.0.1", "--port", str(self.port), "--basedir", str(self.basedir)]
        with (self.basedir / "output.txt").open("ab") as output:
            self._process = subprocess.Popen(
                [sys.executable, guard.__file__, *octoprint, *where],
                stdin=subprocess.PIPE,
                stdout=output,
                stderr=subprocess.STDOUT,
                cwd=self.basedir,
                env={**_clean_environment(), **self._environment},
                start_new_session=True,
            )
        try:
            waiting.wait_for(self._answers, START_SECONDS, "OctoPrint to answer")
        except BaseException:
            self.stop()
            raise
        return self

    @property
    def pid(self) -> int:
        """The process that guards OctoPrint's, which is below it."""
        assert self._process is not None
        return self._process.pid

    def _answers(self) -> bool:
        assert self._process is not None
        if self._process.poll() is not None:
            output = _last_lines(self._text("output.txt"))
            raise ServerDied(f"exit status {self._process.returncode}\n{output}")
        try:
            return self.get("/api/version", timeout=5).status_code == 200
        except requests.RequestException:
            return False

    def stop(self) -> None:
        """Guarantee that the server and all it started are gone; a second call does nothing."""
        process, self._process = self._process, None
        if process is None:
            return
        assert process.stdin is not None
        process.stdin.close()
        process.wait()
        self._admin.close()

    def wait(self) -> None:
        """Return when the process has ended by itself."""
        assert self._process is not None
        self._process.wait()

    def restart(self) -> OctoPrintServer:
        """Return the server, stopped and started again on the same base folder and port."""
        self.stop()
        return self.start()

    def __enter__(self) -> OctoPrintServer:
        return self.start()

    def __exit__(self, *exc_info: object) -> None:
        self.stop()

    # logs

    def forget_logs(self) -> None:
        """Leave out of the logs, from now on, what they have had until now."""
        for name in (LOG, SERIAL_LOG):
            path = self.basedir / name
            if path.exists():
                had = path.read_bytes()
                self._forgotten[name] = had[:BEGINNING], len(had)

    def log(self) -> str:
        """Return octoprint.log as it is now."""
        return self._text(LOG)

    def serial_log(self) -> str:
        """Return serial.log as it is now; its marks of direction differ between the versions."""
        return self._text(SERIAL_LOG)

    def sent(self) -> list[str]:
        """Return the lines that went out on the serial port, in order."""
        return self._serial_lines("Send: ", ">>> ")

    def received(self) -> list[str]:
        """Return the lines that came in from the serial port, in order."""
        return self._serial_lines("Recv: ", "<<< ")

    def _serial_lines(self, *markers: str) -> list[str]:
        lines = []
        for line in self.serial_log().splitlines():
            # date and time come first; 1.11 and 2.0 mark the direction in different ways
            for marker in markers:
                _, found, text = line.partition(f" - {marker}")
                if found:
                    lines.append(text)
        return lines

    def log_tail(self) -> str:
        """Return the end of octoprint.log, for a failure message."""
        told = [line for line in self.log().splitlines() if PORTS_COME_AND_GO not in line]
        return _last_lines("\n".join(told))

    def serial_log_tail(self) -> str:
        """Return the end of serial.log, for a failure message."""
        return _last_lines(self.serial_log())

    def _text(self, name: str) -> str:
        path = self.basedir / name
        if not path.exists():
            return ""
        has = path.read_bytes()
        begins, length = self._forgotten.get(name, (b"", 0))
        # OctoPrint begins another file with every connection; its inode may be that of an old one
        if len(has) >= length and has.startswith(begins):
            has = has[length:]
        return has.decode("utf-8", "replace")

    # HTTP

    def client(self, user: User | None = None) -> Client:
        """Return a client with the user's API key; without a user one that nobody logged in."""
        return Client(self.url, user.api_key if user else None)

    def session(self, user: User) -> Client:
        """Return a client logged in like a browser: cookies and CSRF token, no API key."""
        client = self.client()
        client.log_in(user)
        return client

    def get(self, path: str, **kwargs: Any) -> requests.Response:
        """Return the response to the admin's GET."""
        return self._admin.get(path, **kwargs)

    def post(self, path: str, **kwargs: Any) -> requests.Response:
        """Return the response to the admin's POST."""
        return self._admin.post(path, **kwargs)

    def put(self, path: str, **kwargs: Any) -> requests.Response:
        """Return the response to the admin's PUT."""
        return self._admin.put(path, **kwargs)

    def patch(self, path: str, **kwargs: Any) -> requests.Response:
        """Return the response to the admin's PATCH."""
        return self._admin.patch(path, **kwargs)

    def delete(self, path: str, **kwargs: Any) -> requests.Response:
        """Return the response to the admin's DELETE."""
        return self._admin.delete(path, **kwargs)

    # what tests do all the time

    def wait_for(
        self, predicate: Callable[[], T], timeout: float = 10, what: str = "the condition"
    ) -> T:
        """Return the predicate's first true value; see ``waiting.wait_for``."""
        return waiting.wait_for(predicate, timeout, what)

    def connect(self, port: str | Path, baudrate: int = USB_BAUD) -> None:
        """Tell OctoPrint to open the port; ``wait_state`` tells when the printer is there."""
        request = {
            "command": "connect",
            "port": str(port),
            "baudrate": baudrate,
            # without it 2.0 takes its built-in profile, not the one in the base folder
            "printerProfile": "_default",
        }
        _ok(self.post("/api/connection", json=request))

    def disconnect(self) -> None:
        """Tell OctoPrint to close the port."""
        _ok(self.post("/api/connection", json={"command": "disconnect"}))

    def state(self) -> str:
        """Return OctoPrint's word for the printer's state, ``Operational`` for example."""
        # what is asked of the connection lists the machine's ports, which takes twice as long
        return self.job()["state"]

    def wait_state(self, state: str, timeout: float = 30) -> None:
        """Return once the state's text begins with ``state``."""
        last = ""

        def reached() -> bool:
            nonlocal last
            last = self.state()
            return last.startswith(state)

        try:
            waiting.wait_for(reached, timeout, f"the state {state!r}")
        except AssertionError as error:
            raise AssertionError(f"{error}; the state is {last!r}") from None

    def wait_disconnected(self, timeout: float = 30) -> None:
        """Return once no port is open; the versions have different words for it."""
        words = ("Offline", "Closed", "Error")
        waiting.wait_for(
            lambda: self.state().startswith(words), timeout, "the end of the connection"
        )

    def commands(self, *lines: str) -> None:
        """Send G-code as typed into the terminal."""
        _ok(self.post("/api/printer/command", json={"commands": list(lines)}))

    def upload(self, name: str, content: str | bytes) -> None:
        """Put a file into OctoPrint's local storage."""
        _ok(self.post("/api/files/local", files={"file": (name, content)}))

    def select_and_print(self, name: str) -> None:
        """Print a local file."""
        _ok(self.post(f"/api/files/local/{name}", json={"command": "select", "print": True}))

    def job(self) -> dict[str, Any]:
        """Return OctoPrint's job information."""
        return _ok(self.get("/api/job")).json()

    def set_setting(self, path: str, value: Any) -> None:
        """Set one setting, ``plugins.rrfmodel.name`` for example, through the settings API."""
        nested = value
        for key in reversed(path.split(".")):
            nested = {key: nested}
        _ok(self.post("/api/settings", json=nested))


def _ok(response: requests.Response) -> requests.Response:
    """Return the response; an AssertionError shows the body of one that isn't 2xx."""
    request = f"{response.request.method} {response.request.url}"
    assert response.ok, f"{request}: {response.status_code} {response.text[:500]}"
    return response


def _last_lines(text: str, count: int = 60, width: int = 300) -> str:
    # an object model is one line of many kilobytes
    return "\n".join(line[:width] for line in text.splitlines()[-count:])


def _clean_environment() -> dict[str, str]:
    """Return the environment without what would make the server another one than a user's."""
    unwanted = ("PYTHONPATH", "PYTHONWARNINGS", "PYTEST_", "OCTOPRINT_")
    return {key: value for key, value in os.environ.items() if not key.startswith(unwanted)}
