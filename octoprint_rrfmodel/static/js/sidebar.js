/* The sidebar: what RepRapFirmware says of the machine, as it comes by push. */
$(function () {
    /**
     * @typedef {{name: string, current: string, active: string, standby: string,
     *            state: string, stateText: string, labelClass: string}} HeaterRow
     * @typedef {{letter: string, position: string, homed: boolean, title: string}} AxisMark
     */

    let words;

    const show = RRFModel.show;

    /** @returns {HeaterRow} */
    function heaterRow(key, name, heater) {
        const state = words.heater[heater.state] || {text: heater.state || "", label: ""};
        return {
            key: key,
            name: name,
            current: show.degrees(heater.current),
            active: show.target(heater.active),
            standby: show.target(heater.standby),
            state: heater.state || "",
            stateText: state.text,
            labelClass: state.label
        };
    }

    /** @returns {HeaterRow[]} one for each heater of each tool, then beds and chambers */
    function heaterRows(model) {
        const heat = model.heat || {};
        const heaters = heat.heaters || [];
        const rows = [];
        (model.tools || []).forEach(function (tool, number) {
            if (!tool) return;
            (tool.heaters || []).forEach(function (index, place) {
                if (!heaters[index]) return;
                const title = tool.name || _.sprintf(gettext("Tool %(number)s"), tool);
                const name = place ? title + " (" + (place + 1) + ")" : title;
                // two tools may have one name
                rows.push(heaterRow("tool" + number + "." + place, name, heaters[index]));
            });
        });
        [
            {slots: heat.bedHeaters, key: "bed", title: gettext("Bed")},
            {slots: heat.chamberHeaters, key: "chamber", title: gettext("Chamber")}
        ].forEach(function (kind) {
            (kind.slots || []).forEach(function (index, slot) {
                if (!heaters[index]) return;
                const name = slot ? kind.title + " " + slot : kind.title;
                rows.push(heaterRow(kind.key + slot, name, heaters[index]));
            });
        });
        return rows;
    }

    /** @returns {AxisMark[]} one for each axis that is meant to be seen */
    function axisMarks(model) {
        const axes = (model.move || {}).axes || [];
        return axes
            .filter(function (axis) {
                return axis && axis.letter && axis.visible !== false;
            })
            .map(function (axis) {
                const position = axis.machinePosition;
                return {
                    key: axis.letter,
                    letter: axis.letter,
                    position: typeof position === "number" ? position.toFixed(2) : "–",
                    homed: !!axis.homed,
                    title: axis.homed ? gettext("homed") : gettext("not homed")
                };
            });
    }

    function RrfModelSidebarViewModel(parameters) {
        const self = this;

        const core = parameters[0];
        const notifications = parameters[1];
        words = RRFModel.words;

        self.status = core.status;
        self.now = ko.observable(Date.now());

        self.mayRead = core.mayRead;

        /** The model's top-level keys that the sidebar shows. */
        self.model = ko.pureComputed(() => ({
            state: core.model("state"),
            heat: core.model("heat"),
            move: core.model("move"),
            tools: core.model("tools")
        }));

        self.isShown = core.isRrf;
        self.mayRead = core.mayRead;

        /** Whether a row is wanted; every one can be folded away in the settings. */
        self.wants = function (row) {
            const plugins = (core.settings.settings || {}).plugins;
            const rows = plugins && plugins.rrfmodel && plugins.rrfmodel.sidebar;
            // who may not read settings has all of them
            return !rows || !rows[row] || ko.unwrap(rows[row]);
        };

        self.state = ko.pureComputed(function () {
            return self.model().state || {};
        });

        self.statusText = ko.pureComputed(function () {
            const word = self.state().status;
            return word ? words.status[word] || word : gettext("Reading the model …");
        });

        self.toolText = ko.pureComputed(function () {
            const number = self.state().currentTool;
            if (typeof number !== "number") return "–";
            if (number < 0) return gettext("none");
            const tool = (self.model().tools || []).find(function (candidate) {
                return candidate && candidate.number === number;
            });
            return tool && tool.name ? number + " (" + tool.name + ")" : String(number);
        });

        self.heaters = RRFModel.rows(() => heaterRows(self.model()));
        self.axes = RRFModel.rows(() => axisMarks(self.model()));

        self.message = ko.pureComputed(() => self.state().displayMessage || "");

        self.fans = RRFModel.rows(() =>
            (core.model("fans") || [])
                .map((fan, index) => ({fan: fan, index: index}))
                .filter((found) => !!found.fan)
                .map((found) => ({
                    key: found.index,
                    name:
                        found.fan.name ||
                        _.sprintf(gettext("Fan %(number)s"), {number: found.index}),
                    speed: show.percent(found.fan.actualValue),
                    rpm: found.fan.rpm >= 0 ? found.fan.rpm + " " + gettext("rpm") : ""
                }))
        );

        self.speedFactor = ko.pureComputed(() => show.percent((self.model().move || {}).speedFactor));
        self.extrusionFactors = ko.pureComputed(() =>
            ((self.model().move || {}).extruders || [])
                .map((extruder) => show.percent((extruder || {}).factor))
                .join(" / ")
        );

        const job = ko.pureComputed(() => core.model("job") || {});
        self.layerText = ko.pureComputed(function () {
            if (typeof job().layer !== "number") return "";
            const layers = (job().file || {}).numLayers;
            return layers ? job().layer + " / " + layers : String(job().layer);
        });
        self.leftText = ko.pureComputed(function () {
            const left = job().timesLeft || {};
            const known = [left.slicer, left.filament, left.file].find(
                (seconds) => typeof seconds === "number"
            );
            return known === undefined ? "" : show.duration(known);
        });

        /** Warnings to show, those that one button mends grouped with it. */
        self.warnings = ko.pureComputed(function () {
            const rows = [];
            if (!self.mayRead()) return rows;
            (self.status().warnings || []).forEach(function (warning) {
                const fix = notifications.mayFix(warning.fix) ? warning.fix : "";
                const last = rows[rows.length - 1];
                if (fix && last && last.fix === fix) {
                    last.texts.push(RRFModel.warningText(warning));
                    return;
                }
                rows.push({
                    texts: [RRFModel.warningText(warning)],
                    fix: fix,
                    fixText: words.fix[fix] || "",
                    kind: warning.level === "advice" ? "advice" : "warning",
                    labelClass: warning.level === "fault" ? "alert-error" : ""
                });
            });
            return rows;
        });
        // the same warnings stay as they are, or a screen reader would tell them with each message
        self.warnings.equalityComparer = _.isEqual;

        self.fix = (row) => notifications.fix(row);

        self.firmwareText = ko.pureComputed(function () {
            const firmware = self.status().firmware;
            return firmware ? [firmware.name, firmware.version].filter(Boolean).join(" ") : "";
        });

        self.age = ko.pureComputed(function () {
            const received = core.received();
            if (typeof received.age !== "number") return undefined;
            return received.age + Math.max(0, self.now() - received.at) / 1000;
        });

        self.ageText = ko.pureComputed(function () {
            const age = self.age();
            if (age === undefined) return gettext("no data yet");
            if (age < 60) return _.sprintf(gettext("%(seconds)d s ago"), {seconds: age});
            return _.sprintf(gettext("%(minutes)d min ago"), {minutes: age / 60});
        });

        self.isStale = ko.pureComputed(function () {
            return !!self.status().stale;
        });

        self.reasonText = ko.pureComputed(function () {
            const blocked = self.status().blocked;
            if (blocked) return words.blocked[blocked] || blocked;
            return self.isStale() ? gettext("the printer does not answer") : "";
        });

        self.tellsInTab = ko.pureComputed(
            () => core.tabIsOpen() && core.pageIsVisible() && self.isShown() && !!self.reasonText()
        );

        core.received.subscribe(() => self.now(Date.now()));

        window.setInterval(function () {
            if (self.isShown() && !document.hidden) self.now(Date.now());
        }, 1000);
    }

    OCTOPRINT_VIEWMODELS.push({
        construct: RrfModelSidebarViewModel,
        dependencies: ["rrfModelViewModel", "rrfModelNotificationsViewModel"],
        elements: ["#sidebar_plugin_rrfmodel", "#rrfmodel_age"]
    });
});
