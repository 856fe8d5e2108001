"""Methods about prints that are over, and the one under way."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...rrf.klipper import past_jobs as shapes
from ...rrf.views.past_job import CARD, OCTOPRINT
from .methods import CONTROL, Method
from .places import CARD as CARD_ROOT
from .places import Place

MOST = 1000


class HistoryMethods:
    """Answers them; ``jobs`` is the plugin's ``JobHistory``, ``roots()`` are ``Roots``."""

    def __init__(self, jobs, roots):
        self._jobs = jobs
        self._roots = roots

    def rows(self):
        """Return the rows."""
        return (
            Method("server.history.list", self._list),
            Method("server.history.totals", self._totals),
            Method("server.history.get_job", self._job),
            Method("server.history.delete_job", self._delete, CONTROL),
        )

    def _list(self, call):
        since, before = call.number("since", 0), call.number("before", float(10**12))
        limit, start = call.whole("limit", 50), call.whole("start", 0)
        found = [job for job in self._jobs.all() if since <= job[0].began <= before]
        if call.text("order", "desc") == "asc":
            found.reverse()
        chosen = found[start : start + (limit or MOST)]
        return {"count": len(found), "jobs": [self.told(*job) for job in chosen]}

    def _totals(self, call):
        jobs = [shapes.told(*job, {}, exists=False) for job in self._jobs.all()]
        return {"job_totals": shapes.totals(jobs), "auxiliary_totals": []}

    def _job(self, call):
        uid = call.text("uid")
        for job in self._jobs.all():
            if shapes.job_id(job[0]) == uid:
                return {"job": self.told(*job)}
        raise RequestRefused(404, gettext("There is no such print in the history."))

    def _delete(self, call):
        is_all = call.flag("all")
        uid = None if is_all else call.text("uid")
        gone = self._jobs.forget(lambda job: is_all or shapes.job_id(job) == uid)
        if not gone and not is_all:
            raise RequestRefused(
                404, gettext("There is no print in the history that has ended so.")
            )
        return {"deleted_jobs": [shapes.job_id(job) for job in gone]}

    def told(self, job, is_over):
        """Return a print in Moonraker's members, with what is known of its file."""
        roots = self._roots()
        root = roots.card if job.source == CARD else roots.own
        found = root.find(job.name)
        # another file may have its name by now
        is_same = found is not None and not found.is_folder and found.modified <= job.began
        metadata = {}
        if is_same:
            metadata = roots.metadata(Place(root.root, found.path), found, is_asked=False)
            del metadata["job_id"], metadata["print_start_time"]
        return shapes.told(job, is_over, metadata, is_same)

    def last_run(self, place):
        """Return number and beginning of the last print of a file, both ``None`` for none."""
        source = CARD if place.root == CARD_ROOT else OCTOPRINT
        for job, _ in self._jobs.all():
            if job.source == source and job.name == place.path:
                return shapes.job_id(job), job.began
        return None, None
