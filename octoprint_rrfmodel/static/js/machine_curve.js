/* Small curves of the last ten minutes, one for each heater, from the server's history. */
$(function () {
	const SECONDS = 600;
	const WIDTH = 60;
	const HEIGHT = 22;
	/** More points than pixels show nothing more. */
	const POINTS = 60;
	/** Degrees that are seen at least: noise is no curve. */
	const LEAST_SPAN = 20;

	/** The path of an SVG through values at times; what isn't known is a gap. */
	const pathOf = function (times, values, now) {
		const first = times.findIndex(time => time >= now - SECONDS);
		if (first < 0) return "";
		const step = Math.max(1, Math.ceil((times.length - first) / POINTS));
		const found = [];
		for (let place = first; place < times.length; place += step) found.push([times[place], values[place]]);
		const known = found.map(([, value]) => value).filter(RRFModel.isNumber);
		if (known.length < 2) return "";
		const least = Math.min(...known);
		const span = Math.max(LEAST_SPAN, Math.max(...known) - least);
		let draws = "M";
		return found
			.map(function ([time, value]) {
				if (!RRFModel.isNumber(value)) {
					draws = "M";
					return "";
				}
				const x = WIDTH * (1 - (now - time) / SECONDS);
				const y = HEIGHT - 1 - ((value - least) / span) * (HEIGHT - 2);
				const point = draws + x.toFixed(1) + " " + y.toFixed(1);
				draws = "L";
				return point;
			})
			.join("");
	};

	/** Returns `heater number => path`; nothing is computed while the view is hidden. */
	RRFModel.curves = function (core) {
		const history = RRFModel.historyOf(core);
		const isShown = core.isShown("machine");
		const paths = ko.observable({});
		ko.computed(function () {
			if (!history.revision() || !isShown()) return;
			const {times} = history;
			const now = times[times.length - 1];
			const found = {};
			history.series.forEach(function (each) {
				if (each.kind === "heater" && each.what === "current") found[each.number] = pathOf(times, each.values, now);
			});
			paths(found);
		}).extend({deferred: true});
		return heater => paths()[heater] || "";
	};
});
