/* Tuning in the sub-view Machine: motors, input shaping, heaters, and what of it lasts. */
$(function () {
	const {list, numbered, object} = RRFModel;
	const SHAPERS = ["none", "mzv", "zvd", "zvdd", "zvddd", "ei2", "ei3"];
	const MONITORS = [0, 1, 2];

	/** Members over the model of its view; `isOpen(name)` of a fold. */
	RRFModel.tuning = function (core, model, isOpen) {
		const self = {command: core.command, confirm: core.confirm};
		const move = ko.pureComputed(() => (isOpen("tuning") ? object(model("move")) : {}));
		const heat = ko.pureComputed(() => object(model("heat")));

		/** What was changed here since the machine started: its restart forgets it. */
		self.changes = ko.observableArray();
		core.resets.subscribe(() => self.changes([]));
		/** Sends a command, and keeps in mind what it has changed. */
		self.change = (what, text, name, values) =>
			core.command(name, values).done(function () {
				const others = self.changes().filter(each => each.what !== what);
				self.changes(others.concat({what: what, text: what + ": " + text}));
			});

		//~~ motors

		self.drives = RRFModel.rows(() => [
			...numbered(move().axes)
				.filter(({item}) => item.letter)
				.map(({item}) => ({key: item.letter, name: item.letter, current: item.current})),
			...numbered(move().extruders).map(({item, index}) => ({
				key: index,
				name: _.sprintf(gettext("Extruder %(number)s"), {number: index}),
				current: item.current,
				advance: RRFModel.pressureAdvance(item)
			}))
		]);

		const shaping = ko.pureComputed(() => object(move().shaping));
		const given = RRFModel.lastGiven(core, () => [shaping().type]);
		self.shapers = SHAPERS.map(name => ({name: name, text: RRFModel.term("shaping", name)}));
		self.shape = function (values) {
			const wanted = Object.assign({type: given.values()[0]}, values);
			const {type, frequency, damping} = wanted;
			const words = [RRFModel.term("shaping", type), frequency && frequency + " Hz", damping];
			const text = words.filter(Boolean).join(" ");
			return self.change(gettext("Input shaping"), text, "input_shaping", wanted);
		};
		self.shaper = ko.pureComputed({
			read: () => given.values()[0],
			write: type => type !== undefined && type !== given.values()[0] && given.send([type], self.shape({type}))
		});
		self.hasShaper = ko.pureComputed(() => SHAPERS.includes(shaping().type));
		self.frequency = ko.pureComputed(() => shaping().frequency);
		self.damping = ko.pureComputed(() => shaping().damping);

		//~~ heaters

		const monitorOf = row => place => {
			const told = ko.pureComputed(() => object(row.monitors()[place]));
			const name = row.name() + ", " + (place + 1);
			const set = function (values) {
				const {limit, condition, action} = Object.assign({}, told(), values);
				const isOff = condition === "disabled";
				const sent = {heater: row.key, monitor: place, condition: condition};
				// one that was off has no limit
				if (!isOff) Object.assign(sent, {limit: limit || row.max(), action: action || 0});
				return self.change(name, isOff ? "–" : sent.limit + " °C", "heater_monitor", sent);
			};
			const choice = member =>
				ko.pureComputed({
					read: () => told()[member],
					write: value => value !== undefined && value !== told()[member] && set({[member]: value})
				});
			return {
				label: name,
				limit: ko.pureComputed(() => told().limit),
				setLimit: limit => set({limit: limit}),
				condition: choice("condition"),
				action: choice("action"),
				isOn: ko.pureComputed(() => RRFModel.isNumber(told().limit))
			};
		};
		const options = (kind, names) => names.map(name => ({name: name, text: RRFModel.term(kind, name)}));
		self.conditions = options("condition", ["disabled", "tooHigh", "tooLow"]);
		self.actions = options("action", [0, 1, 2, 3]);

		self.heaterRows = RRFModel.rows(
			() =>
				(isOpen("heaters") ? numbered(heat().heaters) : []).map(({item, index}) => ({
					key: index,
					name: RRFModel.heaterName(core, index),
					max: item.max,
					isTuning: item.state === "tuning",
					monitors: list(item.monitors),
					rate: RRFModel.show.fixed(object(item.model).heatingRate, 2),
					deadTime: RRFModel.show.fixed(object(item.model).deadTime, 1)
				})),
			row => (row.fields = MONITORS.map(monitorOf(row)))
		);

		/** What the firmware says of how far a tuning is, and what came of it. */
		self.tuningSaid = ko.observable("");
		core.replies.subscribe(function (lines) {
			const said = lines.filter(line => /^auto tun/i.test(line.message)).pop();
			if (said) self.tuningSaid(said.message);
		});

		self.heatersSummary = ko.pureComputed(() =>
			numbered(heat().heaters)
				.map(({item, index}) =>
					[
						RRFModel.heaterName(core, index),
						item.state === "tuning" ? gettext("tuning") : "≤ " + item.max + " °C"
					].join(" ")
				)
				.join(", ")
		);
		return self;
	};
});
