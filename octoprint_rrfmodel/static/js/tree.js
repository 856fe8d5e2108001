/* The object model as a tree: its nodes, what changed in them, and which of them are shown. */
$(function () {
	const LEAF = 0;
	const LIST = 1;
	const OBJECT = 2;

	/** Below these anybody names what is there. */
	const OPEN = /^(global|job\.file\.customInfo)\./;

	const kindOf = value => (value === null || typeof value !== "object" ? LEAF : Array.isArray(value) ? LIST : OBJECT);

	/** What is at a path; `pattern` is the path with [] for any element. */
	function Node(parent, step) {
		const inList = parent && parent.kind === LIST;
		const joint = inList || !parent || !parent.path ? "" : ".";
		this.parent = parent;
		this.step = step;
		this.name = inList ? "[" + step + "]" : step;
		this.path = parent ? parent.path + joint + this.name : "";
		this.pattern = parent ? parent.pattern + joint + (inList ? "[]" : step) : "";
		this.lowerName = this.name.toLowerCase();
		this.depth = parent ? parent.depth + 1 : -1;
		this.kind = this.value = undefined;
		this.children = null;
		this.members = null;
		this.text = "";
		this.unit = this.meaning = "";
		this.isLive = this.isOpen = this.isChanged = this.isGone = false;
		this.changedAt = 0;
		// in what is searched: shown, found itself or below, one of those below, opened by hand
		this.isShown = this.isFound = this.leads = false;
		this.isOpenFound = null;
		// among its shown siblings
		this.place = this.siblings = 0;
	}

	function each(node, action) {
		action(node);
		if (node.children) for (const child of node.children) each(child, action);
	}

	const discard = nodes => (nodes || []).forEach(child => each(child, node => (node.isGone = true)));

	RRFModel.ModelTree = class {
		constructor() {
			this.root = new Node(null, "");
			this.meanings = {};
			this.rows = [];
			this.now = 0;
			this.search({text: "", changed: false, live: false});
		}

		/** Takes the model; returns whether anything changed. What is the same object is skipped. */
		update(model, now) {
			this.now = now;
			// the model itself stays the same object
			this.root.value = null;
			const isChanged = this.take(this.root, model);
			if (isChanged && this.isFiltered()) this.isReshaped = true;
			return isChanged;
		}

		/** Nothing has changed from here on. */
		forget() {
			this.all(node => {
				node.isChanged = false;
				node.changedAt = 0;
			});
		}

		/** Takes units and meanings, by pattern. */
		learn(meanings) {
			this.meanings = meanings;
			this.all(node => this.explain(node));
		}

		/** Shows only what has the text in its name or value, changed, is live; as asked. */
		search(wanted) {
			const text = wanted.text.trim().toLowerCase();
			this.wanted = Object.assign({}, wanted, {text: text, isPath: /[.[]/.test(text)});
			this.all(node => (node.isOpenFound = null));
		}

		all(action) {
			each(this.root, action);
			this.isReshaped = true;
			this.judgedAt = 0;
		}

		isFiltered() {
			return !!this.wanted.text || this.wanted.changed || this.wanted.live;
		}

		isOpen(node) {
			if (!this.isFiltered()) return node.isOpen;
			return node.isOpenFound === null ? node.leads : node.isOpenFound;
		}

		open(node, isOpen) {
			node[this.isFiltered() ? "isOpenFound" : "isOpen"] = isOpen;
			this.isReshaped = true;
		}

		openAll(isOpen) {
			each(this.root, node => this.open(node, isOpen));
		}

		/** Brings `rows` up to date; returns whether that was needed. */
		layOut() {
			if (!this.isReshaped) return false;
			if (this.isFiltered()) {
				for (const child of this.root.children || []) {
					if (child.changedAt >= this.judgedAt) this.judge(child, false);
				}
				this.judgedAt = this.now;
			}
			this.isReshaped = false;
			this.rows = [];
			this.list(this.root);
			return true;
		}

		judge(node, isBelowFound) {
			const {text, isPath, changed, live} = this.wanted;
			const name = isPath ? node.path.toLowerCase() : node.lowerName;
			const isNamed = isBelowFound || name.includes(text);
			node.leads = false;
			if (!node.children || !node.children.length) {
				node.isShown =
					(isNamed || (!isPath && node.text.toLowerCase().includes(text))) &&
					(!changed || node.isChanged) &&
					(!live || node.isLive);
				node.isFound = node.isShown && (!isBelowFound || changed || live);
				return;
			}
			const isEnough = isNamed && !changed && !live;
			node.isShown = isEnough;
			for (const child of node.children) {
				this.judge(child, isNamed);
				node.isShown = node.isShown || child.isShown;
				node.leads = node.leads || child.isFound;
			}
			node.isFound = node.leads || (isEnough && !isBelowFound);
		}

		list(node) {
			let shown = node.children || [];
			if (this.isFiltered()) shown = shown.filter(child => child.isShown);
			shown.forEach((child, index) => {
				child.place = index + 1;
				child.siblings = shown.length;
				this.rows.push(child);
				if (child.children && this.isOpen(child)) this.list(child);
			});
		}

		take(node, value) {
			if (value === node.value) return false;
			const kind = kindOf(value);
			let isChanged = kind === LEAF || kind !== node.kind;
			node.value = value;
			if (kind !== node.kind) {
				discard(node.children);
				node.kind = kind;
				node.children = kind === LEAF ? null : [];
				node.members = kind === LEAF ? null : new Map();
				this.explain(node);
				this.isReshaped = true;
			}
			if (kind === LEAF) node.text = typeof value === "string" ? JSON.stringify(value) : String(value);
			else isChanged = this.takeMembers(node, value) || isChanged;
			if (isChanged) {
				node.isChanged = true;
				node.changedAt = this.now;
			}
			return isChanged;
		}

		takeMembers(node, values) {
			const steps = Object.keys(values);
			let isChanged = false;
			for (const step of steps) {
				let child = node.members.get(step);
				if (!child) {
					child = new Node(node, step);
					node.members.set(step, child);
					this.insert(node, child);
				}
				isChanged = this.take(child, values[step]) || isChanged;
			}
			if (node.members.size > steps.length) {
				const isKept = new Set(steps);
				discard(node.children.filter(child => !isKept.has(child.step)));
				node.children = node.children.filter(child => isKept.has(child.step));
				node.members = new Map(node.children.map(child => [child.step, child]));
				this.isReshaped = isChanged = true;
			}
			node.text = (node.kind === LIST ? "[#]" : "{#}").replace("#", steps.length);
			return isChanged;
		}

		/** Puts a member where its name belongs; most come in order. */
		insert(node, child) {
			let place = node.children.length;
			if (node.kind === OBJECT) {
				while (place && node.children[place - 1].name > child.name) place--;
			}
			node.children.splice(place, 0, child);
		}

		/** A list's values mean what the list means, variables what all of them do. */
		explain(node) {
			const isElement = node.parent && node.parent.kind === LIST && node.kind !== OBJECT;
			const above = isElement || OPEN.test(node.pattern) ? node.parent : {};
			const isKnown = Object.prototype.hasOwnProperty.call(this.meanings, node.pattern);
			const own = isKnown ? this.meanings[node.pattern] : {};
			node.unit = own.unit || above.unit || "";
			node.meaning = own.text || above.meaning || "";
			node.isLive = !!(own.live || above.isLive);
		}
	};
});
