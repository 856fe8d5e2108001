/* The sub-view Machine, above: what is used daily. */
$(function () {
	function RrfModelMachineViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const model = core.modelOfView("machine");
		const isOpen = core.isShown("machine");

		self.isShown = ko.pureComputed(() => core.isRrf() && core.view() === "machine");
		self.mayControl = core.mayControl;
		self.forbidden = core.forbidden;

		const old = core.oldness(isOpen);
		self.isStale = ko.pureComputed(() => old.key("move"));
		self.staleTitle = ko.pureComputed(() => old.keyTitle("move"));

		/** Whether a command may be given now, and why not, for what it greys. */
		self.may = command => core.mayControl() && !core.forbidden(command);
		self.why = command => core.forbidden(command) || null;

		Object.assign(
			self,
			RRFModel.heatRows(core, model),
			RRFModel.machineMoves(core, model),
			RRFModel.machineTurns(core, model),
			RRFModel.spindles(core, model),
			RRFModel.machineCard(core, isOpen)
		);
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelMachineViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#rrfmodel_machine"]
	});
});
