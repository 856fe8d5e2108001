/* The tab over the whole window, for a large screen and for a tablet beside the machine. */
$(function () {
	const KEY = "rrfmodel.wide";
	const BODY_CLASS = "rrfmodel-wide";
	/** What a window of a phone is told while that is on, and what it takes without being told. */
	const FITTING = "width=device-width, initial-scale=1";
	const UNTOLD = "width=980";
	const VIEWPORT = "rrfmodel_viewport";

	// a browser may forbid to keep anything
	const kept = function () {
		try {
			return window.localStorage.getItem(KEY) === "true";
		} catch (error) {
			return false;
		}
	};
	const keep = function (isWide) {
		try {
			window.localStorage.setItem(KEY, String(isWide));
		} catch (error) {
			// it holds as long as the page does
		}
	};

	const tellViewport = function (isOn) {
		let told = document.getElementById(VIEWPORT);
		if (!told && !isOn) return;
		if (!told) {
			told = document.createElement("meta");
			told.id = VIEWPORT;
			told.name = "viewport";
			document.head.append(told);
		}
		told.content = isOn ? FITTING : UNTOLD;
	};

	/** Adds to the core `isWide`, whether somebody wants the tab so, and `flipWide`. */
	RRFModel.addWide = function (core) {
		core.isWide = ko.observable(kept());
		core.isWide.subscribe(keep);
		core.flipWide = () => core.isWide(!core.isWide());
		core.wideTitle = ko.pureComputed(() =>
			core.isWide() ? gettext("Back into the page") : gettext("Use the whole window")
		);

		// other tabs need OctoPrint's sidebar beside them
		const isOn = ko.pureComputed(() => core.isWide() && core.tabIsOpen());
		ko.computed(function () {
			document.body.classList.toggle(BODY_CLASS, isOn());
			tellViewport(isOn());
			// charts and the row of tabs measure themselves then
			ko.ignoreDependencies(() => window.dispatchEvent(new Event("resize")));
		}).extend({deferred: true});
	};
});
