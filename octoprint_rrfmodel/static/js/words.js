/* Words in the page's language and values as people read them. */
$(function () {
	const isNumber = (RRFModel.isNumber = value => typeof value === "number");

	/** Words in the page's language; OctoPrint defines gettext after this file has run. */
	RRFModel.makeWords = () => ({
		/** Sub-views of the tab. */
		view: {
			machine: gettext("Machine"),
			job: gettext("Job"),
			chart: gettext("Chart"),
			console: gettext("Console"),
			model: gettext("Model")
		},
		/** The machine's state, by state.status; a new one is shown as it came. */
		status: {
			starting: gettext("Starting"),
			updating: gettext("Updating the firmware"),
			halted: gettext("Halted"),
			off: gettext("No motor supply"),
			pausing: gettext("Pausing"),
			resuming: gettext("Resuming"),
			paused: gettext("Paused"),
			cancelling: gettext("Cancelling"),
			simulating: gettext("Simulating"),
			processing: gettext("Printing from its card"),
			changingTool: gettext("Changing the tool"),
			busy: gettext("Busy"),
			idle: gettext("Idle")
		},
		/** A heater's state: word and label class. */
		heater: {
			off: {text: gettext("off"), label: ""},
			standby: {text: gettext("standby"), label: "label-info"},
			active: {text: gettext("active"), label: "label-success"},
			fault: {text: gettext("fault"), label: "label-important"},
			tuning: {text: gettext("tuning"), label: "label-warning"},
			offline: {text: gettext("offline"), label: "label-warning"}
		},
		/** What the line is busy with, by doing.what, and by commands that say more. */
		doing: {
			homing: gettext("Homing"),
			heating: gettext("Heating"),
			probing: gettext("Probing"),
			calibrating: gettext("Levelling or calibrating"),
			tool_change: gettext("Changing the tool"),
			macro: gettext("Running a macro"),
			filament: gettext("Changing the filament"),
			pausing: gettext("Pausing"),
			resuming: gettext("Resuming"),
			cancelling: gettext("Cancelling"),
			waiting: gettext("Waiting"),
			answer: gettext("Waits for an answer"),
			saving: gettext("Saving"),
			other: gettext("Busy")
		},
		doingBy: {
			M109: gettext("Heating the tool"),
			M116: gettext("Waiting for temperatures"),
			M190: gettext("Heating the bed"),
			M191: gettext("Heating the chamber"),
			M303: gettext("Tuning a heater"),
			M400: gettext("Waiting for the end of the moves"),
			M701: gettext("Loading the filament"),
			M702: gettext("Unloading the filament")
		},
		macro: gettext("Macro %(name)s"),
		toolChange: gettext("Changing to T%(tool)s"),
		toolAway: gettext("Putting the tool away"),
		streamed: gettext("Printing, sent by OctoPrint"),
		/** Why the model can't be asked for, where nothing is known of what the line does. */
		blocked: {
			heating: gettext("Busy"),
			long_command: gettext("Busy"),
			streaming: gettext("A file is being sent to the printer's card"),
			buffers: gettext("The printer is short of memory for its answers"),
			unreachable: gettext("The board doesn't answer, trying again")
		},
		/** What a person is told, by the code of a warning; others have the server's text. */
		warning: {
			halted: gettext("The machine was stopped by an emergency stop. Restart it, or use its power switch."),
			off: gettext("The motors have no supply voltage."),
			position_lost: gettext(
				"The motors had no supply voltage, and the machine has lost its position. Home what can be homed beside the print, or set the position by G92."
			),
			reset: gettext("The board was reset during the print, which can't go on. Cancel it, then home."),
			message_box_unanswerable: gettext(
				"The machine waits for an answer that this firmware does not take over USB. Answer on the machine's own page or panel, or reset the machine."
			),
			long_running_commands: gettext("OctoPrint does not know some of RepRapFirmware's commands that take long."),
			uppercase: gettext("OctoPrint's terminal would change file names and texts to upper case."),
			unknown_commands: gettext("OctoPrint does not count the acknowledgements of T-1 and of commands such as echo."),
			external_heatup: gettext("OctoPrint would take RepRapFirmware's temperature reports for a heat-up."),
			profile_tools: gettext(
				"The printer profile has fewer extruders than the machine's highest tool number needs, so that OctoPrint drops tool commands."
			),
			profile_reconnect: gettext(
				"Disconnect the printer and connect it again: OctoPrint still uses the old number of extruders."
			),
			settings_reconnect: gettext(
				"What was set takes effect at the next connection. Disconnect the printer and connect it again."
			),
			mqtt_topic: gettext(
				"Nothing is published over MQTT: the topic in the plugin's settings is empty, too long, or has one of the characters + and # in it."
			),
			heater_fault: gettext("Heater %(heater)s reports a fault. Find the cause, then reset it."),
			filament_error: gettext("The filament monitor of extruder %(number)s reports an error. Check the filament."),
			driver_error: gettext("Motor driver %(number)s reports an error. Find the cause."),
			startup_error: gettext("Line %(line)s of %(file)s failed when the machine started: %(message)s"),
			filament_monitor_mode: gettext(
				"The filament monitor of extruder %(number)s acts only on what the machine prints from its own card. Give it S2 in its M591 in config.g, so that it acts on OctoPrint's prints too."
			),
			supply_voltage: gettext(
				"The supply of board %(number)s has fallen below 10 V. Check its power supply and fuses."
			),
			driver_warning: gettext("Motor driver %(number)s is getting too hot. Cool it, or lower the motor's current."),
			open_load: gettext("Motor driver %(number)s reports that its motor may not be connected. Check its cable."),
			mcu_temperature: gettext("The processor of board %(number)s is hotter than 85 °C. Cool the board."),
			versions_differ: gettext(
				"Board %(number)s runs firmware %(version)s and the main board %(main)s. Update them to the same version."
			)
		},
		/** Why OctoPrint's print is paused, by what to do next. */
		paused: {
			wait: gettext("The print was paused. %(why)s Then resume the print, or cancel it."),
			resume: gettext("The print was paused. %(why)s That is over now: resume the print, or cancel it."),
			cancel: gettext("The print was paused and can only be cancelled. %(why)s"),
			answer: gettext("The print was paused. %(why)s")
		},
		waiting: gettext(
			'A message waits for an answer: "%(text)s". Do what it says, then resume the print, or cancel it.'
		),
		/** Notices in the page's words; others have the server's text. */
		notice: {
			board_reset: gettext("The board was reset and has begun anew. Home it before it moves."),
			not_homed: gettext("Nothing was moved: home %(detail)s first."),
			no_tool_selected: gettext("Nothing was done: select a tool first."),
			too_cold: gettext("Nothing was extruded: tool %(detail)s is too cold. Heat it first."),
			no_such_tool: gettext("Nothing was done: the machine has no tool %(detail)s."),
			no_bed: gettext("Nothing was heated: the machine has no heated bed."),
			no_chamber: gettext("Nothing was heated: the machine has no heated chamber."),
			message_box: gettext(
				"Not sent, nobody could answer it on this firmware: %(detail)s. Update the firmware to 3.6.1 or newer."
			),
			debug_table: gettext(
				"Not sent, the printer would not acknowledge it: %(detail)s. Use the machine's own console."
			),
			recover_failed: gettext(
				"The machine did not come back after its restart. Check its power and cable, then connect."
			)
		},
		/** What the button of a warning says, by the command that it sends. */
		fix: {
			recover: gettext("Restart the machine"),
			reset_heater_fault: gettext("Reset the fault"),
			fix_settings: gettext("Set OctoPrint's settings"),
			fix_profile: gettext("Raise the number of extruders"),
			reconnect: gettext("Reconnect")
		}
	});

	/** Values as people read them; what is not known is a dash. */
	RRFModel.show = {
		degrees: value => (isNumber(value) ? value.toFixed(1) : "–"),

		/** A target: one that was never set is -273.15. */
		target: value => (isNumber(value) && value > -273 ? value.toFixed(0) : "–"),

		fixed: (value, digits) => (isNumber(value) ? value.toFixed(digits) : "–"),

		/** A fraction as whole percent. */
		percent: value => (isNumber(value) ? Math.round(value * 100) + " %" : "–"),

		/** Seconds as hours, minutes and seconds. */
		duration: function (seconds) {
			if (!isNumber(seconds) || seconds < 0) return "–";
			const whole = Math.round(seconds);
			const two = number => String(number).padStart(2, "0");
			const text = two(Math.floor(whole / 60) % 60) + ":" + two(whole % 60);
			return Math.floor(whole / 3600) + ":" + text;
		}
	};

	/** A notice in the page's words, the machine's own text in it as it came. */
	RRFModel.noticeText = function (message) {
		const text = RRFModel.words.notice[message.code];
		return text ? _.sprintf(text, {detail: message.detail}) : message.text;
	};

	/** A warning of the server in the page's language; a heater has the name that is given. */
	RRFModel.warningText = function (warning, heaterName) {
		const words = RRFModel.words;
		const values = warning.values || {};
		if (warning.code === "print_paused" && words.paused[values.next]) {
			const why = values.message
				? _.sprintf(words.waiting, {text: values.message})
				: (warning.causes || []).map(cause => RRFModel.warningText(cause, heaterName)).join(" ");
			return _.sprintf(words.paused[values.next], {why: why});
		}
		// one of several things has its numbers behind the code
		const text = words.warning[warning.code.replace(/(_\d+)+$/, "")];
		const heater = heaterName ? heaterName(Number(values.number)) : values.number;
		return text ? _.sprintf(text, Object.assign({heater: heater}, values)) : warning.text;
	};
});
