/* The firmware's own terms in a person's words, by kind and by the name that the model has. */
$(function () {
	/** Made once gettext is there; what stands in no table is shown as it came. */
	const makeTerms = () => ({
		/** move.kinematics.name; the designs that have a name of their own keep it. */
		kinematics: {
			cartesian: gettext("Cartesian"),
			coreXY: gettext("CoreXY"),
			coreXYU: gettext("CoreXYU"),
			coreXYUV: gettext("CoreXYUV"),
			coreXZ: gettext("CoreXZ"),
			markForged: gettext("Markforged"),
			delta: gettext("Delta"),
			linearDelta: gettext("Delta"),
			rotaryDelta: gettext("Rotary delta"),
			"rotary delta": gettext("Rotary delta"),
			polar: gettext("Polar"),
			hangprinter: gettext("Hangprinter"),
			scara: gettext("SCARA"),
			fiveBarScara: gettext("Five-bar SCARA"),
			unknown: gettext("unknown")
		},
		/** network.interfaces[].type. */
		network: {
			wifi: gettext("Wi-Fi"),
			ethernet: gettext("Ethernet"),
			lan: gettext("Ethernet")
		},
		/** network.interfaces[].state. */
		link: {
			disabled: gettext("off"),
			idle: gettext("not connected"),
			enabled: gettext("on"),
			starting: gettext("connecting"),
			networkLost: gettext("connection lost"),
			establishingLink: gettext("waiting for a link"),
			obtainingIP: gettext("waiting for an address"),
			reconnecting: gettext("connecting again"),
			connecting: gettext("connecting"),
			connected: gettext("connected"),
			active: gettext("connected"),
			changingMode: gettext("changing"),
			starting1: gettext("connecting"),
			starting2: gettext("connecting"),
			establishing1: gettext("waiting for a link"),
			establishing2: gettext("waiting for a link"),
			establishing3: gettext("waiting for a link")
		},
		/** sensors.filamentMonitors[].type. */
		monitor: {
			simple: gettext("switch"),
			laser: gettext("laser"),
			pulsed: gettext("pulses"),
			rotatingMagnet: gettext("rotating magnet"),
			unknown: gettext("unknown")
		},
		/** sensors.filamentMonitors[].status. */
		monitorStatus: {
			noMonitor: gettext("no monitor"),
			ok: gettext("ok"),
			noDataReceived: gettext("no data yet"),
			noFilament: gettext("no filament"),
			tooLittleMovement: gettext("too little movement"),
			tooMuchMovement: gettext("too much movement"),
			sensorError: gettext("sensor error")
		},
		/** move.compensation.type. */
		compensation: {
			none: gettext("off"),
			mesh: gettext("mesh"),
			point: gettext("points")
		},
		/** move.shaping.type; the shapers have names of their own. */
		shaping: {
			none: gettext("off"),
			custom: gettext("custom"),
			mzv: "MZV",
			zvd: "ZVD",
			zvdd: "ZVDD",
			zvddd: "ZVDDD",
			ei2: "EI2",
			ei3: "EI3"
		},
		/** spindles[].state. */
		spindle: {
			unconfigured: gettext("not set up"),
			stopped: gettext("stopped"),
			forward: gettext("forward"),
			reverse: gettext("reverse")
		},
		/** heat.heaters[].monitors[].condition. */
		condition: {
			disabled: gettext("off"),
			tooHigh: gettext("too hot"),
			tooLow: gettext("too cold"),
			undefined: gettext("unknown")
		},
		/** heat.heaters[].monitors[].action. */
		action: {
			0: gettext("fault"),
			1: gettext("switch off for good"),
			2: gettext("switch off for a while"),
			3: gettext("switch the power off")
		}
	});

	let terms;

	/** Versions of the firmware differ in capitals. */
	const byLowerCase = words => new Map(Object.entries(words).map(([name, word]) => [name.toLowerCase(), word]));

	/** A term of the firmware in words; nothing where nothing is known. */
	RRFModel.term = function (kind, name) {
		if (name === null || name === undefined) return "";
		terms = terms || _.mapValues(makeTerms(), byLowerCase);
		const text = String(name);
		return terms[kind].get(text.toLowerCase()) || text;
	};

	/** A card by its number as the firmware counts it. */
	RRFModel.volumeName = number =>
		Number(number) === 0 ? gettext("SD card") : _.sprintf(gettext("SD card %(number)d"), {number: Number(number) + 1});
});
