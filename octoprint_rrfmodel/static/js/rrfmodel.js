/* The sidebar: what RepRapFirmware says of the machine, as it comes by push. */
$(function () {
    /**
     * @typedef {{name: string, current: string, active: string, standby: string,
     *            state: string, stateText: string, labelClass: string}} HeaterRow
     * @typedef {{letter: string, position: string, homed: boolean, title: string}} AxisMark
     */

    /** Words in the page's language; OctoPrint defines gettext after this file has run. */
    const makeWords = () => ({
        /** The machine's state, by state.status; a new one is shown as it came. */
        status: {
            starting: gettext("Starting"),
            updating: gettext("Updating the firmware"),
            halted: gettext("Halted"),
            off: gettext("No motor supply"),
            pausing: gettext("Pausing"),
            resuming: gettext("Resuming"),
            paused: gettext("Paused"),
            cancelling: gettext("Cancelling"),
            simulating: gettext("Simulating"),
            processing: gettext("Printing from its card"),
            changingTool: gettext("Changing the tool"),
            busy: gettext("Busy"),
            idle: gettext("Idle")
        },
        /** A heater's state: word and label class. */
        heater: {
            off: {text: gettext("off"), label: ""},
            standby: {text: gettext("standby"), label: "label-info"},
            active: {text: gettext("active"), label: "label-success"},
            fault: {text: gettext("fault"), label: "label-important"},
            tuning: {text: gettext("tuning"), label: "label-warning"},
            offline: {text: gettext("offline"), label: "label-warning"}
        },
        blocked: {
            heating: gettext("the printer waits for a temperature"),
            long_command: gettext("the printer is busy with a long command"),
            streaming: gettext("a file is being sent to the printer's card"),
            buffers: gettext("the printer is short of memory for its answers")
        },
        /** What a person is told, by the code of a warning; others have the server's text. */
        warning: {
            halted: gettext(
                "The machine was stopped by an emergency stop. Restart it with M999 or its power switch."
            ),
            off: gettext("The motors have no supply voltage."),
            reset: gettext(
                "The board was reset during the print, which can't go on. Cancel it, then home."
            ),
            message_box_unanswerable: gettext(
                "The machine waits for an answer that this firmware does not take over USB. Answer on the machine's own page or panel, or reset the machine."
            ),
            long_running_commands: gettext(
                "OctoPrint does not know some of RepRapFirmware's commands that take long."
            ),
            uppercase: gettext(
                "OctoPrint's terminal would change file names and texts to upper case."
            ),
            unknown_commands: gettext(
                "OctoPrint does not count the acknowledgements of T-1 and of commands such as echo."
            ),
            external_heatup: gettext(
                "OctoPrint would take RepRapFirmware's temperature reports for a heat-up."
            ),
            profile_tools: gettext(
                "The printer profile has fewer extruders than the machine's highest tool number needs, so that OctoPrint drops tool commands."
            ),
            profile_reconnect: gettext(
                "Disconnect the printer and connect it again: OctoPrint still uses the old number of extruders."
            )
        },
        numbered: {
            heater_fault: gettext(
                "Heater %(number)s reports a fault. Find the cause, then reset it with M562."
            ),
            filament_error: gettext(
                "The filament monitor of extruder %(number)s reports an error. Check the filament."
            ),
            driver_error: gettext(
                "Motor driver %(number)s reports an error. Find the cause."
            )
        },
        /** What the button of a warning says, by the command that it sends. */
        fix: {
            recover: gettext("Restart the machine"),
            fix_settings: gettext("Set OctoPrint's settings"),
            fix_profile: gettext("Raise the number of extruders")
        }
    });

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

    function degrees(value) {
        return typeof value === "number" ? value.toFixed(1) : "–";
    }

    /** A target as text: one that was never set is -273.15. */
    function target(value) {
        return typeof value === "number" && value > -273 ? value.toFixed(0) : "–";
    }

    /** @returns {HeaterRow} */
    function heaterRow(name, heater) {
        const state = words.heater[heater.state] || {text: heater.state || "", label: ""};
        return {
            name: name,
            current: degrees(heater.current),
            active: target(heater.active),
            standby: target(heater.standby),
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

        words = makeWords();

        self.loginState = parameters[0];
        self.access = parameters[1];

        self.status = ko.observable({});
        self.model = ko.observable({});
        self.received = ko.observable({age: undefined, at: 0});
        self.now = ko.observable(Date.now());
        self.told = {};

        self.mayRead = ko.pureComputed(function () {
            return self.loginState.hasPermission(self.access.permissions.PLUGIN_RRFMODEL_READ);
        });

        self.isShown = ko.pureComputed(function () {
            return self.mayRead() && !!self.status().connected && !!self.status().is_rrf;
        });

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
            return !!permission && self.loginState.hasPermission(self.access.permissions[permission]);
        };

        self.fix = function (row) {
            if (!self.mayFix(row.fix)) return;
            OctoPrint.plugins.rrfmodel.command(row.fix).fail(function (xhr) {
                self.notify((xhr.responseJSON || {}).error || gettext("That did not work."));
            });
        };

        self.firmwareText = ko.pureComputed(function () {
            const firmware = self.status().firmware;
            return firmware ? [firmware.name, firmware.version].filter(Boolean).join(" ") : "";
        });

        self.age = ko.pureComputed(function () {
            const received = self.received();
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

        self.requestData = function () {
            if (!self.mayRead()) return;
            OctoPrint.plugins.rrfmodel.getStatus().done(function (status) {
                self.fromStatus(status);
                if (!status.is_rrf || !status.revision) return;
                OctoPrint.plugins.rrfmodel.getModel("", "d99vn").done(function (answer) {
                    self.model(answer.result || {});
                });
            });
        };

        self.fromStatus = function (status) {
            self.received({age: status.age, at: Date.now()});
            self.now(Date.now());
            self.status(status);
            self.tell(status.warnings || []);
        };

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

        self.notify = function (text) {
            new PNotify({
                title: gettext("RepRapFirmware"),
                text: text,
                title_escape: true,
                text_escape: true,
                type: "notice"
            });
        };

        self.onStartupComplete = self.requestData;
        self.onServerReconnect = self.requestData;
        self.onUserPermissionsChanged =
            self.onUserLoggedIn =
            self.onUserLoggedOut =
                function () {
                    self.model({});
                    self.requestData();
                };

        self.onDataUpdaterPluginMessage = function (plugin, message) {
            if (plugin !== "rrfmodel" || !self.mayRead()) return;
            if (message.type === "notice") {
                self.notify(message.text);
                return;
            }
            if (message.type === "reset") self.model({});
            if (message.type === "model") {
                self.model(Object.assign({}, self.model(), message.changed));
            }
            self.fromStatus(message.status);
        };

        window.setInterval(function () {
            if (self.isShown() && !document.hidden) self.now(Date.now());
        }, 1000);
    }

    OCTOPRINT_VIEWMODELS.push({
        construct: RrfModelSidebarViewModel,
        dependencies: ["loginStateViewModel", "accessViewModel"],
        elements: ["#sidebar_plugin_rrfmodel"]
    });
});
