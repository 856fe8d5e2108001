/* What all regions of the page share: the model as it comes by push, permissions, commands. */
window.RRFModel = {};

$(function () {
	/** Sub-views of the tab, in the order of their links; the address is TAB + "/" + name. */
	const VIEWS = ["machine", "job", "chart", "console", "model"];
	const TAB = "#tab_plugin_rrfmodel";
	/** Behind an address and a question mark: the tab uses the whole window. */
	const WIDE = "wide";
	/** Until the model is asked for again that the server didn't have. */
	const AGAIN_MS = 5000;

	/**
	 * Returns a function `key => value` over the model that moves only while `isShown()` does:
	 * who is hidden costs nothing, and catches up when shown.
	 */
	function Feed(latest, isShown) {
		const self = this;
		const values = {};
		const behind = new Set();

		const observed = function (key) {
			return values[key] || (values[key] = ko.observable(latest[key]));
		};

		self.of = function (key) {
			return observed(key)();
		};

		/** Takes note of top-level keys that changed. */
		self.changed = function (keys) {
			keys.forEach(key => behind.add(key));
			self.catchUp();
		};

		self.catchUp = function () {
			if (!isShown() || !behind.size) return;
			const keys = Array.from(behind);
			behind.clear();
			keys.forEach(key => observed(key)(latest[key]));
		};

		isShown.subscribe(self.catchUp);
	}

	function RrfModelViewModel(parameters) {
		const self = this;
		const latest = {};
		const feeds = [];

		// gettext comes with OctoPrint's own scripts, which run after this file
		RRFModel.words = RRFModel.makeWords();

		const [loginState, access] = parameters;
		self.settings = parameters[2];

		/** The plugin's state, section 2 of its API. */
		self.status = ko.observable({});
		self.received = ko.observable({age: undefined, at: 0});
		/** The mesh with its points, where the machine's files can be read; else null. */
		self.heightmap = ko.observable(null);
		/** Lines that were said on the line since those before, as the console has them. */
		self.replies = ko.observable([]);

		self.may = permission => loginState.hasPermission(access.permissions[permission]);
		self.mayRead = ko.pureComputed(() => self.may("PLUGIN_RRFMODEL_READ"));
		self.mayControl = ko.pureComputed(() => self.may("PLUGIN_RRFMODEL_CONTROL"));
		/** Another number after each reset and with each machine. */
		self.resets = ko.pureComputed(() => [self.status().resets, (self.status().firmware || {}).electronics].join());
		/** Whether the card's files can be read. */
		self.hasNetwork = () => self.status().link === "network" || !!self.status().beside;
		/** As OctoPrint's terminal has it. */
		self.mayWatch = ko.pureComputed(() => self.mayRead() && self.may("MONITOR_TERMINAL"));
		self.maySet = ko.pureComputed(() => self.may("SETTINGS"));

		self.isRrf = ko.pureComputed(() => self.mayRead() && !!self.status().connected && !!self.status().is_rrf);

		//~~ which part of the page is seen

		self.pageIsVisible = ko.observable(!document.hidden);
		self.tabIsOpen = ko.observable(false);
		self.view = ko.observable(VIEWS[0]);

		/** Whether a sub-view of the tab is seen now. */
		self.isShown = name => ko.pureComputed(() => self.pageIsVisible() && self.tabIsOpen() && self.view() === name);

		// on a slow line only what is looked at is kept fresh
		const look = function () {
			const data = {view: self.tabIsOpen() ? self.view() : ""};
			if (self.isRrf() && self.pageIsVisible()) OctoPrint.plugins.rrfmodel.getStatus({data});
		};
		ko.computed(look);
		setInterval(look, 20000);

		const subscribed = function (isShown) {
			// one that nobody listens to would be computed anew at each question
			isShown.subscribe(() => undefined);
			const feed = new Feed(latest, isShown);
			feeds.push(feed);
			return feed.of;
		};

		/** Returns `key => value of that top-level key` for a sub-view. */
		self.modelOfView = name => subscribed(self.isShown(name));

		/** The same for what is seen whichever tab is open. */
		self.model = subscribed(self.pageIsVisible);

		/** The whole model as it came last, for who asks at a click. */
		self.latest = latest;

		RRFModel.addNow(self, parameters[3]);
		RRFModel.addWide(self);
		RRFModel.addCommands(self);
		RRFModel.addAlerts(self);
		RRFModel.addForbidden(self, parameters[3]);
		RRFModel.addEffects(self, parameters[3]);

		self.address = name => TAB + "/" + name;

		self.views = VIEWS.map(name => ({
			name: name,
			address: self.address(name),
			title: RRFModel.words.view[name],
			isOpen: ko.pureComputed(() => self.view() === name)
		}));

		// OctoPrint picks the tab whose link has the page's address, so that the link has to follow
		const follow = function () {
			const {hash} = window.location;
			const [name, mode] = hash.slice(TAB.length + 1).split("?");
			if (!hash.startsWith(TAB) || !VIEWS.includes(name)) return false;
			if (mode === WIDE) self.isWide(true);
			self.view(name);
			$(TAB + "_link a").attr("href", hash);
			return true;
		};

		// OctoPrint goes to its first tab where the link stands in the menu of those without room
		const goThere = function () {
			if (!follow()) return;
			if (!self.tabIsOpen()) $(TAB + "_link a").tab("show");
			OctoPrint.coreui.hashFromTabChange = true;
		};

		self.onStartup = function () {
			// links of the tab lead elsewhere, its content stays where it is
			$(TAB + "_link a").attr("data-target", TAB);
			$(window).on("hashchange", goThere);
			follow();
		};

		self.onTabChange = function (current) {
			self.tabIsOpen((current || "").split("/")[0] === TAB);
		};

		self.onBrowserTabVisibilityChange = self.pageIsVisible;

		//~~ what comes from the server

		const replace = function (model) {
			const keys = new Set([...Object.keys(latest), ...Object.keys(model)]);
			Object.keys(latest).forEach(key => delete latest[key]);
			Object.assign(latest, model);
			feeds.forEach(feed => feed.changed(keys));
		};

		/** Keys that were pushed since the model was asked for, or null. */
		let asked = null;
		let askingAgain;
		/** The server's time of the latest state. */
		let toldAt = -Infinity;
		/** And of that before the model was asked for: at a log-in older messages come. */
		let knownAt = -Infinity;
		/** Whether a notice may be one of those. */
		let mayBeOld = true;

		self.requestData = function () {
			asked = null;
			window.clearTimeout(askingAgain);
			if (!self.mayRead()) return;
			OctoPrint.plugins.rrfmodel.getStatus().done(function (answer) {
				mayBeOld = false;
				knownAt = answer.at;
				self.fromLaterStatus(answer);
				const status = self.status();
				// before the first age all of it is still to be pushed
				if (status.is_rrf && status.age !== null) requestModel();
				else replace({});
			});
		};

		const requestModel = function () {
			const pushed = (asked = new Set());
			const take = function (model) {
				// it is of no use any more behind a reset or a later question
				if (asked !== pushed) return;
				asked = null;
				pushed.forEach(key => (model[key] = latest[key]));
				replace(model);
			};
			OctoPrint.plugins.rrfmodel
				.getModel("", "d99vno")
				.done(answer => take(Object.assign({}, answer.result)))
				.fail(function () {
					if (asked !== pushed) return;
					// what is known may be another machine's
					take({});
					askingAgain = window.setTimeout(self.requestData, AGAIN_MS);
				});
		};

		self.fromStatus = function (status) {
			toldAt = status.at;
			self.received({age: status.age, at: Date.now()});
			self.status(status);
		};

		/** Takes a state that was asked for: late, it says less than what was pushed since. */
		self.fromLaterStatus = function (status) {
			if (status.at >= toldAt) self.fromStatus(status);
		};

		self.onStartupComplete = self.requestData;
		// where the first attempt succeeds OctoPrint calls it no reconnect
		self.onServerConnect = self.onServerReconnect = function () {
			toldAt = knownAt = -Infinity;
			self.requestData();
		};
		self.onUserPermissionsChanged =
			self.onUserLoggedIn =
			self.onUserLoggedOut =
				function () {
					mayBeOld = true;
					replace({});
					self.requestData();
				};

		self.onDataUpdaterPluginMessage = function (plugin, message) {
			if (plugin !== "rrfmodel" || !self.mayRead()) return;
			// a state that was asked for may overtake changes, which come but once
			if ((message.status || message).at < knownAt) return;
			if (message.type === "notice") {
				if (mayBeOld) return;
				// a paused print is a warning, and what the machine answers to this page a reply
				const isTold =
					message.code === "print_paused" || (message.code === "refused" && self.mayWatch() && self.awaitsReplies());
				if (!isTold) self.notify(RRFModel.noticeText(message));
				return;
			}
			if (message.type === "console") {
				if (!mayBeOld && self.mayWatch()) self.replies(message.lines);
				return;
			}
			if (message.type === "reset") {
				asked = null;
				replace({});
			}
			if (message.type === "model") {
				Object.assign(latest, message.changed);
				const keys = Object.keys(message.changed);
				if (asked) keys.forEach(key => asked.add(key));
				feeds.forEach(feed => feed.changed(keys));
			}
			self.fromLaterStatus(message.status);
		};
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelViewModel,
		dependencies: ["loginStateViewModel", "accessViewModel", "settingsViewModel", "printerStateViewModel"],
		elements: ["#tab_plugin_rrfmodel_link", "#rrfmodel_views"]
	});
});
