/* What one turns while something is printed: factors, baby step, fan, temperatures. */
$(function () {
	const BABYSTEPS = [-0.05, -0.02, 0.02, 0.05];
	const {list, numbered, isNumber} = RRFModel;

	/** By kind of row: how far one click goes, the limits, and the command that sets a value. */
	const KINDS = {
		speed: {step: 5, unit: "%", min: 1, max: 1000, command: () => ["speed_factor", "percent"]},
		flow: {
			step: 1,
			unit: "%",
			min: 1,
			max: 1000,
			command: row => ["extrusion_factor", "percent", {extruder: row.index()}]
		},
		fan: {
			step: 5,
			unit: "%",
			min: 0,
			max: 100,
			command: row => ["fan", "speed", {fan: row.index()}],
			convert: percent => percent / 100
		},
		tool: {
			step: 5,
			unit: "°C",
			min: 0,
			command: row => ["tool_temperatures", "active", {tool: row.index()}]
		},
		bed: {step: 5, unit: "°C", min: 0, command: row => ["bed", "active", {index: row.index()}]},
		chamber: {
			step: 5,
			unit: "°C",
			min: 0,
			command: row => ["chamber", "active", {index: row.index()}]
		}
	};
	const signed = (amount, unit) => (amount > 0 ? "+" : "−") + Math.abs(amount) + " " + unit;

	/** Returns the rows of the print that `isOn()` tells of. */
	RRFModel.jobControls = function (core, model, isOn) {
		const self = {};
		const show = RRFModel.show;
		const old = core.oldness(isOn);
		const move = ko.pureComputed(() => (isOn() && model("move")) || {});
		const percentOf = fraction => (isNumber(fraction) ? Math.round(fraction * 100) : null);

		const factors = () => [{key: "speed", kind: "speed", name: gettext("Speed"), value: percentOf(move().speedFactor)}];
		const flows = function (tool) {
			const used = tool && list(tool.extruders);
			return numbered(move().extruders)
				.filter(found => !used || used.includes(found.index))
				.map(found => ({
					key: "flow" + found.index,
					kind: "flow",
					index: found.index,
					name: _.sprintf(gettext("Flow of E%(number)s"), {number: found.index}),
					value: percentOf(found.item.factor)
				}));
		};
		const partFan = function (tool) {
			const index = (tool && list(tool.fans)[0]) || 0;
			const fan = list(model("fans"))[index];
			const rule = (fan && fan.thermostatic) || {};
			if (!fan || list(rule.sensors || rule.heaters).length) return [];
			const value = percentOf(fan.requestedValue);
			return [{key: "fan", kind: "fan", index: index, name: gettext("Part fan"), value: value}];
		};
		const heater = function (kind, index, number, name, more) {
			const found = list((model("heat") || {}).heaters)[number] || {};
			const target = isNumber(found.active) && found.active > -273 ? found.active : null;
			return Object.assign(
				{
					key: kind + index,
					kind: kind,
					index: index,
					name: name,
					heaters: [number],
					current: show.degrees(found.current) + " °C",
					value: target,
					most: found.max
				},
				more
			);
		};
		const heaters = function (tool) {
			const heat = model("heat") || {};
			const slots = (kind, indices, title) =>
				list(indices)
					.map((number, index) => ({number: number, index: index}))
					.filter(slot => slot.number >= 0)
					.map(slot => heater(kind, slot.index, slot.number, title + (slot.index ? " " + slot.index : "")));
			const own = list((tool || {}).heaters);
			return own
				.map((number, place) =>
					heater("tool", tool.number, number, "E" + tool.number + (place ? " (" + (place + 1) + ")" : ""), {
						key: "tool" + tool.number + "-" + place,
						place: place,
						actives: list(tool.active).slice(0, own.length).join(),
						value: isNumber(list(tool.active)[place]) ? tool.active[place] : null
					})
				)
				.concat(slots("bed", heat.bedHeaters, gettext("Bed")))
				.concat(slots("chamber", heat.chamberHeaters, gettext("Chamber")));
		};

		self.rows = RRFModel.rows(
			function () {
				if (!isOn()) return [];
				const number = (model("state") || {}).currentTool;
				const tool = list(model("tools")).find(each => each && each.number === number);
				const rows = [factors(), flows(tool), partFan(tool), heaters(tool)];
				const empty = {current: "", heaters: [], index: 0, place: 0, actives: "", most: null};
				return _.flatten(rows).map(row => Object.assign({}, empty, row));
			},
			function (row) {
				const kind = KINDS[row.kind()];
				const given = RRFModel.lastGiven(core, () => [row.value()]);
				const most = () => (isNumber(row.most()) ? row.most() : kind.max);
				row.unit = kind.unit;
				row.min = kind.min;
				row.max = ko.pureComputed(most);
				row.test = {speed: "speed-factor", flow: "flow"}[row.kind()] || row.kind();
				row.isOld = ko.pureComputed(() => old.heaters(row.heaters()));
				row.send = function (value) {
					const [name, member, more] = kind.command(row);
					let sent = kind.convert ? kind.convert(value) : value;
					if (row.actives().includes(",")) {
						sent = row.actives().split(",").map(Number);
						sent[row.place()] = value;
					}
					return given.send([value], core.command(name, Object.assign({[member]: sent}, more)));
				};
				/** What was given last: who types the old value again has changed it back. */
				row.shown = ko.pureComputed(() => given.values()[0]);
				/** A step away from what nobody knows would be one away from nothing. */
				row.isKnown = ko.pureComputed(() => isNumber(row.shown()));
				row.turns = [-kind.step, kind.step].map(step => ({
					text: step > 0 ? "+" : "−",
					label: ko.pureComputed(() => row.name() + ": " + signed(step, kind.unit)),
					run: function () {
						const limit = most();
						const wanted = Math.max(kind.min, row.shown() + step);
						return row.send(isNumber(limit) ? Math.min(limit, wanted) : wanted);
					}
				}));
			}
		);

		const z = ko.pureComputed(() => list(move().axes).find(axis => axis && axis.letter === "Z"));
		self.hasBabystep = ko.pureComputed(() => !!z());
		self.babystep = ko.pureComputed(() => show.fixed((z() || {}).babystep, 3) + " mm");
		const step = (amount, more) => () => core.command("babystep", Object.assign({axis: "Z", amount: amount}, more));
		self.babysteps = BABYSTEPS.map(amount => ({
			text: (amount > 0 ? "+" : "−") + Math.abs(amount),
			label: _.sprintf(gettext("Baby step of %(amount)s mm"), {amount: amount}),
			run: step(amount)
		}));
		self.clearBabystep = step(0, {absolute: true});

		self.whyNot = ko.pureComputed(() => (isOn() && core.forbidden("fan")) || null);
		self.may = ko.pureComputed(() => core.mayControl() && !self.whyNot());
		return self;
	};
});
