/* The bed as a picture in the sub-view Machine: mesh, objects, head, and what is calibrated. */
$(function () {
	/** Heights in mm that the colours and the profile reach to, the least that has room is taken. */
	const REACHES = [0.05, 0.1, 0.2, 0.5, 1, 2, 5];
	/** Below zero and above. */
	const COLOURS = ["47, 134, 214", "217, 83, 79"];
	/** More points than that in a row are no grid of a bed. */
	const MOST = 200;
	const {list, object, isNumber} = RRFModel;

	const signed = (value, digits, unit) =>
		isNumber(value) ? (value < 0 ? "−" : "+") + Math.abs(value).toFixed(digits) + " " + unit : "–";
	const pair = (found, names) => (list(found).length ? list(found) : names).slice(0, 2);

	/** One over other axes has no place in a picture from above. */
	const isFromAbove = ({axes}) => ["", "XY"].includes(list(axes).join(""));

	/** The grid of a map that is known, or of what the model tells; null where there is none. */
	const gridOf = function (map, found) {
		if (map) return {min: map.min, spacing: map.spacing, count: map.count, radius: map.radius};
		if (!found || !isFromAbove(found)) return null;
		const min = pair(found.mins, [found.xMin, found.yMin]);
		const max = pair(found.maxs, [found.xMax, found.yMax]);
		const spacing = pair(found.spacings, [found.xSpacing, found.ySpacing]);
		const count = spacing.map((step, at) => Math.floor((max[at] - min[at]) / step + 1.01));
		const isGrid = count.every(each => each > 0 && each < MOST);
		return isGrid ? {min, spacing, count, radius: found.radius} : null;
	};

	/** Its points as `{x, y, column, row}`, those that lie outside of its radius left out. */
	const pointsOf = ({min, spacing, count, radius}) =>
		_.flatten(
			_.range(count[1]).map(row =>
				_.range(count[0]).map(column => ({
					column: column,
					row: row,
					x: min[0] + column * spacing[0],
					y: min[1] + row * spacing[1]
				}))
			)
		).filter(({x, y}) => !(radius > 0) || Math.hypot(x, y) < radius);

	/** Members over the model of its view; `isOpen()` of its fold. */
	RRFModel.machineBed = function (core, model, isOpen) {
		const move = ko.pureComputed(() => (isOpen() ? object(model("move")) : {}));
		const kinematics = () => object(move().kinematics);
		const compensation = () => object(move().compensation);
		/** The same object as long as nothing in it changes, so that nothing is drawn anew. */
		const steady = function (value) {
			const made = ko.pureComputed(value);
			made.equalityComparer = _.isEqual;
			return made;
		};

		//~~ what is calibrated: towers of a delta, screws that a bed stands on

		const marks = steady(function () {
			const {towers, tiltCorrection} = kinematics();
			const {screwX, screwY, lastCorrections} = object(tiltCorrection);
			const screws = list(screwX).map((x, index) => ({
				name: _.sprintf(gettext("Screw %(number)s"), {number: index + 1}),
				short: String(index + 1),
				x: x,
				y: list(screwY)[index],
				text: signed(list(lastCorrections)[index], 3, "mm"),
				more: ""
			}));
			return list(towers)
				.map((tower, index) => ({
					name: _.sprintf(gettext("Tower %(name)s"), {name: "XYZUVW"[index]}),
					short: "XYZUVW"[index],
					x: tower.xPos,
					y: tower.yPos,
					text: signed(tower.endstopAdjustment, 3, "mm"),
					more: tower.angleCorrection ? ", " + signed(tower.angleCorrection, 2, "°") : ""
				}))
				.concat(screws)
				.filter(({x, y}) => isNumber(x) && isNumber(y));
		});

		const self = RRFModel.bedMap(move, marks);
		self.marks = marks;
		self.markOf = ({x, y}) => ({cx: x, cy: -y, r: self.letters() / 4});
		self.markTextOf = ({x, y}) => ({x: x, y: -y - self.letters() / 2, "font-size": self.letters()});
		self.tilt = ko.pureComputed(function () {
			const {xTilt, yTilt} = kinematics();
			const percent = tilt => signed(100 * tilt, 3, "%");
			return isNumber(xTilt) && isNumber(yTilt) ? `X ${percent(xTilt)}, Y ${percent(yTilt)}` : "";
		});

		//~~ mesh

		/** Asked for where the machine's files can be read, whenever the mesh is another one. */
		const wanted = ko.pureComputed(function () {
			const {file, meshDeviation} = compensation();
			const isKnown = core.hasNetwork() && file && meshDeviation;
			return isKnown ? JSON.stringify([core.resets(), file, meshDeviation]) : "";
		});
		wanted.subscribe(function (mine) {
			core.heightmap(null);
			if (!mine) return;
			OctoPrint.plugins.rrfmodel.getHeightmap().done(found => wanted() === mine && core.heightmap(found));
		});

		const isUsed = ko.pureComputed(() => !!compensation().meshDeviation);
		const map = ko.pureComputed(function () {
			const found = isUsed() && core.heightmap();
			return found && isFromAbove(found) ? found : null;
		});
		const grid = steady(() => gridOf(map(), (isUsed() && compensation().liveGrid) || compensation().probeGrid));
		self.gridClass = ko.pureComputed(() => (isUsed() ? "" : "rrfmodel-map-next"));
		/** Dots of a line's round ends. */
		self.dots = ko.pureComputed(() =>
			grid() && !map()
				? pointsOf(grid())
						.map(({x, y}) => `M${x} ${-y}h0`)
						.join("")
				: ""
		);
		self.dotSize = ko.pureComputed(() => self.letters() / 5);
		self.gridText = ko.pureComputed(function () {
			if (!grid()) return "";
			const {count, spacing} = grid();
			const values = {
				columns: count[0],
				rows: count[1],
				x: +spacing[0].toFixed(1),
				y: +spacing[1].toFixed(1)
			};
			const text = isUsed()
				? gettext("%(columns)s × %(rows)s points, every %(x)s × %(y)s mm")
				: gettext("next probing: %(columns)s × %(rows)s points, every %(x)s × %(y)s mm");
			return _.sprintf(text, values) + (map() ? "; " + gettext("blue is low, red is high") : "");
		});

		const known = steady(function () {
			const points = map() ? pointsOf(grid()) : [];
			return points
				.map(point => Object.assign({z: list(map().points[point.row])[point.column]}, point))
				.filter(({z}) => isNumber(z));
		});
		const deviation = steady(() => object(compensation().meshDeviation));
		const reach = ko.pureComputed(function () {
			const {mean, deviation: root} = deviation();
			const most = known().length ? Math.max(...known().map(({z}) => Math.abs(z))) : Math.abs(mean) + 2 * root;
			return REACHES.find(each => each >= most) || most;
		});
		self.cells = ko.pureComputed(function () {
			const [width, height] = grid() ? grid().spacing : [0, 0];
			return known().map(({x, y, z}) => ({
				place: {
					x: x - width / 2,
					y: -y - height / 2,
					width: width,
					height: height,
					fill: `rgba(${COLOURS[z < 0 ? 0 : 1]}, ${Math.min(1, Math.abs(z) / reach()).toFixed(2)})`
				},
				text: `X ${x.toFixed(0)}, Y ${y.toFixed(0)}: ${signed(z, 3, "mm")}`
			}));
		});

		//~~ its profile from the front, over a scale that reaches as far up as down

		self.hasProfile = ko.pureComputed(() => isUsed() && isNumber(deviation().mean));
		self.reachText = ko.pureComputed(() => "±" + reach() + " mm");
		/** A line for each row where the points are known, else the mean. */
		self.profile = ko.pureComputed(function () {
			if (!known().length) return `M0 ${-deviation().mean / reach()}H1`;
			const [left, right] = self.ends();
			const placed = ({x, z}) => `${(x - left) / (right - left)} ${-z / reach()}`;
			return _.values(_.groupBy(known(), "row"))
				.map(row => "M" + row.map(placed).join("L"))
				.join("");
		});
		/** Where two thirds of the points lie, while no more is known. */
		self.band = ko.pureComputed(function () {
			const {mean, deviation: root} = deviation();
			return {y: -(mean + root) / reach(), height: (2 * root) / reach()};
		});
		self.hasBand = ko.pureComputed(() => !known().length);

		//~~ what lies on it

		self.places = steady(() =>
			isOpen()
				? list(object(object(model("job")).build).objects)
						.map(each => ({ends: RRFModel.endsOf(each), name: object(each).name || ""}))
						.filter(each => each.ends)
				: []
		);
		self.isThere = ko.pureComputed(() => isOpen() && self.isKnown());
		return self;
	};
});
