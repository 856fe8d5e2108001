/* Why something can't be done now, as the server would refuse it: what is greyed and why. */
$(function () {
	/** What the board's own print is doing, by state.status. */
	const PRINTING = ["processing", "simulating", "pausing", "resuming", "cancelling"];

	/** What forbids a command, by its name; "" is a move. As the server's table has it. */
	const STATES = {
		"": "printing",
		home: "printingOrPaused",
		jog: "printing",
		extrude: "printing",
		select_tool: "printing",
		filament: "printing",
		spindle: "printing",
		tool_offsets: "printing",
		workplace: "printing",
		set_zero: "printing",
		macro: "printingOrPaused",
		input_shaping: "printing",
		motor_current: "printing",
		save_parameters: "printing",
		heater_monitor: "printing",
		probe_height: "printing",
		restore_point: "printing",
		heater_tuning: "printingOrPaused",
		probe: "printingOrPaused",
		resume_after_power_loss: "printingOrPaused",
		firmware_update: "printingOrPaused",
		mesh: "printingOrPaused",
		power_off: "printingOrPaused",
		job_start: "printingOrPaused",
		recover: "printing",
		fan: "machine",
		temperatures: "machine",
		babystep: "machine",
		speed_factor: "machine",
		extrusion_factor: "machine",
		reset_heater_fault: "machine",
		object: "machine"
	};

	/**
	 * Adds `core.forbidden(command)`: "" or why the machine refuses it now, without a command why
	 * it refuses moves.
	 */
	RRFModel.addForbidden = function (core, octoprint) {
		const status = ko.pureComputed(() => (core.model("state") || {}).status);
		const streams = () => RRFModel.isStreaming(octoprint);

		const machine = ko.pureComputed(function () {
			if (!core.status().connected) return gettext("No printer is connected.");
			if (!core.isRrf()) return gettext("The printer has not said that it runs RepRapFirmware.");
			if (status() === "halted") return gettext("The machine was stopped. Restart it first.");
			return core.age() === undefined ? gettext("Reading the model …") : "";
		});
		const isPrinting = ko.pureComputed(() => (streams() && !octoprint.isPaused()) || PRINTING.includes(status()));
		const reasons = {
			machine: machine,
			printing: ko.pureComputed(() => machine() || (isPrinting() ? gettext("Not while a print runs.") : "")),
			printingOrPaused: ko.pureComputed(function () {
				if (machine() || isPrinting()) return reasons.printing();
				const isPaused = streams() || status() === "paused";
				return isPaused ? gettext("Not before the print is over.") : "";
			})
		};

		core.forbidden = command => reasons[STATES[command || ""] || "machine"]();
	};
});
