/* What RepRapFirmware needs of OctoPrint, and the printer profile: in the settings and the wizard. */
$(function () {
	const RECONNECT = "reconnect";

	function RrfModelSetupViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		let dialog;

		const fieldNames = {
			"volume.formFactor": gettext("Form of the bed"),
			"volume.origin": gettext("Origin"),
			"volume.width": gettext("Width (X) in mm"),
			"volume.depth": gettext("Depth (Y) in mm"),
			"volume.height": gettext("Height (Z) in mm"),
			"volume.custom_box": gettext("Limits of the axes"),
			"axes.x.speed": gettext("Speed of X in mm/min"),
			"axes.y.speed": gettext("Speed of Y in mm/min"),
			"axes.z.speed": gettext("Speed of Z in mm/min"),
			"axes.e.speed": gettext("Speed of extruders in mm/min"),
			"extruder.count": gettext("Number of extruders"),
			"extruder.sharedNozzle": gettext("Extruders share a nozzle"),
			heatedBed: gettext("Heated bed"),
			heatedChamber: gettext("Heated chamber")
		};
		/** By the code of the warning; names that OctoPrint's own settings have where there are some. */
		const settingNames = {
			long_running_commands: gettext("Long running commands"),
			uppercase: gettext("Commands that keep their case in the terminal"),
			unknown_commands: gettext("Acknowledgements of commands that OctoPrint does not know"),
			external_heatup: gettext("Detection of heat-ups that OctoPrint did not begin")
		};
		const values = {
			rectangular: gettext("rectangular"),
			circular: gettext("round"),
			lowerleft: gettext("lower left"),
			center: gettext("centre")
		};

		const shown = function (value) {
			if (value === true) return gettext("yes");
			if (value === false || value === null || value === undefined) return gettext("no");
			if (typeof value === "number") return String(Math.round(value * 100) / 100);
			if (Array.isArray(value)) return value.join(", ");
			if (typeof value === "object")
				return ["x", "y", "z"].map(axis => [value[axis + "_min"], value[axis + "_max"]].join(" … ")).join(", ");
			return values[value] || String(value);
		};

		self.maySet = core.maySet;
		self.isReady = ko.observable(false);
		self.needed = ko.observableArray();
		self.fields = ko.observableArray();

		self.isComplete = ko.pureComputed(() => self.needed().every(row => row.fulfilled));
		self.isChosen = ko.pureComputed(() => self.fields().some(row => row.isWanted()));

		self.fromSetup = function (setup) {
			self.isReady(setup.ready);
			self.needed(
				setup.settings.map(row => ({
					name: settingNames[row.code] || gettext("Setting"),
					fulfilled: row.fulfilled,
					text: RRFModel.warningText({code: row.code}) || "",
					now: shown(row.now),
					wanted: row.missing.length
						? _.sprintf(gettext("also %(codes)s"), {codes: row.missing.join(", ")})
						: shown(row.wanted),
					stateText: row.fulfilled ? gettext("as needed") : gettext("to be set")
				}))
			);
			const unwanted = self
				.fields()
				.filter(row => !row.isWanted())
				.map(row => row.field);
			self.fields(
				setup.profile.map(row => ({
					field: row.field,
					name: fieldNames[row.field] || gettext("Field"),
					now: shown(row.now),
					wanted: shown(row.wanted),
					isWanted: ko.observable(!unwanted.includes(row.field))
				}))
			);
		};

		self.requestData = function () {
			if (!core.maySet()) return undefined;
			return OctoPrint.plugins.rrfmodel.getSetup().done(self.fromSetup);
		};

		// OctoPrint 1.11 finds changes of its own in its open dialog and would ask whose are to
		// stay, although it writes only what somebody has changed there
		let isOwnChange = false;
		let isBehind = false;
		self.onSettingsPreventRefresh = function () {
			const prevents = isOwnChange;
			isOwnChange = false;
			return prevents;
		};
		self.onSettingsHidden = function () {
			if (isBehind) core.settings.requestData();
			isOwnChange = isBehind = false;
		};
		const changeSettings = function (name) {
			isOwnChange = isBehind = $("#settings_dialog").is(":visible");
			return core.command(name).done(self.requestData);
		};

		self.fixSettings = () => changeSettings("fix_settings");
		self.writeProfile = () =>
			core
				.command("fix_profile", {
					fields: self
						.fields()
						.filter(row => row.isWanted())
						.map(row => row.field)
				})
				.done(self.requestData);
		/** Whether something that was set takes effect only at the next connection. */
		self.needsReconnect = ko.pureComputed(() =>
			(core.status().warnings || []).some(warning => warning.fix === RECONNECT)
		);
		self.mayReconnect = ko.pureComputed(() => core.may("CONNECTION"));
		self.reconnect = () => core.command(RECONNECT);

		/** Both at once, but for what is unticked of the profile. */
		self.setUp = () => self.fixSettings().then(() => (self.isChosen() ? self.writeProfile() : undefined));
		self.isSetUp = ko.pureComputed(() => self.isComplete() && !self.isChosen());

		self.restore = () => changeSettings("restore_settings");

		self.onSettingsShown = self.requestData;
		const isMachineReady = ko.pureComputed(() => !!core.status().ready);
		isMachineReady.subscribe(function () {
			if ($("#settings_dialog").is(":visible")) self.requestData();
		});

		//~~ the first-run wizard

		// what reads the page aloud goes on at the heading
		const focusStep = () => dialog.find("h4:visible").trigger("focus");
		self.later = () => dialog.modal("hide");
		self.done = function () {
			dialog.modal("hide");
			core.command("wizard_done");
		};

		const isDue = ko.pureComputed(() => !!core.status().first_run && core.maySet());
		const isBeside = () => $(".modal:visible").length > 0;

		let wasOffered = false;
		const offer = function () {
			if (wasOffered || !isDue() || isBeside()) return;
			self.requestData().done(function () {
				const isAsNeeded = self.isComplete() && !self.fields().length;
				if (wasOffered || !isDue() || isBeside() || isAsNeeded) return;
				// once a page: who wants it later has closed it
				wasOffered = true;
				dialog.modal({keyboard: true});
			});
		};

		self.onAllBound = function () {
			dialog = $("#rrfmodel_wizard_dialog");
			dialog.on("shown", focusStep);
			// somebody is at another dialog: it comes after that
			$(document).on("hidden", ".modal", offer);
			isDue.subscribe(offer);
			offer();
		};
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelSetupViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#rrfmodel_setup", "#rrfmodel_wizard"]
	});
});
