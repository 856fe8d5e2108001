"""A support bundle as a file: a zip archive of JSON and plain text, of a bounded size."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Mapping
from typing import Any

MODEL, MACHINE = "model.json", "machine.json"
"""What a replay needs: the object model in the envelope of ``M409``, and what the board is."""

MOST_BYTES = 4_000_000
"""Of one file in it; nothing that is put into one comes near that."""

FORM = 1
"""Number of the form of these files, which ``machine.json`` tells."""


class NoBundle(ValueError):
    """What was to be a bundle is none; says why."""


def packed(files: Mapping[str, Any]) -> bytes:
    """Return an archive of files by name: texts as they are, other values as JSON.

    One that is too large is left out, and a text says so in its place.
    """
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as written:
        for name, value in files.items():
            text = value if isinstance(value, str) else json.dumps(value, indent=1) + "\n"
            data = text.encode("utf-8", errors="replace")
            if len(data) > MOST_BYTES:
                name, data = f"{name}.txt", b"It was too large.\n"
            written.writestr(name, data)
    return archive.getvalue()


def member(archive: bytes, name: str) -> Any:
    """Return the value in one of the JSON files of an archive; ``NoBundle`` where there is none."""
    try:
        with zipfile.ZipFile(io.BytesIO(archive)) as opened:
            if opened.getinfo(name).file_size > MOST_BYTES:
                raise NoBundle(f"{name} is too large")
            return json.loads(opened.read(name))
    except KeyError:
        raise NoBundle(f"no support bundle: there is no {name} in it") from None
    except NoBundle:
        raise
    # NotImplementedError, a RuntimeError, is zipfile's word for a compression that it lacks
    except (zipfile.BadZipFile, ValueError, RuntimeError, EOFError) as error:
        raise NoBundle(f"no support bundle: {error}") from None
