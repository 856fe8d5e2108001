/* The sub-view Console: what was said on the line, and an input for G-code. */
$(function () {
	/** Lines that stay on the page. */
	const MOST_LINES = 500;
	const MOST_COMMANDS = 100;
	/** So near to its end a list counts as read to the end. */
	const NEAR_PX = 30;
	const KINDS = [
		{begins: /^Error:/, css: "rrfmodel-error"},
		{begins: /^Warning:/, css: "rrfmodel-warned"}
	];

	function RrfModelConsoleViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const view = () => document.querySelector("#rrfmodel_console .rrfmodel-console");

		self.isOpen = core.isShown("console");
		self.mayWatch = core.mayWatch;
		/** As OctoPrint's terminal has it, and what the server asks for. */
		self.maySend = ko.pureComputed(() => core.isRrf() && core.mayControl() && core.may("CONTROL"));

		//~~ lines

		const lines = ko.observableArray();
		let last = 0;

		const rowOf = function (line) {
			const isSent = line.type === "command";
			const kind = KINDS.find(each => !isSent && each.begins.test(line.message));
			return {
				number: line.number,
				time: new Date(line.time * 1000).toLocaleTimeString(),
				text: line.message,
				css: isSent ? "rrfmodel-sent" : (kind || {css: ""}).css
			};
		};

		const add = function (found) {
			const fresh = found.filter(line => line.number > last);
			if (!fresh.length) return;
			last = fresh[fresh.length - 1].number;
			const list = view();
			const isAtEnd = list.scrollHeight - list.scrollTop - list.clientHeight < NEAR_PX;
			lines(lines.peek().concat(fresh.map(rowOf)).slice(-MOST_LINES));
			if (isAtEnd) list.scrollTop = list.scrollHeight;
		};

		self.filter = ko.observable("").extend({rateLimit: {timeout: 100, method: "notifyWhenChangesStop"}});
		self.lines = ko.pureComputed(function () {
			const wanted = self.filter().trim().toLowerCase();
			return wanted ? lines().filter(line => line.text.toLowerCase().includes(wanted)) : lines();
		});

		let isAsking = false;
		const ask = function () {
			if (isAsking || !self.isOpen() || !core.mayWatch()) return;
			isAsking = true;
			OctoPrint.plugins.rrfmodel
				.getConsole(last)
				.done(function (answer) {
					// another server's numbers begin anew
					const newest = answer.lines.length ? answer.lines[answer.lines.length - 1].number : last;
					if (newest < last) forget();
					add(answer.lines);
				})
				.always(() => (isAsking = false));
		};
		const forget = function () {
			last = 0;
			lines([]);
		};
		// what is pushed while it is hidden is asked for when it is shown
		self.isOpen.subscribe(isOpen => isOpen && ask());
		core.mayWatch.subscribe(function (mayWatch) {
			forget();
			if (mayWatch) ask();
		});
		core.replies.subscribe(function (found) {
			if (!self.isOpen() || !found.length) return;
			if (isAsking || found[0].number > last + 1) ask();
			else add(found);
		});
		self.onServerConnect = self.onServerReconnect = function () {
			forget();
			ask();
		};

		self.clear = () => lines([]);

		//~~ the input

		const given = [];
		let place = 0;
		let draft = "";
		self.text = ko.observable("");

		self.send = function () {
			const text = self.text().trim();
			if (!text || !self.maySend()) return;
			if (given[given.length - 1] !== text) given.push(text);
			if (given.length > MOST_COMMANDS) given.shift();
			place = given.length;
			self.text("");
			const list = view();
			list.scrollTop = list.scrollHeight;
			const input = document.querySelector("[data-test=console-input]");
			RRFModel.mark([input], core.script(text));
		};

		self.onKey = function (_self, event) {
			const step = {ArrowUp: -1, ArrowDown: 1}[event.key];
			if (!step || place + step < 0 || place + step > given.length) return true;
			if (place === given.length) draft = self.text();
			place += step;
			self.text(place === given.length ? draft : given[place]);
			return false;
		};
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelConsoleViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#rrfmodel_console"]
	});
});
