/* Sections of the sub-view Machine that fold: what each tells in a line, and which are open. */
$(function () {
	const STORED = "rrfmodel.folds";

	const stored = function () {
		try {
			return RRFModel.object(JSON.parse(window.localStorage.getItem(STORED)));
		} catch (error) {
			return {};
		}
	};

	/** A few texts in a line, those that are empty left out. */
	const line = (...texts) => texts.filter(Boolean).join(", ");

	/** Each section's line, from the members of the view model; a section without one isn't there. */
	const summaries = {
		bed: self =>
			line(
				self.hasBed() && gettext("Compensation") + ": " + (self.meshType() || "–"),
				self.meshDeviation(),
				...self.probes().map(probe => probe.name() + ": " + probe.value())
			),
		offsets: self => self.offsetsSummary(),
		tuning: self =>
			line(
				self.motion.pressure() && gettext("Pressure advance") + " " + self.motion.pressure(),
				self.motion.shaping() && gettext("Input shaping") + ": " + self.motion.shaping()
			),
		heaters: self => self.heatersSummary(),
		sensors: self =>
			line(
				...self
					.sensors()
					.slice(0, 3)
					.map(sensor => sensor.name() + " " + sensor.value()),
				...self.monitors().map(monitor => gettext("filament") + " " + monitor.status()),
				self.endstopsSummary(),
				self.inputs().length && gettext("inputs")
			),
		kinematics: self => line(self.kinematics(), self.motion.workplace(), self.motion.requested()),
		boards: self =>
			line(
				...self
					.boards()
					.slice(0, 1)
					.map(board => [board.short(), board.version(), board.supplyNow(), board.heatNow()].filter(Boolean).join(" ")),
				self.boards().length > 1 && _.sprintf(gettext("%(count)s boards"), {count: self.boards().length}),
				self.motion.running()
			),
		network: self => line(...self.interfaces().map(each => [each.type(), each.address() || each.state()].join(" "))),
		volumes: self => line(...self.volumes().map(each => each.name() + ": " + each.text())),
		power: self => (self.hasPower() ? self.powerText() : ""),
		outputs: self =>
			line(
				...self.outputs().map(each => gettext("Output") + " " + each.key + " " + each.value()),
				self.counts.strips() && _.sprintf(gettext("LED strips: %(count)s"), {count: self.counts.strips()})
			),
		variables: self => String(self.counts.variables() || ""),
		places: self => String(self.counts.places() || "")
	};

	/** Adds `folds` by name to the view model: `summary`, `isThere`, `isOpen`, `toggle`. */
	RRFModel.addFolds = function (self) {
		const open = stored();
		self.folds = _.mapValues(summaries, function (summary, name) {
			const text = ko.pureComputed(() => summary(self));
			const isOpen = ko.observable(open[name] === true);
			isOpen.subscribe(function (value) {
				open[name] = value;
				try {
					window.localStorage.setItem(STORED, JSON.stringify(open));
				} catch (error) {
					// who keeps nothing has it folded the next time
				}
			});
			return {
				summary: text,
				isThere: ko.pureComputed(() => !!text()),
				isOpen: isOpen,
				toggle: () => isOpen(!isOpen())
			};
		});
	};
});
