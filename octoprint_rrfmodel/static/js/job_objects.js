/* The objects of the board's own print, as rows and as a map of the bed; each can be cancelled. */
$(function () {
	const {list, isNumber} = RRFModel;

	/** Letters of a name that have room in the map. */
	const MOST_LETTERS = 14;

	const isRange = ends => list(ends).length === 2 && ends.every(isNumber);
	/** Left, right, front and back of an object, as a text; empty where they aren't known. */
	RRFModel.endsOf = each => (each && isRange(each.x) && isRange(each.y) ? each.x.concat(each.y).join() : "");

	/** Returns their rows; `asked` asks before what can't be taken back. */
	RRFModel.jobObjects = function (core, job, asked) {
		const range = ends => (isRange(ends) ? ends.map(Math.round).join("…") : "–");

		return RRFModel.rows(
			function () {
				const build = job().build || {};
				return list(build.objects).map((each, index) => ({
					key: index,
					name: (each && each.name) || _.sprintf(gettext("Object %(number)s"), {number: index + 1}),
					place: each ? "X " + range(each.x) + ", Y " + range(each.y) + " mm" : "",
					hasPlace: !!RRFModel.endsOf(each),
					ends: RRFModel.endsOf(each),
					isCurrent: build.currentObject === index,
					isCancelled: !!(each && each.cancelled)
				}));
			},
			function (row) {
				const send = action => () => core.command("object", {index: row.key, action: action});
				row.cancel = () =>
					asked(
						_.sprintf(gettext("Cancel object %(name)s?"), {name: row.name()}),
						_.sprintf(gettext("%(name)s isn't printed any further."), {name: row.name()}),
						gettext("Cancel object"),
						send("cancel")
					);
				row.resume = send("resume");
				row.stateText = ko.pureComputed(function () {
					if (row.isCancelled()) return gettext("cancelled");
					return row.isCurrent() ? gettext("printed now") : "";
				});
				const label = text => ko.pureComputed(() => row.name() + ": " + text);
				row.cancelLabel = label(gettext("Cancel object"));
				row.resumeLabel = label(gettext("Print again"));
				row.mapLabel = ko.pureComputed(() => (row.isCancelled() ? row.resumeLabel() : row.cancelLabel()));
				row.turn = () => (row.isCancelled() ? row.resume() : row.cancel());
			}
		);
	};

	/** Returns the map of these rows on the bed that `move()` tells of. */
	RRFModel.objectMap = function (core, move, objects) {
		const self = RRFModel.bedMap(move);
		self.isThere = ko.pureComputed(() => self.isKnown() && objects().some(row => row.hasPlace()));
		/** Where the name of a row stands. */
		self.textOf = function (row) {
			const {x, y, width, height} = self.rectOf(row.ends());
			const size = self.letters();
			return {x: x + width / 2, y: y + height / 2 + size / 3, "font-size": size};
		};
		self.nameOf = function (row) {
			const name = row.name();
			return name.length > MOST_LETTERS ? name.slice(0, MOST_LETTERS - 1) + "…" : name;
		};
		self.mayTurn = ko.pureComputed(() => core.mayControl() && !core.forbidden("object"));
		self.onClick = row => (self.mayTurn() ? row.turn() : undefined);
		self.onKey = function (row, event) {
			if (!["Enter", " "].includes(event.key)) return true;
			if (self.mayTurn()) row.turn();
			return false;
		};
		return self;
	};
});
