/* What lies on the machine's card and is used beside its controls: macros and filaments. */
$(function () {
	const MACROS = "0:/macros";
	const FILAMENTS = "0:/filaments";
	const NEW_MS = 500;

	/** A folder of the card that is listed when it is asked for, and opens into those below. */
	function Folder(core, root) {
		const self = this;
		self.path = ko.observable(root);
		self.entries = ko.observableArray();
		self.isOpen = ko.observable(false);
		self.isReading = ko.observable(false);
		self.isRoot = ko.pureComputed(() => self.path() === root);
		/** Too new to be picked from: the second half of a double click would run a macro. */
		self.isNew = ko.observable(false);
		let generation = 0;
		let settling;

		const read = function (path, tellRefusal) {
			const asked = (generation += 1);
			self.isReading(true);
			return OctoPrint.plugins.rrfmodel
				.getFiles(path)
				.done(function (found) {
					if (asked !== generation) return;
					self.path(path);
					self.entries(
						found.entries.sort((one, other) => other.folder - one.folder || one.name.localeCompare(other.name))
					);
					self.isOpen(true);
					self.isNew(true);
					window.clearTimeout(settling);
					settling = window.setTimeout(() => self.isNew(false), NEW_MS);
				})
				.fail(xhr => tellRefusal && core.tellRefusal(xhr))
				.always(() => asked === generation && self.isReading(false));
		};
		/** Lists it, or the one that is open again. */
		self.show = () => read(self.isOpen() ? self.path() : root, true);
		/** The same without anybody having asked: what comes of it is told by what is there. */
		self.showQuietly = () => read(root, false);
		self.pathOf = entry => self.path() + "/" + entry.name;
		self.enter = entry => read(self.pathOf(entry), true);
		self.up = () => read(self.path().slice(0, self.path().lastIndexOf("/")), true);

		// the next machine has a card of its own
		self.close = function () {
			generation += 1;
			self.isReading(false);
			self.isOpen(false);
			self.entries([]);
		};
		core.isRrf.subscribe(self.close);
		core.resets.subscribe(self.close);
	}

	/** Returns the members of a view model that is shown while `isShown()` holds. */
	RRFModel.machineCard = function (core, isShown) {
		const self = {};
		/** Older firmware doesn't list its card over a line. */
		self.hasCard = ko.pureComputed(() => core.status().protocol !== "M408");

		self.macros = new Folder(core, MACROS);
		self.macroFilter = ko.observable("");
		self.foundMacros = ko.pureComputed(function () {
			const text = self.macroFilter().trim().toLowerCase();
			const entries = self.macros.entries();
			return text ? entries.filter(entry => entry.name.toLowerCase().includes(text)) : entries;
		});
		self.pickMacro = entry =>
			entry.folder
				? self.macros.enter(entry).done(() => self.macroFilter(""))
				: core.command("macro", {path: self.macros.pathOf(entry)});

		// once for each machine, as soon as it has nothing better to do
		let askedOf = null;
		ko.computed(function () {
			if (!core.isRrf()) {
				askedOf = null;
				return;
			}
			const machine = core.resets();
			const {ready, blocked, doing} = core.status();
			const isFree = ready && !blocked && !doing && !core.forbidden("macro");
			if (!isShown() || !isFree || !self.hasCard() || askedOf === machine) return;
			askedOf = machine;
			ko.ignoreDependencies(self.macros.showQuietly);
		}).extend({deferred: true});

		self.filaments = new Folder(core, FILAMENTS);
		self.filamentNames = ko.pureComputed(() => self.filaments.entries().filter(entry => entry.folder));
		self.askFilaments = function () {
			if (!self.filaments.isOpen()) self.filaments.show();
		};
		self.loadLabel = entry => _.sprintf(gettext("Load %(name)s"), {name: entry.name});
		self.load = entry => core.command("filament", {action: "load", name: entry.name});
		self.unload = () => core.command("filament", {action: "unload"});
		return self;
	};
});
