"""What a browser's page and its processes were doing when a test failed."""

from __future__ import annotations

from typing import Any

import psutil

ANSWER_MS = 3_000
"""A page that computes nothing for ever answers within it, on the slowest machine too."""


def page_report(page: Any) -> str:
    """Return whether the page answers and what it shows, and what the browser's processes do."""
    return "\n".join([_page(page), *_processes(page), _machine()])


def _page(page: Any) -> str:
    from playwright.sync_api import Error

    if page.is_closed():
        return "the page is closed"
    try:
        page.wait_for_function("() => true", timeout=ANSWER_MS)
        return f"{page.url} answers; it shows:\n{page.inner_text('body', timeout=ANSWER_MS)[:2000]}"
    except Error as error:
        return f"{page.url} doesn't answer: {error}\n{_without_script(page)}"


def _without_script(page: Any) -> str:
    """Return whether the page answers once what its script is at has been ended."""
    from playwright.sync_api import Error

    try:
        # one of the few requests that Chromium answers beside a script that runs
        page.devtools.send("Runtime.terminateExecution")
        page.wait_for_function("() => true", polling=100, timeout=ANSWER_MS)
        return "it answers with its script ended"
    except Error as error:
        return f"nor with its script ended: {error}"


def _processes(page: Any) -> list[str]:
    own = [
        process for process in psutil.Process().children(recursive=True) if _is_browsers(process)
    ]
    for process in own:
        _percent(process)
    psutil.cpu_percent(1)
    return [_of(process) for process in own]


def _is_browsers(process: psutil.Process) -> bool:
    try:
        return "chrom" in process.name()
    except psutil.Error:
        return False


def _percent(process: psutil.Process) -> float:
    try:
        return process.cpu_percent()
    except psutil.Error:
        return 0.0


def _of(process: psutil.Process) -> str:
    try:
        kinds = [each for each in process.cmdline() if each.startswith("--type=")]
        memory = process.memory_info().rss >> 20
        return (
            f"{process.pid} {(kinds or ['browser'])[0]} {process.status()}"
            f" {_percent(process):.0f} % of a core, {memory} MiB"
        )
    except psutil.Error as error:
        return str(error)


def _machine() -> str:
    memory = psutil.virtual_memory()
    return f"{memory.available >> 20} of {memory.total >> 20} MiB free, load {psutil.getloadavg()}"
