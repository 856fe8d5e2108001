/* What goes to the server, what is asked before, and what is told of it. */
$(function () {
	/** So long a request without an answer holds up others. */
	const LONGEST_TURN_MS = 5000;

	/** Adds to the core `command`, `script`, `confirm`, `notify` and what is made of them. */
	RRFModel.addCommands = function (core) {
		let last = $.Deferred().resolve();

		/** Sends what comes behind what is under way: of two requests at once any may be the first. */
		const inTurn = function (send) {
			const turn = $.Deferred();
			const go = _.once(() => send().done(turn.resolve).fail(turn.reject));
			last.always(go);
			window.setTimeout(go, LONGEST_TURN_MS);
			last = turn;
			return turn.promise();
		};

		/**
		 * Sends a command; a refusal is told in the server's words. Returns the promise, whose
		 * `shown` ends when the machine shows the effect or has refused.
		 */
		core.command = function (name, values) {
			const send = () => OctoPrint.plugins.rrfmodel.command(name, values);
			// a stop waits for nothing
			const promise = name === "emergency_stop" ? send() : inTurn(send);
			return core.awaited(name, values, promise.fail(core.tellRefusal));
		};

		/** Sends G-code as the console does. */
		core.script = function (text) {
			const promise = inTurn(() => OctoPrint.plugins.rrfmodel.script(text));
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
