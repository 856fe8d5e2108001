/* What is told once when it begins, and taken back when it is over. */
$(function () {
    /** The command that mends what a warning is about; asks for one permission each. */
    const NEEDED_FOR = {
        recover: "PLUGIN_RRFMODEL_CONTROL",
        fix_settings: "SETTINGS",
        fix_profile: "SETTINGS"
    };

    const TYPES = {fault: "error", warning: "notice"};

    function RrfModelNotificationsViewModel(parameters) {
        const self = this;
        const core = parameters[0];
        const words = RRFModel.words;
        let told = new Map();

        self.mayFix = (fix) => !!NEEDED_FOR[fix] && core.may(NEEDED_FOR[fix]);

        self.fix = function (warning) {
            if (self.mayFix(warning.fix)) core.command(warning.fix);
        };

        /** What is to be told now: key, text, kind. Advice can wait and stands in the sidebar. */
        const due = ko.pureComputed(function () {
            if (!core.mayRead()) return [];
            const warnings = core.status().warnings || [];
            // what has paused a print is told with that
            const told = new Set(
                warnings.flatMap((warning) => (warning.causes || []).map((cause) => cause.code))
            );
            return warnings
                .filter((warning) => warning.level !== "advice" && !told.has(warning.code))
                .map((warning) => ({
                    // why a print is paused may change while it is
                    key: JSON.stringify([warning.code, warning.values, warning.causes]),
                    text: RRFModel.warningText(warning),
                    type: TYPES[warning.level] || "error",
                    warning: warning
                }));
        });

        /** The part of a notification that has the button, for those who may press it. */
        const confirmation = function (warning) {
            if (!warning || !self.mayFix(warning.fix)) return {};
            return {
                confirm: true,
                buttons: [
                    {text: gettext("Later"), click: (notice) => notice.remove()},
                    {
                        text: words.fix[warning.fix],
                        addClass: "btn-primary",
                        click: function (notice) {
                            notice.remove();
                            self.fix(warning);
                        }
                    }
                ]
            };
        };

        const tell = (item) =>
            core.notify(item.text, item.type, {hide: false, confirm: confirmation(item.warning)});

        const update = function (items) {
            const next = new Map();
            items.forEach(function (item) {
                next.set(item.key, told.get(item.key) || tell(item));
            });
            told.forEach((notice, key) => next.has(key) || notice.remove());
            told = next;
        };
        due.subscribe(update);
    }

    OCTOPRINT_VIEWMODELS.push({
        construct: RrfModelNotificationsViewModel,
        dependencies: ["rrfModelViewModel"]
    });
});
