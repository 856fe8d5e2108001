/* Spindles of a router in the sub-view Machine, and the laser in their stead. */
$(function () {
	const {numbered, object} = RRFModel;

	/** Returns the members of a view model over the model of its view. */
	RRFModel.spindles = function (core, model) {
		const self = {};
		const show = RRFModel.show;
		self.spindles = RRFModel.rows(
			() =>
				numbered(model("spindles"))
					.filter(found => found.item.state !== "unconfigured")
					.map(found => ({
						key: found.index,
						name: _.sprintf(gettext("Spindle %(number)s"), {number: found.index}),
						current: show.fixed(found.item.current, 0),
						active: found.item.active,
						state: RRFModel.term("spindle", found.item.state),
						turnsBack: found.item.state === "reverse",
						// told from 3.5 on
						canReverse: found.item.canReverse !== false,
						max: found.item.max
					})),
			function (row) {
				row.label = _.sprintf(gettext("Speed of %(name)s in rpm"), {name: row.name()});
				/** What somebody has chosen, until the machine turns that way. */
				const wanted = ko.observable(null);
				let isSent = false;
				row.isReverse = ko.pureComputed({
					read: () => (wanted() === null ? row.turnsBack() : wanted()),
					write: function (isReverse) {
						// while the machine is to turn another way, its present one says nothing
						const isNew = isSent || isReverse !== row.turnsBack();
						isSent = false;
						wanted(isNew ? isReverse : null);
					}
				});
				const asItTurns = function () {
					isSent = false;
					wanted(null);
				};
				row.turnsBack.subscribe(function (turnsBack) {
					if (isSent || turnsBack === wanted()) asItTurns();
				});
				row.set = function (rpm) {
					isSent = wanted() !== null;
					return core.command("spindle", {
						spindle: row.key,
						rpm: rpm,
						direction: row.isReverse() ? "reverse" : "forward"
					});
				};
				row.stop = function () {
					asItTurns();
					return core.command("spindle", {spindle: row.key, rpm: 0});
				};
			}
		);
		self.laser = ko.pureComputed(() =>
			object(model("state")).machineMode === "Laser"
				? show.percent(object(object(model("move")).currentMove).laserPwm)
				: ""
		);
		return self;
	};
});
