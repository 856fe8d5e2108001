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
        this.node = null;
        this.shape = ko.observable({});
        this.value = ko.observable("");
        this.isLit = ko.observable(false);
    }

    function RrfModelModelViewModel(parameters) {
        const self = this;
        const core = parameters[0];
        const tree = new RRFModel.ModelTree();
        const model = core.modelOfView("model");
        const isShown = core.isShown("model");
        let seen = {};
        let view = {top: 0, height: 0, row: 0};
        let dimming = null;
        let selected = null;
        let hasMeanings = false;

        self.isSeen = ko.pureComputed(() => isShown() && core.isRrf());

        self.text = ko.observable("");
        self.onlyChanged = ko.observable(false);
        self.onlyLive = ko.observable(false);
        self.slots = ko.observableArray();
        self.height = ko.observable("0");
        self.shift = ko.observable("");
        self.activeId = ko.observable(null);
        self.count = ko.observable("");
        self.detail = ko.observable(null);
        self.detailValue = ko.observable("");
        self.copied = ko.observable("");

        const box = () => document.querySelector("#rrfmodel_model [role=tree]");

        //~~ from the model to the rows

        /** Take what is other than before; a key that didn't change is the same object. */
        const take = function () {
            const latest = core.latest;
            const keys = Object.keys(Object.assign({}, seen, latest)).filter(
                (key) => seen[key] !== latest[key]
            );
            if (!keys.length) return false;
            seen = Object.assign({}, latest);
            return tree.update(keys, latest, Date.now());
        };

        const render = function () {
            if (tree.layOut()) {
                self.height(tree.rows.length * view.row + "px");
                self.count(tree.isFiltered() ? countText(tree.rows.length) : "");
                if (selected && !isThere(selected)) select(null);
            }
            const wanted = Math.ceil(view.height / view.row) + 2 * SPARE || 0;
            if (self.slots.peek().length < wanted) addSlots(wanted);
            const last = Math.max(0, tree.rows.length - wanted);
            const first = Math.min(last, Math.max(0, Math.floor(view.top / view.row) - SPARE));
            self.shift("translateY(" + first * view.row + "px)");
            const now = Date.now();
            let activeId = null;
            let isAnyLit = false;
            self.slots.peek().forEach(function (slot, place) {
                const node = tree.rows[first + place] || null;
                fill(slot, node, now);
                isAnyLit = isAnyLit || slot.isLit.peek();
                if (node && node === selected) activeId = slot.id;
            });
            self.activeId(activeId);
            if (selected) self.detailValue(valueAndUnit(selected));
            if (isAnyLit && !dimming) dimming = window.setTimeout(dim, LIT_MS);
        };

        const dim = function () {
            dimming = null;
            if (self.isSeen.peek()) render();
        };

        const addSlots = function (wanted) {
            const more = [];
            for (let number = self.slots.peek().length; number < wanted; number++) {
                more.push(new Slot(number));
            }
            self.slots(self.slots.peek().concat(more));
        };

        const fill = function (slot, node, now) {
            const shape = slot.shape.peek();
            const isOpen = !!node && tree.isOpen(node);
            if (
                slot.node !== node ||
                (node &&
                    (shape.isOpen !== isOpen ||
                        shape.isSelected !== (node === selected) ||
                        shape.meaning !== node.meaning ||
                        shape.place !== node.place ||
                        shape.siblings !== node.siblings))
            ) {
                slot.node = node;
                slot.shape(node ? shapeOf(node, isOpen) : {});
            }
            slot.value(node ? valueAndUnit(node) : "");
            slot.isLit(!!node && !(node.children && isOpen) && now - node.changedAt < LIT_MS);
        };

        const shapeOf = (node, isOpen) => ({
            name: node.name,
            meaning: node.meaning,
            indent: node.depth * INDENT + "px",
            level: node.depth + 1,
            place: node.place,
            siblings: node.siblings,
            isOpen: isOpen,
            expanded: node.children && node.children.length ? String(isOpen) : null,
            isSelected: node === selected
        });

        const valueAndUnit = (node) =>
            RRFModel.treeValue(node) + (typeof node.value === "number" && node.unit ? " " + node.unit : "");

        const countText = (rows) =>
            rows
                ? _.sprintf(gettext("Rows found: %(count)d"), {count: rows})
                : gettext("Nothing found");

        const isThere = (node) => {
            for (let above = node.parent; above; node = above, above = node.parent) {
                if (!above.children || !above.children.includes(node)) return false;
            }
            return true;
        };

        /** Note how much is seen; asked only when that may have changed. */
        const measure = function () {
            const element = box();
            view.top = element.scrollTop;
            view.height = element.clientHeight;
            view.row = parseFloat(window.getComputedStyle(element).lineHeight);
        };

        const show = function () {
            measure();
            take();
            tree.forget();
            if (!hasMeanings) {
                hasMeanings = true;
                OctoPrint.plugins.rrfmodel
                    .getMeanings()
                    .done(function (meanings) {
                        tree.learn(meanings);
                        if (self.isSeen.peek()) render();
                    })
                    .fail(function (xhr) {
                        hasMeanings = false;
                        core.tellRefusal(xhr);
                    });
            }
            render();
        };

        //~~ what a person does

        const select = function (node) {
            selected = node;
            self.copied("");
            self.detail(node && {path: node.path, meaning: node.meaning, unit: node.unit});
        };

        const toggle = (node, isOpen) => tree.open(node, isOpen === undefined ? !tree.isOpen(node) : isOpen);

        self.pick = function (slot) {
            if (!slot.node) return;
            select(slot.node);
            toggle(slot.node);
            render();
        };

        self.scrolled = function () {
            view.top = box().scrollTop;
            render();
        };

        /** Keys as in the ARIA practices for trees: what each does with the selected row. */
        const page = () => Math.max(1, Math.floor(view.height / view.row) - 1);
        const KEYS = {
            ArrowDown: (place) => place + 1,
            ArrowUp: (place) => place - 1,
            PageDown: (place) => place + page(),
            PageUp: (place) => place - page(),
            Home: () => 0,
            End: () => tree.rows.length - 1,
            ArrowRight: function (place, node) {
                if (!node || !node.children || !node.children.length) return place;
                if (tree.isOpen(node)) return place + 1;
                toggle(node, true);
                return place;
            },
            ArrowLeft: function (place, node) {
                if (node && node.children && tree.isOpen(node)) toggle(node, false);
                else if (node && node.parent.parent) return tree.rows.indexOf(node.parent);
                return place;
            },
            Enter: function (place, node) {
                if (node) toggle(node);
                return place;
            }
        };
        KEYS[" "] = KEYS.Enter;

        self.pressed = function (_self, event) {
            const key = KEYS[event.key];
            if (!key || event.ctrlKey || event.altKey || event.metaKey) return true;
            const place = selected ? tree.rows.indexOf(selected) : -1;
            const next = Math.min(tree.rows.length - 1, Math.max(0, key(place, tree.rows[place])));
            select(tree.rows[next] || null);
            keepInSight(next);
            render();
            return false;
        };

        const keepInSight = function (place) {
            const top = place * view.row;
            const lowest = top + view.row - view.height;
            const wanted = Math.min(top, Math.max(lowest, view.top));
            if (wanted === view.top) return;
            box().scrollTop = view.top = wanted;
        };

        self.flip = (flag) => () => flag(!flag());
        self.forget = function () {
            tree.forget();
            render();
        };
        self.openAll = (isOpen) => () => {
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
        self.copyCommand = (_self, event) =>
            copy('M409 K"' + selected.path.replace(/"/g, '""') + '"', event);

        //~~ when all that happens

        self.onStartupComplete = function () {
            self.isSeen.subscribe((is) => is && show());
            if (self.isSeen()) show();
            $(window).on("resize", function () {
                if (!self.isSeen()) return;
                measure();
                tree.isReshaped = true;
                render();
            });
            // a message brings its status last; where none comes, the state of the machine moves
            ko.computed(function () {
                if (!self.isSeen()) return;
                core.received();
                model("state");
                ko.ignoreDependencies(() => take() && render());
            });
            const find = ko.pureComputed(() => ({
                text: self.text(),
                changed: self.onlyChanged(),
                live: self.onlyLive()
            }));
            find.extend({rateLimit: {timeout: 150, method: "notifyWhenChangesStop"}});
            find.subscribe(function (wanted) {
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
