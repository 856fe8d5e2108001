/* The sidebar: what RepRapFirmware says of the machine, as it comes by push. */
$(function () {
	let words;

	const show = RRFModel.show;

	/** Returns the row of a heater. */
	function heaterRow(key, name, heater, index) {
		const state = words.heater[heater.state] || {text: heater.state || "", label: ""};
		return {
			key: key,
			name: name,
			index: index,
			current: show.degrees(heater.current),
			active: show.target(heater.active),
			standby: show.target(heater.standby),
			state: heater.state || "",
			stateText: state.text,
			labelClass: state.label
		};
	}

	/** Returns a row for each heater, after the first tool that has it. */
	function heaterRows(model) {
		const heat = model.heat || {};
		const heaters = heat.heaters || [];
		const rows = [];
		const seen = new Set();
		(model.tools || []).forEach(function (tool, number) {
			if (!tool) return;
			(tool.heaters || []).forEach(function (index, place) {
				if (!heaters[index] || seen.has(index)) return;
				seen.add(index);
				const title = tool.name || _.sprintf(gettext("Tool %(number)s"), tool);
				const name = place ? title + " (" + (place + 1) + ")" : title;
				// two tools may have one name
				rows.push(heaterRow("tool" + number + "." + place, name, heaters[index], index));
			});
		});
		[
			{slots: heat.bedHeaters, key: "bed", title: gettext("Bed")},
			{slots: heat.chamberHeaters, key: "chamber", title: gettext("Chamber")}
		].forEach(function (kind) {
			(kind.slots || []).forEach(function (index, slot) {
				if (!heaters[index]) return;
				const name = slot ? kind.title + " " + slot : kind.title;
				rows.push(heaterRow(kind.key + slot, name, heaters[index], index));
			});
		});
		return rows;
	}

	/** Returns a mark for each axis that is meant to be seen. */
	function axisMarks(model) {
		const axes = (model.move || {}).axes || [];
		return axes
			.filter(function (axis) {
				return axis && axis.letter && axis.visible !== false;
			})
			.map(function (axis) {
				// as the tab has it: with workplace and tool
				const position = show.fixed(axis.userPosition, 2);
				return {
					key: axis.letter,
					letter: axis.letter,
					position: position === "–" ? show.fixed(axis.machinePosition, 2) : position,
					homed: !!axis.homed,
					title: axis.homed ? gettext("homed") : gettext("not homed")
				};
			});
	}

	function RrfModelSidebarViewModel(parameters) {
		const self = this;

		const core = parameters[0];
		words = RRFModel.words;

		self.status = core.status;

		self.mayRead = core.mayRead;

		/** The model's top-level keys that the sidebar shows. */
		self.model = ko.pureComputed(() => ({
			state: core.model("state"),
			heat: core.model("heat"),
			move: core.model("move"),
			tools: core.model("tools")
		}));

		self.isShown = core.isRrf;
		self.mayRead = core.mayRead;

		/** Whether a row is wanted; every one can be folded away in the settings. */
		self.wants = function (row) {
			const plugins = (core.settings.settings || {}).plugins;
			const rows = plugins && plugins.rrfmodel && plugins.rrfmodel.sidebar;
			// who may not read settings has all of them
			return !rows || !rows[row] || ko.unwrap(rows[row]);
		};

		self.state = ko.pureComputed(function () {
			return self.model().state || {};
		});

		self.statusText = core.activity;
		const old = core.oldness(core.pageIsVisible);
		self.isStale = ko.pureComputed(() => old.key("move"));
		self.staleTitle = ko.pureComputed(() => old.keyTitle("move"));

		self.toolText = ko.pureComputed(function () {
			const number = self.state().currentTool;
			if (typeof number !== "number") return "–";
			if (number < 0) return gettext("none");
			const tool = (self.model().tools || []).find(function (candidate) {
				return candidate && candidate.number === number;
			});
			return tool && tool.name ? number + " (" + tool.name + ")" : String(number);
		});

		self.heaters = RRFModel.rows(
			() => heaterRows(self.model()),
			function (row) {
				row.isOld = ko.pureComputed(() => old.heaters([row.index()]));
				row.title = ko.pureComputed(() => old.heatersTitle([row.index()]));
			}
		);
		self.axes = RRFModel.rows(() => axisMarks(self.model()));

		self.message = ko.pureComputed(() => self.state().displayMessage || "");

		self.fans = RRFModel.rows(() =>
			(core.model("fans") || [])
				.map((fan, index) => ({fan: fan, index: index}))
				.filter(found => !!found.fan)
				.map(found => ({
					key: found.index,
					name: found.fan.name || _.sprintf(gettext("Fan %(number)s"), {number: found.index}),
					speed: show.percent(found.fan.actualValue),
					rpm: found.fan.rpm >= 0 ? found.fan.rpm + " " + gettext("rpm") : ""
				}))
		);

		self.speedFactor = ko.pureComputed(() => show.percent((self.model().move || {}).speedFactor));
		self.extrusionFactors = ko.pureComputed(() =>
			((self.model().move || {}).extruders || []).map(extruder => show.percent((extruder || {}).factor)).join(" / ")
		);

		const job = ko.pureComputed(() => core.model("job") || {});
		self.layerText = ko.pureComputed(function () {
			if (typeof job().layer !== "number") return "";
			const layers = (job().file || {}).numLayers;
			return layers ? job().layer + " / " + layers : String(job().layer);
		});
		self.leftText = ko.pureComputed(function () {
			const left = job().timesLeft || {};
			const known = [left.slicer, left.filament, left.file].find(seconds => typeof seconds === "number");
			return known === undefined ? "" : show.duration(known);
		});

		self.tellsInTab = ko.pureComputed(() => core.tabIsOpen() && core.pageIsVisible());

		/** Warnings to show; the strip tells them where it is seen. */
		self.warnings = ko.pureComputed(() =>
			self.tellsInTab()
				? []
				: core.alerts().map(alert =>
						Object.assign({}, alert, {
							kind: alert.level === "advice" ? "advice" : "warning",
							levelClass: "rrfmodel-" + alert.level
						})
					)
		);
		// the same warnings stay as they are, or a screen reader would tell them with each message
		self.warnings.equalityComparer = _.isEqual;

		self.fix = core.mend;

		self.firmwareText = ko.pureComputed(function () {
			const firmware = self.status().firmware;
			return firmware ? [firmware.name, firmware.version].filter(Boolean).join(" ") : "";
		});

		self.ageText = core.ageText;
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelSidebarViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#sidebar_plugin_rrfmodel"]
	});
});
