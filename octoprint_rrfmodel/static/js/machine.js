/* The sub-view Machine, above: fans, axes and factors, behind its heaters. */
$(function () {
    const JOG_STEPS = [0.05, 0.1, 1, 10, 50];
    const BABYSTEPS = [-0.1, -0.05, -0.02, 0.02, 0.05, 0.1];
    const {list, numbered, isNumber} = RRFModel;

    /** Whether temperatures rule a fan; its sensors were heaters before 3.4. */
    const isThermostatic = (thermostatic) =>
        list(thermostatic.sensors || thermostatic.heaters).length > 0;

    function RrfModelMachineViewModel(parameters) {
        const self = this;
        const core = parameters[0];
        const model = core.modelOfView("machine");
        const show = RRFModel.show;

        self.isShown = ko.pureComputed(() => core.isRrf() && core.view() === "machine");
        self.mayControl = core.mayControl;

        const named = RRFModel.named;
        const move = ko.pureComputed(() => model("move") || {});

        Object.assign(self, RRFModel.heatRows(core, model));

        //~~ fans

        self.fans = RRFModel.rows(
            () =>
                numbered(model("fans")).map((found) => ({
                    key: found.index,
                    name: found.item.name || _.sprintf(gettext("Fan %(number)s"), {number: found.index}),
                    speed: Math.round((found.item.requestedValue || 0) * 100),
                    actual: show.percent(found.item.actualValue),
                    rpm: found.item.rpm >= 0 ? found.item.rpm + " " + gettext("rpm") : "",
                    isThermostatic: isThermostatic(found.item.thermostatic || {})
                })),
            function (row) {
                row.set = (percent) => core.command("fan", {fan: row.key, speed: percent / 100});
                row.label = named(row, gettext("Speed of %(name)s in percent"));
            }
        );

        //~~ axes

        self.jogSteps = JOG_STEPS;
        self.jogStep = ko.observable(1);
        self.pickStep = (step) => self.jogStep(step);
        /** In mm/min, as the firmware counts; an axis goes no faster than it can. */
        self.jogSpeed = ko.observable(6000);
        const jog = function (axes, more) {
            const speed = Number(self.jogSpeed());
            const values = speed > 0 ? {axes: axes, speed: speed} : {axes: axes};
            return core.command("jog", Object.assign(values, more));
        };

        self.axes = RRFModel.rows(
            () =>
                numbered(move().axes)
                    .filter((found) => found.item.letter && found.item.visible !== false)
                    .map((found) => ({
                        // A and a are two axes
                        key: found.item.letter,
                        homed: !!found.item.homed,
                        user: show.fixed(found.item.userPosition, 2),
                        machine: show.fixed(found.item.machinePosition, 2),
                        limits: show.fixed(found.item.min, 0) + " … " + show.fixed(found.item.max, 0)
                    })),
            function (row) {
                row.letter = row.key;
                row.jog = (direction) => () => jog({[row.key]: direction * self.jogStep()});
                row.goTo = (position) => jog({[row.key]: position}, {absolute: true});
                row.home = () => core.command("home", {axes: [row.key]});
                const ofAxis = (text) => _.sprintf(text, {axis: row.key});
                row.homeLabel = ofAxis(gettext("Home %(axis)s"));
                row.plusLabel = ofAxis(gettext("Move %(axis)s forward"));
                row.minusLabel = ofAxis(gettext("Move %(axis)s back"));
                row.goLabel = ofAxis(gettext("Move %(axis)s to a position in mm"));
                row.homedText = ko.pureComputed(() =>
                    row.homed() ? gettext("homed") : gettext("not homed")
                );
            }
        );
        self.homeAll = () => core.command("home", {axes: []});

        //~~ baby step, factors, extrusion

        self.babystep = ko.pureComputed(function () {
            const z = list(move().axes).find((axis) => axis && axis.letter === "Z");
            return z ? show.fixed(z.babystep, 3) : "–";
        });
        self.babysteps = BABYSTEPS.map((amount) => ({
            text: (amount > 0 ? "+" : "") + amount,
            label: _.sprintf(gettext("Baby step of %(amount)s mm"), {amount: amount}),
            step: () => core.command("babystep", {axis: "Z", amount: amount})
        }));
        self.clearBabystep = () =>
            core.command("babystep", {axis: "Z", amount: 0, absolute: true});

        const percentOf = (fraction) =>
            isNumber(fraction) ? Math.round(fraction * 100) : null;

        self.speedFactor = ko.pureComputed(() => percentOf(move().speedFactor));
        self.setSpeedFactor = (percent) => core.command("speed_factor", {percent: percent});
        self.extruders = RRFModel.rows(
            () =>
                numbered(move().extruders).map((found) => ({
                    key: found.index,
                    name: _.sprintf(gettext("Extruder %(number)s"), {number: found.index}),
                    percent: percentOf(found.item.factor)
                })),
            function (row) {
                row.set = (percent) =>
                    core.command("extrusion_factor", {extruder: row.key, percent: percent});
                row.label = named(row, gettext("Extrusion factor of %(name)s"));
            }
        );

        self.extrudeLength = ko.observable(10);
        self.extrudeSpeed = ko.observable(300);
        const extrude = (sign) => () =>
            core.command("extrude", {
                amounts: sign * Number(self.extrudeLength()),
                speed: Number(self.extrudeSpeed())
            });
        self.extrude = extrude(1);
        self.retract = extrude(-1);
    }

    OCTOPRINT_VIEWMODELS.push({
        construct: RrfModelMachineViewModel,
        dependencies: ["rrfModelViewModel"],
        elements: ["#rrfmodel_machine"]
    });
});
