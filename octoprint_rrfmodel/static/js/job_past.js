/* The last jobs, as the plugin keeps them: what was printed when, for how long, and how it ended. */
$(function () {
	const FIRST = 5;

	/** Returns the list, read anew with each change while `isWanted()` holds. */
	RRFModel.pastJobs = function (core, isWanted) {
		const self = {};
		const show = RRFModel.show;
		const outcomes = {
			finished: {text: gettext("finished"), label: "label-success"},
			cancelled: {text: gettext("cancelled"), label: "label-warning"},
			aborted: {text: gettext("broken off"), label: "label-important"},
			simulated: {text: gettext("simulated"), label: "label-info"}
		};
		const unseen = {text: gettext("end not seen"), label: ""};
		const sources = {
			card: gettext("from the machine's card"),
			octoprint: gettext("sent by OctoPrint")
		};
		const when = seconds =>
			new Date(seconds * 1000).toLocaleString(document.documentElement.lang || undefined, {
				dateStyle: "short",
				timeStyle: "short"
			});
		const jobs = ko.observableArray();
		let known;

		self.all = ko.observable(false);
		self.rows = ko.pureComputed(() => (self.all() ? jobs() : jobs().slice(0, FIRST)));
		self.hasMore = ko.pureComputed(() => !self.all() && jobs().length > FIRST);
		self.showAll = () => self.all(true);

		ko.computed(function () {
			const changes = core.status().jobs;
			if (!isWanted() || changes === known) return;
			OctoPrint.plugins.rrfmodel.getJobs().done(function (answer) {
				known = changes;
				jobs(
					answer.jobs.map(job => ({
						name: job.name,
						path: job.path,
						isOnCard: job.source === "card",
						source: sources[job.source],
						when: when(job.began),
						duration: show.duration(job.duration),
						outcome: outcomes[job.outcome] || unseen,
						isSimulated: job.outcome === "simulated",
						againLabel: _.sprintf(gettext("Print %(name)s"), job)
					}))
				);
			});
		}).extend({deferred: true});
		return self;
	};
});
