/* What the sub-view Job tells of the file on the card that is printed or selected, and its picture. */
$(function () {
	const RETRY_MS = 30000;
	const MOST_ATTEMPTS = 5;
	const {list, isNumber} = RRFModel;

	/** `folded: name` on a <details>: whether it is open is remembered under that name. */
	ko.bindingHandlers.folded = {
		init: function (element, name) {
			const key = "rrfmodel.open." + name();
			element.open = window.localStorage.getItem(key) === "true";
			element.addEventListener("toggle", () => window.localStorage.setItem(key, String(element.open)));
		}
	};

	RRFModel.pictureUrl = (path, version) =>
		OctoPrint.getBlueprintUrl("rrfmodel") + "thumbnail?" + $.param({path: path, v: version});

	RRFModel.bytes = count => (count < 1e6 ? (count / 1e3).toFixed(1) + " kB" : (count / 1e6).toFixed(1) + " MB");

	/** Returns the facts of the file whose path `path()` is, as `job()` has it. */
	RRFModel.jobFile = function (job, path) {
		const self = {};
		const show = RRFModel.show;
		const file = ko.pureComputed(() => job().file || {});

		const metres = lengths =>
			list(lengths)
				.filter(isNumber)
				.map(length => (length / 1000).toFixed(2) + " m")
				.join(" + ");
		const millimetres = value => (value > 0 ? show.fixed(value, 2) + " mm" : "");
		const time = seconds => seconds && show.duration(seconds);

		const texts = {
			slicer: () => file().generatedBy,
			size: () => isNumber(file().size) && RRFModel.bytes(file().size),
			height: () => millimetres(file().height),
			layerHeight: () => millimetres(file().layerHeight),
			filament: () => metres(file().filament),
			printTime: () => time(file().printTime),
			simulatedTime: () => time(file().simulatedTime),
			modified: () => String(file().lastModified || "").replace("T", " ")
		};
		self.facts = _.mapValues(texts, text => ko.pureComputed(() => (path() && text()) || ""));
		self.has = ko.pureComputed(() => _.some(self.facts, text => text()));
		self.summary = ko.pureComputed(() =>
			[self.facts.printTime(), self.facts.filament(), self.facts.slicer()].filter(text => text).join(", ")
		);

		//~~ its picture

		const attempt = ko.observable(0);
		let retrying;

		self.hasPicture = ko.observable(false);
		self.picture = ko.pureComputed(function () {
			const has = list(file().thumbnails).length > 0;
			if (!has || !path()) return null;
			// a file that was sliced anew has another picture under its old name
			const version = [file().size, file().lastModified, attempt()].join("-");
			return RRFModel.pictureUrl(path(), version);
		});
		self.pictureCame = () => self.hasPicture(true);
		// the machine may have been busy
		self.pictureFailed = function () {
			self.hasPicture(false);
			window.clearTimeout(retrying);
			if (attempt() < MOST_ATTEMPTS) retrying = window.setTimeout(() => attempt(attempt() + 1), RETRY_MS);
		};
		self.picture.subscribe(() => self.hasPicture(false));
		path.subscribe(() => attempt(0));
		return self;
	};
});
