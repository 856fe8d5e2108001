"""``python -m extras.site.reference``: the pages of docs/reference that the code's tables make.

What stands in a table of the code stands once, there; these pages are written from it, and a test
holds them to it. Run it where OctoPrint is installed, as the plugin's sentences are read too.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from octoprint_rrfmodel.host.plugin_settings import DEFAULTS
from octoprint_rrfmodel.host.warning_texts import TEXTS
from octoprint_rrfmodel.host.warnings import ALL_LEVELS, FIXES
from octoprint_rrfmodel.rrf.model.marks import MARKS
from octoprint_rrfmodel.rrf.model.meanings import MEANINGS
from octoprint_rrfmodel.rrf.views.warnings import ADVICE, CONDITIONS, POSITION_LOST, RESET
from octoprint_rrfmodel.rrf.wire.refusals import CODES as REFUSALS
from octoprint_rrfmodel.rrf.wire.refusals import ROWS as REFUSAL_ROWS

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "reference"
TEMPLATES = ROOT / "octoprint_rrfmodel" / "templates" / "rrfmodel"

CHECKBOX = re.compile(
    r"settings\.plugins\.rrfmodel\.(?P<key>[a-z_.]+)\"\s*/>\s*"
    r"\{\{ _\((?P<quote>['\"])(?P<text>.*?)(?P=quote)\) \}\}"
)
"""A setting with the words behind it."""

GROUP_OF_ROWS = re.compile(r"^\s+\"(?P<group>operations|replies)\",$")

ROW = re.compile(r"\(\"(?P<row>\w+)\", _\((?P<quote>['\"])(?P<text>.*?)(?P=quote)\)\)")
"""A row of a list of settings in a template, with its words."""

WORDS = {
    "silence_minutes": "Minutes that the board may say nothing during a command that takes long,"
    " before the connection ends; 0: any time",
    "mqtt.topic": "Topic to publish at, the whole of it",
    "moonraker.address": "Address of that port; 127.0.0.1 is this computer alone, 0.0.0.0 all that"
    " can reach it",
    "moonraker.port": "Its number",
    "wizard_seen": "Somebody has been led through what a machine needs of OctoPrint",
    "network.gap_minutes": "Minutes that a board on the network may not answer, before the"
    " connection ends",
    "network.beside_port": "Port of the web server of a board on the cable, mostly 80: an emergency"
    " stop goes over its network, too; 0: not",
    "network.passwords": "Passwords of boards, by address; told to nobody, set by the command"
    " `network_password`",
    "network.hosts": "Boards that were connected, by address; told to nobody",
    "simulator.enabled": "Offer the serial port `RRF-SIM`, a board that needs no hardware",
    "simulator.machine": "Which machine that is",
    "simulator.firmware": "Its firmware",
    "simulator.speed": "How fast its time goes by",
    "simulator.faults": "Its faults, such as `lost_ok:50`",
    "simulator.demo_print": "Have a large print with several objects on its card",
}
"""Of settings that the templates have no such words for."""

ABOUT = {
    "guard": "What pauses a print that OctoPrint streams: [each with its reason](guard.md).",
    "network": "A board [on the network](../network.md).",
    "operations": "What goes out for OctoPrint's buttons and files; a row that is off goes out as"
    " OctoPrint has it. [The rows](../operations.md).",
    "replies": "Replies of the firmware's that are put into words that OctoPrint knows."
    " [The rows](../operations.md#replies).",
    "mqtt": "For the plugin OctoPrint-MQTT, [where that is installed](../integrations.md#mqtt).",
    "sidebar": "Rows of the sidebar that are shown.",
    "simulator": "[The simulated board](../simulator.md) in OctoPrint.",
}
"""What stands before the settings of a group."""

GENERATED = "<!-- Written by python -m extras.site.reference from the tables of the code. -->\n\n"


def pages() -> dict[str, str]:
    """Return the text of each page by its file's name."""
    made = {
        "settings.md": _settings(),
        "guard.md": _guard(),
        "warnings.md": _warnings(),
        "object-model.md": _object_model(),
    }
    return {name: GENERATED + "\n".join(lines) + "\n" for name, lines in made.items()}


def words_of_settings() -> dict[str, str]:
    """Return what each setting does, by its path below ``plugins.rrfmodel``."""
    return {**WORDS, **dict(_words_of_templates())}


def _words_of_templates() -> Iterator[tuple[str, str]]:
    for path in sorted(TEMPLATES.glob("settings_*.jinja2")):
        text = path.read_text(encoding="utf-8")
        for found in CHECKBOX.finditer(text):
            yield found["key"], found["text"]
        group = "sidebar" if path.stem == "settings_sidebar" else ""
        for line in text.splitlines():
            begins, row = GROUP_OF_ROWS.match(line), ROW.search(line)
            group = begins["group"] if begins else group
            if row and group:
                yield f"{group}.{row['row']}", row["text"]


def paths_of(settings: Mapping[str, Any], parent: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the path of each setting with its default; an empty mapping is one setting."""
    for name, value in settings.items():
        if isinstance(value, Mapping) and value:
            yield from paths_of(value, f"{parent}{name}.")
        else:
            yield parent + name, value


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> list[str]:
    head = list(head)
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(cell or " " for cell in line) + " |" for line in lines] + [""]


def _settings() -> list[str]:
    words = words_of_settings()
    tops: dict[str, list[tuple[str, Any]]] = {}
    for path, default in paths_of(DEFAULTS):
        top = path.partition(".")[0] if "." in path else ""
        tops.setdefault(top, []).append((path, default))
    lines = [
        "# Settings",
        "",
        "In OctoPrint under *Settings → RepRapFirmware*, and below `plugins.rrfmodel` in its"
        " `config.yaml` and REST API. Nothing has to be set.",
        "",
    ]
    for top in sorted(tops):
        lines += [f"## `{top}`", ""] if top else []
        lines += [ABOUT[top], ""] if top in ABOUT else []
        rows = ((f"`{path}`", _default(default), words[path]) for path, default in tops[top])
        lines += _table(("setting", "default", "what it does"), rows)
    return lines


def _default(value: Any) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    return "none" if value in ({}, []) else f"`{json.dumps(value)}`"


def _guard() -> list[str]:
    reasons: dict[str, list[str]] = {}
    for refused in REFUSAL_ROWS:
        reasons.setdefault(refused.code, []).append(refused.reason)
    stops = [row for row in CONDITIONS if row.stops_a_print]
    faults = [(row.code, row.reason, "yes" if row.resumable else "no") for row in stops]
    faults.append((RESET.code, "Nothing of a print that was under way holds any more.", "no"))
    return [
        "# What pauses a print",
        "",
        "RepRapFirmware pauses for a fault what it prints from its own card, and nothing else. So"
        " the plugin pauses a print that OctoPrint streams, says why, and keeps it paused until the"
        " cause is over. Each cause is a [setting](settings.md#guard), `guard.<cause>`, on at"
        " first. A board on the network prints its own files, and pauses them itself.",
        "",
        "## The machine",
        "",
        *_table(
            ("cause", "what a person is told", "why", "may go on when it is over"),
            (
                (f"`{code}`", _sentence(code), reason, may_go_on)
                for code, reason, may_go_on in faults
            ),
        ),
        f"After `off` the position is lost, too (`{POSITION_LOST.code}`):"
        f" {_sentence(POSITION_LOST.code)}",
        "",
        "## A line of the file",
        "",
        "The firmware refuses a line with a sentence and goes on with the next one; the file would"
        " run to its end beside the part.",
        "",
        *_table(
            ("cause", "what a person is told", "why"),
            ((f"`{code}`", _sentence(code), " ".join(reasons[code])) for code in REFUSALS),
        ),
        "`M25`, `M226`, `M600` and `M601` in a file pause it as well (setting"
        " `operations.file_pause`), as from a file on the card.",
    ]


def _warnings() -> list[str]:
    return [
        "# Warnings",
        "",
        "What is wrong as long as it is: on every page, in the sidebar, and in"
        " [`warnings` of the state](../api.md). A `fault` doesn't work, a `warning` may not work"
        " for long, `advice` could work better. The command mends it, by a button of the page, or"
        " over [HTTP](../commands.md).",
        "",
        *_table(
            ("code", "level", "sentence", "command"),
            (
                (
                    f"`{code}`",
                    ALL_LEVELS.get(code, ADVICE),
                    _sentence(code),
                    f"`{FIXES[code]}`" if code in FIXES else "",
                )
                for code in sorted(TEXTS)
            ),
        ),
        "Slanted is what belongs to the case: a number, a name, a place in a file. With"
        " `print_paused` the guard says why it has [paused a print](guard.md).",
    ]


def _sentence(code: str) -> str:
    return re.sub(r"%\((\w+)\)s", r"*\1*", TEXTS[code])


def _object_model() -> list[str]:
    lines = [
        "# The object model",
        "",
        "What the members of RepRapFirmware's model say, as [`meanings`](../api.md) tells it and"
        " the page shows it. `[]` is any element. A *live* one changes all the time, and is asked"
        " for again and again. Which members there are depends on firmware and machine.",
        "",
    ]
    tops = [path for path in MEANINGS if "." not in path]
    for top in tops:
        lines += [f"## `{top}`", "", f"{MEANINGS[top].text}.", ""]
        below = (
            (path, meaning)
            for path, meaning in MEANINGS.items()
            if path.startswith((f"{top}.", f"{top}["))
        )
        rows = [
            (
                f"`{path}`",
                meaning.unit,
                meaning.text.replace("|", "\\|"),
                "live" if "live" in MARKS.get(path, ()) else "",
            )
            for path, meaning in below
        ]
        lines += _table(("path", "unit", "meaning", ""), rows) if rows else []
    return lines[:-1]


def main() -> int:
    """Write the pages and return 0."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in pages().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
        print(f"docs/reference/{name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
