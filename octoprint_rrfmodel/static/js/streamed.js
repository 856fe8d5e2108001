/* The print that OctoPrint sends, in the form in which the sub-view Job shows one. */
$(function () {
	/**
	 * Returns what is known of OctoPrint's own print: `is()` tells whether there is one. Only with
	 * the server's history there are `layers()`.
	 */
	RRFModel.streamedJob = function (octoprint, isOpen, history) {
		const self = {};
		const show = RRFModel.show;

		self.may = ko.pureComputed(() => octoprint.loginState.hasPermission(octoprint.access.permissions.PRINT));
		self.is = ko.pureComputed(() => isOpen() && RRFModel.isStreaming(octoprint));
		const told = value => ko.pureComputed(() => (self.is() ? value() : ""));

		self.name = told(() => octoprint.filedisplay() || octoprint.filepath() || "");
		self.percent = ko.pureComputed(() => (self.is() ? Math.floor((Number(octoprint.progress()) || 0) * 10) / 10 : 0));
		self.duration = told(() => show.duration(octoprint.printTime()));
		self.secondsLeft = told(() => octoprint.printTimeLeft());

		/** By the words that the board has for its own prints. */
		self.phase = told(function () {
			if (octoprint.isCancelling()) return "cancelling";
			if (octoprint.isPausing()) return "pausing";
			return octoprint.isPaused() ? "paused" : "processing";
		});

		/** Layer and number of layers, where the file tells them. */
		self.layers = told(function () {
			if (!history) return "";
			history.revision();
			return history.streamed;
		});
		return self;
	};
});
