/* What the machine does now, and what of what is shown is old: told alike wherever it is told. */
$(function () {
	const {isNumber} = RRFModel;
	/** A temperature that the line has told holds so long, and a value beside stale ones. */
	const FRESH_SECONDS = 10;
	/** A key that is asked for rarely is old by then, though the rest comes. */
	const RARE_SECONDS = 60;
	/** Nor is a position of a machine that has been at work since. */
	const MOVED_SECONDS = 2;
	/** From then on it is worth telling which line of a print takes its time. */
	const LINE_SECONDS = 2;
	/** The first box mode that waits for an answer. */
	const ANSWERED = 2;
	/** The warning that a box is open which can't be answered here. */
	const UNANSWERABLE = "message_box_unanswerable";
	/** States of the board that say nothing of a print that OctoPrint sends. */
	const SILENT = ["idle", "busy"];

	const match = (pattern, text) => (pattern.exec(text) || [])[1];

	/** The words of what the line is busy with; some commands tell more of it. */
	const doingText = function (doing) {
		const words = RRFModel.words;
		const [, code] = /^\s*([GM]\s*\d+)/i.exec(doing.command) || [];
		const exact = words.doingBy[(code || "").replace(/\s/g, "").toUpperCase()];
		if (exact) return exact;
		const tool = match(/^\s*T\s*(-?\d+)/i, doing.command);
		if (doing.what === "tool_change" && tool !== undefined)
			return Number(tool) < 0 ? words.toolAway : _.sprintf(words.toolChange, {tool: tool});
		const path = match(/^\s*M98\b[^"]*P\s*"((?:[^"]|"")*)"/i, doing.command);
		if (path) return _.sprintf(words.macro, {name: path.split("/").pop().replace(/""/g, '"')});
		return words.doing[doing.what] || words.status.busy;
	};

	/** Whether OctoPrint sends a print, also one that is paused. */
	RRFModel.isStreaming = octoprint => octoprint.isBusy() && !octoprint.sd();

	/** Whether nothing goes on before somebody answers; some firmware tells it by text alone. */
	const waits = (box, {doing, warnings}) =>
		(box && box.mode >= ANSWERED) ||
		(doing && (doing.what === "answer" || (warnings || []).some(warning => warning.code === UNANSWERABLE)));

	/** What OctoPrint's own print does, empty without one. */
	const streamedText = function (octoprint) {
		const words = RRFModel.words;
		if (!RRFModel.isStreaming(octoprint)) return "";
		if (octoprint.isCancelling()) return words.status.cancelling;
		if (octoprint.isPausing()) return words.status.pausing;
		if (octoprint.isPaused()) return words.status.paused;
		return words.streamed;
	};

	/**
	 * Adds to the core `now()`, the page's time; `elapsed()`, the seconds since the state came;
	 * `activity()`, the one statement of what the machine does; `oldness(isShown)`.
	 */
	RRFModel.addNow = function (core, octoprint) {
		core.now = ko.observable(Date.now());
		core.received.subscribe(() => core.now(Date.now()));
		window.setInterval(function () {
			if (core.isRrf() && !document.hidden) core.now(Date.now());
		}, 1000);

		core.elapsed = () => Math.max(0, core.now() - core.received().at) / 1000;
		core.age = ko.pureComputed(function () {
			const {age} = core.received();
			return isNumber(age) ? age + core.elapsed() : undefined;
		});

		core.ageText = ko.pureComputed(function () {
			const age = core.age();
			if (age === undefined) return gettext("no data yet");
			if (age < 60) return _.sprintf(gettext("%(seconds)d s ago"), {seconds: age});
			return _.sprintf(gettext("%(minutes)d min ago"), {minutes: age / 60});
		});

		const since = (text, seconds) =>
			seconds < 1 ? text : text + ", " + _.sprintf(gettext("%(seconds)d s"), {seconds: seconds});

		core.activity = ko.pureComputed(function () {
			const words = RRFModel.words;
			const told = core.status();
			const state = core.model("state") || {};
			const doing = told.doing;
			if (waits(state.messageBox, told)) return words.doing.answer;
			if (state.status === "halted") return words.status.halted;
			// what somebody has just asked for, until the machine says so itself
			if (core.asked()) return words.status[core.asked()] + "…";
			const print = streamedText(octoprint);
			const seconds = doing ? doing.since + core.elapsed() : 0;
			// most lines of a print are through before anybody has read of them
			const isTold = seconds >= LINE_SECONDS || !print;
			if (doing && isTold && (doing.what !== "other" || told.stale)) return since(doingText(doing), seconds);
			const known = told.stale ? "" : state.status || "";
			if (print && (!known || SILENT.includes(known))) return print;
			if (known) return words.status[known] || known;
			if (told.blocked) return words.blocked[told.blocked] || told.blocked;
			if (core.age() === undefined || !state.status) return gettext("Reading the model …");
			return since(gettext("The printer does not answer"), core.age());
		});

		const ageOf = function (key) {
			const ages = core.status().ages || {};
			return isNumber(ages[key]) ? ages[key] + core.elapsed() : core.age();
		};
		const isKeyOld = function (key) {
			const {doing, stale} = core.status();
			// who moves is elsewhere by now
			const isMoving = doing && doing.what !== "other" && ageOf(key) > MOVED_SECONDS;
			if (isMoving && key === "move") return true;
			if (!isNumber((core.status().ages || {})[key])) return !!stale;
			return ageOf(key) > (stale ? FRESH_SECONDS : RARE_SECONDS);
		};
		const heaterAge = function (index) {
			const ages = core.status().heater_ages || {};
			return isNumber(ages[index]) ? ages[index] + core.elapsed() : Infinity;
		};
		const isHeaterOld = index => isKeyOld("heat") && heaterAge(index) > FRESH_SECONDS;

		const title = seconds =>
			isNumber(seconds) && isFinite(seconds)
				? _.sprintf(gettext("Value of %(seconds)d s ago"), {seconds: seconds})
				: null;

		/**
		 * Whether something is old, and since when; nothing is computed unless `isShown()`.
		 * `heaters` is of those with these indices, `key` of a top-level key.
		 */
		core.oldness = isShown => ({
			key: key => isShown() && isKeyOld(key),
			keyTitle: key => (isShown() && isKeyOld(key) ? title(ageOf(key)) : null),
			heaters: indices => isShown() && indices.some(isHeaterOld),
			heatersTitle: function (indices) {
				const old = isShown() ? indices.filter(isHeaterOld) : [];
				const ages = old.map(index => Math.min(heaterAge(index), ageOf("heat")));
				return old.length ? title(Math.max(...ages)) : null;
			}
		});
	};
});
