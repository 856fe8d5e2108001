/* The sub-view Job: the print under way, whoever runs it; without one what can be printed. */
$(function () {
	const GCODES = "0:/gcodes/";
	/** States in which a job is there, and those in which it goes on. */
	const WITH_JOB = ["processing", "simulating", "pausing", "paused", "resuming", "cancelling"];
	const GOING_ON = ["processing", "simulating"];
	/** Then a click is forgotten that nothing has come of: a file may heat up for long. */
	const LONGEST_WAIT_MS = 600000;

	const {list, isNumber} = RRFModel;

	/** The name of a file that is only selected is told as that of the last one. */
	const pathOf = (job, status) => (job.file || {}).fileName || (!WITH_JOB.includes(status) && job.lastFileName) || "";

	function RrfModelJobViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const model = core.modelOfView("job");
		const history = RRFModel.historyOf(core);
		const isOpen = core.isShown("job");
		const show = RRFModel.show;

		self.isShown = ko.pureComputed(() => core.isRrf() && core.view() === "job");
		self.mayControl = core.mayControl;

		const job = ko.pureComputed(() => model("job") || {});
		const file = ko.pureComputed(() => job().file || {});
		const status = ko.pureComputed(() => (model("state") || {}).status || "");
		const streamed = (self.streamed = RRFModel.streamedJob(parameters[1], isOpen, history));

		//~~ what is printed

		const isOwn = ko.pureComputed(() => WITH_JOB.includes(status()));
		/** Whether the board prints from its card. */
		self.hasOwn = ko.pureComputed(() => isOwn() && !streamed.is());
		/** Whether anything is printed. */
		self.hasJob = ko.pureComputed(() => isOwn() || streamed.is());
		/** What the print does, by the board's words; empty without one. */
		const phase = ko.pureComputed(function () {
			if (streamed.is()) return streamed.phase();
			return isOwn() ? status() : "";
		});
		const old = core.oldness(isOpen);
		self.isStale = ko.pureComputed(() => old.key("job"));
		self.staleTitle = ko.pureComputed(() => old.keyTitle("job"));

		const nameOf = path => (path && path.startsWith(GCODES) ? path.slice(GCODES.length) : path || "");

		/** The file on the card; none while OctoPrint's own print has the machine. */
		self.path = ko.pureComputed(() => (streamed.is() ? "" : pathOf(job(), status())));
		self.name = ko.pureComputed(() => (streamed.is() ? streamed.name() : nameOf(self.path())));

		self.file = RRFModel.jobFile(job, self.path);
		self.times = RRFModel.jobTimes(core, job, streamed, phase);

		const fraction = ko.pureComputed(function () {
			const position = job().filePosition;
			const whole = file().size;
			return isNumber(position) && whole > 0 ? Math.min(position / whole, 1) : 0;
		});
		self.percent = ko.pureComputed(() => (streamed.is() ? streamed.percent() : Math.floor(fraction() * 1000) / 10));
		self.percentText = ko.pureComputed(() => self.percent().toFixed(1) + " %");

		self.layerText = ko.pureComputed(function () {
			const sent = streamed.layers();
			if (streamed.is()) return sent ? sent.layer + " / " + sent.layers : "–";
			const layer = isNumber(job().layer) ? job().layer : "–";
			return file().numLayers ? layer + " / " + file().numLayers : String(layer);
		});
		self.layerTime = ko.pureComputed(() => show.duration(job().layerTime));
		self.height = ko.pureComputed(function () {
			const axes = self.hasJob() ? list((model("move") || {}).axes) : [];
			const z = axes.find(axis => axis && axis.letter === "Z");
			return z && isNumber(z.userPosition) ? show.fixed(z.userPosition, 2) + " mm" : "–";
		});

		//~~ pause, resume, cancel: told at once, until the print does it

		const actions = {
			pause: {
				text: gettext("Pausing …"),
				isOver: now => ["paused", "cancelling"].includes(now),
				reasons: {
					pausing: gettext("The print is being paused."),
					paused: gettext("The print is paused."),
					cancelling: gettext("The print is being cancelled.")
				}
			},
			resume: {
				text: gettext("Resuming …"),
				isOver: now => GOING_ON.concat("cancelling").includes(now),
				reasons: {
					processing: gettext("The print isn't paused."),
					simulating: gettext("The print isn't paused."),
					pausing: gettext("The print is being paused."),
					resuming: gettext("The print is being resumed."),
					cancelling: gettext("The print is being cancelled.")
				}
			},
			cancel: {
				text: gettext("Cancelling …"),
				isOver: () => false,
				reasons: {cancelling: gettext("The print is being cancelled.")}
			}
		};
		const awaited = ko.observable(null);
		const isDone = ko.pureComputed(() => awaited() && (!phase() || actions[awaited().name].isOver(phase())));
		isDone.subscribe(is => is && awaited(null));
		/** What was clicked and hasn't come about yet: its name, or nothing. */
		self.awaited = ko.pureComputed(() => (awaited() || {}).name);
		self.statusText = ko.pureComputed(function () {
			if (!isOpen()) return "";
			return self.awaited() ? actions[self.awaited()].text : core.activity();
		});

		const send = function (name) {
			const mine = {name: name};
			const forget = () => awaited() === mine && awaited(null);
			awaited(mine);
			window.setTimeout(forget, LONGEST_WAIT_MS);
			const promise = streamed.is()
				? OctoPrint.job[name]().fail(core.tellRefusal)
				: core.command("job", {action: name});
			promise.fail(forget);
		};
		const maySend = () => (streamed.is() ? streamed.may() : self.mayControl());
		/** Why a button can't be used now, empty where it can. */
		self.whyNot = _.mapValues(actions, (action, name) =>
			ko.pureComputed(() => (self.awaited() === name ? action.text : action.reasons[phase()] || ""))
		);
		self.may = _.mapValues(actions, (action, name) =>
			ko.pureComputed(() => self.hasJob() && maySend() && !self.whyNot[name]())
		);
		self.isBusy = name => (self.awaited() === name ? "true" : null);

		// the page's own view stands still while it is hidden
		const nowPrinted = () => pathOf(core.latest.job || {}, (core.latest.state || {}).status);
		/** Asks first, and does it only if it is still the same print by then. */
		const asked = function (title, message, proceed, onproceed) {
			const [path, name, isStreamed] = [self.path(), self.name(), streamed.is()];
			core.confirm(title, message, proceed, function () {
				const isSame = isStreamed ? streamed.is() && self.name() === name : path === nowPrinted();
				if (isSame) onproceed();
				else core.notify(gettext("Nothing was done: it is another print by now."));
			});
		};
		self.pause = () => send("pause");
		self.resume = () => send("resume");
		self.cancel = () =>
			asked(gettext("Cancel the print?"), gettext("It can't be taken up again."), gettext("Cancel the print"), () =>
				send("cancel")
			);

		self.controls = RRFModel.jobControls(
			core,
			model,
			ko.pureComputed(() => isOpen() && self.hasJob())
		);
		self.objects = RRFModel.jobObjects(core, () => (streamed.is() ? {} : job()), asked);
		self.map = RRFModel.objectMap(core, () => (isOpen() && self.objects().length && model("move")) || {}, self.objects);
		self.layers = RRFModel.jobLayers(history, isOpen, self.hasJob);

		//~~ what can be begun

		const begin = (action, path) => core.command("job", {action: action, path: path});
		const confirmed = (name, onproceed) =>
			core.confirm(
				gettext("Start the print?"),
				name + ": " + gettext("The machine heats up and moves. Its bed has to be clear."),
				gettext("Start"),
				onproceed
			);
		self.start = function () {
			const path = self.path();
			confirmed(self.name(), function () {
				if (path === nowPrinted()) begin("start", path);
				else core.notify(gettext("Nothing was done: it is another print by now."));
			});
		};
		self.simulate = () => begin("simulate", self.path());
		self.printFile = row => confirmed(row.name, () => begin("start", row.path));
		self.simulateFile = row => begin("simulate", row.path);
		self.printAgain = row =>
			confirmed(row.name, function () {
				if (row.isOnCard) begin("start", row.path);
				else OctoPrint.files.select("local", row.path, true).fail(core.tellRefusal);
			});

		/** Why nothing can be begun now; a job may outlast the loss of the motors' supply. */
		self.whyNoStart = ko.pureComputed(function () {
			if (!isOpen()) return "";
			return status() === "off" ? RRFModel.words.warning.off : core.forbidden("job_start");
		});
		self.mayStart = ko.pureComputed(() => self.mayControl() && !self.whyNoStart());
		self.mayStartAgain = row => !self.whyNoStart() && (row.isOnCard ? self.mayControl() : streamed.may());
		/** Whether a file is only selected. */
		self.isSelected = ko.pureComputed(() => !self.hasJob() && !!self.path() && !self.last());

		const isIdle = ko.pureComputed(() => isOpen() && core.isRrf() && !self.hasJob());
		const hasCard = ko.pureComputed(() => isIdle() && !!core.status().ready && core.status().protocol === "M409");
		self.hasCard = ko.pureComputed(() => !self.hasJob() && core.status().protocol === "M409");
		self.card = RRFModel.cardFiles(core, hasCard);
		self.past = RRFModel.pastJobs(core, isIdle);

		/** The last job; one without a time was only selected. How it ended only an SBC tells. */
		self.last = ko.pureComputed(function () {
			const told = job();
			const isIt = self.path() === told.lastFileName && told.lastDuration;
			if (self.hasJob() || !isIt) return null;
			return {
				name: nameOf(told.lastFileName),
				duration: show.duration(told.lastDuration),
				warmUp: show.duration(told.lastWarmUpDuration),
				isAborted: told.lastFileAborted,
				isCancelled: told.lastFileCancelled,
				isSimulated: told.lastFileSimulated || core.status().simulated_file === told.lastFileName
			};
		});
		// its buttons are made anew with each value, and a click in between would be lost
		self.last.equalityComparer = _.isEqual;

		self.onAfterBinding = self.layers.bind;
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelJobViewModel,
		dependencies: ["rrfModelViewModel", "printerStateViewModel"],
		elements: ["#rrfmodel_job"]
	});
});
