/* How the sub-view Machine moves: axes with their steps, homing, levelling, workplaces. */
$(function () {
	/** Distances of one click, the longest first. */
	const STEPS = [50, 10, 1, 0.1];
	/** One that goes towards a bed goes in smaller ones. */
	const STEPS_OF = {Z: [10, 1, 0.1, 0.05]};
	/** The step of the buttons that are marked plus and minus for whoever looks for those. */
	const PLAIN_STEP = 1;
	/** G54 to G59.3. */
	const WORKPLACES = 9;
	/** A tower of a delta moves with the others, and homes with them. */
	const TOWERS = ["X", "Y", "Z"];
	const {list, numbered, object} = RRFModel;

	const workplaceName = number => "G" + (number < 6 ? number + 54 : "59." + (number - 5));
	RRFModel.workplaceName = workplaceName;

	/** Whether the kinematics is a delta's, by the names that firmware has had for them. */
	RRFModel.isDelta = move => /delta/i.test(object(object(move).kinematics).name || "");

	/** Returns the members of a view model over the model of its view. */
	RRFModel.machineMoves = function (core, model) {
		const self = {};
		const show = RRFModel.show;
		const move = ko.pureComputed(() => object(model("move")));
		const mode = ko.pureComputed(() => object(model("state")).machineMode);
		const isDelta = ko.pureComputed(() => RRFModel.isDelta(move()));

		/** Of machines without filament, whose zero is where the workpiece is. */
		self.isRouter = ko.pureComputed(() => ["CNC", "Laser"].includes(mode()));

		/** In mm/min, as the firmware counts; an axis goes no faster than it can. */
		self.jogSpeed = ko.observable(6000);
		const jog = function (axes, more) {
			const speed = Number(self.jogSpeed());
			const values = speed > 0 ? {axes: axes, speed: speed} : {axes: axes};
			return core.command("jog", Object.assign(values, more));
		};

		const stepButton = (letter, distance) => ({
			text: (distance > 0 ? "+" : "−") + Math.abs(distance),
			test: Math.abs(distance) === PLAIN_STEP ? (distance > 0 ? "plus" : "minus") : "jog",
			distance: distance,
			label: _.sprintf(
				distance > 0
					? gettext("Move %(axis)s forward by %(distance)s mm")
					: gettext("Move %(axis)s back by %(distance)s mm"),
				{axis: letter, distance: Math.abs(distance)}
			),
			run: () => jog({[letter]: distance})
		});

		self.axes = RRFModel.rows(
			() =>
				numbered(move().axes)
					.filter(({item}) => item.letter && item.visible !== false)
					.map(({item}) => ({
						// A and a are two axes
						key: item.letter,
						homed: !!item.homed,
						position: show.fixed(item.userPosition, 2),
						machine: show.fixed(item.machinePosition, 2),
						limits: show.fixed(item.min, 0) + " … " + show.fixed(item.max, 0) + " mm",
						homesAlone: !(isDelta() && TOWERS.includes(item.letter))
					})),
			function (row) {
				row.letter = row.key;
				const steps = STEPS_OF[row.letter] || STEPS;
				row.back = steps.map(step => stepButton(row.letter, -step));
				row.forward = steps
					.slice()
					.reverse()
					.map(step => stepButton(row.letter, step));
				row.goTo = position => jog({[row.letter]: position}, {absolute: true});
				row.home = () => core.command("home", {axes: [row.letter]});
				row.setZero = () => setZero([row.letter]);
				const ofAxis = text => _.sprintf(text, {axis: row.letter});
				row.homeLabel = ofAxis(gettext("Home %(axis)s"));
				row.goLabel = ofAxis(gettext("Move %(axis)s to a position in mm"));
				row.zeroLabel = ofAxis(gettext("Set %(axis)s to zero here"));
				row.homedText = ko.pureComputed(() => (row.homed() ? gettext("homed") : gettext("not homed")));
			}
		);
		self.homeAll = () => core.command("home", {axes: []});

		//~~ levelling

		self.hasProbe = ko.pureComputed(() => numbered(object(model("sensors")).probes).length > 0 || isDelta());
		self.mesh = action => () => core.command("mesh", {action: action});

		//~~ workplaces

		const known = ko.pureComputed(() => object(move()).workplaceNumber);
		const chosen = RRFModel.lastGiven(core, () => [known()]);
		self.workplaces = _.range(WORKPLACES).map(number => ({
			number: number,
			name: workplaceName(number)
		}));
		/** Counts from 0, as in the model. */
		self.workplace = ko.pureComputed({
			read: () => chosen.values()[0] || 0,
			write: function (number) {
				// the element tells its value too, when it comes to be
				if (number === undefined || number === chosen.values()[0]) return;
				chosen.send([number], core.command("workplace", {workplace: number + 1}));
			}
		});
		const setZero = letters => core.command("set_zero", {axes: letters, workplace: self.workplace() + 1});
		self.setAllZero = () => setZero(self.axes().map(row => row.letter));

		//~~ baby step

		self.babystep = ko.pureComputed(function () {
			const z = list(move().axes).find(axis => axis && axis.letter === "Z");
			return z ? show.fixed(z.babystep, 3) : "–";
		});
		self.babysteps = [-0.05, -0.02, 0.02, 0.05].map(amount => ({
			text: (amount > 0 ? "+" : "−") + Math.abs(amount),
			label: _.sprintf(gettext("Baby step of %(amount)s mm"), {amount: amount}),
			step: () => core.command("babystep", {axis: "Z", amount: amount})
		}));
		self.clearBabystep = () => core.command("babystep", {axis: "Z", amount: 0, absolute: true});
		return self;
	};
});
