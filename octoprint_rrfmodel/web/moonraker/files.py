"""Files, prints and what has been printed, put together for Moonraker's clients."""

from tornado.ioloop import IOLoop

from ...host.print_files import LOCAL, PrintFiles
from . import downloads
from .card_files import CardFiles
from .file_changes import FileChanges
from .file_methods import FileMethods
from .file_news import FileNews
from .history_methods import HistoryMethods
from .own_files import OwnFiles
from .print_methods import PrintMethods
from .roots import Roots

NOTIFY_HISTORY = "notify_history_changed"


class Files:
    """Makes the parts; ``host`` is OctoPrint, ``link`` leads to the board.

    ``model()`` is the snapshot, ``parts`` is ``moonraker.Parts``.
    """

    def __init__(self, host, link, model, *, parts):
        def of(name):
            return PrintFiles(name, host.files, host.printer, fire=host.fire)

        self._jobs = parts.jobs
        self._history = HistoryMethods(parts.jobs, lambda: self._roots)
        self._card = CardFiles(link, model, of("printer"))
        self._roots = Roots(OwnFiles(of(LOCAL)), self._card, self._history.last_run)
        prints = PrintMethods(host.printer, parts.commands.run, lambda: self._roots)
        methods = FileMethods(self._roots), FileChanges(self._roots, prints)
        self._parts = (*methods, prints, self._history)
        self._news = None

    def rows(self):
        """Return the rows of all."""
        return [row for part in self._parts for row in part.rows()]

    def routes(self, app, thumbnails, redeem):
        """Return what Tornado serves itself; OctoPrint asks on the thread of Tornado's loop."""
        self._card.attach(thumbnails, IOLoop.current())
        return downloads.routes(self._roots, thumbnails, app, redeem)

    def attach(self, tell, count):
        """Have ``count()`` sockets told of news by ``tell(method, params, permission)``."""
        self._news = FileNews(self._roots.item, tell, count)

        def tell_of_job(action, job, is_over):
            if count():
                told = {"action": action, "job": self._history.told(job, is_over)}
                tell(NOTIFY_HISTORY, [told], "PLUGIN_RRFMODEL_READ")

        self._jobs.attach(tell_of_job)

    def subscribe(self, events):
        """Begin to hear OctoPrint's events."""
        self._news.subscribe(events)
