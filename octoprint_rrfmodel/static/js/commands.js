/* What goes to the server, what is asked before, and what is told of it. */
$(function () {
	/** Adds to the core `command`, `script`, `confirm`, `notify` and what is made of them. */
	RRFModel.addCommands = function (core) {
		/**
		 * Sends a command; a refusal is told in the server's words. Returns the promise, whose
		 * `shown` ends when the machine shows the effect or has refused.
		 */
		core.command = function (name, values) {
			const promise = OctoPrint.plugins.rrfmodel.command(name, values);
			return core.awaited(name, values, promise.fail(core.tellRefusal));
		};

		/** Sends G-code as the console does. */
		core.script = function (text) {
			const promise = OctoPrint.plugins.rrfmodel.script(text);
			return core.awaited("script", {}, promise.fail(core.tellRefusal));
		};

		/** Asks before something that can't be taken back; all three texts are text, no markup. */
		core.confirm = function (title, text, proceed, onproceed) {
			// each of them is markup there, and names of the printer's may stand in it
			const texts = {title, message: text, proceed, cancel: gettext("Back")};
			showConfirmationDialog(Object.assign(_.mapValues(texts, _.escape), {onproceed}));
		};

		core.emergencyStop = () =>
			core.confirm(
				gettext("Stop the machine at once?"),
				gettext(
					"Its print is lost. By USB it stops when what it is busy with is through: in an emergency take its power."
				),
				gettext("Emergency stop"),
				() => core.command("emergency_stop")
			);
		core.restart = () =>
			core.confirm(
				gettext("Restart the machine?"),
				gettext("It forgets where its axes are, and is connected again."),
				gettext("Restart"),
				() => core.command("recover")
			);

		core.tellRefusal = function (xhr) {
			const {error} = xhr.responseJSON || {};
			core.notify((error && error.message) || error || gettext("That did not work."));
		};

		core.notify = function (text, type, more) {
			const options = {
				title: gettext("RepRapFirmware"),
				text: text,
				title_escape: true,
				text_escape: true,
				type: type || "notice"
			};
			const notice = new PNotify(Object.assign(options, more));
			// its history would keep each one for as long as the page is open
			notice.options.destroy = true;
			return notice;
		};
	};
});
