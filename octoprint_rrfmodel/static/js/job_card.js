/* The files on the machine's card: folders, pictures, and what begins a print of one. */
$(function () {
	const ROOT = "0:/gcodes";
	/** So long a list is good, as long as the server keeps one. */
	const GOOD_MS = 20000;
	const {isNumber} = RRFModel;

	/** `seen: action` calls the action once, when somebody first sees the element. */
	ko.bindingHandlers.seen = {
		init: function (element, action) {
			const observer = new IntersectionObserver(function (entries) {
				if (!entries.some(entry => entry.isIntersecting)) return;
				observer.disconnect();
				action()();
			});
			observer.observe(element);
			ko.utils.domNodeDisposal.addDisposeCallback(element, () => observer.disconnect());
		}
	};

	/**
	 * The list of one folder at a time, asked for while `isWanted()` holds: when it begins to, at a
	 * click, and when a machine is busy no longer.
	 */
	RRFModel.cardFiles = function (core, isWanted) {
		const self = {};
		let asked = 0;
		let readAt = -Infinity;
		let readOf;

		self.folder = ko.observable(ROOT);
		self.entries = ko.observableArray();
		self.isReading = ko.observable(false);
		self.error = ko.observable("");
		self.isRoot = ko.pureComputed(() => self.folder() === ROOT);
		self.folderName = ko.pureComputed(() => self.folder().slice(ROOT.length + 1));
		self.isEmpty = ko.pureComputed(() => !self.entries().length && !self.isReading() && !self.error() && readOf);

		//~~ pictures: one after the other, as each is many questions

		let queue = [];
		let isFetching = false;

		const fetchNext = function () {
			if (isFetching || !isWanted() || !queue.length) return;
			isFetching = true;
			queue.pop().picture(true);
		};
		const addPicture = function (row) {
			row.picture = ko.observable(false);
			row.hasPicture = ko.observable(false);
			row.url = ko.pureComputed(() =>
				row.picture() ? RRFModel.pictureUrl(row.path, row.size + "-" + row.date) + "&if_any=1" : null
			);
			const came = is => () => {
				row.hasPicture(is);
				isFetching = false;
				fetchNext();
			};
			row.pictureCame = came(true);
			row.pictureFailed = came(false);
			row.isSeen = function () {
				if (row.isFolder || row.picture()) return;
				queue.unshift(row);
				fetchNext();
			};
		};

		//~~ the list

		const rowOf = folder => entry => {
			const row = {
				name: entry.name,
				path: folder + "/" + entry.name,
				isFolder: entry.folder,
				size: entry.folder || !isNumber(entry.size) ? "" : RRFModel.bytes(entry.size),
				date: String(entry.date || "")
					.replace("T", " ")
					.slice(0, 16)
			};
			addPicture(row);
			row.open = () => read(row.path);
			row.printLabel = _.sprintf(gettext("Print %(name)s"), row);
			row.simulateLabel = _.sprintf(gettext("Simulate %(name)s"), row);
			return row;
		};
		/** Folders first, then what was written last. */
		const inOrder = (one, other) =>
			other.isFolder - one.isFolder ||
			(one.isFolder ? 0 : other.date.localeCompare(one.date)) ||
			one.name.localeCompare(other.name);

		const read = function (folder) {
			if (!isWanted()) return;
			const mine = (asked += 1);
			const of = core.resets();
			self.isReading(true);
			OctoPrint.plugins.rrfmodel
				.getFiles(folder)
				.done(function (answer) {
					if (mine !== asked) return;
					queue = [];
					isFetching = false;
					self.error("");
					self.folder(folder);
					[readAt, readOf] = [Date.now(), of];
					self.entries(answer.entries.map(rowOf(folder)).sort(inOrder));
				})
				.fail(function (xhr) {
					if (mine !== asked) return;
					self.error((xhr.responseJSON || {}).error || gettext("The card can't be read now."));
				})
				.always(() => mine === asked && self.isReading(false));
		};
		/** As if the card had never been read. */
		self.forget = function () {
			asked += 1;
			readOf = undefined;
			self.folder(ROOT);
			self.entries([]);
			self.error("");
			self.isReading(false);
		};
		self.read = () => read(self.folder());
		self.up = () => read(self.folder().slice(0, self.folder().lastIndexOf("/")));

		const mayAsk = ko.pureComputed(() => isWanted() && !core.status().blocked && !core.status().doing);
		ko.computed(function () {
			if (!mayAsk()) return;
			const of = core.resets();
			ko.ignoreDependencies(function () {
				if (readOf !== undefined && readOf !== of) self.forget();
				if (self.error() || readOf !== of || Date.now() - readAt > GOOD_MS) self.read();
			});
			fetchNext();
		}).extend({deferred: true});
		return self;
	};
});
