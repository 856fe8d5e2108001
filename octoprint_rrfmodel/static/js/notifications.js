/* What is told once when it begins, and taken back when it is over, and what the machine answers. */
$(function () {
	const TYPES = {fault: "error", warning: "notice"};

	/** Lines of one reply that a notification has room for. */
	const MOST_LINES = 12;
	const REPLY_MS = 8000;
	const ERROR_MS = 20000;
	const KINDS = [
		{begins: /^Error:/, type: "error", delay: ERROR_MS},
		{begins: /^Warning:/, type: "notice", delay: ERROR_MS},
		{begins: /(?:)/, type: "info", delay: REPLY_MS}
	];

	/** They come with every click, and must not lie on what is clicked next, a stop least of all. */
	const BELOW = {dir1: "up", dir2: "left", firstpos1: 25, firstpos2: 25};

	function RrfModelNotificationsViewModel(parameters) {
		const core = parameters[0];
		let told = new Map();

		/** The strip is seen: what stands there isn't told once more. */
		const isInStrip = ko.pureComputed(() => core.tabIsOpen() && core.pageIsVisible());

		/** What is to be told now. Advice can wait and stands in strip and sidebar. */
		const due = ko.pureComputed(() => core.alerts().filter(row => row.level !== "advice"));

		/** The part of a notification that has the button, for those who may press it. */
		const confirmation = function (row) {
			if (!row.fix) return {};
			return {
				confirm: true,
				buttons: [
					{text: gettext("Later"), click: notice => notice.remove()},
					{
						text: row.fix.text,
						addClass: "btn-primary",
						click: function (notice) {
							notice.remove();
							core.mend(row);
						}
					}
				]
			};
		};

		const tell = row =>
			core.notify(row.text, TYPES[row.level] || "error", {
				hide: false,
				confirm: confirmation(row)
			});

		/** Who has seen it in the strip knows it, and who opens the strip sees it there. */
		const update = function () {
			const next = new Map();
			due().forEach(row => next.set(row.key, told.has(row.key) ? told.get(row.key) : isInStrip() ? null : tell(row)));
			told.forEach((notice, key) => !next.has(key) && notice && notice.remove());
			told = next;
		};
		due.subscribe(update);
		isInStrip.subscribe(function (isSeen) {
			if (!isSeen) return;
			told.forEach(function (notice, key) {
				if (notice) notice.remove();
				told.set(key, null);
			});
		});

		//~~ replies

		core.replies.subscribe(function (lines) {
			if (core.isShown("console")() || !core.awaitsReplies()) return;
			const texts = lines.filter(line => line.asked && line.type === "response").map(line => line.message);
			if (!texts.length) return;
			const kind = KINDS.find(each => texts.some(text => each.begins.test(text)));
			const rest = texts.length > MOST_LINES ? ["…"] : [];
			core.notify(texts.slice(0, MOST_LINES).concat(rest).join("\n"), kind.type, {
				title: gettext("The machine says"),
				delay: kind.delay,
				addclass: "rrfmodel-told",
				stack: BELOW
			});
		});
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelNotificationsViewModel,
		dependencies: ["rrfModelViewModel"]
	});
});
