/* How long a print goes on and how long it has been on, whoever runs it. */
$(function () {
	/** Which estimate is believed, the one that knows most first. */
	const ESTIMATES = ["simulation", "slicer", "filament", "file"];
	const DAY_MS = 24 * 3600 * 1000;
	const {isNumber} = RRFModel;

	/** The time of day that lies so far ahead, with the day where it isn't today. */
	const clock = function (ms) {
		const at = new Date(ms);
		const options = {hour: "2-digit", minute: "2-digit"};
		if (at.toDateString() !== new Date().toDateString()) {
			options.weekday = "short";
			if (ms - Date.now() > 6 * DAY_MS) Object.assign(options, {day: "numeric", month: "short"});
		}
		return at.toLocaleString(document.documentElement.lang || undefined, options);
	};

	RRFModel.jobTimes = function (core, job, streamed, phase) {
		const self = {};
		const show = RRFModel.show;

		/** What is left of a time that was told for the whole, after what has been printed. */
		const rest = function (seconds) {
			if (!isNumber(seconds) || !isNumber(job().duration)) return undefined;
			return Math.max(0, seconds - job().duration + (job().warmUpDuration || 0));
		};
		const left = name => () => (job().timesLeft || {})[name];
		const seconds = {
			file: left("file"),
			filament: left("filament"),
			slicer: left("slicer"),
			simulation: () => rest((job().file || {}).simulatedTime)
		};
		const texts = table => _.mapValues(table, time => ko.pureComputed(() => show.duration(time())));

		self.left = texts(seconds);
		self.spent = texts({
			duration: () => job().duration,
			warmUp: () => job().warmUpDuration,
			paused: () => job().pauseDuration
		});
		self.duration = ko.pureComputed(() => (streamed.is() ? streamed.duration() : self.spent.duration()));

		const best = ko.pureComputed(function () {
			if (streamed.is()) return streamed.secondsLeft();
			const told = ESTIMATES.map(each => seconds[each]()).filter(isNumber);
			// one that is over was wrong
			return told.find(time => time > 0) || told[0];
		});
		/** When it ends and how long that is; how long alone while it stands still. */
		self.ends = ko.pureComputed(function () {
			if (!isNumber(best())) return gettext("end not known yet");
			const time = {left: show.duration(best())};
			if (phase() === "paused") return _.sprintf(gettext("left %(left)s"), time);
			const {age, at} = core.received();
			const told = streamed.is() || !isNumber(age) ? Date.now() : at - age * 1000;
			time.time = clock(told + best() * 1000);
			return _.sprintf(gettext("ends %(time)s, left %(left)s"), time);
		});
		return self;
	};
});
