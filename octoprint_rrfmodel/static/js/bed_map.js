/* The bed from above, as Job and Machine draw it: its outline, the head, and places on it. */
$(function () {
	const {list, object, isNumber} = RRFModel;

	/** Letters that have room beside each other on the bed. */
	const LETTERS = 22;

	/**
	 * Draws the bed that `move()` tells of, in the machine's mm; the picture's y goes down.
	 * `marks()` are further places, `{x, y}` each, to be seen.
	 */
	RRFModel.bedMap = function (move, marks) {
		const self = {};
		const axis = letter => object(list(move().axes).find(each => each && each.letter === letter));
		const numbers = text => text.split(",").map(Number);
		const round = ko.pureComputed(() => object(move().kinematics).printRadius);

		// a text stays the same while the axes move, and then nothing is drawn anew
		const ends = ko.pureComputed(function () {
			const [x, y] = [axis("X"), axis("Y")];
			if (round() > 0) return [-round(), round(), -round(), round()].join();
			const isKnown = [x.min, x.max, y.min, y.max].every(isNumber) && x.max > x.min && y.max > y.min;
			return isKnown ? [x.min, x.max, y.min, y.max].join() : "";
		});
		self.isKnown = ko.pureComputed(() => !!ends());
		/** Left, right, front, back. */
		self.ends = () => numbers(ends() || "0,100,0,100");
		self.letters = ko.pureComputed(() => (self.ends()[1] - self.ends()[0]) / LETTERS);
		self.outline = ko.pureComputed(function () {
			const [left, right, front, back] = self.ends();
			const r = round();
			return r > 0
				? `M${r} 0A${r} ${r} 0 1 1 ${-r} 0A${r} ${r} 0 1 1 ${r} 0Z`
				: `M${left} ${-front}V${-back}H${right}V${-front}Z`;
		});
		self.box = ko.pureComputed(function () {
			const [left, right, front, back] = self.ends();
			const size = self.letters();
			const seen = marks ? marks() : [];
			const around = (name, room, least, most) => [
				Math.min(least - size / 2, ...seen.map(each => each[name] - room)),
				Math.max(most + size / 2, ...seen.map(each => each[name] + room))
			];
			const x = around("x", 4 * size, left, right);
			const y = around("y", 2 * size, front, back);
			return [x[0], -y[1], x[1] - x[0], y[1] - y[0]].join(" ");
		});
		/** Where the picture has a rectangle from left, right, front and back. */
		self.rect = ([left, right, front, back]) => ({
			x: left,
			y: -back,
			width: Math.max(right - left, 1),
			height: Math.max(back - front, 1)
		});
		/** The same from a text, where there is one. */
		self.rectOf = text => (text ? self.rect(numbers(text)) : {});
		self.head = ko.pureComputed(function () {
			const [x, y] = [axis("X"), axis("Y")];
			const isThere = [x, y].every(each => each.homed && isNumber(each.machinePosition));
			if (!isThere || !ends()) return null;
			return {cx: x.machinePosition, cy: -y.machinePosition, r: self.letters() / 3};
		});
		return self;
	};
});
