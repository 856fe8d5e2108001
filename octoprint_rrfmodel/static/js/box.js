/* Message boxes of the machine (M291): one dialog on every open page, as long as the box is open. */
$(function () {
	const CLOSE = 1;
	const CANCELLABLE = 3;
	const CHOICES = 4;
	const INTEGER = 5;
	const NUMBER = 6;
	const TEXT = 7;
	const JOG_STEPS = [-10, -1, -0.1, 0.1, 1, 10];
	/** In mm/min. */
	const JOG_SPEED = 600;
	/** What was meant for what was there before answers no box that just opened. */
	const UNREAD_MS = 700;
	/** How long an accepted answer keeps the buttons locked where the box stays as it is. */
	const ANSWERED_MS = 5000;

	function RrfModelBoxViewModel(parameters) {
		const self = this;
		const core = parameters[0];

		self.mayControl = core.mayControl;
		self.value = ko.observable("");
		self.error = ko.observable("");
		/** Which answer is under way: "ok", "cancel", a choice's index; `null` without one. */
		self.sent = ko.observable(null);
		self.isUnread = ko.observable(false);
		/** Somebody wants to see the page behind the dialog; nothing is answered by that. */
		self.isAside = ko.observable(false);
		self.secondsLeft = ko.observable(0);

		/** The box as the model has it, `null` where none is open. */
		self.box = ko.pureComputed(function () {
			const box = core.isRrf() && (core.model("state") || {}).messageBox;
			return box && typeof box.mode === "number" && !core.isTold(box) ? box : null;
		});

		const member = (name, otherwise) =>
			ko.pureComputed(function () {
				const box = self.box();
				return box && box[name] !== undefined && box[name] !== null ? box[name] : otherwise;
			});
		const title = member("title", "");
		self.title = ko.pureComputed(() => RRFModel.plainText(title()) || gettext("Message"));
		self.message = member("message", "");
		self.mode = member("mode", -1);
		self.min = member("min", null);
		self.max = member("max", null);
		const seq = member("seq", null);

		// the firmware lacks a way, or the user the right to go it
		self.isUnanswerable = ko.pureComputed(() =>
			(core.status().warnings || []).some(w => w.code === "message_box_unanswerable")
		);
		self.canAnswer = ko.pureComputed(() => core.mayControl() && !self.isUnanswerable());
		self.mayAnswer = ko.pureComputed(() => self.canAnswer() && self.sent() === null && !self.isUnread());

		const choices = member("choices", []);
		const defaultChoice = member("default", -1);
		self.choices = RRFModel.rows(
			() =>
				self.mode() === CHOICES && Array.isArray(choices())
					? choices().map((text, index) => ({
							key: index,
							text: text,
							isDefault: index === defaultChoice()
						}))
					: [],
			function (row) {
				row.pick = () => answer("ok", row.key, row.key);
			}
		);
		self.wantsValue = ko.pureComputed(() => self.mode() >= INTEGER);
		self.inputType = ko.pureComputed(() => (self.mode() === TEXT ? "text" : "number"));
		self.step = ko.pureComputed(() => (self.mode() === INTEGER ? 1 : "any"));
		self.hasOk = ko.pureComputed(() => self.mode() >= CLOSE && self.mode() !== CHOICES);
		self.okText = ko.pureComputed(() => (self.mode() === CLOSE ? gettext("Close") : gettext("OK")));
		self.canCancel = ko.pureComputed(() => self.mode() === CANCELLABLE || !!member("cancelButton", false)());

		/** Axes that the box offers to move: bits in the order of the machine's axes. */
		const controls = member("axisControls", 0);
		self.axes = RRFModel.rows(
			() =>
				controls()
					? ((core.model("move") || {}).axes || [])
							.filter((axis, index) => axis && controls() & (1 << index))
							.map(axis => ({key: axis.letter}))
					: [],
			function (row) {
				row.letter = row.key;
				row.steps = JOG_STEPS.map(step => ({
					text: (step > 0 ? "+" : "") + step,
					label: _.sprintf(gettext("Move %(axis)s by %(step)s mm"), {
						axis: row.key,
						step: step
					}),
					// slow enough to stop in time
					jog: () => core.command("jog", {axes: {[row.key]: step}, speed: JOG_SPEED})
				}));
			}
		);
		self.positions = ko.pureComputed(() =>
			(controls() ? (core.model("move") || {}).axes || [] : [])
				.filter(axis => axis && axis.letter)
				.map(axis => axis.letter + " " + RRFModel.show.fixed(axis.userPosition, 2))
				.concat(controls() ? "mm" : [])
				.join("  ")
		);

		self.limitText = ko.pureComputed(function () {
			if (!self.wantsValue()) return "";
			const [min, max] = [self.min(), self.max()];
			const [ofText, ofNumber] =
				min === null
					? [gettext("At most %(max)s characters"), gettext("At most %(max)s")]
					: max === null
						? [gettext("At least %(min)s characters"), gettext("At least %(min)s")]
						: [gettext("From %(min)s to %(max)s characters"), gettext("From %(min)s to %(max)s")];
			if (min === null && max === null) return "";
			return _.sprintf(self.mode() === TEXT ? ofText : ofNumber, {min: min, max: max});
		});

		const fits = size => (self.min() === null || size >= self.min()) && (self.max() === null || size <= self.max());

		/** What was typed as the value to send; undefined where it isn't one. */
		const typed = function () {
			const text = String(self.value());
			if (self.mode() === TEXT) return fits(text.length) ? text : undefined;
			const number = Number(text.replace(",", "."));
			const isOne =
				text.trim() !== "" &&
				Number.isFinite(number) &&
				(self.mode() === NUMBER || Number.isInteger(number)) &&
				fits(number);
			return isOne ? number : undefined;
		};

		const answer = function (action, value, button = action) {
			if (!self.mayAnswer()) return;
			const values = {action: action};
			if (value !== undefined) values.value = value;
			// older firmware doesn't count its boxes
			if (seq() !== null) values.seq = seq();
			// who presses again before the next poll may answer the next box
			self.sent(button);
			const answered = shown;
			const ifSame = act => () => answered === shown && act();
			core
				.command("message_box", values)
				.done(ifSame(() => (unlocking = window.setTimeout(unlock, ANSWERED_MS))))
				.fail(
					ifSame(function () {
						unlock();
						takeFocus();
					})
				);
		};

		self.ok = function () {
			if (!self.hasOk() || !self.mayAnswer()) return;
			const value = self.wantsValue() ? typed() : undefined;
			if (self.wantsValue() && value === undefined) {
				self.error(
					[gettext("That is not a value that the machine takes."), self.limitText()].filter(Boolean).join(" ")
				);
				return;
			}
			answer("ok", value);
		};
		self.cancel = () => self.canCancel() && answer("cancel");
		/** What the button does that looks like the next step. */
		const confirm = function () {
			const chosen = self.choices().find(row => row.isDefault());
			if (chosen) chosen.pick();
			else self.ok();
		};

		self.timeText = ko.pureComputed(() =>
			self.secondsLeft() > 0
				? _.sprintf(gettext("Closes by itself in %(seconds)s s"), {
						seconds: self.secondsLeft()
					})
				: ""
		);

		//~~ opening and closing

		let dialog;
		let shown = null;
		let closesAt = 0;
		let unlocking;
		let reading;

		const unlock = function () {
			window.clearTimeout(unlocking);
			self.sent(null);
		};

		const keyOf = box => (box ? [box.seq, box.mode, box.title, box.message].join("|") : null);

		const update = function (box) {
			const key = keyOf(box);
			if (key === shown) return;
			const wasOpen = shown !== null && !self.isAside();
			shown = key;
			self.error("");
			unlock();
			self.isAside(false);
			window.clearTimeout(reading);
			self.isUnread(!!box);
			reading = window.setTimeout(() => self.isUnread(false), UNREAD_MS);
			if (!box) {
				if (wasOpen) dialog.modal("hide");
				return;
			}
			self.value(box.default !== undefined && box.default !== null ? String(box.default) : "");
			closesAt = box.timeout > 0 ? Date.now() + box.timeout : 0;
			tick();
			if (wasOpen) takeFocus();
			else open();
		};

		/** The button that was pressed has lost it when it was locked. */
		const takeFocus = () => window.setTimeout(focusOnContent);
		// on no button: a key that was meant for something else would answer
		const focusOnContent = () => dialog.find("input:visible:enabled, h3").last().trigger("focus").trigger("select");

		/** Where somebody was before; a dialog that goes leaves them nowhere. */
		let cameFrom = null;
		const goBack = function () {
			const isThere = cameFrom && cameFrom !== document.body && cameFrom.isConnected;
			if (isThere) cameFrom.focus({preventScroll: true});
			cameFrom = null;
		};

		const open = function () {
			if (!dialog[0].contains(document.activeElement)) cameFrom = document.activeElement;
			dialog.modal({backdrop: "static", keyboard: false});
		};

		self.putAside = function () {
			self.isAside(true);
			dialog.modal("hide");
		};
		self.showAgain = function () {
			self.isAside(false);
			open();
		};

		const tick = () => self.secondsLeft(closesAt ? Math.max(0, Math.ceil((closesAt - Date.now()) / 1000)) : 0);

		self.onKey = function (_self, event) {
			if (event.key === "Escape") self.cancel();
			if (event.key !== "Enter") return true;
			// held down it was meant for what was there before; buttons, links and fields have their own
			const isHere = !$(event.target).closest("button, a, input").length;
			const isHeld = (event.originalEvent || event).repeat;
			if (isHere && !isHeld) confirm();
			return !isHeld;
		};

		self.onAllBound = function () {
			dialog = $("#rrfmodel_box_dialog");
			dialog.on("shown", focusOnContent);
			dialog.on("hidden", goBack);
			self.box.subscribe(update);
			update(self.box());
			window.setInterval(() => shown !== null && tick(), 1000);
		};
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelBoxViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#rrfmodel_box"]
	});
});
