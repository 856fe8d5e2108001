/* The sidebar: what RepRapFirmware says of the machine, as it comes by push. */
$(function () {
    /**
     * @typedef {{name: string, current: string, active: string, standby: string,
     *            state: string, stateText: string, labelClass: string}} HeaterRow
     * @typedef {{letter: string, position: string, homed: boolean, title: string}} AxisMark
     */

    let words;

    /** A warning about one of several things: code, and numbers with underscores between. */
    const NUMBERED = /^(heater_fault|filament_error|driver_error)_([\d_]+)$/;

    /** The command that mends what a warning is about; asks for one permission each. */
    const NEEDED_FOR = {
        recover: "PLUGIN_RRFMODEL_CONTROL",
        fix_settings: "SETTINGS",
        fix_profile: "SETTINGS"
    };

    /** The plugin's own words in the page's language for a warning of the server. */
    function warningText(warning) {
        const numbered = NUMBERED.exec(warning.code);
        if (numbered) {
            return _.sprintf(words.numbered[numbered[1]], {
                number: numbered[2].replace("_", ".")
            });
        }
        return words.warning[warning.code] || warning.text;
    }

    /** Whether a warning is about the machine; the others are advice, and can wait. */
    function isFault(warning) {
        return !warning.fix || warning.fix === "recover";
    }

    const show = RRFModel.show;

    /** @returns {HeaterRow} */
    function heaterRow(name, heater) {
        const state = words.heater[heater.state] || {text: heater.state || "", label: ""};
        return {
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
        (model.tools || []).forEach(function (tool) {
            if (!tool) return;
            (tool.heaters || []).forEach(function (index, place) {
                if (!heaters[index]) return;
                const title = tool.name || _.sprintf(gettext("Tool %(number)s"), tool);
                rows.push(
                    heaterRow(place ? title + " (" + (place + 1) + ")" : title, heaters[index])
                );
            });
        });
        [
            {slots: heat.bedHeaters, title: gettext("Bed")},
            {slots: heat.chamberHeaters, title: gettext("Chamber")}
        ].forEach(function (kind) {
            (kind.slots || []).forEach(function (index, slot) {
                if (!heaters[index]) return;
                rows.push(heaterRow(slot ? kind.title + " " + slot : kind.title, heaters[index]));
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
        words = RRFModel.words;

        self.status = core.status;
        self.now = ko.observable(Date.now());
        self.told = {};

        self.mayRead = core.mayRead;

        /** The model's top-level keys that the sidebar shows. */
        self.model = ko.pureComputed(() => ({
            state: core.model("state"),
            heat: core.model("heat"),
            move: core.model("move"),
            tools: core.model("tools")
        }));

        self.isShown = core.isRrf;

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

        self.heaters = ko.pureComputed(function () {
            return heaterRows(self.model());
        });

        self.axes = ko.pureComputed(function () {
            return axisMarks(self.model());
        });

        /** Warnings to show, those that one button mends grouped with it. */
        self.warnings = ko.pureComputed(function () {
            const rows = [];
            if (!self.mayRead()) return rows;
            (self.status().warnings || []).forEach(function (warning) {
                const fix = self.mayFix(warning.fix) ? warning.fix : "";
                const last = rows[rows.length - 1];
                if (fix && last && last.fix === fix) {
                    last.texts.push(warningText(warning));
                    return;
                }
                rows.push({
                    texts: [warningText(warning)],
                    fix: fix,
                    fixText: words.fix[fix] || "",
                    kind: isFault(warning) ? "warning" : "advice",
                    labelClass: isFault(warning) ? "alert-error" : ""
                });
            });
            return rows;
        });

        self.mayFix = function (fix) {
            const permission = NEEDED_FOR[fix];
            return !!permission && core.may(permission);
        };

        self.fix = function (row) {
            if (!self.mayFix(row.fix)) return;
            core.command(row.fix);
        };

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

        core.received.subscribe(() => self.now(Date.now()));
        core.status.subscribe((status) => self.tell(status.warnings || []));

        /** Tell each warning once; it may be told again when its cause was gone in between. */
        self.tell = function (warnings) {
            const told = {};
            warnings.filter(isFault).forEach(function (warning) {
                told[warning.code] =
                    self.told[warning.code] ||
                    new PNotify({
                        title: gettext("RepRapFirmware"),
                        text: warningText(warning),
                        title_escape: true,
                        text_escape: true,
                        type: "error",
                        hide: false,
                        confirm: self.confirmation(warning)
                    });
            });
            Object.keys(self.told).forEach(function (code) {
                if (!told[code]) self.told[code].remove();
            });
            self.told = told;
        };

        /** The part of a notification that has the button, for those who may press it. */
        self.confirmation = function (warning) {
            if (!self.mayFix(warning.fix)) return {};
            const later = {
                text: gettext("Later"),
                click: function (notice) {
                    notice.remove();
                }
            };
            const now = {
                text: words.fix[warning.fix],
                addClass: "btn-primary",
                click: function (notice) {
                    notice.remove();
                    self.fix(warning);
                }
            };
            return {confirm: true, buttons: [later, now]};
        };

        window.setInterval(function () {
            if (self.isShown() && !document.hidden) self.now(Date.now());
        }, 1000);
    }

    OCTOPRINT_VIEWMODELS.push({
        construct: RrfModelSidebarViewModel,
        dependencies: ["rrfModelViewModel"],
        elements: ["#sidebar_plugin_rrfmodel"]
    });
});
