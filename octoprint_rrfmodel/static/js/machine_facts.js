/* What the sub-view Machine only shows: how it moves, sensors, pins, boards, network, volumes. */
$(function () {
	const {list, numbered, object, isNumber} = RRFModel;
	/** Sensors that are told of in the line of the section that is folded. */
	const FEW = 3;

	/** Pressure advance by model since 3.7, one number before. */
	RRFModel.pressureAdvance = extruder =>
		isNumber(extruder.pressureAdvance) ? extruder.pressureAdvance : object(extruder.pressAdv).k0;

	/** Members over the model of its view; `isOpen(name)` of a fold. */
	RRFModel.machineFacts = function (core, model, isOpen) {
		const self = {};
		const show = RRFModel.show;
		const state = ko.pureComputed(() => object(model("state")));
		const sensors = ko.pureComputed(() => object(model("sensors")));
		const move = ko.pureComputed(() => object(model("move")));

		//~~ motion

		const withUnit = (value, unit, digits) =>
			isNumber(value) ? value.toFixed(digits === undefined ? 1 : digits) + " " + unit : "";

		/** G54 and so on by a number from 0. */
		const workplace = number => (isNumber(number) ? RRFModel.workplaceName(number) : "");

		const shaping = found =>
			[RRFModel.term("shaping", found.type), found.type && found.type !== "none" ? withUnit(found.frequency, "Hz") : ""]
				.filter(Boolean)
				.join(" ");

		const current = ko.pureComputed(() => object(move().currentMove));
		const tool = () => list(model("tools")).find(each => each && each.number === state().currentTool);

		/** Texts by the names that the template has labels for; empty where nothing is known. */
		self.motion = _.mapValues(
			{
				requested: () => withUnit(current().requestedSpeed, "mm/s"),
				top: () => withUnit(current().topSpeed, "mm/s"),
				acceleration: () => withUnit(current().acceleration, "mm/s²", 0),
				extrusion: () => withUnit(current().extrusionRate, "mm/s", 2),
				flow: function () {
					const fed = object(list(move().extruders)[list(object(tool()).extruders)[0]]);
					const flow = (current().extrusionRate * Math.PI * fed.filamentDiameter ** 2) / 4;
					return flow >= 0 ? withUnit(flow, "mm³/s") : "";
				},
				pressure: function () {
					const known = list(move().extruders).map(each => RRFModel.pressureAdvance(object(each)));
					const text = known.map(each => show.fixed(each, 3)).join(" / ");
					return known.some(isNumber) ? text + " s" : "";
				},
				shaping: () => shaping(object(move().shaping)),
				retraction: () => withUnit(object(object(tool()).retraction).length, "mm", 2),
				workplace: () => workplace(move().workplaceNumber),
				running: () => (isNumber(state().upTime) ? show.duration(state().upTime) : "")
			},
			text => ko.pureComputed(text)
		);

		//~~ sensors and pins

		/** Those that a heater has for itself are told in its row. */
		const isOfHeater = index => list(object(model("heat")).heaters).some(heater => heater && heater.sensor === index);
		self.sensors = RRFModel.rows(() =>
			numbered(sensors().analog)
				.filter(found => !isOfHeater(found.index))
				.slice(0, isOpen("sensors") ? undefined : FEW)
				.map(found => ({
					key: found.index,
					name: found.item.name || _.sprintf(gettext("Sensor %(number)s"), {number: found.index}),
					value: withUnit(found.item.lastReading, "°C") || "–"
				}))
		);

		self.inputs = RRFModel.rows(() =>
			numbered(sensors().gpIn).map(found => ({
				key: found.index,
				value: isNumber(found.item.value) ? String(found.item.value) : "–"
			}))
		);
		self.outputs = RRFModel.rows(() =>
			numbered(state().gpOut).map(found => ({
				key: found.index,
				value: show.percent(found.item.pwm),
				percent: Math.round(100 * found.item.pwm)
			}))
		);

		//~~ boards, network, volumes

		/** What is measured now, and between what it was. */
		const measured = function (value, unit) {
			const {current, min, max} = object(value);
			const text = withUnit(current, unit);
			return text && isNumber(min) && isNumber(max)
				? text + " (" + min.toFixed(1) + " … " + max.toFixed(1) + ")"
				: text;
		};

		/** Without what follows it of one build or another. */
		const versionOf = board => String(object(board).firmwareVersion || "").split(/[+ ]/)[0];
		self.boards = RRFModel.rows(() =>
			numbered(model("boards")).map(function (found) {
				const board = found.item;
				const main = list(model("boards"))[0];
				return {
					key: found.index,
					name: board.name || board.shortName || String(found.index),
					short: board.shortName || board.name || String(found.index),
					can: board.canAddress ? _.sprintf(gettext("CAN address %(number)s"), {number: board.canAddress}) : "",
					version: board.firmwareVersion || "",
					address: board.canAddress || 0,
					file: board.firmwareFileName || "",
					differs: !!board.firmwareVersion && versionOf(board) !== versionOf(main),
					supplyNow: withUnit(object(board.vIn).current, "V"),
					heatNow: withUnit(object(board.mcuTemp).current, "°C"),
					supply: measured(board.vIn, "V"),
					twelve: measured(board.v12, "V"),
					temperature: measured(board.mcuTemp, "°C")
				};
			})
		);

		self.interfaces = RRFModel.rows(() =>
			numbered(object(model("network")).interfaces)
				// older firmware tells of none of it
				.filter(({item}) => item.type || item.state || item.actualIP)
				.map(found => ({
					key: found.index,
					type: RRFModel.term("network", found.item.type),
					address: found.item.actualIP || "",
					state: RRFModel.term("link", found.item.state),
					// an address and nothing else: it goes into a link
					link:
						/^\d{1,3}(\.\d{1,3}){3}$/.test(found.item.actualIP || "") && found.item.actualIP !== "0.0.0.0"
							? "http://" + found.item.actualIP + "/"
							: ""
				}))
		);
		self.machineName = ko.pureComputed(() => object(model("network")).name || "");

		const gigabytes = bytes => (isNumber(bytes) ? withUnit(bytes / 1e9, "GB") : "–");
		self.volumes = RRFModel.rows(() =>
			numbered(model("volumes")).map(found => ({
				key: found.index,
				name: found.item.name || RRFModel.volumeName(found.index),
				text: found.item.mounted
					? _.sprintf(gettext("%(free)s of %(size)s free"), {
							free: gigabytes(found.item.freeSpace),
							size: gigabytes(found.item.capacity)
						})
					: gettext("not mounted")
			}))
		);
		return self;
	};
});
