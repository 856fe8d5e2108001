/* The strip above every sub-view: state, tool, position, age, what is wrong, and the job. */
$(function () {
	const {isNumber, list, object, show} = RRFModel;

	/** States of the board in which it has a job of its own. */
	const WITH_JOB = ["processing", "simulating", "pausing", "resuming", "paused", "cancelling"];
	const ICONS = {
		fault: "fas fa-exclamation-circle",
		warning: "fas fa-exclamation-triangle",
		advice: "fas fa-info-circle"
	};

	function RrfModelStripViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const octoprint = parameters[1];
		const connection = parameters[2];

		const isSeen = ko.pureComputed(() => core.pageIsVisible() && core.tabIsOpen());
		const seen = value => ko.pureComputed(() => (isSeen() ? value() : ""));
		const state = () => object(core.model("state"));

		self.isRrf = core.isRrf;
		self.stateText = seen(function () {
			if (core.isRrf()) return core.activity();
			return core.status().connected ? gettext("No RepRapFirmware") : gettext("Not connected");
		});
		self.stateClass = ko.pureComputed(function () {
			if (!core.isRrf() || core.status().stale) return "";
			return {halted: "rrfmodel-fault", idle: "", off: "rrfmodel-warning"}[state().status] || "";
		});

		self.tool = seen(function () {
			const number = state().currentTool;
			if (!core.isRrf() || !isNumber(number)) return "";
			const tool = list(core.model("tools")).find(each => each && each.number === number);
			if (number < 0) return list(core.model("tools")).length ? gettext("no tool") : "";
			return "T" + number + (tool && tool.name ? " " + tool.name : "");
		});
		self.position = seen(() =>
			core.isRrf()
				? list(object(core.model("move")).axes)
						.filter(axis => axis && axis.letter && axis.visible !== false)
						.map(axis => axis.letter + " " + show.fixed(axis.userPosition, 1))
						.join(" ")
				: ""
		);
		const old = core.oldness(isSeen);
		self.isOld = ko.pureComputed(() => old.key("move"));
		self.positionTitle = ko.pureComputed(() => [self.position(), old.keyTitle("move")].filter(Boolean).join(", "));
		self.ageText = seen(() => (core.isRrf() ? core.ageText() : ""));

		//~~ what is wrong

		self.isOpen = ko.observable(false);
		const ownRows = function () {
			const words = {level: "advice", key: "own", fix: null};
			const {connected} = core.status();
			if (!core.mayRead()) return [];
			if (connected === undefined || core.isRrf()) return [];
			// one that is halted is connected again by its restart
			if (core.alerts().some(row => object(row.fix).name === "recover")) return [];
			if (connected) {
				const text = gettext("The connected printer doesn't run RepRapFirmware.");
				return [Object.assign(words, {text: text})];
			}
			const fix = core.may("CONNECTION") ? {connect: true, text: gettext("Connect")} : null;
			const text = gettext("No printer with RepRapFirmware is connected.");
			return [Object.assign(words, {text: text, fix: fix})];
		};
		self.alerts = RRFModel.rows(
			() =>
				isSeen()
					? [...core.alerts(), ...ownRows()].map(row => ({
							key: row.key,
							text: row.text,
							levelClass: "rrfmodel-alert rrfmodel-" + row.level,
							icon: ICONS[row.level] || ICONS.warning,
							fix: row.fix
						}))
					: [],
			function (row) {
				row.test = row.key === "own" ? "no-machine" : "strip-alert";
				row.fixText = ko.pureComputed(() => object(row.fix()).text || "");
				row.mend = function () {
					const fix = row.fix();
					if (!fix.connect) return core.mend({fix: fix});
					// with what is picked in OctoPrint's own panel
					connection.connect();
					return core.awaited("reconnect", {}, $.Deferred().resolve().promise());
				};
			}
		);
		self.more = ko.pureComputed(() => Math.max(0, self.alerts().length - 1));
		self.toggle = () => self.isOpen(!self.isOpen());
		self.onKey = function (_self, event) {
			if (event.key === "Escape") self.isOpen(false);
			return true;
		};
		self.message = seen(() => (core.isRrf() && state().displayMessage) || "");

		//~~ the job, whoever sends it

		const streamed = RRFModel.streamedJob(octoprint, isSeen);
		const ownJob = function () {
			const job = object(core.model("job"));
			const file = object(job.file);
			if (!core.isRrf() || !WITH_JOB.includes(state().status)) return null;
			const left = object(job.timesLeft);
			const seconds = [left.slicer, left.filament, left.file].find(isNumber);
			const layer = isNumber(job.layer) ? String(job.layer) : "";
			return {
				name: (file.fileName || "").split("/").pop(),
				percent: file.size ? (100 * (job.filePosition || 0)) / file.size : null,
				layer: layer && file.numLayers ? layer + "/" + file.numLayers : layer,
				left: isNumber(seconds) ? show.duration(seconds) : ""
			};
		};
		const sentJob = () =>
			streamed.is()
				? {
						name: streamed.name(),
						percent: streamed.percent(),
						// the history that knows the layer is followed while Job or Chart is shown
						layer: "",
						left: show.duration(streamed.secondsLeft())
					}
				: null;
		const job = ko.pureComputed(() => (isSeen() ? sentJob() || ownJob() : null));
		self.hasJob = ko.pureComputed(() => !!job());
		self.jobName = ko.pureComputed(() => object(job()).name || "");
		self.jobFigures = ko.pureComputed(function () {
			const {percent, layer, left} = object(job());
			return [
				isNumber(percent) ? percent.toFixed(0) + " %" : "",
				layer ? _.sprintf(gettext("layer %(layer)s"), {layer: layer}) : "",
				left && left !== "–" ? _.sprintf(gettext("%(time)s left"), {time: left}) : ""
			]
				.filter(Boolean)
				.join(" · ");
		});
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelStripViewModel,
		dependencies: ["rrfModelViewModel", "printerStateViewModel", "connectionViewModel"],
		elements: ["#rrfmodel_strip"]
	});
});
