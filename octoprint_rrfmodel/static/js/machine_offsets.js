/* Offsets of tools in the sub-view Machine. */
$(function () {
	const {list, numbered, isNumber} = RRFModel;

	/** Returns the members of a view model over the model of its view. */
	RRFModel.toolOffsets = function (core, model) {
		const self = {};
		const show = RRFModel.show;
		const axes = () => list((model("move") || {}).axes);

		self.offsetTools = RRFModel.rows(
			() =>
				numbered(model("tools")).map(function ({item, index}) {
					const known = axes()
						.map((axis, place) => [(axis || {}).letter, list(item.offsets)[place]])
						.filter(([letter, offset]) => letter && isNumber(offset));
					return {
						key: index,
						number: item.number,
						name: item.name || _.sprintf(gettext("Tool %(number)s"), item),
						letters: known.map(([letter]) => letter).join(" "),
						offsetOf: Object.fromEntries(known),
						text: known
							.filter(([, offset]) => offset)
							.map(([letter, offset]) => letter + " " + show.fixed(offset, 2) + " mm")
							.join(" ")
					};
				}),
			function (row) {
				row.fields = ko.pureComputed(() =>
					(row.letters() ? row.letters().split(" ") : []).map(letter => ({
						letter: letter,
						value: ko.pureComputed(() => row.offsetOf()[letter]),
						label: _.sprintf(gettext("Offset of %(axis)s in mm"), {axis: letter}),
						send: value =>
							core.command("tool_offsets", {
								tool: row.number(),
								offsets: {[letter]: value}
							})
					}))
				);
			}
		);
		self.offsetsSummary = ko.pureComputed(function () {
			const tools = self.offsetTools().filter(row => row.letters());
			if (!tools.length) return "";
			const told = tools.filter(row => row.text());
			return told.map(row => "T" + row.number() + " " + row.text()).join(", ") || gettext("none");
		});
		return self;
	};
});
