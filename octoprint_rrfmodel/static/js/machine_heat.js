/* Tools, beds and chambers of the sub-view Machine: their heaters, states, offsets and faults. */
$(function () {
    const NO_TOOL = -1;
    const {list, numbered, isNumber} = RRFModel;

    /** Returns the members of a view model over the model of its view. */
    RRFModel.heatRows = function (core, model) {
        const self = {};
        const words = RRFModel.words;
        const show = RRFModel.show;
        const named = RRFModel.named;

        const heat = ko.pureComputed(() => model("heat") || {});
        const move = ko.pureComputed(() => model("move") || {});
        const heaters = ko.pureComputed(() => list(heat().heaters));
        const heaterOf = (index) => heaters()[index] || {};

        //~~ tools, beds, chambers

        const stateWord = (name) => words.heater[name] || {text: name || "", label: ""};

        /** What a row shows of its heaters; of several the first one's state, or a fault. */
        const shownHeater = function (indices) {
            const faulty = indices.find((index) => heaterOf(index).state === "fault");
            const first = heaterOf(faulty === undefined ? indices[0] : faulty);
            return {
                current: indices.map((index) => show.degrees(heaterOf(index).current)).join(" / "),
                // a tool stays what it was when only its heaters are switched off (M568 A0)
                state: first.state || "",
                stateText: stateWord(first.state).text,
                min: first.min,
                max: first.max
            };
        };

        const target = (value) => (isNumber(value) && value > -273 ? value : null);

        /** One field for each heater of a tool; the others keep what they have. */
        const heaterFields = function (row, member, text) {
            const given = RRFModel.lastGiven(core, () => row[member]());
            const places = ko.pureComputed(() => _.range(row.heaterCount()));
            return ko.pureComputed(() => places().map(heaterField(row, member, text, given)));
        };
        const heaterField = (row, member, text, given) => (place) => ({
            min: ko.pureComputed(() => heaterOf(row.heaters()[place]).min),
            max: ko.pureComputed(() => heaterOf(row.heaters()[place]).max),
            value: ko.pureComputed(() => target(row[member]()[place])),
            label: ko.pureComputed(() => {
                const label = _.sprintf(text, {name: row.name()});
                return row.heaterCount() > 1 ? label + " (" + (place + 1) + ")" : label;
            }),
            send: function (value) {
                // -273 and below is how firmware says off, and no temperature to ask for
                const values = given.values().map((known) => (known <= -273 ? 0 : known));
                values[place] = value;
                return given.send(
                    values,
                    core.command("tool_temperatures", {
                        tool: row.number(),
                        [member]: values.length > 1 ? values : value
                    })
                );
            }
        });

        self.tools = RRFModel.rows(
            function () {
                const state = model("state") || {};
                const extruders = list(move().extruders);
                return numbered(model("tools")).map(function (found) {
                    const tool = found.item;
                    const offsets = list(move().axes)
                        .map((axis, place) => ({
                            letter: (axis || {}).letter,
                            offset: list(tool.offsets)[place]
                        }))
                        .filter((axis) => axis.letter && isNumber(axis.offset));
                    const count = list(tool.heaters).length;
                    const fed = extruders[list(tool.extruders)[0]] || {};
                    return Object.assign(shownHeater(list(tool.heaters)), {
                        key: found.index,
                        number: tool.number,
                        name: tool.name || _.sprintf(gettext("Tool %(number)s"), tool),
                        isSelected: state.currentTool === tool.number,
                        hasHeater: count > 0,
                        heaterCount: count,
                        heaters: list(tool.heaters),
                        active: list(tool.active).slice(0, count),
                        standby: list(tool.standby).slice(0, count),
                        filament: fed.filament || "",
                        axes: offsets.map((axis) => axis.letter).join(" "),
                        offsetOf: Object.fromEntries(
                            offsets.map((axis) => [axis.letter, axis.offset])
                        ),
                        offsets: offsets
                            .filter((axis) => axis.offset)
                            .map((axis) => axis.letter + " " + show.fixed(axis.offset, 2))
                            .join(", ")
                    });
                });
            },
            function (row) {
                row.select = () => core.command("select_tool", {tool: row.number()});
                row.activeFields = heaterFields(
                    row,
                    "active",
                    gettext("Active temperature of %(name)s")
                );
                row.standbyFields = heaterFields(
                    row,
                    "standby",
                    gettext("Standby temperature of %(name)s")
                );
                row.setState = (state) => () =>
                    core.command("tool_state", {tool: row.number(), state: state});
                row.showsOffsets = ko.observable(false);
                row.toggleOffsets = () => row.showsOffsets(!row.showsOffsets());
                row.offsetFields = ko.pureComputed(() =>
                    row.showsOffsets() && row.axes()
                        ? row.axes().split(" ").map((letter) => ({
                              letter: letter,
                              value: ko.pureComputed(() => row.offsetOf()[letter]),
                              label: _.sprintf(gettext("Offset of %(axis)s in mm"), {axis: letter}),
                              send: (value) =>
                                  core.command("tool_offsets", {
                                      tool: row.number(),
                                      offsets: {[letter]: value}
                                  })
                          }))
                        : []
                );
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
                const active = RRFModel.lastGiven(core, () => [row.active()]);
                row.setActive = (value) => active.send([value], send({active: value}));
                row.setStandby = (value) => send({standby: value});
                // what only switches a chamber on is its temperature, which the server takes from
                // its model
                row.setState = (state) => function () {
                    const [known] = active.values();
                    const needsTarget = state === "active" && row.command() === "chamber";
                    send({state: state, active: needsTarget && isNumber(known) ? known : null});
                };
                row.activeLabel = named(row, gettext("Active temperature of %(name)s"));
                row.standbyLabel = named(row, gettext("Standby temperature of %(name)s"));
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
        return self;
    };
});
