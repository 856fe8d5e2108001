/* What the machine does, in the bar at the top of the page, and the way to its tab from there. */
$(function () {
	/** Levels of warnings that the chip tells by its colour, the gravest first. */
	const LEVELS = ["fault", "warning"];
	const HALTED = "halted";

	function RrfModelNavbarViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const settings = parameters[1];

		const isWanted = ko.pureComputed(() => {
			const own = settings.settings && settings.settings.plugins.rrfmodel;
			// a server that was not restarted since an update knows no such setting
			return !own || !own.navbar || own.navbar();
		});
		self.isShown = ko.pureComputed(() => core.isRrf() && isWanted());
		self.text = ko.pureComputed(() => (self.isShown() ? core.activity() : ""));
		self.title = ko.pureComputed(() => {
			if (!self.isShown()) return "";
			return [self.text(), ...core.alerts().map(alert => alert.text)].join("\n");
		});
		self.severity = ko.pureComputed(function () {
			if ((core.model("state") || {}).status === HALTED) return LEVELS[0];
			const told = core.alerts().map(alert => alert.level);
			return LEVELS.find(level => told.includes(level)) || null;
		});
		self.chipClass = ko.pureComputed(() => (self.severity() ? "rrfmodel-chip-" + self.severity() : ""));
		self.address = ko.pureComputed(() => core.address(core.view()));
		self.open = function () {
			if (core.tabIsOpen()) return;
			// the tab's own link may be in the menu of those without room, and works there too
			$("#tab_plugin_rrfmodel_link a").tab("show");
		};
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelNavbarViewModel,
		dependencies: ["rrfModelViewModel", "settingsViewModel"],
		elements: ["#navbar_plugin_rrfmodel"]
	});
});
