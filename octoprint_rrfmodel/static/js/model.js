/* The sub-view Model: the whole object model as a tree. */
$(function () {
	/** How long a change is lit up. */
	const LIT_MS = 1500;
	/** Rows above and below what is seen, so that scrolling finds them there. */
	const SPARE = 3;
	const INDENT = 14;

	/** A row of the page: which node it shows changes with scrolling, its elements stay. */
	function Slot(number) {
		this.id = "rrfmodel_node_" + number;
		this.node = this.revision = null;
		this.shape = ko.observable({});
		this.value = ko.observable("");
		this.isLit = ko.observable(false);
	}

	const valueOf = node => (typeof node.value === "number" && node.unit ? node.text + " " + node.unit : node.text);

	const hasChildren = node => !!node.children && node.children.length > 0;

	function RrfModelModelViewModel(parameters) {
		const self = this;
		const core = parameters[0];
		const tree = new RRFModel.ModelTree();
		const model = core.modelOfView("model");
		const isShown = core.isShown("model");
		// what is seen of the tree, in pixels; asked only when it may have changed
		const sight = {top: 0, height: 0, row: 1};
		let revision = 0;
		let selected = null;
		let dimming = null;
		let isExplained = false;

		self.isSeen = ko.pureComputed(() => isShown() && core.isRrf());
		self.text = ko.observable("");
		self.onlyChanged = ko.observable(false);
		self.onlyLive = ko.observable(false);
		self.count = ko.observable("");
		self.slots = ko.observableArray();
		self.height = ko.observable("0");
		self.shift = ko.observable("");
		self.activeId = ko.observable(null);
		self.detail = ko.observable(null);
		self.detailValue = ko.observable("");
		self.copied = ko.observable("");

		const box = () => document.querySelector("#rrfmodel_model [role=tree]");

		const measure = function () {
			sight.top = box().scrollTop;
			sight.height = box().clientHeight;
			sight.row = parseFloat(window.getComputedStyle(box()).lineHeight);
			self.height(tree.rows.length * sight.row + "px");
		};

		//~~ from the tree to the rows

		const countText = function () {
			if (!tree.isFiltered()) return "";
			if (!tree.rows.length) return gettext("Nothing found");
			return _.sprintf(gettext("Rows found: %(count)d"), {count: tree.rows.length});
		};

		const render = function () {
			if (tree.layOut()) {
				revision++;
				self.height(tree.rows.length * sight.row + "px");
				self.count(countText());
				if (selected && selected.isGone) select(null);
			}
			const slots = self.slots.peek();
			const wanted = Math.ceil(sight.height / sight.row) + 2 * SPARE;
			if (slots.length < wanted) {
				self.slots(_.range(wanted).map(number => slots[number] || new Slot(number)));
			}
			const last = Math.max(0, tree.rows.length - wanted);
			const first = Math.min(last, Math.max(0, Math.floor(sight.top / sight.row) - SPARE));
			self.shift("translateY(" + first * sight.row + "px)");
			const now = Date.now();
			let active = null;
			self.slots.peek().forEach(function (slot, place) {
				const node = tree.rows[first + place];
				fill(slot, node, now);
				if (node && node === selected) active = slot.id;
			});
			self.activeId(active);
			if (selected) self.detailValue(valueOf(selected));
		};

		const fill = function (slot, node, now) {
			if (slot.node !== node || slot.revision !== revision) {
				slot.node = node;
				slot.revision = revision;
				slot.shape(node ? shapeOf(node) : {});
			}
			slot.value(node ? valueOf(node) : "");
			const isLit = !!node && now - node.changedAt < LIT_MS && !(hasChildren(node) && tree.isOpen(node));
			slot.isLit(isLit);
			if (isLit && !dimming) dimming = window.setTimeout(dim, LIT_MS);
		};

		const dim = function () {
			dimming = null;
			if (self.isSeen.peek()) render();
		};

		const shapeOf = node => ({
			name: node.name,
			meaning: node.meaning,
			indent: node.depth * INDENT + "px",
			level: node.depth + 1,
			place: node.place,
			siblings: node.siblings,
			expanded: hasChildren(node) ? String(tree.isOpen(node)) : null,
			isSelected: node === selected
		});

		//~~ what a person does

		const select = function (node) {
			selected = node;
			revision++;
			self.copied("");
			self.detail(node && {path: node.path, meaning: node.meaning});
		};

		const toggle = node => tree.open(node, !tree.isOpen(node));

		self.pick = function (slot) {
			select(slot.node);
			toggle(slot.node);
			render();
		};

		self.scrolled = function () {
			sight.top = box().scrollTop;
			render();
		};

		/** As in the ARIA practices for trees: which row is next; some open or close one. */
		const KEYS = {
			ArrowDown: place => place + 1,
			ArrowUp: place => place - 1,
			Home: () => 0,
			End: () => tree.rows.length - 1,
			ArrowRight: function (place, node) {
				if (!node || !hasChildren(node)) return place;
				if (tree.isOpen(node)) return place + 1;
				toggle(node);
				return place;
			},
			ArrowLeft: function (place, node) {
				if (!node) return place;
				if (!hasChildren(node) || !tree.isOpen(node)) {
					return node.depth ? tree.rows.indexOf(node.parent) : place;
				}
				toggle(node);
				return place;
			},
			Enter: function (place, node) {
				if (node) toggle(node);
				return place;
			}
		};

		self.pressed = function (_self, event) {
			const key = KEYS[event.key];
			if (!key || event.ctrlKey || event.altKey || event.metaKey) return true;
			const place = tree.rows.indexOf(selected);
			const wanted = key(place, tree.rows[place]);
			const next = Math.min(tree.rows.length - 1, Math.max(0, wanted));
			select(tree.rows[next] || null);
			render();
			const top = next * sight.row;
			const lowest = top + sight.row - sight.height;
			box().scrollTop = Math.min(top, Math.max(lowest, sight.top));
			return false;
		};

		self.flip = flag => () => flag(!flag());
		self.forget = function () {
			tree.forget();
			render();
		};
		self.openAll = isOpen => () => {
			tree.openAll(isOpen);
			render();
		};

		const copy = function (text, event) {
			copyToClipboard(text);
			// the helper takes the focus away
			event.currentTarget.focus();
			self.copied(_.sprintf(gettext("Copied: %(text)s"), {text: text}));
		};
		self.copyPath = (_self, event) => copy(selected.path, event);
		self.copyCommand = (_self, event) => copy('M409 K"' + selected.path.replace(/"/g, '""') + '"', event);

		//~~ when all that happens

		const explain = function () {
			if (isExplained) return;
			isExplained = true;
			OctoPrint.plugins.rrfmodel.getMeanings().then(
				function (meanings) {
					tree.learn(meanings);
					if (self.isSeen.peek()) render();
				},
				function (xhr) {
					isExplained = false;
					core.tellRefusal(xhr);
				}
			);
		};

		const show = function () {
			measure();
			tree.update(core.latest, Date.now());
			self.forget();
			explain();
		};

		self.onStartupComplete = function () {
			self.isSeen.subscribe(isSeen => isSeen && show());
			if (self.isSeen()) show();
			$(window).on("resize", function () {
				if (!self.isSeen()) return;
				measure();
				render();
			});
			// a message brings the status last; where none comes, the machine's state is replaced
			ko.computed(function () {
				if (!self.isSeen()) return;
				core.received();
				model("state");
				ko.ignoreDependencies(() => tree.update(core.latest, Date.now()) && render());
			});
			ko.pureComputed(() => ({
				text: self.text(),
				changed: self.onlyChanged(),
				live: self.onlyLive()
			}))
				.extend({rateLimit: {timeout: 150, method: "notifyWhenChangesStop"}})
				.subscribe(function (wanted) {
					tree.search(wanted);
					render();
				});
		};
	}

	OCTOPRINT_VIEWMODELS.push({
		construct: RrfModelModelViewModel,
		dependencies: ["rrfModelViewModel"],
		elements: ["#rrfmodel_model"]
	});
});
