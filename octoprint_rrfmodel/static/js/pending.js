/* What somebody has clicked on is marked as under way until something comes of it. */
$(function () {
	const open = new WeakMap();

	const count = function (element, change) {
		const left = (open.get(element) || 0) + change;
		open.set(element, left);
		if (left) element.setAttribute("aria-busy", "true");
		else element.removeAttribute("aria-busy");
	};

	/**
	 * Marks elements with `aria-busy=true` while a promise is open, or its `shown`, and with each the
	 * control of class `rrfmodel-control` that it is of. Returns what it waits for.
	 */
	RRFModel.mark = function (elements, promise) {
		const awaited = (promise && promise.shown) || promise;
		if (!awaited || !awaited.always) return null;
		const marked = new Set(elements);
		elements.forEach(function (element) {
			const control = element.closest(".rrfmodel-control");
			if (control) marked.add(control);
		});
		marked.forEach(element => count(element, 1));
		return awaited.always(() => marked.forEach(element => count(element, -1)));
	};

	/** `does: action` is `click: action` of a button whose action returns a promise, or none. */
	ko.bindingHandlers.does = {
		init: function (element, valueOf, _all, _model, context) {
			const run = function (data, event) {
				RRFModel.mark([element], valueOf().call(data, data, event));
			};
			ko.applyBindingsToNode(element, {click: run}, context);
		}
	};
});
