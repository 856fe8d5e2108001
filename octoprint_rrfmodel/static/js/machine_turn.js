/* What is turned in the sub-view Machine: fans, factors, extruders, spindles. */
$(function () {
	const LENGTHS = [1, 5, 10, 50];
	const {list, numbered, object, isNumber} = RRFModel;

	/** Whether temperatures rule a fan; its sensors were heaters before 3.4. */
	const isThermostatic = thermostatic => list(thermostatic.sensors || thermostatic.heaters).length > 0;

	const percentOf = fraction => (isNumber(fraction) ? Math.round(fraction * 100) : null);

	/**
	 * A number that is turned up and down: `value`, `send(value)`, and `more` and `less`, which go
	 * by `step` from what was given last.
	 */
	RRFModel.turned = function (core, value, send, step, [least, most]) {
		const given = RRFModel.lastGiven(core, () => [value()]);
		const self = {value: ko.pureComputed(() => given.values()[0])};
		self.send = wanted => given.send([wanted], send(wanted));
		const by = change =>
			function () {
				const known = self.value();
				if (isNumber(known)) return self.send(Math.min(most, Math.max(least, known + change)));
			};
		self.less = by(-step);
		self.more = by(step);
		self.text = ko.pureComputed(() => (isNumber(value()) ? value() + " %" : "–"));
		return self;
	};

	/** Returns the members of a view model over the model of its view. */
	RRFModel.machineTurns = function (core, model) {
		const self = {};
		const show = RRFModel.show;
		const named = RRFModel.named;
		const move = ko.pureComputed(() => object(model("move")));

		//~~ fans

		self.fans = RRFModel.rows(
			() =>
				numbered(model("fans")).map(({item, index}) => ({
					key: index,
					name: item.name || _.sprintf(gettext("Fan %(number)s"), {number: index}),
					speed: percentOf(item.requestedValue || 0),
					actual: show.percent(item.actualValue),
					rpm: item.rpm >= 0 ? item.rpm + " " + gettext("rpm") : "",
					isThermostatic: isThermostatic(item.thermostatic || {}),
					from: object(item.thermostatic).lowTemperature
				})),
			function (row) {
				const send = percent => core.command("fan", {fan: row.key, speed: percent / 100});
				row.turned = RRFModel.turned(core, row.speed, send, 10, [0, 100]);
				/** What the slider is at while somebody holds it. */
				const held = ko.observable();
				row.slider = ko.pureComputed({
					read: () => (held() === undefined ? row.turned.value() : held()),
					write: value => held(Number(value))
				});
				row.slide = function (_row, event) {
					if (held() === undefined) return;
					RRFModel.mark([event.target], row.turned.send(held()));
					held(undefined);
				};
				row.label = named(row, gettext("Speed of %(name)s in percent"));
				row.automatic = ko.pureComputed(() =>
					isNumber(row.from())
						? _.sprintf(gettext("automatic from %(degrees)s °C"), {degrees: row.from()})
						: gettext("automatic")
				);
			}
		);

		//~~ factors

		const speedFactor = ko.pureComputed(() => percentOf(move().speedFactor));
		const setSpeed = percent => core.command("speed_factor", {percent});
		self.speed = RRFModel.turned(core, speedFactor, setSpeed, 5, [1, 1000]);

		const extruders = RRFModel.rows(
			() =>
				numbered(move().extruders).map(({item, index}) => ({
					key: index,
					name: _.sprintf(gettext("Extruder %(number)s"), {number: index}),
					percent: percentOf(item.factor)
				})),
			function (row) {
				const set = percent => core.command("extrusion_factor", {extruder: row.key, percent});
				row.turned = RRFModel.turned(core, row.percent, set, 1, [1, 1000]);
				row.label = named(row, gettext("Extrusion factor of %(name)s"));
				row.lessLabel = named(row, gettext("Extrude less: %(name)s"));
				row.moreLabel = named(row, gettext("Extrude more: %(name)s"));
			}
		);
		self.showsAllExtruders = ko.observable(false);
		self.toggleExtruders = () => self.showsAllExtruders(!self.showsAllExtruders());
		const used = ko.pureComputed(function () {
			const current = object(model("state")).currentTool;
			const tool = list(model("tools")).find(each => each && each.number === current);
			return list(object(tool).extruders);
		});
		/** Those of the tool that is selected; of several machines' many only one is turned. */
		self.extruders = ko.pureComputed(function () {
			const all = extruders();
			if (self.showsAllExtruders() || all.length < 3) return all;
			const found = all.filter(row => used().includes(row.key));
			return found.length ? found : all.slice(0, 1);
		});
		self.hasMoreExtruders = ko.pureComputed(() => extruders().length > 2);
		self.hasExtruder = ko.pureComputed(() => extruders().length > 0);

		//~~ extrusion

		/** In mm/s. */
		self.extrudeSpeed = ko.observable(5);
		const extrude = amount => core.command("extrude", {amounts: amount, speed: 60 * Number(self.extrudeSpeed())});
		const lengths = (sign, text) =>
			LENGTHS.map(length => ({
				length,
				label: _.sprintf(text, {length}),
				run: () => extrude(sign * length)
			}));
		self.extrusions = lengths(1, gettext("Extrude %(length)s mm"));
		self.retractions = lengths(-1, gettext("Retract %(length)s mm"));
		self.extrude = extrude;
		return self;
	};
});
