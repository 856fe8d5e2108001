/* The layers of the print under way, or of the last one, as bars of their times. */
$(function () {
	const LATEST_LAYERS = 30;
	/** So many have room at least: a few would be bars like walls. */
	const FEWEST = 20;
	const {isNumber} = RRFModel;

	/** Returns the chart of what the server keeps in `history`. */
	RRFModel.jobLayers = function (history, isOpen, hasJob) {
		const self = {};
		const show = RRFModel.show;
		let element;

		self.all = ko.observable(true);
		const layers = ko.pureComputed(function () {
			history.revision();
			return self.all() ? history.layers : history.layers.slice(-LATEST_LAYERS);
		});
		self.title = ko.pureComputed(() => (hasJob() ? gettext("Layers") : gettext("Layers of the last print")));
		self.has = ko.pureComputed(() => layers().length > 0);

		/** The layer under the pointer; else the last one that is through. */
		const pointed = ko.observable(null);
		self.facts = ko.pureComputed(function () {
			const layer = pointed() || layers()[layers().length - 1];
			if (!layer) return "";
			const title = _.sprintf(gettext("Layer %(number)s"), {number: layer.layer});
			const height = layer.height > 0 ? show.fixed(layer.height, 2) + " mm" : "–";
			const parts = [show.duration(layer.seconds), "Z " + height];
			if (isNumber(layer.filament))
				parts.push(
					_.sprintf(gettext("%(length)s mm of filament"), {
						length: show.fixed(layer.filament, 0)
					})
				);
			return title + ": " + parts.join(", ");
		});
		self.text = ko.pureComputed(function () {
			const sum = layers().reduce((seconds, layer) => seconds + layer.seconds, 0);
			return _.sprintf(gettext("Times of %(count)s layers, %(average)s on average"), {
				count: layers().length,
				average: show.duration(sum / layers().length)
			});
		});

		const draw = RRFModel.drawSoon(
			() => element,
			function () {
				const colour = window.getComputedStyle(element);
				const shown = layers();
				const first = self.all() || !shown.length ? 1 : shown[0].layer;
				const last = shown.length ? shown[shown.length - 1].layer : 1;
				const bars = {
					color: colour.getPropertyValue("--rrfmodel-series-1").trim(),
					data: shown.map(layer => [layer.layer, layer.seconds]),
					bars: {show: true, align: "center", barWidth: 0.8, lineWidth: 0, fill: 0.9}
				};
				$.plot(
					$(element),
					[bars],
					RRFModel.chartOptions(element, {
						grid: {hoverable: true},
						xaxis: {
							min: first - 0.5,
							max: Math.max(last, first + FEWEST - 1) + 0.5,
							minTickSize: 1,
							tickDecimals: 0
						},
						yaxis: {min: 0, tickFormatter: value => show.duration(value)}
					})
				);
			}
		);

		ko.computed(function () {
			layers();
			if (isOpen()) draw();
		});

		self.bind = function () {
			element = document.querySelector("#rrfmodel_job .rrfmodel-plot");
			$(element).on("plothover", (_event, _position, item) =>
				pointed(item && item.dataIndex < layers().length ? layers()[item.dataIndex] : null)
			);
			draw();
		};
		return self;
	};
});
