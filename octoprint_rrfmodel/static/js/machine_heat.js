/* Heat in the sub-view Machine: a row for each heater of tools, beds and chambers. */
$(function () {
	const NO_TOOL = -1;
	const {list, numbered, isNumber} = RRFModel;
	/** States that a heater is switched to; others happen to it. */
	const CHOSEN = ["off", "standby", "active"];
	/** What a temperature profile of OctoPrint's calls the heaters of a kind. */
	const PROFILE = {tool: "extruder", bed: "bed", chamber: "chamber"};

	const target = value => (isNumber(value) && value > -273 ? value : null);

	/** A promise of several, whose `shown` ends with the last of theirs. */
	const together = function (promises) {
		const all = $.when(...promises);
		all.shown = $.when(...promises.map(promise => promise.shown || promise));
		return all;
	};

	/** Returns the members of a view model over the model of its view. */
	RRFModel.heatRows = function (core, model) {
		const self = {};
		const words = RRFModel.words;
		const show = RRFModel.show;

		const heat = ko.pureComputed(() => model("heat") || {});
		const state = ko.pureComputed(() => model("state") || {});
		const extruders = ko.pureComputed(() => list((model("move") || {}).extruders));
		const heaters = ko.pureComputed(() => list(heat().heaters));
		const old = core.oldness(core.isShown("machine"));
		const curveOf = RRFModel.curves(core);
		const heaterOf = index => heaters()[index] || {};

		/** What OctoPrint's user has given names to, for heaters of a kind. */
		const presetsOf = (kind, send) =>
			ko.pureComputed(() =>
				list(core.settings.temperature_profiles())
					.filter(profile => Number(profile[PROFILE[kind]]) > 0)
					.map(function (profile) {
						const degrees = Number(profile[PROFILE[kind]]);
						return {text: profile.name + " " + degrees + " °C", run: () => send(degrees)};
					})
					.concat({text: "0 °C", run: () => send(0)})
			);

		/**
		 * One row of the table. `owner` has what a tool or slot is, the rest is of its heater at
		 * `place`; `states` is left out for the further heaters of a tool.
		 */
		const heaterRow = function (owner, place) {
			const row = {owner: owner, kind: owner.kind, isFirst: place === 0};
			row.heater = ko.pureComputed(() => owner.heaters()[place]);
			row.name = ko.pureComputed(() =>
				owner.heaters().length > 1
					? _.sprintf("%(name)s (%(place)s)", {name: owner.name(), place: place + 1})
					: owner.name()
			);
			const heater = ko.pureComputed(() => heaterOf(row.heater()));
			row.hasHeater = ko.pureComputed(() => row.heater() !== undefined);
			row.current = ko.pureComputed(() => show.degrees(heater().current));
			row.isOld = ko.pureComputed(() => row.hasHeater() && old.heaters([row.heater()]));
			row.oldTitle = ko.pureComputed(() => old.heatersTitle([row.heater()]));
			row.state = ko.pureComputed(() => owner.stateOf(row.heater(), heater().state || ""));
			// off, standby and active are told by the button that is pressed
			row.alarm = ko.pureComputed(() =>
				!row.state() || CHOSEN.includes(row.state()) ? "" : (words.heater[row.state()] || {text: row.state()}).text
			);
			row.isFault = ko.pureComputed(() => row.state() === "fault");
			row.resetFault = () => core.command("reset_heater_fault", {heater: row.heater()});
			row.curve = ko.pureComputed(() => curveOf(row.heater()));
			const field = (member, text) => ({
				min: ko.pureComputed(() => heater().min),
				max: ko.pureComputed(() => heater().max),
				value: ko.pureComputed(() => target(owner[member]()[place])),
				label: ko.pureComputed(() => _.sprintf(text, {name: row.name()})),
				send: value => owner.send(member, place, value)
			});
			row.active = field("active", gettext("Active temperature of %(name)s"));
			row.standby = owner.states.includes("standby")
				? field("standby", gettext("Standby temperature of %(name)s"))
				: null;
			row.presets = presetsOf(owner.kind, row.active.send);
			row.presetsLabel = ko.pureComputed(() => _.sprintf(gettext("Temperatures for %(name)s"), {name: row.name()}));
			row.isWaiting = ko.pureComputed(() => row.active.value() > 0 && ["off", "standby"].includes(row.state()));
			row.states = !row.isFirst
				? []
				: owner.states.map(name => ({
						test: (owner.kind === "tool" ? "tool-" : "state-") + name,
						text: self.stateTexts[name],
						isPressed: ko.pureComputed(() => row.state() === name),
						// to give a temperature heats nothing by itself
						isNext: ko.pureComputed(() => name === "active" && row.isWaiting()),
						title: ko.pureComputed(() =>
							name === "active" && row.isWaiting()
								? _.sprintf(gettext("Heat to %(degrees)s °C"), {
										degrees: row.active.value()
									})
								: null
						),
						run: () => owner.setState(name)
					}));
			return row;
		};

		self.stateTexts = {
			off: gettext("Off"),
			standby: gettext("Standby"),
			active: gettext("Active")
		};

		const addRows = function (owner) {
			const places = ko.pureComputed(() => Math.max(1, owner.heaters().length));
			owner.rows = ko.pureComputed(() => _.range(places()).map(place => heaterRow(owner, place)));
		};

		//~~ tools

		self.tools = RRFModel.rows(
			function () {
				const tools = model("tools");
				return numbered(tools).map(function (found) {
					const tool = found.item;
					const count = list(tool.heaters).length;
					const fed = extruders()[list(tool.extruders)[0]] || {};
					return {
						key: found.index,
						number: tool.number,
						name: tool.name || _.sprintf(gettext("Tool %(number)s"), tool),
						isSelected: state().currentTool === tool.number,
						heaters: list(tool.heaters),
						active: list(tool.active).slice(0, count),
						standby: list(tool.standby).slice(0, count),
						filament: fed.filament || "",
						isFed: list(tool.extruders).length > 0
					};
				});
			},
			function (row) {
				row.kind = "tool";
				row.states = CHOSEN;
				row.select = () => core.command("select_tool", {tool: row.number()});
				row.stateOf = function (heater, known) {
					const tools = list(model("tools"));
					const tool = tools[row.key] || {};
					// a tool stays what it was when only its heaters are switched off (M568 A0)
					return RRFModel.ownState(tool, tools, heater, known);
				};
				const given = {
					active: RRFModel.lastGiven(core, () => row.active()),
					standby: RRFModel.lastGiven(core, () => row.standby())
				};
				row.send = function (member, place, value) {
					// -273 and below is how firmware says off, and no temperature to ask for
					const values = given[member].values().map(known => (known <= -273 ? 0 : known));
					values[place] = value;
					const sent = {[member]: values.length > 1 ? values : value};
					return given[member].send(
						values,
						core.command("tool_temperatures", Object.assign({tool: row.number()}, sent))
					);
				};
				row.setState = name => core.command("tool_state", {tool: row.number(), state: name});
				addRows(row);
			}
		);

		self.noTool = ko.pureComputed(() => state().currentTool === NO_TOOL);
		const selected = ko.pureComputed(() => self.tools().find(tool => tool.isSelected()));
		self.loadedText = ko.pureComputed(function () {
			const tool = selected();
			return tool ? "T" + tool.number() + ": " + (tool.filament() || gettext("none")) : "";
		});
		self.whyNoFilament = ko.pureComputed(
			() => core.forbidden("filament") || (selected() ? null : gettext("Select a tool first."))
		);
		self.deselect = () => core.command("select_tool", {tool: NO_TOOL});

		//~~ beds, chambers

		self.slots = RRFModel.rows(
			function () {
				return [
					{command: "bed", indices: heat().bedHeaters, title: gettext("Bed")},
					{command: "chamber", indices: heat().chamberHeaters, title: gettext("Chamber")}
				].flatMap(kind =>
					numbered(list(kind.indices).map(index => heaters()[index])).map(found => ({
						key: kind.command + found.index,
						index: found.index,
						heaters: [kind.indices[found.index]],
						name: found.index ? kind.title + " " + found.index : kind.title,
						active: [found.item.active],
						standby: [found.item.standby]
					}))
				);
			},
			function (row) {
				row.kind = row.key.replace(/\d+$/, "");
				row.states = row.kind === "bed" ? CHOSEN : ["off", "active"];
				row.stateOf = (_heater, known) => known;
				const send = values => core.command(row.kind, Object.assign({index: row.index()}, values));
				const active = RRFModel.lastGiven(core, () => row.active());
				row.send = function (member, _place, value) {
					const promise = send({[member]: value});
					return member === "active" ? active.send([value], promise) : promise;
				};
				// what only switches a chamber on is its temperature, which the server takes from
				// its model
				row.setState = function (name) {
					const [known] = active.values();
					const needsTarget = name === "active" && row.kind === "chamber";
					return send({state: name, active: needsTarget && isNumber(known) ? known : null});
				};
				addRows(row);
			}
		);

		const owners = () => self.tools().concat(self.slots());
		self.heaters = ko.pureComputed(() => owners().flatMap(owner => owner.rows()));
		self.hasHeat = ko.pureComputed(() => self.heaters().some(row => row.hasHeater()));

		const allOff = () =>
			together(
				owners()
					.filter(owner => owner.heaters().length)
					.map(owner => owner.setState("off"))
			);
		/** Asks where a print would suffer. */
		self.allOff = () =>
			core.forbidden("home")
				? core.confirm(gettext("Switch all heaters off?"), gettext("The print needs them."), gettext("All off"), allOff)
				: allOff();
		return self;
	};
});
