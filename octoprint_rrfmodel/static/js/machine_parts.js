/* The sub-view Machine, below and folded: what is looked at or set now and then. */
$(function () {
	const {list, numbered, object, isNumber, show} = RRFModel;

	function RrfModelMachinePartsViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const model = core.modelOfView("machine");

		self.isShown = ko.pureComputed(() => core.isRrf() && core.view() === "machine");
		self.mayControl = core.mayControl;
		/** What is folded and not in its section's line is not computed. */
		RRFModel.addFolds(self);
		const isOpen = name => self.folds[name].isOpen();

		const sensors = ko.pureComputed(() => object(model("sensors")));
		const state = ko.pureComputed(() => object(model("state")));
		const move = ko.pureComputed(() => object(model("move")));
		const HARMLESS = ["", "ok", "noDataReceived", "noMonitor"];

		self.endstops = RRFModel.rows(() =>
			numbered(sensors().endstops).map(found => ({
				key: found.index,
				name: object(list(move().axes)[found.index]).letter || String(found.index),
				text: found.item.triggered ? gettext("triggered") : gettext("open"),
				isTriggered: !!found.item.triggered
			}))
		);

		/** Those that are triggered, which is what one looks for. */
		self.endstopsSummary = ko.pureComputed(function () {
			if (!self.endstops().length) return "";
			const found = self.endstops().filter(each => each.isTriggered());
			return found.length
				? _.sprintf(gettext("endstops triggered: %(axes)s"), {
						axes: found.map(each => each.name()).join(" ")
					})
				: gettext("endstops open");
		});

		self.may = command => core.mayControl() && !core.forbidden(command);
		self.why = command => core.forbidden(command) || null;
		Object.assign(self, RRFModel.tuning(core, model, isOpen), RRFModel.morePanels(core, model, isOpen));

		self.probes = RRFModel.rows(() =>
			numbered(sensors().probes).map(found => ({
				key: found.index,
				name: _.sprintf(gettext("Probe %(number)s"), {number: found.index}),
				value: list(found.item.value).join(" / "),
				offsets: list(found.item.offsets)
					.map(offset => show.fixed(offset, 2) + " mm")
					.join(", "),
				height: found.item.triggerHeight
			}))
		);

		self.monitors = RRFModel.rows(() =>
			numbered(sensors().filamentMonitors).map(found => ({
				key: found.index,
				name: _.sprintf(gettext("Extruder %(number)s"), {number: found.index}),
				type: RRFModel.term("monitor", found.item.type),
				status: RRFModel.term("monitorStatus", found.item.status),
				isBad: !HARMLESS.includes(found.item.status || "")
			}))
		);

		//~~ card

		/** Only there can its own files be read, and they hold passwords. */
		self.hasFiles = ko.pureComputed(() => core.maySet() && core.hasNetwork());
		/** Opens their dialog, whose script comes when it is first wanted. */
		self.showFiles = function () {
			const url = BASEURL + "plugin/rrfmodel/static/on_demand/files.js";
			const script = RRFModel.showFiles || $.ajax({url, dataType: "script", cache: true}).fail(core.tellRefusal);
			return $.when(script).done(() => RRFModel.showFiles(core));
		};

		//~~ power

		self.hasPower = ko.pureComputed(() => typeof state().atxPower === "boolean");
		self.isOn = ko.pureComputed(() => state().atxPower === true);
		self.powerText = ko.pureComputed(() => (self.isOn() ? gettext("on") : gettext("off")));
		self.switchOn = () => core.command("power", {on: true});
		self.switchOff = () =>
			core.confirm(
				gettext("Switch the power off?"),
				gettext("Heaters and motors lose their power."),
				gettext("Switch off"),
				() => core.command("power", {on: false})
			);

		//~~ mesh, kinematics, calibration

		const compensation = ko.pureComputed(() => object(move().compensation));
		self.meshType = ko.pureComputed(() => RRFModel.term("compensation", compensation().type));
		/** Routers have none. */
		self.hasBed = ko.pureComputed(
			() => self.probes().length > 0 || list(object(model("heat")).bedHeaters).some(heater => heater >= 0)
		);
		self.meshFile = ko.pureComputed(() => compensation().file || "");
		self.meshDeviation = ko.pureComputed(function () {
			const deviation = object(compensation().meshDeviation);
			return !isNumber(deviation.mean)
				? ""
				: _.sprintf(gettext("mean %(mean)s mm, deviation %(deviation)s mm"), {
						mean: show.fixed(deviation.mean, 3),
						deviation: show.fixed(deviation.deviation, 3)
					});
		});

		self.kinematics = ko.pureComputed(() => RRFModel.term("kinematics", object(move().kinematics).name) || "–");
		self.calibration = ko.pureComputed(function () {
			const found = object(move().calibration);
			const [before, after] = [object(found.initial).deviation, object(found.final).deviation];
			if (!found.numFactors || !isNumber(after)) return "";
			return _.sprintf(gettext("%(factors)s factors, deviation %(deviation)s mm, before it %(before)s mm"), {
				factors: found.numFactors,
				deviation: show.fixed(after, 3),
				before: show.fixed(before, 3)
			});
		});

		Object.assign(self, RRFModel.machineFacts(core, model, isOpen), RRFModel.toolOffsets(core, model));

		self.axes = RRFModel.rows(() =>
			numbered(isOpen("kinematics") ? move().axes : [])
				.filter(({item}) => item.letter)
				.map(({item}) => ({
					key: item.letter,
					machine: show.fixed(item.machinePosition, 2) + " mm",
					limits: show.fixed(item.min, 0) + " … " + show.fixed(item.max, 0) + " mm",
					speed: isNumber(item.speed) ? (item.speed / 60).toFixed(0) + " mm/s" : "–",
					acceleration: isNumber(item.acceleration) ? item.acceleration.toFixed(0) + " mm/s²" : "–",
					current: isNumber(item.current) ? item.current.toFixed(0) + " mA" : "–"
				}))
		);

		self.bed = RRFModel.machineBed(core, model, () => self.isShown() && isOpen("bed"));
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelMachinePartsViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#rrfmodel_machine_parts"]
	});
});
