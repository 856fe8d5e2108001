/* What the chart is made of: points of series, names of heaters, and the pointer over it. */
$(function () {
	/** Samples that are drawn of a series before several become one. */
	const MOST_SAMPLES = 250;
	/** Pixels from which on a movement is a selection. */
	const LEAST_DRAG = 8;

	/** Points from one index to another: of many samples the least and the greatest of each few. */
	RRFModel.pointsOf = function (history, values, first, last, factor) {
		const points = [];
		const step = Math.ceil((last - first) / MOST_SAMPLES);
		const point = place => [history.times[place] * 1000, values[place] * factor];
		let place = first;
		while (place < last) {
			// the same samples are taken together when the chart moves on
			const end = Math.min(last, place + step - ((place + history.dropped) % step));
			let least = -1;
			let most = -1;
			let gap = -1;
			for (; place < end; place++) {
				if (values[place] === null) gap = place;
				else {
					if (least < 0 || values[place] < values[least]) least = place;
					if (most < 0 || values[place] > values[most]) most = place;
				}
			}
			if (least >= 0) points.push(point(Math.min(least, most)));
			if (least !== most) points.push(point(Math.max(least, most)));
			if (gap >= 0) points.push([history.times[gap] * 1000, null]);
		}
		return points;
	};

	/** Names of heaters by their numbers, after the tools, beds and chambers that they are of. */
	RRFModel.heaterNames = function (model) {
		const names = {};
		const heat = model("heat") || {};
		[
			{slots: heat.chamberHeaters, title: gettext("Chamber")},
			{slots: heat.bedHeaters, title: gettext("Bed")}
		].forEach(kind =>
			(kind.slots || []).forEach(function (heater, slot) {
				if (heater >= 0) names[heater] = slot ? kind.title + " " + slot : kind.title;
			})
		);
		(model("tools") || []).forEach(function (tool) {
			if (!tool) return;
			const title = tool.name || _.sprintf(gettext("Tool %(number)s"), tool);
			(tool.heaters || []).forEach(function (heater, place) {
				if (!names[heater]) names[heater] = place ? title + " (" + (place + 1) + ")" : title;
			});
		});
		return names;
	};

	/**
	 * Look at a time under the pointer, and select a part by dragging: `time(event)` is that of a
	 * place or null, `pointed` gets it, `selected` both ends; `released` lets the chart follow again.
	 */
	RRFModel.followPointer = function (element, mark, chart) {
		let from = null;
		let at = 0;

		const select = function (event) {
			const left = element.getBoundingClientRect().left;
			const width = Math.abs(event.clientX - at);
			mark.style.left = Math.min(at, event.clientX) - left + "px";
			mark.style.width = width + "px";
			mark.hidden = width < LEAST_DRAG;
		};
		const leave = function () {
			from = null;
			mark.hidden = true;
		};

		element.addEventListener("pointerdown", function (event) {
			if (event.button) return;
			from = chart.time(event);
			at = event.clientX;
			if (from !== null) element.setPointerCapture(event.pointerId);
		});
		element.addEventListener("pointermove", function (event) {
			chart.pointed(chart.time(event));
			if (from !== null) select(event);
		});
		element.addEventListener("pointerup", function (event) {
			const start = from;
			const isSelection = start !== null && Math.abs(event.clientX - at) >= LEAST_DRAG;
			leave();
			if (isSelection) chart.selected(start, chart.time(event));
		});
		element.addEventListener("pointercancel", leave);
		element.addEventListener("pointerleave", () => chart.pointed(null));
		element.addEventListener("dblclick", chart.released);
	};
});
