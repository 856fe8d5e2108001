/* The sub-view Machine, above: tools, beds, chambers, fans, axes and factors. */
$(function () {
    const JOG_STEPS = [0.05, 0.1, 1, 10, 50];
    const BABYSTEPS = [-0.1, -0.05, -0.02, 0.02, 0.05, 0.1];
    const NO_TOOL = -1;

    const list = (value) => (Array.isArray(value) ? value : []);

    /** Elements of an array of the model with their indices, gaps left out. */
    const numbered = (value) =>
        list(value)
            .map((item, index) => ({item: item, index: index}))
            .filter((found) => !!found.item);

    /** Whether temperatures rule a fan; its sensors were heaters before 3.4. */
    const isThermostatic = (thermostatic) =>
        list(thermostatic.sensors || thermostatic.heaters).length > 0;

    function RrfModelMachineViewModel(parameters) {
        const self = this;
        const core = parameters[0];
        const model = core.modelOfView("machine");
        const words = RRFModel.words;
        const show = RRFModel.show;

        self.isShown = ko.pureComputed(() => core.isRrf() && core.view() === "machine");
        self.mayControl = core.mayControl;

        const heat = ko.pureComputed(() => model("heat") || {});
        const move = ko.pureComputed(() => model("move") || {});
        const heaters = ko.pureComputed(() => list(heat().heaters));
        const heaterOf = (index) => heaters()[index] || {};

        //~~ tools, beds, chambers

        const stateWord = (name) => words.heater[name] || {text: name || "", label: ""};

        /** What a row shows of the first of its heaters, which rule it together. */
        const shownHeater = function (indices) {
            const first = heaterOf(indices[0]);
            return {
                current: indices.map((index) => show.degrees(heaterOf(index).current)).join(" / "),
                // a tool stays what it was when only its heaters are switched off (M568 A0)
                state: first.state || "",
                stateText: stateWord(first.state).text,
                min: first.min,
                max: first.max,
                faults: indices.filter((index) => heaterOf(index).state === "fault")
            };
        };

        /** A value for each of several heaters is shown by the first. */
        const firstOf = (value) => (Array.isArray(value) ? value[0] : value);
        const target = (value) =>
            typeof firstOf(value) === "number" && firstOf(value) > -273 ? firstOf(value) : null;

        self.tools = RRFModel.rows(
            function () {
                const state = model("state") || {};
                const extruders = list(move().extruders);
                return numbered(model("tools")).map(function (found) {
                    const tool = found.item;
                    const offsets = list(move().axes)
                        .map((axis, place) => ({
                            letter: axis.letter,
                            offset: list(tool.offsets)[place]
                        }))
                        .filter((axis) => axis.offset)
                        .map((axis) => axis.letter + " " + show.fixed(axis.offset, 2));
                    const fed = extruders[list(tool.extruders)[0]] || {};
                    return Object.assign(shownHeater(list(tool.heaters)), {
                        key: found.index,
                        number: tool.number,
                        name: tool.name || _.sprintf(gettext("Tool %(number)s"), tool),
                        isSelected: state.currentTool === tool.number,
                        hasHeater: list(tool.heaters).length > 0,
                        active: target(tool.active),
                        standby: target(tool.standby),
                        filament: fed.filament || "",
                        offsets: offsets.join(", ")
                    });
                });
            },
            function (row) {
                row.select = () => core.command("select_tool", {tool: row.number()});
                row.setActive = (value) =>
                    core.command("tool_temperatures", {tool: row.number(), active: value});
                row.setStandby = (value) =>
                    core.command("tool_temperatures", {tool: row.number(), standby: value});
                row.setState = (state) => () =>
                    core.command("tool_state", {tool: row.number(), state: state});
                row.activeLabel = _.sprintf(gettext("Active temperature of %(name)s"), {
                    name: row.name()
                });
                row.standbyLabel = _.sprintf(gettext("Standby temperature of %(name)s"), {
                    name: row.name()
                });
            }
        );

        self.noTool = ko.pureComputed(() => (model("state") || {}).currentTool === NO_TOOL);
        self.deselect = () => core.command("select_tool", {tool: NO_TOOL});

        self.slots = RRFModel.rows(
            function () {
                return [
                    {command: "bed", indices: heat().bedHeaters, title: gettext("Bed")},
                    {command: "chamber", indices: heat().chamberHeaters, title: gettext("Chamber")}
                ].flatMap((kind) =>
                    numbered(list(kind.indices).map((index) => heaters()[index])).map((found) =>
                        Object.assign(shownHeater([kind.indices[found.index]]), {
                            key: kind.command + found.index,
                            command: kind.command,
                            index: found.index,
                            name: found.index ? kind.title + " " + found.index : kind.title,
                            hasStandby: kind.command === "bed",
                            active: target(found.item.active),
                            standby: target(found.item.standby)
                        })
                    )
                );
            },
            function (row) {
                const send = (values) =>
                    core.command(row.command(), Object.assign({index: row.index()}, values));
                row.setActive = (value) => send({active: value});
                row.setStandby = (value) => send({standby: value});
                row.setState = (state) => () => send({state: state});
                row.activeLabel = _.sprintf(gettext("Active temperature of %(name)s"), {
                    name: row.name()
                });
                row.standbyLabel = _.sprintf(gettext("Standby temperature of %(name)s"), {
                    name: row.name()
                });
            }
        );

        self.faults = RRFModel.rows(
            () =>
                numbered(heaters())
                    .filter((found) => found.item.state === "fault")
                    .map((found) => ({
                        key: found.index,
                        text: _.sprintf(gettext("Heater %(number)s reports a fault."), {
                            number: found.index
                        })
                    })),
            function (row) {
                row.reset = () => core.command("reset_heater_fault", {heater: row.key});
            }
        );

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
                row.label = _.sprintf(gettext("Speed of %(name)s in percent"), {name: row.name()});
            }
        );

        //~~ axes

        self.jogSteps = JOG_STEPS;
        self.jogStep = ko.observable(1);
        self.pickStep = (step) => self.jogStep(step);

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
                        min: found.item.min,
                        max: found.item.max,
                        limits: show.fixed(found.item.min, 0) + " … " + show.fixed(found.item.max, 0)
                    })),
            function (row) {
                row.letter = row.key;
                row.jog = (direction) => () =>
                    core.command("jog", {axes: {[row.key]: direction * self.jogStep()}});
                row.goTo = (position) =>
                    core.command("jog", {axes: {[row.key]: position}, absolute: true});
                row.home = () => core.command("home", {axes: [row.key]});
                const named = (text) => _.sprintf(text, {axis: row.key});
                row.homeLabel = named(gettext("Home %(axis)s"));
                row.plusLabel = named(gettext("Move %(axis)s forward"));
                row.minusLabel = named(gettext("Move %(axis)s back"));
                row.goLabel = named(gettext("Move %(axis)s to a position in mm"));
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
            typeof fraction === "number" ? Math.round(fraction * 100) : null;

        self.speedFactor = ko.pureComputed(() => percentOf(move().speedFactor));
        self.setSpeedFactor = (percent) => core.command("speed_factor", {percent: percent});
        self.extruders = RRFModel.rows(
            () =>
                numbered(move().extruders).map((found) => ({
                    key: found.index,
                    name: _.sprintf(gettext("Extruder %(number)s"), {number: found.index}),
                    percent: percentOf(found.item.factor),
                    position: show.fixed(found.item.position, 1),
                    filament: found.item.filament || "",
                    pressure: found.item.pressureAdvance
                })),
            function (row) {
                row.set = (percent) =>
                    core.command("extrusion_factor", {extruder: row.key, percent: percent});
                row.label = _.sprintf(gettext("Extrusion factor of %(name)s"), {name: row.name()});
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
