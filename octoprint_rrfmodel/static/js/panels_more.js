/* Outputs, variables, kept positions, drivers and sound, in the sub-view Machine. */
$(function () {
	const {list, numbered, object, show} = RRFModel;
	const SOUND = "rrfmodel.sound";
	const MOST_MS = 5000;
	/** Bits of a driver's status, the worst first; of one that stands the load says nothing. */
	const DRIVERS = [
		[1 << 1, "hot", "important"],
		[15 << 2, "short", "important"],
		[(1 << 9) | (1 << 11) | (1 << 14), "error", "important"],
		[1, "warm", "warning"],
		[3 << 6, "open", "warning"]
	];
	const STANDS = 3 << 16;

	/** What somebody has typed as a value of a variable: of a text's a text again. */
	const valueOf = function (typed, told) {
		const number = Number(typed);
		if (typeof told === "string" || !typed.trim()) return typed;
		if (typed === "true" || typed === "false") return typed === "true";
		return Number.isFinite(number) ? number : typed;
	};

	/** The machine's beeps, once somebody has wanted them and clicked, as browsers ask for. */
	const addSound = function (core, self) {
		let context = null;
		self.isLoud = ko.observable(window.localStorage.getItem(SOUND) === "on");
		self.toggleSound = function () {
			self.isLoud(!self.isLoud());
			window.localStorage.setItem(SOUND, self.isLoud() ? "on" : "off");
		};
		document.addEventListener("click", function () {
			if (!self.isLoud()) return;
			context = context || new AudioContext();
			context.resume();
		});
		ko.pureComputed(() => JSON.stringify(object(core.model("state")).beep)).subscribe(function (told) {
			const {frequency, duration} = object(told && JSON.parse(told));
			if (!frequency || !context || !self.isLoud()) return;
			const [tone, volume] = [context.createOscillator(), context.createGain()];
			tone.frequency.value = frequency;
			volume.gain.value = 0.1;
			tone.connect(volume).connect(context.destination);
			tone.start();
			tone.stop(context.currentTime + Math.min(duration, MOST_MS) / 1000);
		});
	};

	/** Members over the model of its view; `isOpen(name)` of a fold. */
	RRFModel.morePanels = function (core, model, isOpen) {
		const self = {};
		const move = () => object(model("move"));
		const opened = (name, value) => (isOpen(name) ? value() : []);
		addSound(core, self);

		const strips = () => numbered(model("ledStrips"));
		self.strips = RRFModel.rows(
			() => opened("outputs", strips).map(({index}) => ({key: index})),
			function (row) {
				row.colour = ko.observable("#ffffff");
				row.count = ko.observable(60);
				row.light = function (colour) {
					const [red, green, blue] = [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16));
					return core.command("led", {strip: row.key, red, green, blue, count: +row.count()});
				};
			}
		);

		const variables = () => Object.entries(object(model("global")));
		self.variables = RRFModel.rows(
			() => opened("variables", variables).map(([key, value]) => ({key, value})),
			function (row) {
				const typed = ko.observable();
				const told = () => (typeof row.value() === "string" ? row.value() : JSON.stringify(row.value()));
				row.isDirty = ko.pureComputed(() => typed() !== undefined);
				row.text = ko.pureComputed({
					read: () => (row.isDirty() ? typed() : told()),
					write: typed
				});
				row.isList = ko.pureComputed(() => Array.isArray(row.value()));
				row.set = function (form) {
					const value = valueOf(row.text(), row.value());
					const promise = core.command("variable", {name: row.key, value: value});
					RRFModel.mark([form.querySelector("input")], promise).always(() => typed(undefined));
				};
			}
		);

		const places = () => numbered(object(model("state")).restorePoints);
		self.places = RRFModel.rows(() =>
			opened("places", places).map(({item, index}) => ({
				key: index,
				text: numbered(move().axes)
					.filter(axis => axis.item.visible !== false)
					.map(axis => axis.item.letter + " " + show.fixed(list(item.coords)[axis.index], 2))
					.join(" ")
			}))
		);
		self.counts = {
			strips: ko.pureComputed(() => strips().length),
			variables: ko.pureComputed(() => variables().length),
			places: ko.pureComputed(() => places().length)
		};

		/** What a driver moves, by its name in the model; the main board's may have no board in it. */
		const movedBy = function (name) {
			const isIt = driver => driver === name || "0." + driver === name;
			const axis = list(move().axes).find(each => each && list(each.drivers).some(isIt));
			const extruder = list(move().extruders).findIndex(each => each && isIt(each.driver));
			return (axis && axis.letter) || (extruder < 0 ? "" : "E" + extruder);
		};
		self.drivers = RRFModel.rows(() =>
			opened("boards", () => list(model("boards"))).flatMap((board, place) =>
				list(object(board).drivers).map(function (driver, number) {
					const {status} = object(driver);
					const name = (board.canAddress || place) + "." + number;
					const isSo = ([bits]) => bits & (status & STANDS ? status & ~(3 << 6) : status);
					const [, word, level] = DRIVERS.find(isSo) || [0, "", "success"];
					return {key: name, drives: movedBy(name), word, css: "label label-" + level};
				})
			)
		);
		return self;
	};
});
