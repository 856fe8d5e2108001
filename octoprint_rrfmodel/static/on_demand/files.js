/* The dialog with the machine's own files: listed, changed, and records of samples as curves. It comes when it is first opened. */
(function () {
	// whoever clicks twice brings it twice
	if (RRFModel.showFiles) return;
	const {list, object} = RRFModel;
	/** Where they are as long as the model's `directories` say nothing else. */
	const FOLDERS = {macros: "0:/macros", system: "0:/sys", filaments: "0:/filaments"};
	const COLOURS = 10;
	/** Columns that are drawn at first: a record may have many, each of its own scale. */
	const FIRST_SHOWN = 4;
	const GONE = 404;
	const {url} = OctoPrint.plugins.rrfmodel;
	const STYLES = BASEURL + "plugin/rrfmodel/static/on_demand/files.css";

	const reasonOf = xhr => (xhr.responseJSON || {}).error || gettext("That did not work.");
	const withoutEnd = path => path.replace(/\/+$/, "");
	const read = path => OctoPrint.get(url + "machine_file?" + $.param({path}));
	/** What a text area makes of a text. */
	const inArea = text => text.replace(/\r\n?/g, "\n");

	//~~ curves

	/**
	 * Returns a record of samples (of M956 and M569.5) as `{title, unit, series}`; null for any other
	 * text. What isn't a row tells the sampling rate, or what went wrong, and is in the title.
	 */
	const curvesOf = function (path, text) {
		const [head, ...lines] = text.trim().split(/\r?\n/);
		const names = head.split(",").map(name => name.trim());
		if (!/\.csv$/i.test(path) || names[0] !== "Sample" || names.length < 2) return null;
		const rows = [];
		const remarks = [];
		lines.forEach(function (line) {
			const row = line.split(",").map(parseFloat);
			const isRow = row.length === names.length && row.every(Number.isFinite);
			if (isRow) rows.push(row);
			else if (line.trim()) remarks.push(line.trim());
		});
		if (rows.length < 2) return null;
		const time = names.indexOf("Timestamp");
		const rate = Number((/^Rate (\d+)/m.exec(remarks.join("\n")) || [])[1]);
		const xOf = row => (time > 0 ? row[time] : rate > 0 ? (row[0] * 1000) / rate : row[0]);
		return {
			title: [_.sprintf(gettext("%(count)s samples"), {count: rows.length}), ...remarks].join(", "),
			unit: time > 0 || rate > 0 ? " ms" : "",
			series: names
				.map((name, column) => ({name, column}))
				.filter(({column}) => column > 0 && column !== time)
				.map(({name, column}, place) => ({
					name: name,
					colour: "--rrfmodel-series-" + (place % COLOURS),
					isShown: ko.observable(place < FIRST_SHOWN),
					points: rows.map(row => [xOf(row), row[column]])
				}))
		};
	};

	const draw = function (element, {series, unit}) {
		const style = window.getComputedStyle(element);
		const data = series
			.filter(each => each.isShown())
			.map(each => ({
				data: each.points,
				color: style.getPropertyValue(each.colour).trim(),
				lines: {show: true, lineWidth: 1}
			}));
		const tickFormatter = (value, axis) => value.toFixed(axis.tickDecimals) + unit;
		$.plot($(element), data, RRFModel.chartOptions(element, {xaxis: {tickFormatter, ticks: 5}}));
	};

	/** `rrfmodelCurves: curves` draws those that are shown. */
	ko.bindingHandlers.rrfmodelCurves = {
		init: function (element, valueOf) {
			const curves = valueOf();
			const drawSoon = RRFModel.drawSoon(
				() => element,
				() => draw(element, curves)
			);
			ko.computed({
				read: function () {
					curves.series.forEach(each => each.isShown());
					drawSoon();
				},
				disposeWhenNodeIsRemoved: element
			});
		}
	};

	//~~ a file

	/** One that was read; `tell` shows a sentence, `machineNow()` names the machine that is connected. */
	function File(core, tell, machineNow, answer) {
		const self = this;
		const {path} = answer;
		const stored = ko.observable();
		let lineEnd;
		let stamp;
		let machine;

		const know = function (found) {
			stored(inArea(found.text));
			lineEnd = found.text.includes("\r\n") ? "\r\n" : "\n";
			stamp = found.stamp;
			machine = machineNow();
		};
		know(answer);

		self.path = path;
		self.text = ko.observable(stored());
		self.curves = curvesOf(path, answer.text);
		self.isText = ko.observable(!self.curves);
		/** What the card has meanwhile, where that is another text; else null. */
		self.theirs = ko.observable(null);
		self.saved = ko.observable("");
		self.wantsRestart = ko.observable(false);
		self.isRefused = ko.observable(false);
		self.isDirty = ko.pureComputed(() => self.text() !== stored());
		const isSaving = ko.observable(false);
		self.maySave = ko.pureComputed(() => self.isDirty() && !isSaving());

		self.save = function () {
			// a stamp tells files apart, not machines
			if (machine !== machineNow()) {
				self.isRefused(true);
				return tell(gettext("Another machine is connected than the one that this file is of, or none."));
			}
			const text = self.text();
			tell("");
			self.saved("");
			isSaving(true);
			return OctoPrint.putJson(url + "machine_file", {path, stamp, text: text.replace(/\n/g, lineEnd)})
				.done(function (told) {
					stamp = told.stamp;
					stored(text);
					self.theirs(null);
					self.isRefused(false);
					self.wantsRestart(told.restart);
					const parts = [gettext("Saved.")];
					if (told.restart) parts.push(gettext("The machine reads it when it starts."));
					if (told.backup) parts.push(gettext("What was there before:") + " " + told.backup);
					self.saved(parts.join(" "));
				})
				.fail(function (xhr) {
					self.isRefused(true);
					tell(reasonOf(xhr));
				})
				.always(() => isSaving(false));
		};

		/** Looks at what the card has now; what was typed stays. */
		self.readAgain = () =>
			read(path)
				.done(function (found) {
					const before = stored();
					know(found);
					const isOther = stored() !== before && self.isDirty();
					if (isOther) self.theirs(stored());
					self.isRefused(false);
					tell("");
				})
				.fail(function (xhr) {
					// the next saving makes it anew
					if (xhr.status === GONE) stamp = "";
					tell(reasonOf(xhr));
				});

		self.take = () =>
			core.confirm(gettext("Discard what was typed?"), path, gettext("Discard"), function () {
				self.text(stored());
				self.theirs(null);
			});
	}

	//~~ the dialog

	function Files(core, dialog) {
		const self = this;
		let asked = 0;

		self.maySet = core.maySet;
		self.error = ko.observable("");
		self.isReading = ko.observable(false);
		self.folder = ko.observable("");
		self.entries = ko.observableArray();
		self.file = ko.observable(null);
		self.isEmpty = ko.pureComputed(() => !self.entries().length && !self.isReading() && !self.error());
		self.restart = core.restart;
		self.mayRestart = ko.pureComputed(() => core.mayControl() && !core.forbidden("recover"));
		self.whyNoRestart = ko.pureComputed(() => core.forbidden("recover") || null);

		const machineNow = () => object(list(core.latest.boards)[0]).uniqueId;
		const folderOf = name => withoutEnd(object(core.latest.directories)[name] || FOLDERS[name]);
		self.backup = ko.pureComputed(() => (self.file() ? folderOf("system") + "/backup" : ""));

		// what had the focus goes with what was shown
		const focusOn = name =>
			window.setTimeout(() => dialog.find(`[data-test=${name}]:visible`).first().trigger("focus"));

		/** Hands an answer over unless something else was asked for meanwhile. */
		const ask = function (promise, take) {
			const mine = (asked += 1);
			self.error("");
			self.isReading(true);
			return promise
				.done(answer => mine === asked && take(answer))
				.fail(xhr => mine === asked && self.error(reasonOf(xhr)))
				.always(() => mine === asked && self.isReading(false));
		};

		const isDirty = () => !!self.file() && self.file().isDirty();
		/** Goes on at once, or after a question where something typed would be lost. */
		const leave = function (goOn) {
			if (!isDirty()) return goOn();
			core.confirm(gettext("Discard what was typed?"), self.file().path, gettext("Discard"), goOn);
			return null;
		};

		const rowOf = folder => entry => {
			const row = {
				name: entry.name,
				isFolder: entry.folder,
				size: entry.folder ? "" : RRFModel.bytes(entry.size),
				date: String(entry.date || "")
					.replace("T", " ")
					.slice(0, 16)
			};
			const path = folder + "/" + entry.name;
			row.open = () => (row.isFolder ? show(path) : open(path));
			return row;
		};
		const inOrder = (one, other) => other.isFolder - one.isFolder || one.name.localeCompare(other.name);

		const show = path =>
			leave(function () {
				self.file(null);
				self.folder(path);
				self.entries([]);
				return ask(OctoPrint.get(url + "machine_files?" + $.param({path})), function (found) {
					self.entries(found.entries.map(rowOf(path)).sort(inOrder));
					if (!dialog[0].contains(document.activeElement)) focusOn("files-entry");
				});
			});
		const open = path =>
			ask(read(path), function (answer) {
				self.file(new File(core, self.error, machineNow, answer));
				focusOn("files-name");
			});

		const titles = {macros: gettext("Macros"), system: gettext("System"), filaments: gettext("Filaments")};
		self.roots = Object.keys(FOLDERS).map(name => ({
			name: name,
			title: titles[name],
			show: () => show(folderOf(name)),
			isOpen: ko.pureComputed(() => (self.folder() + "/").startsWith(folderOf(name) + "/"))
		}));
		self.isRoot = ko.pureComputed(() => Object.keys(FOLDERS).some(name => folderOf(name) === self.folder()));
		self.up = () => show(self.folder().slice(0, self.folder().lastIndexOf("/")));
		self.back = () => leave(() => show(self.folder()));

		self.open = function () {
			dialog.modal({backdrop: "static"});
			if (!self.file()) show(self.folder() || folderOf("macros"));
		};

		dialog.on("hide", function (event) {
			if (event.target !== dialog[0]) return;
			if (isDirty()) event.preventDefault();
			leave(function () {
				// what still comes is of no use
				asked += 1;
				const isOpen = event.isDefaultPrevented();
				self.file(null);
				if (isOpen) dialog.modal("hide");
			});
		});
		// of a page that is left while something isn't saved browsers ask themselves
		$(window).on("beforeunload", () => isDirty() || undefined);
	}

	let files;

	/** Shows the dialog. */
	RRFModel.showFiles = function (core) {
		if (!files) {
			const dialog = $("#rrfmodel_files");
			$("<link rel='stylesheet'>").attr("href", STYLES).appendTo(document.head);
			files = new Files(core, dialog);
			ko.applyBindings(files, dialog[0]);
		}
		files.open();
	};
})();
