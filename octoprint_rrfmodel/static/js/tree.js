/* The object model as a tree: its nodes, what changed in them, and which of them are shown. */
$(function () {
    const LEAF = 0;
    const LIST = 1;
    const OBJECT = 2;

    /**
     * @typedef {object} Node
     * @property {string} name as its parent has it, `[3]` for an element
     * @property {string} path as M409 takes it, `heat.heaters[0].current`
     * @property {string} pattern the same with `[]` for any element
     * @property {*} value of a leaf
     * @property {?Node[]} children in the order they are shown
     * @property {boolean} changed since the last `forget()`
     * @property {number} changedAt when it or something below it changed
     * @property {boolean} live whether the firmware says that it changes frequently
     * @property {number} place among its shown siblings, from 1
     * @property {number} siblings how many of them are shown
     */

    function kindOf(value) {
        if (value === null || typeof value !== "object") return LEAF;
        return Array.isArray(value) ? LIST : OBJECT;
    }

    /** @returns {Node} */
    function makeNode(parent, step) {
        const inList = !!parent && parent.kind === LIST;
        const name = inList ? "[" + step + "]" : step;
        const joint = inList || !parent || !parent.path ? "" : ".";
        return {
            parent: parent,
            name: name,
            path: parent ? parent.path + joint + name : "",
            pattern: parent ? parent.pattern + (inList ? "[]" : joint + name) : "",
            depth: parent ? parent.depth + 1 : -1,
            kind: parent ? undefined : OBJECT,
            value: undefined,
            text: null,
            lowerText: null,
            lowerPath: null,
            children: parent ? null : [],
            members: parent ? null : new Map(),
            isOpen: !parent,
            isOpenFound: null,
            changed: false,
            changedAt: -Infinity,
            unit: "",
            meaning: "",
            live: false,
            isShown: true,
            isFound: false,
            leads: false,
            place: 0,
            siblings: 0
        };
    }

    class ModelTree {
        constructor() {
            this.root = makeNode(null, "");
            this.rows = [];
            this.meanings = {};
            this.find = {text: "", changed: false, live: false};
            this.isReshaped = true;
            this.isSearched = true;
            this.unjudged = new Set();
        }

        /** Take the values of top-level keys; return whether anything changed. */
        update(keys, model, now) {
            this.now = now;
            let changed = false;
            keys.forEach((key) => {
                const value = model[key];
                const isGone = value === undefined || value === null;
                if (isGone ? !this.drop(key) : !this.takeMember(this.root, key, value)) return;
                changed = true;
                this.unjudged.add(key);
            });
            if (changed && (this.find.text || this.find.changed)) this.isReshaped = true;
            return changed;
        }

        /** Nothing has changed from here on. */
        forget() {
            each(this.root, (node) => {
                node.changed = false;
                node.changedAt = -Infinity;
            });
            this.isReshaped = this.isSearched = true;
        }

        /** Learn units and meanings, by pattern. */
        learn(meanings) {
            this.meanings = meanings;
            each(this.root, (node) => this.explain(node));
            this.isReshaped = this.isSearched = true;
        }

        /** Show only what has the text in its name or value, changed, is live; as asked. */
        search(find) {
            const text = find.text.trim().toLowerCase();
            this.find = {
                text: text,
                isPath: /[.[]/.test(text),
                changed: find.changed,
                live: find.live
            };
            each(this.root, (node) => {
                node.isOpenFound = null;
            });
            this.isReshaped = this.isSearched = true;
        }

        isFiltered() {
            return !!this.find.text || this.find.changed || this.find.live;
        }

        isOpen(node) {
            if (!this.isFiltered()) return node.isOpen;
            return node.isOpenFound === null ? node.leads : node.isOpenFound;
        }

        open(node, isOpen) {
            if (!node.children) return;
            node[this.isFiltered() ? "isOpenFound" : "isOpen"] = isOpen;
            this.isReshaped = true;
        }

        openAll(isOpen) {
            each(this.root, (node) => {
                if (node.parent) this.open(node, isOpen);
            });
        }

        /** Open everything above a node. */
        reveal(node) {
            for (let above = node.parent; above && above.parent; above = above.parent) {
                if (!this.isOpen(above)) this.open(above, true);
            }
        }

        /** Bring `rows` up to date; return whether that was needed. */
        layOut() {
            if (!this.isReshaped) return false;
            this.isReshaped = false;
            if (this.isFiltered()) {
                this.root.children.forEach((child) => {
                    if (this.isSearched || this.unjudged.has(child.name)) this.judge(child, false);
                });
                this.isSearched = false;
            }
            this.unjudged.clear();
            this.rows = [];
            this.list(this.root);
            return true;
        }

        /** Decide whether a node is shown, and whether it or what is below was itself found. */
        judge(node, isBelowFound) {
            const find = this.find;
            const onlySome = find.changed || find.live;
            const isNamed = !!find.text && !isBelowFound && this.hasName(node);
            const passes = isBelowFound || isNamed || !find.text;
            node.leads = false;
            if (!node.children || !node.children.length) {
                const isFound = passes || (!find.isPath && textOf(node).indexOf(find.text) >= 0);
                node.isShown =
                    isFound && (!find.changed || node.changed) && (!find.live || node.live);
                node.isFound = node.isShown && (!isBelowFound || onlySome);
                return;
            }
            let isShown = passes && !onlySome;
            for (const child of node.children) {
                this.judge(child, isBelowFound || isNamed);
                isShown = isShown || child.isShown;
                node.leads = node.leads || child.isFound;
            }
            node.isShown = isShown;
            node.isFound = node.leads || (isNamed && isShown);
        }

        hasName(node) {
            if (node.lowerPath === null) node.lowerPath = node.path.toLowerCase();
            const place = node.lowerPath.lastIndexOf(this.find.text);
            return place >= 0 && (this.find.isPath || place >= node.path.length - node.name.length);
        }

        list(node) {
            const shown = this.isFiltered()
                ? node.children.filter((child) => child.isShown)
                : node.children;
            shown.forEach((child, index) => {
                child.place = index + 1;
                child.siblings = shown.length;
                this.rows.push(child);
                if (child.children && this.isOpen(child)) this.list(child);
            });
        }

        take(node, value) {
            const kind = kindOf(value);
            let changed = false;
            if (kind !== node.kind) {
                node.kind = kind;
                node.children = kind === LEAF ? null : [];
                node.members = kind === OBJECT ? new Map() : null;
                node.text = node.lowerText = null;
                this.isReshaped = true;
                changed = true;
            }
            if (kind !== LEAF) {
                const below = kind === LIST ? this.takeList(node, value) : this.takeMembers(node, value);
                changed = below || changed;
            } else if (value !== node.value) {
                node.value = value;
                node.text = node.lowerText = null;
                changed = true;
            }
            if (changed) {
                node.changed = true;
                node.changedAt = this.now;
            }
            return changed;
        }

        takeList(node, values) {
            const children = node.children;
            let changed = false;
            for (let index = 0; index < values.length; index++) {
                if (index === children.length) children.push(this.begin(node, String(index)));
                changed = this.take(children[index], values[index]) || changed;
            }
            if (children.length === values.length) return changed;
            children.length = values.length;
            this.isReshaped = true;
            return true;
        }

        takeMembers(node, values) {
            const names = Object.keys(values);
            let changed = false;
            names.forEach((name) => {
                changed = this.takeMember(node, name, values[name]) || changed;
            });
            if (node.members.size === names.length) return changed;
            const kept = new Set(names);
            node.children = node.children.filter((child) => kept.has(child.name));
            node.members = new Map(node.children.map((child) => [child.name, child]));
            this.isReshaped = true;
            return true;
        }

        takeMember(node, name, value) {
            let child = node.members.get(name);
            if (!child) {
                child = this.begin(node, name);
                node.members.set(name, child);
                insert(node.children, child);
            }
            return this.take(child, value);
        }

        drop(name) {
            const child = this.root.members.get(name);
            if (!child) return false;
            this.root.members.delete(name);
            this.root.children = this.root.children.filter((other) => other !== child);
            this.isReshaped = true;
            return true;
        }

        begin(parent, step) {
            const node = makeNode(parent, step);
            this.explain(node);
            this.isReshaped = true;
            return node;
        }

        /** A list's values mean what the list means, variables what all of them do. */
        explain(node) {
            const known = Object.prototype.hasOwnProperty.call(this.meanings, node.pattern);
            const own = known ? this.meanings[node.pattern] : null;
            const above = node.parent || {};
            const isElement = above.kind === LIST || OPEN.test(node.pattern);
            node.unit = own ? own.unit : isElement ? above.unit : "";
            node.meaning = own ? own.text : isElement ? above.meaning : "";
            node.live = own ? !!own.live : isElement && !!above.live;
        }
    }

    function each(node, action) {
        action(node);
        if (node.children) for (const child of node.children) each(child, action);
    }

    /** Put a member where its name belongs; most come in order. */
    function insert(children, child) {
        let place = children.length;
        while (place && children[place - 1].name > child.name) place--;
        children.splice(place, 0, child);
    }

    /** Below these anybody names what is there. */
    const OPEN = /^(global|job\.file\.customInfo)\./;

    /** The value as the row shows it: JSON for a leaf, else how much is below. */
    function valueText(node) {
        if (node.kind === LIST) return "[" + node.children.length + "]";
        if (node.kind === OBJECT) return "{" + node.children.length + "}";
        if (node.text === null) node.text = JSON.stringify(node.value);
        return node.text;
    }

    function textOf(node) {
        if (node.lowerText === null) node.lowerText = valueText(node).toLowerCase();
        return node.lowerText;
    }

    RRFModel.ModelTree = ModelTree;
    RRFModel.treeValue = valueText;
});
