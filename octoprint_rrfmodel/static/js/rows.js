/* Lists that stay in place while their values change, and fields that show a value and set it. */
$(function () {
    /** A reply that came so soon after a command may have been asked for before it. */
    const UNDERWAY_MS = 2000;
    /** Then what was sent holds no longer, though no newer model has come. */
    const LOST_MS = 30000;

    RRFModel.list = (value) => (Array.isArray(value) ? value : []);
    RRFModel.object = (value) => (value && typeof value === "object" ? value : {});

    /** Elements of an array of the model with their indices, gaps left out. */
    RRFModel.numbered = (value) =>
        RRFModel.list(value)
            .map((item, index) => ({item: item, index: index}))
            .filter((found) => !!found.item);

    /** A text with the row's name in it, which another machine may change. */
    RRFModel.named = (row, text) => ko.pureComputed(() => _.sprintf(text, {name: row.name()}));

    /**
     * Returns an observable array of rows. `describe()` returns plain objects with a `key` each;
     * every other member becomes an observable of the row with that key, so that the page keeps
     * its elements, where the focus is and what has been typed. `extend(row)` adds what a new row
     * can do, once.
     */
    RRFModel.rows = function (describe, extend) {
        const rows = ko.observableArray();
        let known = new Map();

        const rowOf = function (values) {
            let row = known.get(values.key);
            if (!row) {
                row = {key: values.key};
                Object.keys(values).forEach(function (name) {
                    if (name !== "key") row[name] = ko.observable(values[name]);
                });
                if (extend) extend(row);
                return row;
            }
            Object.keys(values).forEach(function (name) {
                if (name === "key") return;
                if (row[name]) row[name](values[name]);
                else row[name] = ko.observable(values[name]);
            });
            return row;
        };

        ko.computed(function () {
            const found = describe();
            ko.ignoreDependencies(function () {
                const next = found.map(rowOf);
                known = new Map(next.map((row) => [row.key, row]));
                const present = rows.peek();
                const isSame =
                    next.length === present.length &&
                    next.every((row, place) => row === present[place]);
                if (!isSame) rows(next);
            });
            // once for an update, however many keys of the model came with it
        }).extend({deferred: true});
        return rows;
    };

    /**
     * Returns what `told()` says of the machine, an array of values, each with what was sent in its
     * stead as long as the model may be older than that: `values()`, and `send(values, promise)`
     * for what goes out now.
     */
    RRFModel.lastGiven = function (core, told) {
        let sent = null;
        const isTold = function () {
            const {age, at} = core.received();
            const isLater = typeof age === "number" && at - age * 1000 > sent.at + UNDERWAY_MS;
            return isLater || (!core.status().blocked && Date.now() - sent.at > LOST_MS);
        };
        return {
            values: () =>
                told().map((value, place) =>
                    sent && !isTold() && value === sent.before[place] ? sent.values[place] : value
                ),
            send: function (values, promise) {
                const mine = (sent = {values: values, before: told(), at: Date.now()});
                return promise.fail(() => {
                    if (sent === mine) sent = null;
                });
            }
        };
    };

    /**
     * <rrf-number params="value, send, label, unit, min, max, step">: an input that shows `value`
     * (an observable) until somebody types; Enter or the button calls `send(number)`, Escape gives
     * up. Sends nothing that isn't a number within the limits.
     */
    ko.components.register("rrf-number", {
        synchronous: true,
        viewModel: function (params) {
            const self = this;
            const typed = ko.observable();

            self.label = params.label;
            self.unit = params.unit || "";
            self.test = params.test;
            self.limits = {min: params.min, max: params.max, step: params.step || "any"};
            self.isDirty = ko.pureComputed(() => typed() !== undefined);
            self.setText = ko.pureComputed(() =>
                _.sprintf(gettext("Set: %(label)s"), {label: ko.unwrap(self.label)})
            );

            self.text = ko.pureComputed({
                read: function () {
                    if (self.isDirty()) return typed();
                    const value = ko.unwrap(params.value);
                    return typeof value === "number" ? String(value) : "";
                },
                write: typed
            });

            self.send = function () {
                const text = String(typed() === undefined ? "" : typed()).replace(",", ".");
                const number = Number(text);
                const min = ko.unwrap(params.min);
                const max = ko.unwrap(params.max);
                const fits =
                    text.trim() !== "" &&
                    Number.isFinite(number) &&
                    (typeof min !== "number" || number >= min) &&
                    (typeof max !== "number" || number <= max);
                if (!fits) return;
                typed(undefined);
                params.send(number);
            };

            self.onKey = function (_self, event) {
                if (event.key === "Escape") typed(undefined);
                return true;
            };
        },
        template:
            '<form class="rrfmodel-number input-append" data-bind="submit: send">' +
            '<input type="number" inputmode="decimal" autocomplete="off"' +
            " data-bind=\"textInput: text, attr: {'aria-label': label, 'data-test': test, min: limits.min," +
            " max: limits.max, step: limits.step}, css: {'rrfmodel-dirty': isDirty}," +
            ' event: {keydown: onKey}">' +
            '<!-- ko if: unit --><span class="add-on" data-bind="text: unit"></span><!-- /ko -->' +
            '<button type="submit" class="btn" data-bind="visible: isDirty,' +
            " attr: {'aria-label': setText, title: setText}\">" +
            '<i class="fas fa-check" aria-hidden="true"></i></button>' +
            "</form>"
    });
});
