/* What is wrong, each thing once and in one wording, with the button that mends it. */
$(function () {
	const {list, object} = RRFModel;

	/** Titles of the boxes by which the firmware tells of a fault, and the words of one. */
	const EVENTS = ["Event notification", "Printing paused"];
	const HEATER_FAULT = /\bHeater (\d+) fault/;
	/** The last mode of a box that waits for nobody. */
	const CLOSED_AT_WILL = 1;

	const isFault = warning => /^heater_fault/.test(warning.code);
	const numberOf = warning => Number(object(warning.values).number);
	/** Warnings and what they come of. */
	const all = warnings => list(warnings).flatMap(each => [each, ...list(each.causes)]);

	/** Which permission a command needs that mends something. */
	const NEEDED_FOR = {
		recover: "PLUGIN_RRFMODEL_CONTROL",
		reset_heater_fault: "PLUGIN_RRFMODEL_CONTROL",
		reconnect: "CONNECTION",
		fix_settings: "SETTINGS",
		fix_profile: "SETTINGS"
	};

	/** The name of a heater as people know it: its tool's, its bed's or chamber's; else its number. */
	RRFModel.heaterName = function (core, index) {
		const heat = object(core.model("heat"));
		const tool = list(core.model("tools")).find(candidate => candidate && list(candidate.heaters).includes(index));
		if (tool) {
			const place = tool.heaters.indexOf(index);
			const name = tool.name || "T" + tool.number;
			return place ? name + " (" + (place + 1) + ")" : name;
		}
		const slots = [
			[heat.bedHeaters, gettext("Bed")],
			[heat.chamberHeaters, gettext("Chamber")]
		];
		for (const [heaters, name] of slots) {
			const slot = list(heaters).indexOf(index);
			if (slot >= 0) return slot ? name + " " + slot : name;
		}
		return String(index);
	};

	/**
	 * Adds to the core `alerts()`, rows of `key`, `level`, `texts`, `text` and `fix`, a command with
	 * `values` and its button's `text`, or null; `mend(row)`; `isTold(box)`, whether one says it too.
	 */
	RRFModel.addAlerts = function (core) {
		const tellsEvent = box => box && box.mode <= CLOSED_AT_WILL && EVENTS.includes(box.title);

		const nameOf = index => RRFModel.heaterName(core, index);

		const fixOf = function (warning) {
			const words = RRFModel.words;
			const [name, values] = isFault(warning)
				? ["reset_heater_fault", {heater: numberOf(warning)}]
				: [warning.fix, undefined];
			if (!NEEDED_FOR[name] || !core.may(NEEDED_FOR[name])) return null;
			return {name: name, values: values, text: words.fix[name]};
		};

		core.alerts = ko.pureComputed(function () {
			if (!core.mayRead()) return [];
			const warnings = list(core.status().warnings);
			// what has paused a print is told with that
			const causes = new Set(warnings.flatMap(warning => list(warning.causes).map(cause => cause.code)));
			const rows = [];
			warnings
				.filter(warning => !causes.has(warning.code))
				.forEach(function (warning) {
					const text = RRFModel.warningText(warning, nameOf);
					const fix = all([warning]).map(fixOf).find(Boolean) || null;
					const last = rows[rows.length - 1];
					if (fix && last && _.isEqual(last.fix, fix)) {
						last.texts.push(text);
						return;
					}
					// why a print is paused may change while it is
					const key = JSON.stringify([warning.code, warning.values, warning.causes]);
					rows.push({key: key, level: warning.level, texts: [text], fix: fix});
				});
			return rows.map(row => Object.assign(row, {text: row.texts.join(" ")}));
		});
		// the same ones stay as they are, or a screen reader would tell them with each message
		core.alerts.equalityComparer = _.isEqual;

		core.mend = function (row) {
			const told = core.command(row.fix.name, row.fix.values);
			const box = object(core.latest.state).messageBox;
			// its text was the alert's, and nobody has seen it as a box
			if (row.fix.name === "reset_heater_fault" && tellsEvent(box))
				told.done(() => core.command("message_box", {action: "ok", seq: box.seq}));
			return told;
		};

		const known = new Set();
		core.isTold = function (box) {
			if (!tellsEvent(box)) return false;
			const key = [box.seq, box.message].join();
			const number = Number((HEATER_FAULT.exec(box.message) || [])[1]);
			core.model("heat");
			// the latest, as both come with one message; the line may tell of a fault before
			const heater = object(list(object(core.latest.heat).heaters)[number]);
			const isWarned = all(core.status().warnings).some(each => isFault(each) && numberOf(each) === number);
			if (isWarned || heater.state === "fault") known.add(key);
			// nor is it news when the fault is over
			return known.has(key);
		};
	};
});
