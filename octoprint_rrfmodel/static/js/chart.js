/* The sub-view Chart: up to an hour of temperatures and heater power, as the server keeps it. */
$(function () {
	const CHOICE = "plugin.rrfmodel.chart";
	const SHORTEST = 30;
	const LONGEST = 3600;
	const COLOURS = 10;
	/** What is shown until somebody chooses otherwise. */
	const SHOWN = {current: true, target: true, pwm: false};
	const AXES = {"°C": 1, "%": 3};
	const POWER_AXIS = 2;

	/** What `use` returns; without storage the choice lasts as long as the page. */
	function ofStorage(use) {
		try {
			return use(window.localStorage);
		} catch (error) {
			return null;
		}
	}

	function RrfModelChartViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const model = core.modelOfView("chart");
		const history = RRFModel.historyOf(core);
		const isOpen = core.isShown("chart");
		const choice = ofStorage(storage => JSON.parse(storage.getItem(CHOICE))) || {};
		const chosen = {};
		const colours = {};
		let element;
		let plot;

		self.isShown = ko.pureComputed(() => core.mayRead() && core.view() === "chart");

		//~~ which part of the time is seen

		const span = (self.span = ko.observable(15 * 60));
		/** Where the chart ends, in seconds; null as long as it follows the time. */
		const end = ko.observable(null);

		self.isHeld = ko.pureComputed(() => end() !== null);

		const latest = () => history.times[history.times.length - 1] || Date.now() / 1000;
		const range = function () {
			const to = end() === null ? latest() : end();
			return {from: to - span(), to: to};
		};

		const clamped = length => Math.min(Math.max(length, SHORTEST), LONGEST);
		const look = function (middle, length) {
			span(clamped(length));
			end(Math.max(Math.min(middle + span() / 2, latest()), history.times[0] || 0));
		};

		self.zoom = factor => () => {
			if (self.isHeld()) look(range().to - span() / 2, span() * factor);
			else span(clamped(span() * factor));
		};
		self.move = part => () => {
			const middle = range().to - span() / 2 + span() * part;
			if (middle + span() / 2 >= latest()) end(null);
			else look(middle, span());
		};
		self.hold = () => end(end() === null ? latest() : null);

		self.isHeld.subscribe(held => (history.seconds = held ? 2 * LONGEST : LONGEST));

		//~~ what is seen

		/** The time under the pointer. */
		const pointed = ko.observable(null);

		const isChosen = function (series) {
			if (!chosen[series.id]) {
				const known = choice[series.id];
				const is = ko.observable(typeof known === "boolean" ? known : SHOWN[series.what]);
				is.subscribe(function (value) {
					choice[series.id] = value;
					ofStorage(storage => storage.setItem(CHOICE, JSON.stringify(choice)));
					draw();
				});
				chosen[series.id] = is;
			}
			return chosen[series.id];
		};

		const colourOf = function (thing) {
			if (colours[thing] === undefined) colours[thing] = Object.keys(colours).length % COLOURS;
			return "--rrfmodel-series-" + colours[thing];
		};

		const textOf = function (series, place) {
			const value = series.values[place];
			if (typeof value !== "number") return "–";
			if (series.what === "pwm") return RRFModel.show.percent(value);
			return value.toFixed(1) + (series.unit ? " " + series.unit : "");
		};

		self.rows = RRFModel.rows(
			function () {
				if (!isOpen()) return self.rows ? self.rows.peek().map(row => ({key: row.key})) : [];
				history.revision();
				const names = RRFModel.heaterNames(model);
				const time = pointed();
				const place = time === null ? history.times.length - 1 : _.sortedIndex(history.times, time);
				const found = new Map();
				history.series.forEach(function (series) {
					const key = series.kind + series.number;
					if (!found.has(key)) {
						const isHeater = series.kind === "heater";
						const title = isHeater ? gettext("Heater") : gettext("Sensor");
						found.set(key, {
							key: key,
							name: (isHeater ? names[series.number] : series.name) || title + " " + series.number,
							colour: "var(" + colourOf(key) + ")",
							current: null,
							target: null,
							pwm: null
						});
					}
					found.get(key)[series.what] = textOf(series, place);
				});
				return Array.from(found.values());
			},
			function (row) {
				row.shown = what => isChosen({id: row.key + "." + what, what: what});
			}
		);

		self.timeText = ko.pureComputed(function () {
			if (pointed() === null) return gettext("Latest values");
			return new Date(pointed() * 1000).toLocaleTimeString();
		});

		self.isEmpty = ko.pureComputed(() => !history.revision() || !history.times.length);

		//~~ the drawing

		const dataOf = function (seen) {
			const first = Math.max(0, _.sortedIndex(history.times, seen.from) - 1);
			const last = Math.min(history.times.length, _.sortedIndex(history.times, seen.to) + 1);
			const style = window.getComputedStyle(element);
			const data = [];
			history.series.forEach(function (series) {
				if (!isChosen(series)()) return;
				const isPower = series.what === "pwm";
				const isTarget = series.what === "target";
				data.push({
					data: RRFModel.pointsOf(history, series.values, first, last, isPower ? 100 : 1),
					color: style.getPropertyValue(colourOf(series.kind + series.number)).trim(),
					yaxis: isPower ? POWER_AXIS : AXES[series.unit] || 3,
					lines: {show: !isTarget, lineWidth: isPower ? 1 : 2, fill: isPower ? 0.08 : false},
					dashes: {show: isTarget, lineWidth: 1.5, dashLength: [6, 4]}
				});
			});
			return data;
		};

		const make = function (data, seen) {
			plot = $.plot(
				$(element),
				data,
				RRFModel.chartOptions(element, {
					grid: {hoverable: true, autoHighlight: false},
					xaxis: {
						mode: "time",
						timezone: "browser",
						// about as many; of more the labels with seconds would touch
						ticks: 5,
						min: seen.from * 1000,
						max: seen.to * 1000
					},
					yaxes: [
						{tickFormatter: value => value + " °C"},
						{
							position: "right",
							min: 0,
							max: 100,
							tickSize: 25,
							tickFormatter: value => value + " %"
						},
						{position: "right"}
					]
				})
			);
		};

		const draw = RRFModel.drawSoon(
			() => element,
			function () {
				const seen = range();
				const data = dataOf(seen);
				if (!plot) return make(data, seen);
				const options = plot.getAxes().xaxis.options;
				options.min = seen.from * 1000;
				options.max = seen.to * 1000;
				plot.setData(data);
				plot.setupGrid();
				plot.draw();
			}
		);

		ko.computed(function () {
			history.revision();
			span();
			end();
			if (isOpen()) draw();
		});

		//~~ pointer

		const timeAt = function (event) {
			const x = event.clientX - element.getBoundingClientRect().left;
			const time = plot.getAxes().xaxis.c2p(x - plot.getPlotOffset().left) / 1000;
			const seen = range();
			return Math.min(Math.max(time, seen.from), seen.to);
		};

		self.onAfterBinding = function () {
			element = document.querySelector("#rrfmodel_chart .rrfmodel-plot");
			RRFModel.followPointer(element, document.querySelector("#rrfmodel_chart .rrfmodel-selection"), {
				time: event => (plot ? timeAt(event) : null),
				pointed: pointed,
				selected: (one, other) => look((one + other) / 2, Math.abs(one - other)),
				released: () => end(null)
			});
			draw();
		};

		self.onServerReconnect = history.forget;
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelChartViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#rrfmodel_chart"]
	});
});
