/* What the server keeps for charts: fetched, and then followed, while somebody looks at it. */
$(function () {
	const INTERVAL_MS = 2000;
	const HOUR = 3600;

	function History(core) {
		const self = this;
		const shown = ["machine", "job", "chart"].map(core.isShown);
		const isWanted = ko.pureComputed(() => core.mayRead() && shown.some(is => is()));
		let since;
		let timer;
		let isAsking = false;
		let generation = 0;

		/** Grows with each answer that brought something. */
		self.revision = ko.observable(0);
		/** How much is kept; more while a chart is held. */
		self.seconds = HOUR;

		self.forget = function () {
			since = undefined;
			generation += 1;
			self.times = [];
			/** By id, each with as many values as there are times. */
			self.series = new Map();
			/** How many samples have gone at the beginning. */
			self.dropped = 0;
			self.began = null;
			self.layers = [];
			/** Where a print is that OctoPrint sends, as far as its file tells. */
			self.streamed = null;
		};

		const addSamples = function (answer) {
			const before = self.times.length;
			self.times = self.times.concat(answer.times);
			answer.series.forEach(function (each) {
				const known = (self.series.get(each.id) || {}).values || Array(before).fill(null);
				self.series.set(each.id, Object.assign({}, each, {values: known.concat(each.values)}));
			});
			// what the server keeps no longer was another machine's
			const kept = new Set(answer.series.map(each => each.id));
			self.series.forEach((each, id) => kept.has(id) || self.series.delete(id));
			self.series.forEach(function (each) {
				while (each.values.length < self.times.length) each.values.push(null);
			});
			const old = self.times.findIndex(time => time >= answer.now - self.seconds);
			if (old > 0) {
				self.times.splice(0, old);
				self.series.forEach(each => each.values.splice(0, old));
				self.dropped += old;
			}
		};

		const take = function (answer) {
			// the server's clock was set back, and what is later than since may be missing
			if (answer.now < since) return self.forget();
			const isNew = since === undefined || answer.began !== self.began;
			if (isNew) self.layers = [];
			self.began = answer.began;
			self.layers = self.layers.concat(answer.layers);
			since = answer.now;
			const isElsewhere = !_.isEqual(self.streamed, answer.streamed);
			self.streamed = answer.streamed;
			if (answer.times.length) addSamples(answer);
			if (isNew || isElsewhere || answer.times.length || answer.layers.length) {
				self.revision(self.revision() + 1);
			}
		};

		const ask = function () {
			if (!isWanted() || isAsking) return;
			isAsking = true;
			const asked = generation;
			OctoPrint.plugins.rrfmodel
				.getHistory(since)
				// an answer for what was forgotten meanwhile lacks what came before it
				.done(answer => asked === generation && take(answer))
				.always(function () {
					isAsking = false;
					if (isWanted()) timer = window.setTimeout(ask, INTERVAL_MS);
				});
		};

		self.forget();
		isWanted.subscribe(function (wanted) {
			window.clearTimeout(timer);
			if (!core.mayRead()) self.forget();
			if (wanted) ask();
		});
	}

	/** The one history of the page. */
	RRFModel.historyOf = core => core.history || (core.history = new History(core));

	/** Options that make a flot chart look like the page around it. */
	RRFModel.chartOptions = function (element, more) {
		const colour = window.getComputedStyle(element).color;
		const grid = {borderWidth: 1, color: colour, tickColor: "rgba(128, 128, 128, 0.3)"};
		return $.extend(true, {series: {shadowSize: 0}, grid: grid, legend: {show: false}}, more);
	};

	/** Calls `draw` soon, once for many calls, and only where the element has a size. */
	RRFModel.drawSoon = function (element, draw) {
		let isDue = false;
		return function () {
			if (isDue) return;
			isDue = true;
			window.requestAnimationFrame(function () {
				isDue = false;
				if (element() && element().offsetWidth) draw();
			});
		};
	};
});
