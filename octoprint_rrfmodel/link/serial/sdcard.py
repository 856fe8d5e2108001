"""The board's card as OctoPrint's SD card: its names, its list, and words that OctoPrint knows.

Part of this touches attributes of OctoPrint's connection that have no public form; both versions
have them under the same names. ``translate`` runs with whoever queues a command, ``reword`` and
``fill`` on OctoPrint's receiving thread, all the rest on the worker.
"""

import collections
from functools import partial

from ...host.tags import SWALLOWED
from ...host.version import IS_2
from ...rrf.card.listing import PRINTABLE, ROOT, CardFile, path_of
from ...rrf.card.wording import BEGINNINGS, LIST_BEGINS, LIST_ENDS, reword
from ...rrf.gcode.operations import Lines
from ...rrf.wire.gcode_words import quoted
from .origin import START_TAG
from .sdjob import PREFIX, is_listed

if IS_2:
    from octoprint.plugins.serial_connector.serial_comm import SDFileData
else:
    from octoprint.util.comm import SDFileData

LOOKED_AT = BEGINNINGS | {LIST_BEGINS[:2]}
"""The first two characters of lines that are looked at more closely."""

POSITION = "X:"
"""How a position begins; OctoPrint reads it where the machine has no more axes than X, Y, Z."""

REFRESH_TAG = "trigger:rrfmodel.card"
OWN_REFRESH_TAG = "trigger:comm.refresh_sd_files"
CANCEL_TAG = "trigger:comm.cancel"
NAMING_TAGS = frozenset(
    ("trigger:comm.select_file", "trigger:comm.start_print", "trigger:comm.delete_sd_file")
)
"""Tags of commands in which OctoPrint names a file; what a person types is a name already."""

NAMING = frozenset(("M23", "M30", "M32", "M36"))

LONG_NAMES = "Cap:LFN_WRITE:1"
"""Ends OctoPrint's wait for a report of capabilities, before which it doesn't list the card; and
with it 2.0 makes no short names of those it is given."""


class SdCard:
    """Lists the card for OctoPrint and maps the names that it uses.

    ``plan`` is a ``CardPlan``, ``job`` an ``SdJob``. ``link`` is the ``SerialLink``, ``model()``
    the snapshot. ``is_reworded(row)`` says whether a row of the table of replies is switched on.
    """

    def __init__(self, plan, job, link, *, model, is_reworded):
        self._plan = plan
        self._job = job
        self._link = link
        self._model = model
        self._is_reworded = is_reworded
        self._forget()

    def _forget(self):
        self._says = collections.deque()
        self._listed = None
        self._plain = None
        self._shown = None
        self._opening = None
        self._has_asked = False
        self._looked_at = LOOKED_AT - {POSITION}
        self._review()

    def _review(self):
        self.is_talking = self._listed is not None or bool(self._says)
        """Whether the next line may have to be another, whatever it is."""

    @property
    def _index(self):
        """What is on the card; without sizes and dates until, and unless, the board tells them."""
        return self._plan.index or self._plain

    folders = ()
    """Over a line none are known but those that files are in."""

    def listed(self):
        """Return the files on the card (``CardFile``), as far as they are known; any thread."""
        index = self._index
        return tuple(index.files.values()) if index else ()

    def facts_of(self, path):
        """Return what the board has read from a file: nothing, it has to be asked."""
        return None

    def identified(self):
        """Begin with a board that has just told that it runs RepRapFirmware."""
        self._plan.forget()
        self._job.forget()
        self._forget()
        comm = self._link.connection
        if comm is None:
            return
        if comm._serial_encoding == "ascii":
            # the firmware's names and texts are UTF-8; OctoPrint's default sends ? for what isn't
            # ASCII, and the encoding is used for lines that go out and for nothing else
            comm._serial_encoding = "utf-8"
        self._says.append(LONG_NAMES)
        self._review()

    ##~~ commands

    def translate(self, cmd, gcode, tags):
        """Return what to queue in place of ``cmd``, ``None`` to queue it as it is."""
        if START_TAG in tags:
            self._job.begins(self._link.connection)
        if gcode in NAMING:
            return self._with_path(cmd, gcode, tags)
        if CANCEL_TAG in tags:
            return self._job.cancel(gcode, self._link.connection)
        if gcode == "M20" and OWN_REFRESH_TAG in tags:
            if REFRESH_TAG not in tags and not self._plan.notices_changes:
                self._plan.refetch()
            return None
        return None

    def is_foreign(self, comm):
        """Return whether the print that OctoPrint shows isn't its own, or was ended elsewhere."""
        return self._job.is_foreign(comm)

    def is_others(self, comm):
        """Return whether the board has a job that OctoPrint has nothing to do with."""
        return self._job.is_others(comm, self._index)

    def is_over(self, comm):
        """Return whether the print that OctoPrint shows has ended, which it is only yet to say."""
        return self._job.is_over(comm)

    def end_job(self):
        """Return the lines that end the board's job, and see to it that they do."""
        return self._job.cancel("M25").lines

    def _with_path(self, cmd, gcode, tags):
        """Return the command with the path that OctoPrint's name stands for."""
        name = cmd[len(gcode) :].strip().strip('"')
        index = self._index
        file = index.file_of(name) if index and not NAMING_TAGS.isdisjoint(tags) else None
        path = file.path if file else path_of(name)
        if gcode in ("M23", "M32"):
            self._opening = path
        return Lines((f"{gcode} {quoted(path)}",)) if file else None

    ##~~ replies

    def reword(self, line):
        """Return a line, other than an ok, in words that OctoPrint knows."""
        worded = self._worded(line)
        self._review()
        return worded

    def _worded(self, line):
        says = self._says
        if line[:2] not in self._looked_at and self._listed is None and not says:
            return line
        comm = self._link.connection
        if comm is None:
            return line
        if says and not line.strip():
            # the blank line behind the board's JSON
            return says.popleft()
        if line.startswith(LIST_BEGINS):
            self._listed = []
            return line
        worded = reword(line, lambda: self._situation(comm), self._is_reworded)
        if worded is not line:
            self._listed = None
            if worded.startswith("File opened"):
                self._job.allow_opening(comm)
            says.extend(self._job.reworded(comm, worded))
            return worded
        return line if self._listed is None else self._collect(comm, line)

    def fill(self):
        """Return a line in the place of one that was the plugin's."""
        if not self._says:
            return SWALLOWED
        said = self._says.popleft()
        self._review()
        return said

    def _situation(self, comm):
        index = self._index
        alias = index.alias_of(self._opening) if index and self._opening else None
        opened = None
        if alias and is_listed(comm, alias):
            opened = (PREFIX + alias, index.file_of(alias).size)
        knows_file, is_telling = bool(self._model()), bool(self._says)
        return self._job.situation(comm, index, opened, knows_file, is_telling)

    def _collect(self, comm, line):
        """Take a line of the board's plain list out, and put the whole list in at its end."""
        if not line.startswith(LIST_ENDS):
            if ":" in line:
                return line  # no name has a colon in it
            self._listed.append(line.strip())
            return SWALLOWED
        names, self._listed = self._listed, None
        if self._plan.index is None:
            paths = [f"{ROOT}/{name}" for name in names if name.lower().endswith(PRINTABLE)]
            self._plain = self._plan.aliases.index(CardFile(path, 0) for path in paths)
        index = self._index
        comm._sdFiles = {
            PREFIX + alias: SDFileData(PREFIX + alias, file.size, file.modified, file.name)
            for alias, file in index.files.items()
        }
        self._shown = index
        return line

    ##~~ what the poller asks

    @property
    def behind(self):
        """Whether there is something to ask about the card."""
        comm = self._link.connection
        return comm is not None and bool(comm._sdEnabled) and self._plan.behind

    def next_request(self):
        """Return what to ask about the card now, ``None`` for nothing."""
        return self._plan.next_request() if self.behind else None

    def take(self, page):
        """Take a page of the list; return whether it is the one that was asked for."""
        return self._plan.take(page)

    def failed(self):
        """Note that the request brought nothing."""
        self._plan.failed()

    ##~~ news

    def replied(self, taken, asked_at):
        """Follow the board after each reply: its card and its job."""
        comm = self._link.connection
        if comm is None:
            return
        model = self._model()
        self._plan.observe(model)
        has_more = len((model.get("move") or {}).get("axes") or ()) > len("XYZ")
        self._looked_at = LOOKED_AT if has_more else LOOKED_AT - {POSITION}
        if not self._has_asked:
            # 2.0 tells which firmware it is only behind the answer to the M21 that came with it
            self._has_asked = True
            if not comm.isSdReady():
                self._link.later(partial(comm.initSdCard, tags={REFRESH_TAG}))
        index = self._plan.index
        if index is not None and (self._shown is None or index.files != self._shown.files):
            self._refresh(comm, index)
        self._job.look(comm)
        if not self._says:
            self._says.extend(self._job.news(comm, self._index))
            self._review()

    def _refresh(self, comm, index):
        """Let OctoPrint ask for the list, which it does only while nothing is printed."""
        if comm.isOperational() and not comm.isBusy() and comm.isSdReady():
            self._shown = index
            self._link.later(partial(comm.refreshSdFiles, tags={REFRESH_TAG}))
