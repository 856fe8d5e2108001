/* The sub-view Machine, below: what the machine has besides heaters, fans and axes. */
$(function () {
    const MACROS = "0:/macros";
    const FILAMENTS = "0:/filaments";
    const NEW_MS = 500;

    const {list, numbered, object, isNumber} = RRFModel;

    /** A folder of the card that is listed when it is asked for, and opens into those below. */
    function Folder(core, root) {
        const self = this;
        self.path = ko.observable(root);
        self.entries = ko.observableArray();
        self.isOpen = ko.observable(false);
        self.isReading = ko.observable(false);
        self.isRoot = ko.pureComputed(() => self.path() === root);
        /** Too new to be picked from: the second half of a double click would run a macro. */
        self.isNew = ko.observable(false);
        let generation = 0;
        let settling;

        const read = function (path) {
            const asked = (generation += 1);
            self.isReading(true);
            OctoPrint.plugins.rrfmodel
                .getFiles(path)
                .done(function (found) {
                    if (asked !== generation) return;
                    self.path(path);
                    self.entries(
                        found.entries.sort(
                            (one, other) =>
                                other.folder - one.folder || one.name.localeCompare(other.name)
                        )
                    );
                    self.isOpen(true);
                    self.isNew(true);
                    window.clearTimeout(settling);
                    settling = window.setTimeout(() => self.isNew(false), NEW_MS);
                })
                .fail(core.tellRefusal)
                .always(() => asked === generation && self.isReading(false));
        };
        self.show = () => (self.isOpen() ? self.isOpen(false) : read(root));
        self.enter = (entry) => read(self.path() + "/" + entry.name);
        self.up = () => read(self.path().slice(0, self.path().lastIndexOf("/")));
        self.pathOf = (entry) => self.path() + "/" + entry.name;

        // the next machine has a card of its own
        const close = function () {
            generation += 1;
            self.isReading(false);
            self.isOpen(false);
        };
        core.isRrf.subscribe(close);
        core.resets.subscribe(close);
    }

    function RrfModelMachinePartsViewModel(parameters) {
        const self = this;
        const core = parameters[0];
        const model = core.modelOfView("machine");
        const show = RRFModel.show;

        self.isShown = ko.pureComputed(() => core.isRrf() && core.view() === "machine");
        self.mayControl = core.mayControl;

        const sensors = ko.pureComputed(() => object(model("sensors")));
        const state = ko.pureComputed(() => object(model("state")));
        const move = ko.pureComputed(() => object(model("move")));
        const yesNo = (value) => (value ? gettext("triggered") : gettext("open"));
        const MONITORS = {
            noMonitor: gettext("no monitor"),
            ok: gettext("ok"),
            noDataReceived: gettext("no data yet"),
            noFilament: gettext("no filament"),
            tooLittleMovement: gettext("too little movement"),
            tooMuchMovement: gettext("too much movement"),
            sensorError: gettext("sensor error")
        };
        const HARMLESS = ["", "ok", "noDataReceived", "noMonitor"];
        const SPINDLES = {
            stopped: gettext("stopped"),
            forward: gettext("forward"),
            reverse: gettext("reverse")
        };

        self.endstops = RRFModel.rows(() =>
            numbered(sensors().endstops).map((found) => ({
                key: found.index,
                name: object(list(move().axes)[found.index]).letter || String(found.index),
                text: yesNo(found.item.triggered),
                isTriggered: !!found.item.triggered
            }))
        );

        self.probes = RRFModel.rows(() =>
            numbered(sensors().probes).map((found) => ({
                key: found.index,
                name: _.sprintf(gettext("Probe %(number)s"), {number: found.index}),
                value: list(found.item.value).join(" / "),
                offsets: list(found.item.offsets)
                    .map((offset) => show.fixed(offset, 2))
                    .join(", "),
                height: show.fixed(found.item.triggerHeight, 3)
            }))
        );

        self.monitors = RRFModel.rows(() =>
            numbered(sensors().filamentMonitors).map((found) => ({
                key: found.index,
                name: _.sprintf(gettext("Extruder %(number)s"), {number: found.index}),
                type: found.item.type || "",
                status: MONITORS[found.item.status] || found.item.status || "",
                isBad: !HARMLESS.includes(found.item.status || "")
            }))
        );

        //~~ spindles, laser, power

        self.spindles = RRFModel.rows(
            () =>
                numbered(model("spindles"))
                    .filter((found) => found.item.state !== "unconfigured")
                    .map((found) => ({
                        key: found.index,
                        name: _.sprintf(gettext("Spindle %(number)s"), {number: found.index}),
                        current: show.fixed(found.item.current, 0),
                        active: found.item.active,
                        state: SPINDLES[found.item.state] || found.item.state || "",
                        turnsBack: found.item.state === "reverse",
                        // told from 3.5 on
                        canReverse: found.item.canReverse !== false,
                        max: found.item.max
                    })),
            function (row) {
                row.label = _.sprintf(gettext("Speed of %(name)s in rpm"), {name: row.name()});
                /** What somebody has chosen, until the machine turns that way. */
                const wanted = ko.observable(null);
                let isSent = false;
                row.isReverse = ko.pureComputed({
                    read: () => (wanted() === null ? row.turnsBack() : wanted()),
                    write: function (isReverse) {
                        // while the machine is to turn another way, its present one says nothing
                        const isNew = isSent || isReverse !== row.turnsBack();
                        isSent = false;
                        wanted(isNew ? isReverse : null);
                    }
                });
                const asItTurns = function () {
                    isSent = false;
                    wanted(null);
                };
                row.turnsBack.subscribe(function (turnsBack) {
                    if (isSent || turnsBack === wanted()) asItTurns();
                });
                row.set = function (rpm) {
                    isSent = wanted() !== null;
                    return core.command("spindle", {
                        spindle: row.key,
                        rpm: rpm,
                        direction: row.isReverse() ? "reverse" : "forward"
                    });
                };
                row.stop = function () {
                    asItTurns();
                    core.command("spindle", {spindle: row.key, rpm: 0});
                };
            }
        );
        self.laser = ko.pureComputed(() =>
            state().machineMode === "Laser" ? show.percent(object(move().currentMove).laserPwm) : ""
        );

        self.hasPower = ko.pureComputed(() => typeof state().atxPower === "boolean");
        self.isOn = ko.pureComputed(() => state().atxPower === true);
        self.powerText = ko.pureComputed(() => (self.isOn() ? gettext("on") : gettext("off")));
        self.switchOn = () => core.command("power", {on: true});
        self.switchOff = () =>
            core.confirm(
                gettext("Switch the power off?"),
                gettext("Heaters and motors lose their power."),
                gettext("Switch off"),
                () => core.command("power", {on: false})
            );

        //~~ mesh, kinematics, calibration

        const compensation = ko.pureComputed(() => object(move().compensation));
        const COMPENSATIONS = {
            none: gettext("none"),
            mesh: gettext("mesh"),
            point: gettext("points")
        };
        self.meshType = ko.pureComputed(
            () => COMPENSATIONS[compensation().type] || compensation().type || "–"
        );
        self.meshFile = ko.pureComputed(() => compensation().file || "");
        self.meshDeviation = ko.pureComputed(function () {
            const deviation = object(compensation().meshDeviation);
            return typeof deviation.mean !== "number"
                ? ""
                : _.sprintf(gettext("mean %(mean)s mm, deviation %(deviation)s mm"), {
                      mean: show.fixed(deviation.mean, 3),
                      deviation: show.fixed(deviation.deviation, 3)
                  });
        });
        self.mesh = (action) => () => core.command("mesh", {action: action});

        self.kinematics = ko.pureComputed(() => object(move().kinematics).name || "–");
        self.calibration = ko.pureComputed(function () {
            const found = object(move().calibration);
            const final = object(found.final);
            return found.numFactors && isNumber(final.deviation)
                ? _.sprintf(gettext("%(factors)s factors, deviation %(deviation)s mm"), {
                      factors: found.numFactors,
                      deviation: show.fixed(final.deviation, 3)
                  })
                : "";
        });

        Object.assign(self, RRFModel.machineFacts(core, model));

        //~~ macros, filaments

        self.macros = new Folder(core, MACROS);
        self.pickMacro = (entry) =>
            entry.folder
                ? self.macros.enter(entry)
                : core.command("macro", {path: self.macros.pathOf(entry)});

        self.filaments = new Folder(core, FILAMENTS);
        self.filamentNames = ko.pureComputed(() =>
            self.filaments.entries().filter((entry) => entry.folder)
        );
        self.loadLabel = (entry) => _.sprintf(gettext("Load %(name)s"), {name: entry.name});
        self.load = (entry) => core.command("filament", {action: "load", name: entry.name});
        self.unload = () => core.command("filament", {action: "unload"});
    }

    OCTOPRINT_VIEWMODELS.push({
        construct: RrfModelMachinePartsViewModel,
        dependencies: ["rrfModelViewModel"],
        elements: ["#rrfmodel_machine_parts"]
    });
});
