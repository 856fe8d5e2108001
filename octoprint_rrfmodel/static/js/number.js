/* A field that shows a value of the machine and sets it. */
$(function () {
	/**
	 * <rrf-number params="value, send, label, unit, min, max, step, test"> shows `value` until
	 * somebody types; Enter or the button calls `send(number)` within the limits, Escape gives up.
	 * What was sent is marked while the promise of `send` is open.
	 */
	const RrfNumber = function (params, root) {
		const self = this;
		const typed = ko.observable();
		const sent = ko.observable();

		self.label = params.label;
		self.unit = params.unit || "";
		self.test = params.test;
		self.limits = {min: params.min, max: params.max, step: params.step || "any"};
		self.isDirty = ko.pureComputed(() => typed() !== undefined);
		self.setText = ko.pureComputed(() => _.sprintf(gettext("Set: %(label)s"), {label: ko.unwrap(self.label)}));

		self.text = ko.pureComputed({
			read: function () {
				if (self.isDirty()) return typed();
				const value = sent() === undefined ? ko.unwrap(params.value) : sent();
				return typeof value === "number" ? String(value) : "";
			},
			write: typed
		});

		self.send = function () {
			const text = String(typed() === undefined ? "" : typed()).replace(",", ".");
			const number = Number(text);
			const min = ko.unwrap(params.min);
			const max = ko.unwrap(params.max);
			const fits =
				text.trim() !== "" &&
				Number.isFinite(number) &&
				(typeof min !== "number" || number >= min) &&
				(typeof max !== "number" || number <= max);
			if (!fits) return;
			typed(undefined);
			const awaited = RRFModel.mark([root.querySelector("input")], params.send(number));
			// one that only sends shows nothing
			if (!awaited || ko.unwrap(params.value) === null) return;
			sent(number);
			awaited.always(() => sent() === number && sent(undefined));
		};

		self.onKey = function (_self, event) {
			if (event.key === "Escape") typed(undefined);
			return true;
		};
	};

	ko.components.register("rrf-number", {
		synchronous: true,
		viewModel: {
			createViewModel: (params, info) => new RrfNumber(params, info.element)
		},
		template: {element: "rrfmodel_number"}
	});
});
