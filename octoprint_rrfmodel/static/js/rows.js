/* Lists that stay in place while their values change, and fields that show a value and set it. */
$(function () {
	/** A reply that came so soon after a command may have been asked for before it. */
	const UNDERWAY_MS = 2000;
	/** Then what was sent holds no longer, though nothing newer has come. */
	const LOST_MS = 30000;

	RRFModel.list = value => (Array.isArray(value) ? value : []);
	RRFModel.object = value => (value && typeof value === "object" ? value : {});

	/** Elements of an array of the model with their indices, gaps left out. */
	RRFModel.numbered = value =>
		RRFModel.list(value)
			.map((item, index) => ({item, index}))
			.filter(found => found.item);

	const RANKS = ["off", "standby", "active"];

	/**
	 * A heater's state as far as it is a tool's own: of one that tools share it may be another's.
	 * `tools` are all of the model, `index` is the heater's and `state` what it says of itself.
	 */
	RRFModel.ownState = function (tool, tools, index, state) {
		const rank = RANKS.indexOf(tool.state);
		const isAnothers = RRFModel.list(tools).some(
			other =>
				other && other !== tool && RRFModel.list(other.heaters).includes(index) && RANKS.indexOf(other.state) > rank
		);
		return rank >= 0 && isAnothers && RANKS.indexOf(state) > rank ? tool.state : state;
	};

	/** A text with the row's name in it, which another machine may change. */
	RRFModel.named = (row, text) => ko.pureComputed(() => _.sprintf(text, {name: row.name()}));

	/**
	 * Returns an observable array of rows, one for each `key` that `describe()` returns; other
	 * members become its observables, so that elements, focus and what was typed stay.
	 * `extend(row)` adds what a new row can do.
	 */
	RRFModel.rows = function (describe, extend) {
		const rows = ko.observableArray();
		let known = new Map();

		const rowOf = function (values) {
			const isNew = !known.has(values.key);
			const row = isNew ? {key: values.key} : known.get(values.key);
			Object.entries(values).forEach(function ([name, value]) {
				if (name === "key") return;
				if (row[name]) row[name](value);
				else row[name] = ko.observable(value);
			});
			if (isNew && extend) extend(row);
			return row;
		};

		ko.computed(function () {
			const found = describe();
			ko.ignoreDependencies(function () {
				const next = found.map(rowOf);
				known = new Map(next.map(row => [row.key, row]));
				const present = rows.peek();
				const isSame = next.length === present.length && next.every((row, place) => row === present[place]);
				if (!isSame) rows(next);
			});
			// once for an update, however many keys of the model came with it
		}).extend({deferred: true});
		return rows;
	};

	/**
	 * Returns the values that `told()` says, each with what was sent in its stead as long as the
	 * model may be older: `values()`, and `send(values, promise)` for what goes out now.
	 */
	RRFModel.lastGiven = function (core, told) {
		const sent = ko.observable(null);
		const isTold = function () {
			const {age, at} = core.received();
			const isLater = typeof age === "number" && at - age * 1000 > sent().at + UNDERWAY_MS;
			return isLater || (!core.status().blocked && Date.now() - sent().at > LOST_MS);
		};
		const isOpen = () => sent() && !isTold();
		return {
			values: () =>
				told().map((value, place) =>
					isOpen() && sent().before.some(each => each[place] === value) ? sent().values[place] : value
				),
			send: function (values, promise) {
				// what was sent before comes from the machine, too
				const earlier = isOpen() ? [...sent().before, sent().values] : [];
				const mine = {values, before: [...earlier, told()], at: Date.now()};
				sent(mine);
				return promise.fail(() => {
					if (sent() === mine) sent(null);
				});
			}
		};
	};
});
