/* When the machine shows the effect of a command: until then it is under way. */
$(function () {
	const {list, object} = RRFModel;

	/** How often the state is asked for while something is under way and nothing is pushed. */
	const ASK_MS = 1000;
	/** The model is pushed a little later than a state that is asked for. */
	const PUSHED_MS = 700;
	/** What is not shown so long after it is through has been refused. */
	const REFUSED_MS = 2500;
	/** And so long after the line was free last nothing will come of it any more. */
	const MOST_MS = 60000;
	/** A reply to a command may be that late. */
	const REPLY_MS = 5000;

	const GOING_ON = ["processing", "simulating", "pausing", "resuming", "cancelling"];

	const near = (one, other) => Math.abs(one - other) < 0.006;
	/** Whether a list of the model has these values: one for all of them, or one each. */
	const has = (told, wanted) =>
		wanted === undefined ||
		wanted === null ||
		list(told).every((value, place) => near(value, Array.isArray(wanted) ? wanted[place] : wanted));
	const status = seen => object(seen.of("state")).status;
	const toolOf = (seen, number) => list(seen.of("tools")).find(tool => tool && tool.number === number) || {};

	const slot = name => (values, seen) => {
		const heat = object(seen.of("heat"));
		const heater = object(list(heat.heaters)[list(heat[name])[values.index || 0]]);
		return (
			has([heater.active], values.active) &&
			has([heater.standby], values.standby) &&
			(!values.state || heater.state === values.state)
		);
	};

	/** What a job has become, by the action. */
	const JOB = {
		pause: seen => status(seen) === "paused" || !GOING_ON.includes(status(seen)),
		resume: seen => status(seen) === "processing" || status(seen) === "simulating",
		cancel: seen => ![...GOING_ON, "paused"].includes(status(seen)),
		start: seen => GOING_ON.includes(status(seen)),
		simulate: seen => GOING_ON.includes(status(seen))
	};

	const isStill = (_values, seen) => seen.isThrough && status(seen) !== "busy";
	const isOver = (_values, seen) => seen.isThrough && !seen.told.doing;

	/** Command to whether the machine shows it; what isn't here shows when it is through. */
	const SHOWS = {
		tool_temperatures: (values, seen) =>
			has(toolOf(seen, values.tool).active, values.active) && has(toolOf(seen, values.tool).standby, values.standby),
		tool_state: (values, seen) => toolOf(seen, values.tool).state === values.state,
		select_tool: (values, seen) => !seen.told.doing && object(seen.of("state")).currentTool === values.tool,
		bed: slot("bedHeaters"),
		chamber: slot("chamberHeaters"),
		reset_heater_fault: (values, seen) =>
			object(list(object(seen.of("heat")).heaters)[values.heater]).state !== "fault",
		fan: (values, seen) => near(object(list(seen.of("fans"))[values.fan]).requestedValue, values.speed),
		home: isOver,
		macro: isOver,
		mesh: isOver,
		filament: isOver,
		script: isOver,
		jog: isStill,
		extrude: isStill,
		speed_factor: (values, seen) => near(object(seen.of("move")).speedFactor, values.percent / 100),
		extrusion_factor: (values, seen) =>
			near(object(list(object(seen.of("move")).extruders)[values.extruder]).factor, values.percent / 100),
		message_box: function (values, seen) {
			const box = object(seen.of("state")).messageBox;
			return !box || (values.seq !== undefined && box.seq !== values.seq);
		},
		object: function (values, seen) {
			const build = object(object(seen.of("job")).build);
			const isCancelled = !!object(list(build.objects)[values.index]).cancelled;
			return isCancelled === (values.action === "cancel");
		},
		job: (values, seen) => JOB[values.action](seen),
		power: (values, seen) => object(seen.of("state")).atxPower === values.on,
		emergency_stop: (_values, seen) => status(seen) === "halted" || !seen.told.connected,
		recover: (_values, seen) => !!seen.told.connected && !!seen.told.ready && status(seen) !== "halted",
		reconnect: (_values, seen) => !!seen.told.connected && !!seen.told.ready,
		octoprint_pause: (_values, seen) => seen.octoprint.isPaused() || !seen.octoprint.isBusy(),
		octoprint_resume: (_values, seen) => !seen.octoprint.isPaused(),
		octoprint_cancel: (_values, seen) => !seen.octoprint.isBusy()
	};

	/** What is as good as done with the server's answer: it is OctoPrint's own. */
	const AT_ONCE = ["fix_settings", "restore_settings", "fix_profile", "wizard_done"];
	/** What may take longer than the machine is without a word. */
	const LONG = ["recover", "reconnect", "octoprint_cancel", "octoprint_pause"];

	/** The word for what was asked of a job until the machine says so itself. */
	const ASKED = {pause: "pausing", resume: "resuming", cancel: "cancelling"};
	const askedOf = (name, values) => ASKED[name === "job" ? values.action : (/^octoprint_(.*)/.exec(name) || [])[1]];

	/**
	 * Adds to the core `awaited(name, values, promise)`, the promise with another, `shown`, until its
	 * effect shows or it is refused; `asked()`, the state.status that the job is to have, or "";
	 * `awaitsReplies()`, whether replies may be about this page.
	 */
	RRFModel.addEffects = function (core, octoprint) {
		const open = new Set();
		const asked = ko.observableArray();
		let closedAt = -Infinity;

		core.asked = ko.pureComputed(() => asked()[asked().length - 1] || "");
		core.awaitsReplies = () => open.size > 0 || Date.now() - closedAt < REPLY_MS;

		window.setInterval(function () {
			// a state is pushed where something has changed
			if (!open.size || Date.now() - core.received().at < ASK_MS) return;
			OctoPrint.plugins.rrfmodel.getStatus().done(core.fromLaterStatus);
		}, ASK_MS);

		/** Follows what comes of a command that the server has taken; calls `end` then. */
		const follow = function (name, values, end) {
			// the answer to the second question from now on was asked for behind the command
			const answers = [];
			let freeAt = Date.now();
			let since = null;
			let throughAt = null;
			const note = function (told) {
				if (since === null) return;
				if (told.doing) freeAt = Date.now();
				const applied = told.at - told.age;
				const last = answers.length ? answers[answers.length - 1] : since;
				if (typeof told.age === "number" && applied > last + 0.01 && answers.length < 2) answers.push(applied);
				if (answers.length === 2 && throughAt === null) throughAt = Date.now();
			};
			const shows = SHOWS[name];
			const seen = ko.pureComputed(function () {
				const told = core.status();
				note(told);
				const isThrough = throughAt !== null;
				return !!shows && shows(values, {of: core.model, isThrough, told, octoprint});
			});
			const look = function () {
				const patience = shows && !LONG.includes(name) ? REFUSED_MS : PUSHED_MS;
				const isThrough = throughAt !== null && Date.now() - throughAt > patience;
				const isMute = Date.now() - freeAt > MOST_MS;
				const waits = LONG.includes(name) || [isStill, isOver].includes(shows);
				if ((since !== null && seen()) || (isThrough && !waits) || isMute) stop();
			};
			const subscription = seen.subscribe(look);
			const timer = window.setInterval(look, 200);
			const stop = function () {
				subscription.dispose();
				window.clearInterval(timer);
				end();
			};
			OctoPrint.plugins.rrfmodel
				.getStatus()
				.done(told => {
					since = told.at;
					core.fromLaterStatus(told);
					look();
				})
				.fail(() => (since = core.status().at));
		};

		core.awaited = function (name, values, promise) {
			const shown = $.Deferred();
			const token = {};
			const word = askedOf(name, values || {});
			open.add(token);
			if (word) asked.push(word);
			const end = function () {
				open.delete(token);
				closedAt = Date.now();
				if (word) asked.splice(asked.indexOf(word), 1);
				shown.resolve();
			};
			promise.fail(end);
			promise.done(() => (AT_ONCE.includes(name) ? end() : follow(name, values || {}, end)));
			promise.shown = shown.promise();
			return promise;
		};
	};
});
